"""One side of measured samples, and the quantities of their pixels."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

import numpy as np

from optipath.errors import SurfaceError
from optipath.faults import listed, shown, unknown
from optipath.plots.colors import ColourScale
from optipath.surfaces.hemisphere.beam import SIDES
from optipath.surfaces.hemisphere.hemisphere import Hemisphere
from optipath.surfaces.hemisphere.sensor import PROJECTIONS
from optipath.surfaces.walk.beam import state_argument
from optipath.values.units import displayed
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from optipath.values.precision import Numbers


@dataclass(frozen=True)
class SeenSide:
    """One side of a measured sample, at one wavelength, for light of one state."""

    measured: Hemisphere
    side: str
    place: int | None
    source: tuple[float, ...]

    @classmethod
    def of(
        cls, measured: Any, side: Any, wavelength: Any, source: Any, *, every: bool = False
    ) -> SeenSide:
        """Return the side that pictures are asked for. Shape: source (4,)."""
        if not isinstance(measured, Hemisphere):
            raise SurfaceError(f"{shown(measured)} is no Hemisphere; give what op.measure returned")
        measured.side(side)
        place = None if every else _place(measured.wavelengths, wavelength)
        return cls(measured, side, place, state_argument("source", source))

    def pixels(self, numbers: Numbers) -> Numbers:
        """Return the pixels (rows, columns, ...) of this side, NaN beyond the horizon."""
        result = numbers[self.measured.side(self.side), :, :, self.place].copy()
        result[self.measured.sensor.solid_angle == 0.0] = np.nan
        return result

    def per_steradian(self, numbers: Numbers) -> Numbers:
        """Return the pixels of this side over their solid angles, NaN beyond the horizon."""
        pixels = self.pixels(numbers)
        area = self.measured.sensor.solid_angle
        with np.errstate(invalid="ignore", divide="ignore"):
            return pixels / area.reshape(*area.shape, *[1] * (pixels.ndim - 2))

    def radius(self, theta: float) -> float:
        """Return the distance from the center for theta in radians, 1 at the horizon."""
        projection = PROJECTIONS[self.measured.sensor.projection]
        return float(projection.radius(np.sin(theta), np.cos(theta)))

    @property
    def mirrored(self) -> float:
        """The specular or refracted angle to the normal, in rad; NaN if totally reflected."""
        beam = self.measured.seen.beam
        if self.side == "reflected":
            return float(np.arctan2(beam.sin, beam.cos))
        sin = beam.smooth_sine(SIDES[self.side])
        return float(np.arcsin(sin)) if sin <= 1.0 else np.nan

    @property
    def colour(self) -> str:
        """The wavelength, as titles have it; nothing where there is none, or they are several."""
        if self.place is None or np.isnan(when := self.measured.wavelengths[self.place]):
            return ""
        return f"{when * 1e9:.5g} nm"

    @property
    def source_line(self) -> str:
        """A last line of titles, which tells the light that comes in; nothing if unpolarised."""
        if not any(self.source[1:]):
            return ""
        return "\nsource ({:g}, {:g}, {:g}, {:g})".format(*self.source)

    def titled(self, what: str) -> str:
        """Return the title of a picture of this side."""
        seen, when = self.measured.seen, self.measured.wavelengths
        parts = [what, self.side, f"incidence {degrees(np.arctan2(seen.beam.sin, seen.beam.cos))}"]
        if self.colour:
            parts.append(self.colour)
        elif self.place is None and len(when) > 1:
            parts.append(f"{len(when)} wavelengths")
        parts += {None: [], 1: ["one event"]}.get(seen.events, [f"{seen.events} events"])
        return ", ".join(parts) + self.source_line


def degrees(angle: float) -> str:
    """Return an angle in radians, as titles have it."""
    return f"{np.degrees(angle):.4g}°"


def _place(wavelengths: Numbers, wanted: Any) -> int:
    """Return which of some wavelengths is wanted."""
    if wanted is None and len(wavelengths) == 1:
        return 0
    if np.isnan(wavelengths).any():
        raise SurfaceError("wavelength is given, but nothing depends on it; leave it out")
    there = listed([displayed(each, "nm") for each in wavelengths])
    if wanted is None:
        raise SurfaceError(f"wavelength is missing; give one of {there}")
    when = np.asarray(Wavelength().resolve(wanted).value, float)
    if when.size != 1:
        raise SurfaceError(f"wavelength is {shown(wanted)}; give one of {there}")
    near = np.isclose(wavelengths, when.item(), rtol=1e-9, atol=0.0)
    if not near.any():
        cure = f"give a wavelength of {there}" + ", or leave it out" * (len(wavelengths) == 1)
        raise SurfaceError(f"{displayed(when.item(), 'nm')} has not been measured; {cure}")
    return int(np.argmax(near))


_STOKES = "S0", "S1", "S2", "S3"
_EFFECTS = {"difference": "relative_difference", "ADM": "adm", "MDM": "mdm"}
"""Methods of `Hemisphere` that compare light with polarization and without."""


class PixelQuantity(NamedTuple):
    """What pictures show of each pixel of a hemisphere."""

    variable: str
    name: str
    unit: str
    colours: ColourScale | Callable[[float], ColourScale]
    known_to: float = np.inf
    masked: tuple[str, ...] = ()

    @property
    def is_bounded(self) -> bool:
        """Whether its colours are those of all values that it can have."""
        return isinstance(self.colours, ColourScale)

    @property
    def over_wavelengths(self) -> bool:
        """Whether it is of all wavelengths together."""
        return self.variable in {"ADM", "MDM"}

    def scale(self, largest: float) -> ColourScale:
        """Return its colours, which end at the largest number where it has no end of its own."""
        return self.colours if isinstance(self.colours, ColourScale) else self.colours(largest)

    @property
    def label(self) -> str:
        """What it is, with its unit."""
        return f"{self.name} ({self.unit})" if self.unit else self.name

    def known(
        self, seen: SeenSide, known_to: float | None, mask: Mapping[str, Any] | None
    ) -> tuple[Numbers, str]:
        """Return the pixels (rows, columns) of a side, and why those that are NaN are not known."""
        self._check_mask(mask)
        measured, why = seen.measured, "no light"
        if self.variable in _STOKES:
            result, at = measured.stokes(seen.source), _STOKES.index(self.variable)
            value, error = (seen.per_steradian(e.values[..., at]) for e in (result, result.se))
        elif self.variable in _EFFECTS:
            result = getattr(measured, _EFFECTS[self.variable])(seen.side, **mask or {})
            place = (..., seen.place) if "wavelength" in result.dims else ...
            value, error = (100.0 * each.values[place] for each in (result, result.se))
            why = f"masked; seen are pixels of {result.attrs['mask']}"
        else:
            result = getattr(measured, self.variable.lower())(seen.source)
            unit = float(np.degrees(1.0)) if self.variable == "AoP" else 1.0
            value, error = (unit * seen.pixels(each.values) for each in (result, result.se))
        limit = self.known_to if known_to is None else known_to
        if np.isinf(limit):
            return value, why
        # An error that is not known is one of too little light.
        value = np.where(error <= limit, value, np.nan)
        return value, f"{why}, or not known to {limit:g}{self.unit}"

    def _check_mask(self, mask: Any) -> None:
        if mask is None:
            return
        if not self.masked:
            raise SurfaceError(f"mask is given, but {self.variable} has none; leave it out")
        if not isinstance(mask, Mapping):
            raise SurfaceError(
                f"mask is {shown(mask)}; give a mapping, such as {{'brighter_than': 0.5}}"
            )
        SurfaceError.raise_for(fault for key in mask for fault in unknown("mask", key, self.masked))


_MASK = "brighter_than", "noise", "known_to"
_SHARE = ColourScale.share()
_ALL = (
    PixelQuantity("S0", "S0", "1/sr", ColourScale.light),
    *(PixelQuantity(name, name, "1/sr", ColourScale.signed_light) for name in _STOKES[1:]),
    PixelQuantity("DoP", "degree of polarisation", "", _SHARE, 0.1),
    PixelQuantity("DoLP", "degree of linear polarisation", "", _SHARE, 0.1),
    PixelQuantity("AoP", "angle of polarisation", "°", ColourScale.cyclic(), 10.0),
    PixelQuantity("difference", "S0 / U - 1", "%", ColourScale.signed, masked=_MASK[:1]),
    PixelQuantity("ADM", "mean of |S0 - U| / U", "%", ColourScale.share, masked=_MASK),
    PixelQuantity("MDM", "largest |S0 - U| / U", "%", ColourScale.share, masked=_MASK),
)
PixelName: TypeAlias = Literal[
    "S0", "S1", "S2", "S3", "DoP", "DoLP", "AoP", "difference", "ADM", "MDM"
]
QUANTITIES = {each.variable: each for each in _ALL}


def quantity_of(name: Any, known: Collection[str]) -> PixelQuantity:
    """Return the quantity of a name, one of those that are known."""
    SurfaceError.raise_for(unknown("quantity", name, known))
    return QUANTITIES[name]


def largest_of(values: Numbers) -> float:
    """Return the largest size among values, 1 where all are 0 or NaN."""
    return float(np.nanmax(np.abs(values), initial=0.0)) or 1.0
