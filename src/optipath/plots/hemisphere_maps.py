"""Maps of hemispheres: one quantity, Mueller elements, differences, facet model."""

from __future__ import annotations

from itertools import product
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Patch

from optipath.errors import SurfaceError
from optipath.plots.axes import own_axes, own_panel, positive
from optipath.plots.colors import FAINT, HATCHED, INK, ColourScale
from optipath.plots.hemisphere_side import (
    QUANTITIES,
    SeenSide,
    degrees,
    largest_of,
    quantity_of,
)
from optipath.plots.text import key_below
from optipath.surfaces.walk.beam import UNPOLARISED

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt
    from matplotlib.axes import Axes
    from matplotlib.image import AxesImage

    from optipath.plots.axes import Panel
    from optipath.plots.hemisphere_side import PixelName
    from optipath.surfaces.hemisphere.beam import Side
    from optipath.surfaces.hemisphere.hemisphere import Hemisphere
    from optipath.values.precision import Numbers


_COLUMNS = 56
"""How wide a sentence is below a disc."""


def hemisphere(
    measured: Hemisphere,
    quantity: PixelName = "S0",
    ax: Axes | None = None,
    *,
    source: npt.ArrayLike = UNPOLARISED,
    side: Side = "reflected",
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
    SurfaceError.raise_for(faults)
    seen = SeenSide.of(measured, side, wavelength, source, every=drawn.over_wavelengths)
    if drawn.masked and any(seen.source[1:]):
        raise SurfaceError(f"{drawn.variable} is of unpolarised light; leave source out")
    values, unknown = drawn.known(seen, known_to, mask)
    ax = own_axes(ax, (5.6, 5.0))
    scale = drawn.scale(largest_of(values) if largest is None else largest)
    image = _draw_disc(ax, seen, values, scale, hatched=fill(unknown, _COLUMNS))
    scale.bar(image, ax, drawn.label, shrink=0.8)
    ax.set_title(seen.titled(drawn.variable))
    return ax


_KNOWN_TO = 0.1


def mueller_hemisphere(
    measured: Hemisphere,
    axes: Any = None,
    *,
    side: Side = "reflected",
    wavelength: Any = None,
    known_to: float | None = None,
) -> Panel:
    """Draw the Mueller matrices of all directions: a map of M00, and of all others over M00.

    M00 is per steradian, in the colours of `hemisphere`; the others are from -1 to 1.

    Parameters
    ----------
    measured, side, wavelength, known_to
        As `hemisphere` takes them; `known_to` is 0.1 by default.
    axes : array_like of 4 x 4 Axes, optional
        Where; in a figure of their own by default.

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
    SurfaceError.raise_for(positive("known_to", known_to))
    limit = _KNOWN_TO if known_to is None else known_to
    seen = SeenSide.of(measured, side, wavelength, UNPOLARISED)
    panel = own_panel(axes, (4, 4), (9.6, 9.4))
    value, error = map(
        seen.pixels, measured.own.estimate(lambda n: _over_first(measured.matrices(n)))
    )
    value = np.where(error <= limit, value, np.nan)
    light = seen.per_steradian(measured.mueller[0][..., 0, 0])
    toned, signed = ColourScale.light(largest_of(light)), ColourScale.signed(1.0)
    first = _draw_disc(panel[0, 0], seen, light, toned, labelled=False)
    for row, column in np.ndindex(4, 4):
        name = f"M{row}{column}"
        ax: Any = panel[row, column]
        ax.set_title(f"{name} / M00" if row or column else "M00")
        if row or column:
            image = _draw_disc(ax, seen, value[..., row, column], signed, labelled=False)
    toned.bar(first, list(panel[:2].flat), "M00 (1/sr)", shrink=0.8)
    signed.bar(image, list(panel[2:].flat), "over M00", shrink=0.8)
    _head_panel(panel, axes, seen, "Mueller matrices", f"no light, or not known to {limit:g}")
    return panel


def _over_first(matrices: Numbers) -> Numbers:
    return np.asarray(matrices / matrices[..., :1, :1])


def differences(
    measured: Hemisphere, axes: Any = None, *, side: Side = "reflected", wavelength: Any = None
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
    side, wavelength
        As `hemisphere` takes them.

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
    _draw_disc(panel[0], seen, polarised, light)
    image = _draw_disc(panel[1], seen, scalar, light)
    light.bar(image, list(panel[:2]), "light (1/sr)", shrink=0.8)
    signed.bar(_draw_disc(panel[2], seen, apart, signed), panel[2], "S0 - U (1/sr)", shrink=0.8)
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
    source, wavelength
        As `hemisphere` takes them.

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
            "photons were measured after other numbers of events than one; measure with events=1"
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
            image = _draw_disc(ax, seen, values[row, ..., column], scale, labelled=False)
            ax.set_title(f"S{column}, {_ROWS[row]}")
        together = list(panel[np.ix_(rows, columns)].flat)
        scale.bar(image, together, label, location=place, shrink=0.8)
    _head_panel(panel, axes, seen, "scattered once")
    return panel


_RINGS = 30.0, 60.0
_LABELLED_AT = np.radians(-62.0)
"""At which azimuth rings are labelled: away from the plane of incidence, where the light is."""

_AZIMUTHS = (0.0, "left", "center"), (90.0, "center", "bottom"), (180.0, "right", "center")
_RING: dict[str, Any] = {"fc": "none", "ec": FAINT, "lw": 0.6, "ls": (0, (4, 3)), "zorder": 4}


def _draw_disc(
    ax: Axes,
    seen: SeenSide,
    values: Numbers,
    scale: ColourScale,
    *,
    labelled: bool = True,
    hatched: str = "",
) -> AxesImage:
    """Draw the pixels of a side within the circle of the horizon, with rings and azimuths.

    Pixels without a value are hatched; a cross marks the specular or refracted direction.
    """
    ax.set_axis_off()
    horizon = Circle((0.0, 0.0), 1.0, facecolor="none", edgecolor=INK, linewidth=1.0, zorder=3)
    ax.add_patch(horizon)
    keys = []
    if np.isnan(values[~np.isnan(seen.measured.sensor.theta)]).any():
        ax.add_patch(Circle((0.0, 0.0), 1.0, **HATCHED))
        keys += [Patch(label=hatched, **HATCHED)] if hatched else []
    place: dict[str, Any] = {"origin": "lower", "extent": (-1.0, 1.0, -1.0, 1.0), "zorder": 2}
    place["interpolation"] = "nearest"
    image = ax.imshow(np.ma.masked_invalid(values), scale.colours, scale.norm, **place)
    image.set_clip_path(horizon)
    reach = 1.16 if labelled else 1.03
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach))
    _draw_rings(ax, seen, labelled=labelled)
    _mark_mirrored(ax, seen)
    if labelled and (keys := [*_keys(seen), *keys]):
        key_below(ax, keys)
    return image


def _head_panel(axes: Any, argument: Any, seen: SeenSide, what: str, hatched: str = "") -> None:
    """Say above discs that are not labelled what is seen, where a caller has not their figure."""
    if argument is None:
        messages = [
            "rings: 30° and 60° from the normal",
            *(f"+ {each.get_label()}" for each in _keys(seen)),
        ]
        messages += [f"hatched: {hatched}"] if hatched else []
        figure = axes.flat[0].figure.figure
        figure.suptitle(f"{seen.titled(what)}\n{'; '.join(messages)}", fontsize="medium")


def _draw_rings(ax: Axes, seen: SeenSide, *, labelled: bool) -> None:
    style: dict[str, Any] = {"ha": "center", "va": "center", "color": INK, "zorder": 6}
    x, y = np.cos(_LABELLED_AT), np.sin(_LABELLED_AT)
    backed = {"boxstyle": "round,pad=0.12", "fc": "white", "ec": "none", "alpha": 0.75}
    for angle in _RINGS:
        radius = seen.radius(np.radians(angle))
        ax.add_patch(Circle((0.0, 0.0), radius, **_RING))
        if labelled:
            text = ax.text(radius * x, radius * y, f"{angle:g}°", fontsize="x-small", **style)
            text.set_bbox(backed)
    if not labelled:
        return
    ax.text(1.08 * x, 1.08 * y, "θ = 90°", fontsize="x-small", **style | {"ha": "left"})
    for azimuth, across, up in _AZIMUTHS:
        x, y = np.cos(np.radians(azimuth)), np.sin(np.radians(azimuth))
        ax.plot([0.97 * x, 1.03 * x], [0.97 * y, 1.03 * y], color=INK, linewidth=1.0, zorder=5)
        name = f"{azimuth:g}°" if azimuth else "φ = 0°"
        ax.text(1.05 * x, 1.05 * y, name, ha=across, va=up, fontsize="small", color=INK)


def _mark_mirrored(ax: Axes, seen: SeenSide) -> None:
    """Mark where a smooth sample sends light."""
    if np.isnan(angle := seen.mirrored):
        return
    # White within black is seen on any colour.
    for size, width, colour in ((9.0, 3.0, "black"), (8.0, 1.2, "white")):
        mark: dict[str, Any] = {"marker": "+", "markersize": size, "markeredgewidth": width}
        ax.plot(seen.radius(angle), 0.0, color=colour, linestyle="none", zorder=7, **mark)


def _keys(seen: SeenSide) -> list[Any]:
    """Return what names the mark."""
    if np.isnan(angle := seen.mirrored):
        return []
    what = "specular direction" if seen.side == "reflected" else "refracted by a smooth sample"
    label = f"{what}, {degrees(angle)}"
    return [Line2D([], [], marker="+", color=INK, linestyle="none", label=label)]
