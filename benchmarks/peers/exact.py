"""The error of light that was found, against the same paths in 50 digits."""

import numpy as np

import optipath as op
from optipath.lab.path_reference import exact_batch

SAMPLES = 200


class Exact:
    """Exact light of some of the paths, computed once for each number of paths."""

    def __init__(self, angles, materials):
        self.angles = angles
        self.graph = op.load_preset("npgr026", filter="horizontal", **materials._asdict()).graph
        self.known = {}

    def error(self, found):
        """Return the largest |found - exact| / S0 of any component of the sampled paths."""
        where = np.linspace(0, len(found) - 1, SAMPLES).astype(int)
        errors = [
            float(abs(float(component) - exact) / light[0])
            for stokes, light in zip(found[where], self.lights(len(found), where), strict=True)
            for component, exact in zip(stokes, light, strict=True)
        ]
        # Unlike Python's, NumPy's maximum of what is not a number is not a number.
        return float(np.max(errors))

    def lights(self, count, where):
        if count not in self.known:
            batch = exact_batch(self.graph, **self.angles.at(where)._asdict())
            self.known[count] = [ends["E"].stokes for ends in batch]
        return self.known[count]
