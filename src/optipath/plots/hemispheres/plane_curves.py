"""Curves of what a rough sample sends into the directions of the plane of incidence."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import SurfaceError
from optipath.plots.hemispheres.plane_cut import PlaneCut
from optipath.plots.hemispheres.plane_quantity import QUANTITIES
from optipath.plots.hemispheres.seen_sides import labels, seen_sides, titled
from optipath.plots.named_quantity import named_quantity
from optipath.plots.own_axes import own_axes
from optipath.plots.positive import positive
from optipath.surfaces.walk.given_beam import UNPOLARISED

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.axes import Axes

    from optipath.plots.hemispheres.plane_quantity import PlaneQuantity
    from optipath.surfaces.hemispheres.hemisphere import Hemisphere

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
        beside=positive("known_to", known_to),
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
