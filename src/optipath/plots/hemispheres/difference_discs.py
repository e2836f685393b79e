"""Light with polarisation, without, and the difference, side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.plots.colour_scale import ColourScale
from optipath.plots.hemispheres.disc import draw_disc
from optipath.plots.hemispheres.pixel_quantity import largest_of
from optipath.plots.hemispheres.seen_side import SeenSide
from optipath.plots.own_axes import own_panel
from optipath.surfaces.walk.given_beam import UNPOLARISED

if TYPE_CHECKING:
    from optipath.plots.own_axes import Panel
    from optipath.surfaces.hemispheres.hemisphere import Hemisphere


def differences(
    measured: Hemisphere, axes: Any = None, *, side: str = "reflected", wavelength: Any = None
) -> Panel:
    """Draw light with polarisation, light without, and the difference, side by side.

    Of unpolarised light on the sample, per steradian, in the colours of `hemisphere`: those of the
    first two are the same, those of the difference go apart from white.

    Parameters
    ----------
    measured : Hemisphere
        What `measure` returned, with ``polarized="both"``.
    axes : array_like of 3 Axes, optional
        Where; in a figure of their own by default.
    side : {"reflected", "transmitted"}, optional
        Above the sample, or below it.
    wavelength : float or str, optional
        One of those measured, where there are several.

    Returns
    -------
    ndarray of Axes, shape (3,)

    Raises
    ------
    SurfaceError
        With all faults at once, or if light has not been measured both with polarisation and
        without.

    Examples
    --------
    >>> import optipath as op
    >>> sample = op.Sample([(0.5 + 2.1j, 0.3)], cells=200)
    >>> found = op.measure(sample, "40 deg", photons=16_384, sensor=16)
    >>> [ax.get_title() for ax in differences(found)]
    ['with polarisation, S0', 'without polarisation, U', 'difference, S0 - U']
    """
    seen = SeenSide.of(measured, side, wavelength, UNPOLARISED)
    panel: Panel = own_panel(axes, (1, 3), (12.5, 4.3))[0]
    with np.errstate(invalid="ignore", divide="ignore"):
        polarised, scalar, apart = (
            seen.pixels(value) / measured.sensor.solid_angle
            for value in (
                measured.mueller[0][..., 0, 0],
                measured.scalar[0],
                measured.difference[0],
            )
        )
    light = ColourScale.light(max(largest_of(polarised), largest_of(scalar)))
    signed = ColourScale.signed_light(largest_of(apart))
    draw_disc(panel[0], seen, polarised, light)
    image = draw_disc(panel[1], seen, scalar, light)
    light.bar(image, list(panel[:2]), "light (1/sr)", shrink=0.8)
    signed.bar(draw_disc(panel[2], seen, apart, signed), panel[2], "S0 - U (1/sr)", shrink=0.8)
    titles = "with polarisation, S0", "without polarisation, U", "difference, S0 - U"
    for ax, title in zip(panel, titles, strict=True):
        ax.set_title(title)
    if axes is None:
        panel[0].figure.figure.suptitle(seen.titled("light"))
    return panel
