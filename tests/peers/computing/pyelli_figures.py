"""Figures of pyElli: pip install pyElli. Its matrices are over M00."""

import elli
import numpy as np
import setups


def result(setup):
    n, k, outside, _ = setups.incidence(setup)
    before, behind = (
        elli.IsotropicMaterial(elli.ConstantRefractiveIndex(index))
        for index in (outside, complex(n, k))
    )
    sample = elli.Structure(before, [], behind)
    return sample.evaluate(np.array([500.0]), setup["incidence"], solver=elli.Solver4x4)


def angles(setup):
    found = result(setup)
    return np.radians([found.psi[0], found.delta[0]])


def over_m00(setup):
    return result(setup).mueller_matrix[0]


if __name__ == "__main__":
    kinds = {"normalized_reflection": over_m00, "psi_delta": angles}
    setups.write("pyelli", "pyElli", __file__, 1e-12, **kinds)
