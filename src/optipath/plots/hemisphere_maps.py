"""Maps of hemispheres: one quantity, Mueller elements, differences, facet model."""

from __future__ import annotations

from itertools import product
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import SurfaceError
from optipath.plots.axes import own_axes, own_panel
from optipath.plots.color_scale import ColourScale
from optipath.plots.colors import positive
from optipath.plots.hemisphere_disc import draw_disc, head_panel
from optipath.plots.hemisphere_side import QUANTITIES, SeenSide, largest_of, quantity_of
from optipath.surfaces.walk.beam import UNPOLARISED

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt
    from matplotlib.axes import Axes

    from optipath.plots.axes import Panel
    from optipath.surfaces.hemisphere.hemisphere import Hemisphere
    from optipath.values.precision import Numbers


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
        If the quantity, the side, the wavelength, the source or the mask does not fit.

    Examples
    --------
    >>> import optipath as op
    >>> sample = op.Sample([(0.5 + 2.1j, 0.3)], cells=200)
    >>> found = op.measure(sample, "40 deg", photons=16_384, sensor=16)
    >>> hemisphere(found, "DoLP").get_title()
    'DoLP, reflected, incidence 40°'
    """
    drawn = quantity_of(quantity, QUANTITIES)
    faults = [*positive("largest", largest), *positive("known_to", known_to)]
    if largest is not None and drawn.is_bounded:
        faults.append(f"largest is given, but colours of {drawn.variable} end at their own limits")
    if drawn.over_wavelengths and wavelength is not None:
        faults.append(f"{drawn.variable} is of all wavelengths together; leave wavelength out")
    if faults:
        raise SurfaceError(*faults)
    seen = SeenSide.of(measured, side, wavelength, source, every=drawn.over_wavelengths)
    if drawn.masked and any(seen.source[1:]):
        raise SurfaceError(f"{drawn.variable} is of unpolarised light; leave source out")
    pixels = drawn.known(seen, known_to, mask)
    ax = own_axes(ax, (5.6, 5.0))
    scale = drawn.scale(largest_of(pixels.values) if largest is None else largest)
    image = draw_disc(ax, seen, pixels.values, scale, hatched=fill(pixels.unknown, _COLUMNS))
    scale.bar(image, ax, drawn.label, shrink=0.8)
    ax.set_title(seen.titled(drawn.variable))
    return ax


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
        If the side or the wavelength does not fit, or no Mueller matrix has been measured.

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
    light = seen.per_steradian(measured.mueller[0][..., 0, 0])
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


def _over_first(matrices: Numbers) -> Numbers:
    return np.asarray(matrices / matrices[..., :1, :1])


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
        If the side or the wavelength does not fit, or light has not been measured both with
        polarisation and without.

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
    every = measured.mueller[0][..., 0, 0], measured.scalar[0], measured.difference[0]
    polarised, scalar, apart = map(seen.per_steradian, every)
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
        If the side or the wavelength does not fit, no Mueller matrix has been measured, or the
        model knows nothing of the sample.

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
    result = measured.stokes(seen.source).values
    model = measured.single_scattering().values @ np.array(seen.source)
    by_photons, by_model = map(seen.per_steradian, (result, model))
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
