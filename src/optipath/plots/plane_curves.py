"""Curves in the plane of incidence of measured samples."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import SurfaceError
from optipath.light.frame import Frame
from optipath.light.light import Light
from optipath.light.quantities import QUANTITIES as OF_LIGHT
from optipath.plots.axes import own_axes, positive
from optipath.plots.colors import DASHES, LINES
from optipath.plots.hemisphere_side import SeenSide, quantity_of
from optipath.surfaces.facet_model import frame_along
from optipath.surfaces.hemisphere.hemisphere import ROUNDED
from optipath.surfaces.walk.beam import UNPOLARISED

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.axes import Axes

    from optipath.plots.hemisphere_side import PixelName, PixelQuantity
    from optipath.surfaces.hemisphere.beam import Side
    from optipath.surfaces.hemisphere.hemisphere import Hemisphere
    from optipath.values.precision import Numbers


BAND = 2.0
"""How many standard errors a band reaches up and down."""

_CURVE = "curve in the plane of incidence"
"""By which curves are found again, so that the next one looks otherwise."""


def in_plane(
    measured: Hemisphere | Mapping[str, Hemisphere],
    quantity: PixelName = "S0",
    ax: Axes | None = None,
    *,
    source: npt.ArrayLike = UNPOLARISED,
    side: Side = "reflected",
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
    source, side
        As `hemisphere` takes them.
    wavelength : float or str, optional
        One of those measured, in metres or with a unit, where there are several; samples that were
        measured at one have that, which the legend tells where it is another.
    known_to : float, optional
        Curves have gaps where the standard error is larger; by default than 0.1 of degrees of
        polarisation, 10 of angles in degrees, 5 of per cents.

    Returns
    -------
    Axes

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
    drawn = quantity_of(quantity, _LIMITS)
    SurfaceError.raise_for(positive("known_to", known_to))
    sides = _sides(several, side, wavelength, source)
    if quantity == "difference" and any(any(seen.source[1:]) for seen in sides.values()):
        raise SurfaceError("difference is of unpolarised light; leave source out")
    ax = own_axes(ax, (7.0, 4.4))
    colours = {seen.colour for seen in sides.values()} - {""}
    for name, seen in sides.items():
        label = f"{name}, {seen.colour}" if len(colours) > 1 and seen.colour else name
        _draw_curve(ax, seen, drawn, label, known_to)
    ax.set(xlim=(-90.0, 90.0), xlabel="exit angle to the normal (°)", ylabel=drawn.label)
    ax.set_xticks(range(-90, 91, 30))
    ax.set_ylim(*_LIMITS[quantity])
    ax.grid(visible=True, alpha=0.3)
    first = next(iter(sides.values()))
    if len(sides) == 1:
        ax.set_title(first.titled(quantity))
    else:
        parts = [quantity, side, "in the plane of incidence"]
        parts += colours if len(colours) == 1 else []
        ax.set_title(", ".join(parts) + first.source_line)
    if any(sides):
        ax.legend(frameon=False)
    return ax


def _sides(
    several: Mapping[Any, Any], side: str, wavelength: Any, source: Any
) -> dict[str, SeenSide]:
    """Return the sides to draw; a wavelength is for samples measured at several."""

    def choices(measured: Any) -> int:
        """Return whether something was measured at no wavelength, at one, or at several, 2."""
        return min(int(np.isfinite(getattr(measured, "wavelengths", np.nan)).sum()), 2)

    most, results = max(map(choices, several.values())), {}
    for name, each in several.items():
        own = wavelength if choices(each) == most else None
        with SurfaceError.wrapping(str(name)):
            results[str(name)] = SeenSide.of(each, side, own, source)
    return results


def _draw_curve(
    ax: Axes, seen: SeenSide, drawn: PixelQuantity, name: str, known_to: float | None
) -> None:
    angles, value, error = _known(seen, drawn, known_to)
    before = sum(line.get_gid() == _CURVE for line in ax.get_lines())
    colour, dash = LINES[before % len(LINES)], DASHES[before % len(DASHES)]
    ax.plot(angles, value, color=colour, linestyle=dash, label=name or None, gid=_CURVE)
    band = BAND * np.nan_to_num(error)
    ax.fill_between(angles, value - band, value + band, color=colour, alpha=0.25, linewidth=0.0)
    if not np.isnan(mirrored := seen.mirrored):
        ax.axvline(np.degrees(mirrored), color=colour, linestyle=":", linewidth=1.0, zorder=0)


_OF_LIGHT = {each.variable: each for each in OF_LIGHT}
_WHOLE = 0.0, 1.02
_LIMITS: dict[str, tuple[float | None, float | None]] = {
    "S0": (0.0, None),
    **dict.fromkeys(("S1", "S2", "S3"), (None, None)),
    **dict.fromkeys(("DoP", "DoLP"), _WHOLE),
    "AoP": (-92.0, 92.0),
    "difference": (None, None),
}
"""Of what curves in the plane of incidence show: the limits of the axis."""

_DIFFERENCE_KNOWN_TO = 5.0


def _known(
    seen: SeenSide, drawn: PixelQuantity, known_to: float | None
) -> tuple[Numbers, Numbers, Numbers]:
    """Return angles of exit in degrees, values and standard errors (columns,), NaN if not known.

    Of the row of pixels in the plane of incidence, or the mean of the two beside it. Angles are
    below 0 on the side of the source.
    """
    measured, name, up = seen.measured, drawn.variable, seen.side == "reflected"
    sensor, source, own = measured.sensor, np.array(seen.source), measured.own
    rows = slice((sensor.pixels - 1) // 2, sensor.pixels // 2 + 1)
    place = measured.side(seen.side), rows, slice(None), seen.place
    area = sensor.solid_angle[rows].sum(axis=0)
    directions = sensor.directions[rows] * (1.0, 1.0, 1.0 if up else -1.0)
    frame = frame_along("direction", directions, up=up)
    # With x perpendicular to the plane.
    in_plane_frame = Frame.from_direction(frame.z, (0.0, 1.0, 0.0))

    def mean(pixels: Numbers) -> Numbers:
        total = pixels.sum(axis=0)
        return np.asarray(total / area.reshape(-1, *[1] * (total.ndim - 1)))

    def at(numbers: Numbers) -> Numbers:
        pixels = numbers[place]
        matrices = measured.matrices(pixels)
        light = Light.of(matrices @ source, frame, measured=True).in_frame(in_plane_frame)
        noise = ROUNDED * source[0] * mean(matrices[..., 0, 0])
        light = Light.of(mean(light.stokes), Frame(), noise=noise, measured=True)
        if name == "difference":
            return 100.0 * (light.stokes[..., 0] / mean(measured.intensities(pixels)) - 1.0)
        values = np.asarray(_OF_LIGHT[name].of(light))
        return np.degrees(values) if name == "AoP" else values

    value, error = own.estimate(at)
    if name == "AoP":
        _, error = own.estimate(lambda numbers: np.remainder(at(numbers) - value + 90.0, 180.0))
        # An angle that goes on from the other end is no line across.
        value = np.where(np.abs(np.diff(value, append=value[-1])) > 90.0, np.nan, value)
    usual = _DIFFERENCE_KNOWN_TO if name == "difference" else drawn.known_to
    limit = usual if known_to is None else known_to
    there = np.isinf(limit) | (error <= limit)
    angles = np.degrees(np.copysign(sensor.theta[rows][0], sensor.coordinates))
    return angles, np.where(there, value, np.nan), np.where(there, error, np.nan)
