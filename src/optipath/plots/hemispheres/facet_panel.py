"""Light scattered once, by photons and by the analytic model, and the difference."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import SurfaceError
from optipath.plots.colour_scale import ColourScale
from optipath.plots.hemispheres.disc import draw_disc, head_panel
from optipath.plots.hemispheres.pixel_quantity import largest_of
from optipath.plots.hemispheres.seen_side import SeenSide
from optipath.plots.own_axes import own_panel
from optipath.surfaces.walk.given_beam import UNPOLARISED

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.plots.own_axes import Panel
    from optipath.surfaces.hemispheres.hemisphere import Hemisphere

_ROWS = "photons", "model", "difference"


def beside_facets(
    measured: Hemisphere,
    axes: Any = None,
    *,
    source: npt.ArrayLike = UNPOLARISED,
    wavelength: Any = None,
) -> Panel:
    """Draw the Stokes vectors of light scattered once: by photons, by the model, the difference.

    The model is `Hemisphere.single_scattering`, averaged over the pixels; M. Wang et al., Optics
    Express 25(19), 2017, figure 4, draw the same. Stokes vectors are per steradian, in the colours
    of `hemisphere`; the differences are in per cent of the largest S0 of the model.

    Parameters
    ----------
    measured : Hemisphere
        What `measure` returned, with ``events=1``.
    axes : array_like of 3 x 4 Axes, optional
        Where; in a figure of their own by default.
    source : array_like, shape (4,), optional
        The Stokes vector of the light that comes in, in the frame whose x is horizontal;
        unpolarised by default.
    wavelength : float or str, optional
        One of those measured, where there are several.

    Returns
    -------
    ndarray of Axes, shape (3, 4)

    Raises
    ------
    SurfaceError
        With all faults at once, or if no Mueller matrix has been measured, or the model knows
        nothing of the sample.

    Examples
    --------
    >>> import optipath as op
    >>> sample = op.Sample([(0.5 + 2.1j, 0.3)], cells=200)
    >>> found = op.measure(sample, "40 deg", photons=16_384, sensor=16, events=1)
    >>> beside_facets(found).shape
    (3, 4)
    """
    seen = SeenSide.of(measured, "reflected", wavelength, source)
    if measured.seen.events != 1:
        raise SurfaceError(
            "the model knows only light that is scattered once, and photons were measured after "
            "other numbers of events, too; measure with events=1"
        )
    panel = own_panel(axes, (3, 4), (12.4, 9.2))
    found = measured.stokes(seen.source).values
    model = measured.single_scattering().values @ np.array(seen.source)
    with np.errstate(invalid="ignore", divide="ignore"):
        by_photons, by_model = (
            seen.pixels(each) / measured.sensor.solid_angle[..., np.newaxis]
            for each in (found, model)
        )
    brightest = largest_of(by_model[..., 0])
    apart = 100.0 * (by_photons - by_model) / brightest
    both = np.stack([by_photons, by_model])
    toned = ColourScale.light(largest_of(both[..., 0]))
    signed = ColourScale.signed_light(largest_of(both[..., 1:]))
    linear = ColourScale.signed(largest_of(apart))
    values = np.stack([by_photons, by_model, apart])
    for rows, columns, scale, label, place in (
        ((0, 1), (0,), toned, "S0 (1/sr)", "left"),
        ((0, 1), (1, 2, 3), signed, "S1, S2, S3 (1/sr)", "right"),
        ((2,), (0, 1, 2, 3), linear, "difference (% of the largest S0)", "right"),
    ):
        for row, column in product(rows, columns):
            ax: Any = panel[row, column]
            image = draw_disc(ax, seen, values[row, ..., column], scale, labelled=False)
            ax.set_title(f"S{column}, {_ROWS[row]}")
        together = list(panel[np.ix_(rows, columns)].flat)
        scale.bar(image, together, label, location=place, shrink=0.8)
    head_panel(panel, axes, seen, "scattered once")
    return panel
