"""Curves in the plane of incidence of measured samples."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import SurfaceError
from optipath.light.frame import Frame
from optipath.light.light import Light
from optipath.plots.axes import own_axes
from optipath.plots.colors import positive
from optipath.plots.hemisphere_side import labels, seen_sides, titled
from optipath.plots.light_quantities import named_quantity
from optipath.surfaces.facet_model import frame_along
from optipath.surfaces.walk.beam import UNPOLARISED
from optipath.sweeps.labels import QUANTITIES as OF_LIGHT

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt
    from matplotlib.axes import Axes

    from optipath.plots.hemisphere_side import SeenSide
    from optipath.surfaces.hemisphere.hemisphere import Hemisphere

    Numbers = npt.NDArray[np.float64]


BAND = 2.0
"""How many standard errors a band reaches up and down."""

_COLOURS = "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"
"""Those that all tell apart: M. Okabe and K. Ito, Color Universal Design (2008)."""

_LINES = "-", "--", "-.", (0, (1, 1)), (0, (6, 2)), (0, (4, 1, 1, 1, 1, 1)), "-"

_CURVE = "curve in the plane of incidence"
"""By which curves are found again, so that the next one looks otherwise."""


def in_plane(
    measured: Hemisphere | Mapping[str, Hemisphere],
    quantity: str = "S0",
    ax: Axes | None = None,
    *,
    source: npt.ArrayLike = UNPOLARISED,
    side: str = "reflected",
    wavelength: Any = None,
    known_to: float | None = None,
) -> Axes:
    """Draw what a sample sends into the plane of incidence, over the angle of exit.

    Angles are to the normal, below 0 on the side that the light comes from; bands reach two
    standard errors up and down, and dotted lines stand where a smooth sample sends light. Stokes
    vectors are per steradian, in frames with x perpendicular to the plane. At r pixels from the
    normal polarisation is too low by the share 1 / (6 r^2), since the frames of photons differ
    within a pixel.

    Parameters
    ----------
    measured : Hemisphere, or mapping of str to Hemisphere
        What `measure` returned; several, by the names of their curves.
    quantity : {"S0", "S1", "S2", "S3", "DoP", "DoLP", "AoP", "difference"}, optional
        What is drawn; ``"difference"`` is that of S0 from the light U without polarisation, over
        U, for an unpolarised source, in per cent.
    ax : Axes, optional
        Where; a figure of its own by default, ``.figure`` of what is returned.
    source : array_like, shape (4,), optional
        The Stokes vector of the light that comes in, in the frame whose x is horizontal;
        unpolarised by default.
    side : {"reflected", "transmitted"}, optional
        Above the sample, or below it.
    wavelength : float or str, optional
        One of those measured, in metres or with a unit, where there are several; samples that were
        measured at one have that, which the legend tells where it is another.
    known_to : float, optional
        Curves have gaps where the standard error is larger; by default than 0.1 of degrees of
        polarisation, 10 of angles in degrees, 5 of per cents.

    Returns
    -------
    Axes

    Raises
    ------
    SurfaceError
        With all faults at once, or if what is drawn has not been measured.

    Examples
    --------
    >>> import optipath as op
    >>> sample = op.Sample([(0.5 + 2.1j, 0.3)], cells=200)
    >>> found = op.measure(sample, "40 deg", photons=16_384, sensor=16)
    >>> ax = in_plane({"silver": found}, "S1")
    >>> ax.get_xlabel(), ax.get_ylabel()
    ('exit angle to the normal (°)', 'S1 (1/sr)')
    """
    several = measured if isinstance(measured, Mapping) else {"": measured}
    if not several:
        raise SurfaceError("measured is an empty mapping; give one Hemisphere at least")
    drawn = named_quantity(quantity, QUANTITIES)
    sides = seen_sides(
        {str(name): each for name, each in several.items()},
        side,
        wavelength,
        source,
        others=positive("known_to", known_to),
    )
    ax, called = own_axes(ax, (7.0, 4.4)), labels(sides)
    for name, seen in sides.items():
        _draw_curve(ax, PlaneCut(seen), drawn, called[name], known_to)
    ax.set(xlim=(-90.0, 90.0), xlabel="exit angle to the normal (°)", ylabel=drawn.label)
    ax.set_xticks(range(-90, 91, 30))
    ax.set_ylim(*drawn.limits)
    ax.grid(visible=True, alpha=0.3)
    if len(sides) == 1:
        ax.set_title(next(iter(sides.values())).titled(drawn.variable))
    else:
        ax.set_title(titled(drawn.variable, sides.values()))
    if any(sides):
        ax.legend(frameon=False)
    return ax


def _draw_curve(
    ax: Axes, cut: PlaneCut, drawn: PlaneQuantity, name: str, known_to: float | None
) -> None:
    value, error = drawn.known(cut, known_to)
    angles = np.degrees(cut.angles)
    before = sum(line.get_gid() == _CURVE for line in ax.get_lines()) % len(_COLOURS)
    colour = _COLOURS[before]
    ax.plot(angles, value, color=colour, linestyle=_LINES[before], label=name or None, gid=_CURVE)
    band = BAND * np.nan_to_num(error)
    ax.fill_between(angles, value - band, value + band, color=colour, alpha=0.25, linewidth=0.0)
    if not np.isnan(mirrored := cut.seen.mirrored):
        ax.axvline(np.degrees(mirrored), color=colour, linestyle=":", linewidth=1.0, zorder=0)


_ROUNDED = 64.0 * np.finfo(float).eps


@dataclass(frozen=True)
class PlaneCut:
    """The light of one side of a measured sample in the plane of incidence.

    Of the row of pixels in the plane, or the mean of the two beside it; x is across the plane.
    """

    seen: SeenSide

    @property
    def _rows(self) -> slice:
        pixels = self.seen.measured.sensor.pixels
        return slice((pixels - 1) // 2, pixels // 2 + 1)

    @cached_property
    def angles(self) -> Numbers:
        """The angle of each pixel to the normal, in radians, below 0 on the side of the source."""
        sensor = self.seen.measured.sensor
        return np.asarray(np.copysign(sensor.theta[self._rows][0], sensor.coordinates))

    @cached_property
    def _frames(self) -> tuple[Frame, Frame]:
        """Those of the pixels, and those with x perpendicular to the plane of incidence."""
        up = self.seen.side == "reflected"
        directions = self.seen.measured.sensor.directions[self._rows]
        directions = directions * (1.0, 1.0, 1.0 if up else -1.0)
        own = frame_along("direction", directions, up=up)
        return own, Frame.from_direction(own.z, (0.0, 1.0, 0.0))

    def light(self, numbers: Numbers) -> Light:
        """Return the light (columns,) per steradian among the numbers of `PartSums.estimate`."""
        own, plane = self._frames
        matrices = self.seen.measured.matrices(self._pixels(numbers))
        seen = Light.of(matrices @ np.array(self.seen.source), own, measured=True)
        stokes = self._mean(seen.in_frame(plane).stokes)
        noise = _ROUNDED * self.seen.source[0] * self._mean(matrices[..., 0, 0])
        return Light.of(stokes, Frame(), noise=noise, measured=True)

    def scalar(self, numbers: Numbers) -> Numbers:
        """Return the light (columns,) per steradian that there is without polarization."""
        return self._mean(self.seen.measured.intensities(self._pixels(numbers)))

    def _pixels(self, numbers: Numbers) -> Numbers:
        at = self.seen.measured.side(self.seen.side)
        return numbers[at, self._rows, :, self.seen.place]

    def _mean(self, pixels: Numbers) -> Numbers:
        area = self.seen.measured.sensor.solid_angle[self._rows].sum(axis=0)
        total = pixels.sum(axis=0)
        return np.asarray(total / area.reshape(-1, *[1] * (total.ndim - 1)))


_OF_LIGHT = {each.variable: each for each in OF_LIGHT}


class PlaneQuantity(NamedTuple):
    """What curves in the plane of incidence show."""

    variable: str
    label: str
    of: Callable[[PlaneCut, Numbers], Numbers]
    limits: tuple[float | None, float | None] = (None, None)
    known_to: float = np.inf
    period: float = np.inf

    def known(self, cut: PlaneCut, known_to: float | None) -> tuple[Numbers, Numbers]:
        """Return values and standard errors (columns,), NaN where not known."""
        if self.variable == "difference" and any(cut.seen.source[1:]):
            raise SurfaceError("difference is of unpolarised light; leave source out")
        own = cut.seen.measured.own
        value, error = own.estimate(lambda numbers: self.of(cut, numbers))
        if np.isfinite(self.period):
            half = self.period / 2.0
            _, error = own.estimate(
                lambda numbers: np.remainder(self.of(cut, numbers) - value + half, self.period)
            )
            # An angle that goes on from the other end is no line across.
            value = np.where(np.abs(np.diff(value, append=value[-1])) > half, np.nan, value)
        limit = self.known_to if known_to is None else known_to
        there = np.isinf(limit) | (error <= limit)
        return np.where(there, value, np.nan), np.where(there, error, np.nan)


def _of_light(variable: str, unit: float, cut: PlaneCut, numbers: Numbers) -> Numbers:
    return unit * np.asarray(_OF_LIGHT[variable].of(cut.light(numbers)))


def _difference(cut: PlaneCut, numbers: Numbers) -> Numbers:
    scalar, stokes = cut.scalar(numbers), cut.light(numbers).stokes
    return 100.0 * (stokes[..., 0] / scalar - 1.0)


_WHOLE = (0.0, 1.02)

QUANTITIES = (
    PlaneQuantity("S0", "S0 (1/sr)", partial(_of_light, "S0", 1.0), (0.0, None)),
    PlaneQuantity("S1", "S1 (1/sr)", partial(_of_light, "S1", 1.0)),
    PlaneQuantity("S2", "S2 (1/sr)", partial(_of_light, "S2", 1.0)),
    PlaneQuantity("S3", "S3 (1/sr)", partial(_of_light, "S3", 1.0)),
    PlaneQuantity("DoP", "degree of polarisation", partial(_of_light, "DoP", 1.0), _WHOLE, 0.1),
    PlaneQuantity(
        "DoLP", "degree of linear polarisation", partial(_of_light, "DoLP", 1.0), _WHOLE, 0.1
    ),
    PlaneQuantity(
        "AoP",
        "angle of polarisation (°)",
        partial(_of_light, "AoP", float(np.degrees(1.0))),
        (-92.0, 92.0),
        10.0,
        180.0,
    ),
    PlaneQuantity("difference", "S0 / U - 1 (%)", _difference, known_to=5.0),
)
