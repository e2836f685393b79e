"""Random paths in which values follow from the wavelength, and their light run by run."""

import numpy as np

import optipath as op
from optipath.values.curve import Curve
from optipath.values.curve_value import curve_values
from random_paths import Draw


class Ramps(Curve):
    """A number that rises from its least value to its largest, stays at the least, and again."""

    label = "ramps"
    span = (1e-7, 1e-5)

    def __init__(self, low, high, period):
        object.__setattr__(self, "numbers_of", (float(low), float(high), float(period)))

    @property
    def content(self):
        return ("ramps", *self.numbers_of)

    def numbers(self, xp, wavelength):
        low, high, period = self.numbers_of
        turns = wavelength / period
        rise = xp.maximum(0.0, 1.5 * (turns - xp.floor(turns)) - 0.5)
        return (xp.minimum(low + (high - low) * rise, high),)


class SpectralDraw(Draw):
    """Draws a path of which values are ramps of the wavelength, and parameters among them."""

    def __init__(self, seed):
        super().__init__(seed, arrays=False)
        self.wavelength = op.Wavelength()

    def number(self, low, high):
        if self.chance(0.4):
            self.values["wavelength"] = 5e-7
            period = self.rng.uniform(2e-8, 3e-7)
            (value,) = curve_values(Ramps(low, high, period), self.wavelength)
            return value
        return super().number(low, high)

    def index(self):
        return op.Material(self.number(0.3, 3), self.number(0, 3))

    def spectral_path(self):
        """A path, and the values of its parameters but for the wavelength."""
        while True:
            path = self.path()
            if self.values.pop("wavelength", None):
                return path, self.values


def wavelengths(count):
    """Wavelengths at which some numbers are at the ends of what they may be."""
    return np.linspace(4e-7, 7e-7, count)


def run_by_run(plan, values, shape):
    """The light of each path of a batch by a run of its own, shape (..., 4) by its end."""
    several = {name: np.broadcast_to(value, shape) for name, value in values.items()}
    found = {}
    for place in np.ndindex(*shape):
        lights = plan.run_all(**{name: float(value[place]) for name, value in several.items()})
        for name, light in lights.items():
            found.setdefault(name, np.empty((*shape, 4)))[place] = light.stokes
    return found
