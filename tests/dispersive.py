"""Numbers that follow from the wavelength, for tests: along a straight line, without any table."""

from dataclasses import dataclass

import numpy as np

import optipath as op
from optipath.values.curve import Curve
from optipath.values.curve_value import curve_values

SHORT, LONG = 4e-7, 7e-7
GRID = np.array([4e-7, 4.6e-7, 5.5e-7, 7e-7])


@dataclass(frozen=True, eq=False)
class Line(Curve):
    """Numbers along a straight line from 400 nm to 700 nm."""

    first: float
    last: float
    label: str = "a line"
    span: tuple[float, float] = (SHORT, LONG)

    @property
    def content(self):
        return self.label, self.first, self.last

    def numbers(self, _xp, wavelength, *_arguments):
        return (self.first + (self.last - self.first) * (wavelength - SHORT) / (LONG - SHORT),)


def line(first, last, wavelength=None):
    """A value that goes from the first at 400 nm to the last at 700 nm."""
    return curve_values(Line(first, last), op.Wavelength() if wavelength is None else wavelength)[0]


def on_line(first, last, wavelength):
    """The number of it at a wavelength, in metres."""
    return first + (last - first) * (np.asarray(wavelength) - SHORT) / (LONG - SHORT)
