"""SeenSide: one side of a measured sample, at one wavelength, for light of one state."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, SurfaceError, listed, shown
from optipath.paths.format.faults import Faults
from optipath.surfaces.hemispheres.hemisphere import Hemisphere
from optipath.surfaces.hemispheres.projections import PROJECTIONS
from optipath.surfaces.hemispheres.sensed_beam import SIDES
from optipath.surfaces.walk.given_beam import given_state
from optipath.values.displayed import displayed
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    import numpy.typing as npt

    Numbers = npt.NDArray[np.float64]


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
        """Return the side that pictures are asked for.

        Shape: source (4,).
        """
        if not isinstance(measured, Hemisphere):
            raise SurfaceError(f"{shown(measured)} is no Hemisphere; give what op.measure returned")
        faults = Faults()
        faults.attempt("", measured.side, side)
        place = None if every else faults.attempt("", _place, measured.wavelengths, wavelength)
        state = faults.attempt("", given_state, "source", source)
        if faults:
            raise SurfaceError(*faults)
        assert state is not None  # noqa: S101 - or a fault has been raised
        return cls(measured, side, place, state)

    def pixels(self, numbers: Numbers) -> Numbers:
        """Return what is known of the pixels of this side, NaN beyond the horizon.

        Shapes: numbers (sides, rows, columns, wavelengths, ...); returns (rows, columns, ...).
        """
        found = numbers[self.measured.side(self.side), :, :, self.place].copy()
        found[self.measured.sensor.solid_angle == 0.0] = np.nan
        return found

    def radius(self, theta: float) -> float:
        """Return how far from the centre of the disc light falls, 1 at the horizon.

        Units: theta in radians.
        """
        projection = PROJECTIONS[self.measured.sensor.projection]
        return float(projection.radius(np.sin(theta), np.cos(theta)))

    @property
    def mirrored(self) -> float:
        """The angle to the normal of light that a smooth sample reflects or lets through, in rad.

        NaN where all of it is totally reflected.
        """
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
    try:
        when = np.asarray(Wavelength().resolve(wanted).value, float)
    except OptipathError as fault:
        raise SurfaceError(*fault.faults) from None
    if when.size != 1:
        raise SurfaceError(f"wavelength is {shown(wanted)}; give one of {there}")
    near = np.isclose(wavelengths, when.item(), rtol=1e-9, atol=0.0)
    if not near.any():
        cure = f"give a wavelength of {there}"
        if len(wavelengths) == 1:
            cure += ", or leave it out"
        raise SurfaceError(f"{displayed(when.item(), 'nm')} has not been measured; {cure}")
    return int(np.argmax(near))
