"""A map of what a rough sample sends into each direction."""

from __future__ import annotations

from functools import partial
from textwrap import fill
from typing import TYPE_CHECKING, Any

from optipath.errors import SurfaceError
from optipath.paths.format.faults import Faults
from optipath.plots.hemispheres.disc import draw_disc
from optipath.plots.hemispheres.pixel_quantity import QUANTITIES, PixelQuantity
from optipath.plots.hemispheres.seen_side import SeenSide
from optipath.plots.named_quantity import named_quantity
from optipath.plots.own_axes import own_axes
from optipath.plots.positive import positive
from optipath.surfaces.walk.given_beam import UNPOLARISED

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt
    from matplotlib.axes import Axes

    from optipath.surfaces.hemispheres.hemisphere import Hemisphere

_COLUMNS = 56
"""How wide a sentence is below a disc."""


def hemisphere(
    measured: Hemisphere,
    quantity: str = "S0",
    ax: Axes | None = None,
    *,
    source: npt.ArrayLike = UNPOLARISED,
    side: str = "reflected",
    wavelength: Any = None,
    largest: float | None = None,
    known_to: float | None = None,
    mask: Mapping[str, float | None] | None = None,
) -> Axes:
    """Draw a map of what a sample sends into each direction, as a disc seen from above.

    Light comes from the left, at the azimuth of 180 deg; rings are at 30 and 60 deg from the
    normal, the horizon is the rim. Stokes vectors are per steradian, in the frames of the pixels:
    the share of the light on the sample that goes there, the BRDF times the cosine. Their colours
    go by its power 0.4, so that dim light is seen beside bright light; the colour bar tells both.

    Parameters
    ----------
    measured : Hemisphere
        What `measure` returned.
    quantity : {"S0", "S1", "S2", "S3", "DoP", "DoLP", "AoP", "difference", "ADM", "MDM"}, optional
        What is drawn; the last three compare light with polarisation and without, in per cent, as
        methods of `Hemisphere` do.
    ax : Axes, optional
        Where, best of a figure with ``layout="constrained"``, which makes room for all that is
        beside the disc; a figure of its own by default, ``.figure`` of what is returned.
    source : array_like, shape (4,), optional
        The Stokes vector of the light that comes in, in the frame whose x is horizontal;
        unpolarised by default.
    side : {"reflected", "transmitted"}, optional
        Above the sample, or below it.
    wavelength : float or str, optional
        One of those measured, in metres or with a unit, where there are several.
    largest : float, optional
        Where the colours of light end; by default at the largest value.
    known_to : float, optional
        Pixels with a larger standard error are hatched, as those without light are; by default
        0.1 of degrees of polarisation, 10 of angles in degrees; all others are all shown.
    mask : mapping of str to float, optional
        What `Hemisphere.adm` takes, for ``"ADM"``, ``"MDM"`` and ``"difference"``; what is masked
        is hatched. Others have none.

    Returns
    -------
    Axes

    Raises
    ------
    SurfaceError
        With all faults at once.

    Examples
    --------
    >>> import optipath as op
    >>> sample = op.Sample([(0.5 + 2.1j, 0.3)], cells=200)
    >>> found = op.measure(sample, "40 deg", photons=16_384, sensor=16)
    >>> hemisphere(found, "DoLP").get_title()
    'DoLP, reflected, incidence 40°'
    """
    drawn = named_quantity(quantity, QUANTITIES)
    faults = [*positive("largest", largest), *positive("known_to", known_to)]
    if largest is not None and drawn.is_bounded:
        faults.append(f"largest is given, but colours of {drawn.variable} end at their own limits")
    faults += drawn.faults_of(mask)
    seen = _seen(drawn, faults, measured, side, wavelength, source)
    pixels = drawn.known(seen, known_to, mask)
    ax = own_axes(ax, (5.6, 5.0))
    scale = drawn.scale(pixels.largest if largest is None else largest)
    image = draw_disc(ax, seen, pixels.values, scale, hatched=fill(pixels.unknown, _COLUMNS))
    scale.bar(image, ax, drawn.label, shrink=0.8)
    ax.set_title(seen.titled(drawn.variable))
    return ax


def _seen(
    drawn: PixelQuantity,
    others: list[str],
    measured: Hemisphere,
    side: str,
    wavelength: Any,
    source: npt.ArrayLike,
) -> SeenSide:
    """Return what is to be drawn; refuse what does not go with the quantity, beside others."""
    faults = Faults(others)
    if drawn.over_wavelengths and wavelength is not None:
        faults.append(f"{drawn.variable} is of all wavelengths together; leave wavelength out")
        wavelength = None
    seen = faults.attempt(
        "",
        partial(SeenSide.of, every=drawn.over_wavelengths),
        measured,
        side,
        wavelength,
        source,
    )
    if seen and drawn.masked and any(seen.source[1:]):
        faults.append(f"{drawn.variable} is of unpolarised light; leave source out")
    if faults or seen is None:
        raise SurfaceError(*faults)
    return seen
