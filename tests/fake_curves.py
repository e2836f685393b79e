"""Curves with a closed form, for tests."""

from optipath.materials.quantities import REAL
from optipath.values.curve import Curve
from optipath.values.curve_value import curve_values
from optipath.values.wavelength import Wavelength


class Metal(Curve):
    """An index that falls and an extinction that grows along the wavelength."""

    parts = ("n", "k")
    label = "a metal"
    span = (300e-9, 800e-9)
    beyond = "take another metal"

    def __init__(self, slope=2e6):
        vars(self)["slope"] = slope

    @property
    def content(self):
        return ("metal",)

    def arguments(self):
        return [("slope", self.slope, REAL)]

    def numbers(self, xp, wavelength, slope):
        return 2.0 - slope * wavelength, 1.0 + xp.sqrt(wavelength * 1e6)


def metal(slope=2e6, wavelength=None):
    """n and k of it, open along the wavelength."""
    return curve_values(Metal(slope), Wavelength() if wavelength is None else wavelength)
