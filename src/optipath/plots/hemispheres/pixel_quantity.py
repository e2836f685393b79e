"""PixelQuantity: what pictures show of each pixel of a hemisphere."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import shown, unknown
from optipath.plots.colour_scale import ColourScale

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    from optipath.plots.hemispheres.seen_side import SeenSide

    Numbers = npt.NDArray[np.float64]


class KnownPixels(NamedTuple):
    """What is known of the pixels of a side.

    Shape: values, errors (rows, columns).
    """

    values: Numbers
    errors: Numbers
    unknown: str = "no light"

    @property
    def largest(self) -> float:
        """The largest size among the values, 1 where all are 0 or NaN."""
        return largest_of(self.values)


class PixelQuantity(NamedTuple):
    """What pictures show of each pixel of a hemisphere."""

    variable: str
    name: str
    unit: str
    of: Callable[[SeenSide, Mapping[str, Any]], KnownPixels]
    scale: Callable[[float], ColourScale]
    known_to: float = np.inf
    masked: tuple[str, ...] = ()
    over_wavelengths: bool = False

    @property
    def is_bounded(self) -> bool:
        """Whether its colours are those of all values that it can have."""
        return self.scale in (_share, _axis)

    def faults_of(self, mask: Any) -> list[str]:
        """Return sentences for what is no mask of it.

        Examples
        --------
        >>> QUANTITIES[0].faults_of({"noise": None})
        ['mask is given, but S0 has none; leave it out']
        """
        if not self.masked and (not isinstance(mask, Mapping | None) or mask):
            return [f"mask is given, but {self.variable} has none; leave it out"]
        if not isinstance(mask, Mapping | None):
            return [f"mask is {shown(mask)}; give a mapping, such as {{'brighter_than': 0.5}}"]
        return [fault for key in mask or {} for fault in unknown("mask", key, self.masked)]

    @property
    def label(self) -> str:
        """What it is, with its unit."""
        return f"{self.name} ({self.unit})" if self.unit else self.name

    def known(
        self, seen: SeenSide, known_to: float | None, mask: Mapping[str, Any] | None
    ) -> KnownPixels:
        """Return what is known of the pixels of a side."""
        limit = self.known_to if known_to is None else known_to
        found = self.of(seen, mask or {})
        if np.isinf(limit):
            return found
        # An error that is not known is one of too little light.
        values = np.where(found.errors <= limit, found.values, np.nan)
        return found._replace(
            values=values, unknown=f"{found.unknown}, or not known to {limit:g}{self.unit}"
        )


def _component(number: int, seen: SeenSide, _mask: Mapping[str, Any]) -> KnownPixels:
    found, area = seen.measured.stokes(seen.source), seen.measured.sensor.solid_angle
    value, error = (seen.pixels(each[..., number]) for each in (found.values, found.se.values))
    with np.errstate(invalid="ignore", divide="ignore"):
        return KnownPixels(value / area, error / area)


def _state(name: str, unit: float, seen: SeenSide, _mask: Mapping[str, Any]) -> KnownPixels:
    found = getattr(seen.measured, name)(seen.source)
    return KnownPixels(unit * seen.pixels(found.values), unit * seen.pixels(found.se.values))


def _effect(name: str, seen: SeenSide, mask: Mapping[str, Any]) -> KnownPixels:
    found = getattr(seen.measured, name)(seen.side, **mask)
    place = (..., seen.place) if "wavelength" in found.dims else ...
    value, error = (100.0 * each.values[place] for each in (found, found.se))
    return KnownPixels(value, error, f"masked; seen are pixels of {found.attrs['mask']}")


def _share(_largest: float) -> ColourScale:
    return ColourScale.share()


def _axis(_largest: float) -> ColourScale:
    return ColourScale.axis()


_light, _signed = ColourScale.light, ColourScale.signed_light
_dop, _dolp = partial(_state, "dop", 1.0), partial(_state, "dolp", 1.0)
_aop = partial(_state, "aop", float(np.degrees(1.0)))
_difference = partial(_effect, "relative_difference")
_adm, _mdm = partial(_effect, "adm"), partial(_effect, "mdm")

_MASK = "brighter_than", "noise", "known_to"
_OVER_ALL: dict[str, Any] = {"masked": _MASK, "over_wavelengths": True}

QUANTITIES = (
    PixelQuantity("S0", "S0", "1/sr", partial(_component, 0), _light),
    PixelQuantity("S1", "S1", "1/sr", partial(_component, 1), _signed),
    PixelQuantity("S2", "S2", "1/sr", partial(_component, 2), _signed),
    PixelQuantity("S3", "S3", "1/sr", partial(_component, 3), _signed),
    PixelQuantity("DoP", "degree of polarisation", "", _dop, _share, 0.1),
    PixelQuantity("DoLP", "degree of linear polarisation", "", _dolp, _share, 0.1),
    PixelQuantity("AoP", "angle of polarisation", "°", _aop, _axis, 10.0),
    PixelQuantity(
        "difference", "S0 / U - 1", "%", _difference, ColourScale.signed, masked=_MASK[:1]
    ),
    PixelQuantity("ADM", "mean of |S0 - U| / U", "%", _adm, ColourScale.share, **_OVER_ALL),
    PixelQuantity("MDM", "largest |S0 - U| / U", "%", _mdm, ColourScale.share, **_OVER_ALL),
)


def largest_of(values: Numbers) -> float:
    """Return the largest size among values, 1 where all are 0 or NaN."""
    return float(np.nanmax(np.abs(values), initial=0.0)) or 1.0
