"""The Mueller matrices of a rough sample, a map of each element."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import SurfaceError
from optipath.plots.colour_scale import ColourScale
from optipath.plots.hemispheres.disc import draw_disc, head_panel
from optipath.plots.hemispheres.pixel_quantity import largest_of
from optipath.plots.hemispheres.seen_side import SeenSide
from optipath.plots.own_axes import own_panel
from optipath.plots.positive import positive
from optipath.surfaces.walk.given_beam import UNPOLARISED

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.plots.own_axes import Panel
    from optipath.surfaces.hemispheres.hemisphere import Hemisphere

_KNOWN_TO = 0.1


def mueller_hemisphere(
    measured: Hemisphere,
    axes: Any = None,
    *,
    side: str = "reflected",
    wavelength: Any = None,
    known_to: float | None = None,
) -> Panel:
    """Draw the Mueller matrices of all directions: a map of M00, and of all others over M00.

    M00 is per steradian, in the colours of `hemisphere`; the others are from -1 to 1.

    Parameters
    ----------
    measured : Hemisphere
        What `measure` returned.
    axes : array_like of 4 x 4 Axes, optional
        Where; in a figure of their own by default.
    side : {"reflected", "transmitted"}, optional
        Above the sample, or below it.
    wavelength : float or str, optional
        One of those measured, where there are several.
    known_to : float, optional
        Pixels with a larger standard error are hatched, as those without light are; 0.1 by default.

    Returns
    -------
    ndarray of Axes, shape (4, 4)

    Raises
    ------
    SurfaceError
        With all faults at once, or if no Mueller matrix has been measured.

    Examples
    --------
    >>> import optipath as op
    >>> sample = op.Sample([(0.5 + 2.1j, 0.3)], cells=200)
    >>> found = op.measure(sample, "40 deg", photons=16_384, sensor=16)
    >>> mueller_hemisphere(found)[0, 1].get_title()
    'M01 / M00'
    """
    if faults := positive("known_to", known_to):
        raise SurfaceError(*faults)
    limit = _KNOWN_TO if known_to is None else known_to
    seen = SeenSide.of(measured, side, wavelength, UNPOLARISED)
    panel = own_panel(axes, (4, 4), (9.6, 9.4))
    value, error = map(
        seen.pixels, measured.own.estimate(lambda n: _over_first(measured.matrices(n)))
    )
    value = np.where(error <= limit, value, np.nan)
    with np.errstate(invalid="ignore", divide="ignore"):
        light = seen.pixels(measured.mueller[0][..., 0, 0]) / measured.sensor.solid_angle
    toned, signed = ColourScale.light(largest_of(light)), ColourScale.signed(1.0)
    first = draw_disc(panel[0, 0], seen, light, toned, labelled=False)
    for row, column in np.ndindex(4, 4):
        name = f"M{row}{column}"
        ax: Any = panel[row, column]
        ax.set_title(f"{name} / M00" if row or column else "M00")
        if row or column:
            pixels = value[..., row, column]
            image = draw_disc(ax, seen, pixels, signed, labelled=False)
    toned.bar(first, list(panel[:2].flat), "M00 (1/sr)", shrink=0.8)
    signed.bar(image, list(panel[2:].flat), "over M00", shrink=0.8)
    head_panel(panel, axes, seen, "Mueller matrices", f"no light, or not known to {limit:g}")
    return panel


def _over_first(matrices: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    return np.asarray(matrices / matrices[..., :1, :1])
