"""PixelQuantity: what pictures show of each pixel of a hemisphere."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import SurfaceError, unknown
from optipath.plots.colour_scale import ColourScale

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    from optipath.plots.seen_side import SeenSide

    Numbers = npt.NDArray[np.float64]


class PixelQuantity(NamedTuple):
    """What pictures show of each pixel of a hemisphere.

    Attributes
    ----------
    variable : str
        What it is called.
    label : str
        That, with its unit, as colour bars have it.
    of : callable
        Returns it for a `SeenSide`, with its standard errors: arrays of shape (rows, columns), NaN
        beyond the horizon and where nothing is known of it.
    scale : callable
        Returns its `ColourScale` for the largest of its sizes.
    known_to : float
        The standard error up to which a pixel is shown.
    unknown : str
        What pixels are of which nothing is known.
    """

    variable: str
    label: str
    of: Callable[[SeenSide], tuple[Numbers, Numbers]]
    scale: Callable[[float], ColourScale]
    known_to: float = np.inf
    unknown: str = "no light"

    def known(self, seen: SeenSide, known_to: float | None) -> tuple[Numbers, str]:
        """Return what is known of each pixel, NaN of the others, and what these others are.

        Parameters
        ----------
        seen : SeenSide
            The pixels.
        known_to : float or None
            The largest standard error; None is the usual one.

        Returns
        -------
        values : ndarray, shape (rows, columns)
        unknown : str
            What pixels are without a value.
        """
        limit = self.known_to if known_to is None else known_to
        value, error = self.of(seen)
        if np.isinf(limit):
            return value, self.unknown
        # An error that is not known is one of too little light.
        return np.where(error <= limit, value, np.nan), f"{self.unknown}, or not known to {limit:g}"


def _component(number: int, seen: SeenSide) -> tuple[Numbers, Numbers]:
    found, area = seen.measured.stokes(seen.source), seen.measured.sensor.solid_angle
    value, error = (seen.pixels(each[..., number]) for each in (found.values, found.se.values))
    with np.errstate(invalid="ignore", divide="ignore"):
        return value / area, error / area


def _by_method(name: str, unit: float, seen: SeenSide) -> tuple[Numbers, Numbers]:
    found = getattr(seen.measured, name)(seen.source)
    return unit * seen.pixels(found.values), unit * seen.pixels(found.se.values)


def _share(_largest: float) -> ColourScale:
    return ColourScale.share()


def _axis(_largest: float) -> ColourScale:
    return ColourScale.axis()


_light, _signed = ColourScale.light, ColourScale.signed_light
_dop, _dolp = partial(_by_method, "dop", 1.0), partial(_by_method, "dolp", 1.0)
_aop = partial(_by_method, "aop", float(np.degrees(1.0)))

QUANTITIES = (
    PixelQuantity("S0", "S0 (1/sr)", partial(_component, 0), _light),
    PixelQuantity("S1", "S1 (1/sr)", partial(_component, 1), _signed),
    PixelQuantity("S2", "S2 (1/sr)", partial(_component, 2), _signed),
    PixelQuantity("S3", "S3 (1/sr)", partial(_component, 3), _signed),
    PixelQuantity("DoP", "degree of polarisation", _dop, _share, 0.1),
    PixelQuantity("DoLP", "degree of linear polarisation", _dolp, _share, 0.1),
    PixelQuantity("AoP", "angle of polarisation (°)", _aop, _axis, 10.0),
)


def quantity_named(name: Any) -> PixelQuantity:
    """Return the quantity of a name.

    Parameters
    ----------
    name : str
        Such as ``"S0"`` or ``"DoLP"``.

    Returns
    -------
    PixelQuantity

    Raises
    ------
    SurfaceError
        If none is called so.

    Examples
    --------
    >>> quantity_named("AoP").label
    'angle of polarisation (°)'
    """
    names = [each.variable for each in QUANTITIES]
    if faults := unknown("quantity", name, names):
        raise SurfaceError(*faults)
    return QUANTITIES[names.index(name)]


def largest_of(values: Numbers) -> float:
    """Return the largest size among values, 1 where all are 0 or NaN."""
    return float(np.nanmax(np.abs(values), initial=0.0)) or 1.0
