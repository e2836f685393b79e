"""A hemisphere of directions, drawn as the disc that a sensor lays it out as."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Patch

from optipath.plots.colors import FAINT, HATCHED, INK
from optipath.plots.hemisphere_side import degrees

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.image import AxesImage

    from optipath.plots.color_scale import ColourScale
    from optipath.plots.hemisphere_side import SeenSide
    from optipath.values.precision import Numbers


_RINGS = 30.0, 60.0
_LABELLED_AT = np.radians(-62.0)
"""At which azimuth rings are labelled: away from the plane of incidence, where the light is."""

_AZIMUTHS = (0.0, "left", "center"), (90.0, "center", "bottom"), (180.0, "right", "center")
_RING: dict[str, Any] = {
    "facecolor": "none",
    "edgecolor": FAINT,
    "linewidth": 0.6,
    "linestyle": (0, (4, 3)),
    "zorder": 4,
}
_KEY: dict[str, Any] = {
    "loc": "upper center",
    "bbox_to_anchor": (0.5, 0.04),
    "frameon": False,
    "fontsize": "small",
    "borderaxespad": 0.0,
}


def draw_disc(
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
    ax.set_aspect("equal")
    ax.set_axis_off()
    reach = 1.16 if labelled else 1.03
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach))
    horizon = Circle((0.0, 0.0), 1.0, facecolor="none", edgecolor=INK, linewidth=1.0, zorder=3)
    ax.add_patch(horizon)
    keys = []
    if np.isnan(values[~np.isnan(seen.measured.sensor.theta)]).any():
        ax.add_patch(Circle((0.0, 0.0), 1.0, **HATCHED))
        keys += [Patch(label=hatched, **HATCHED)] if hatched else []
    image = ax.imshow(
        np.ma.masked_invalid(values),
        cmap=scale.colours,
        norm=scale.norm,
        origin="lower",
        extent=(-1.0, 1.0, -1.0, 1.0),
        interpolation="nearest",
        zorder=2,
    )
    image.set_clip_path(horizon)
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach))
    _draw_rings(ax, seen, labelled=labelled)
    _mark_mirrored(ax, seen)
    if labelled and (keys := [*_keys(seen), *keys]):
        ax.legend(handles=keys, **_KEY)
    return image


def head_panel(axes: Any, argument: Any, seen: SeenSide, what: str, hatched: str = "") -> None:
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
