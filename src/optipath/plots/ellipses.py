"""Polarization ellipses."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Arc, Circle

from optipath.plots.axes import own_axes
from optipath.plots.colors import DASHES, FAINT, INK, LINES
from optipath.plots.light_texts import (
    angle_text,
    digits,
    ellipse_points,
    figures_text,
    lights_to_draw,
    no_ellipse,
    state_text,
)
from optipath.plots.text import fitting, head, key_below

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from matplotlib.axes import Axes

    from optipath.light.light import Light
    from optipath.values.precision import Numbers


_REACH = 1.15
_DASHED: dict[str, Any] = {"linewidth": 0.8, "linestyle": (0, (4, 3))}
"""Of the part of one of several lights that is unpolarised."""

_SIDE = "seen towards the source (⊙\u00a0z)"


def ellipse(
    light: Light | Mapping[str, Light],
    ax: Axes | None = None,
    *,
    labels: str | Sequence[str] | None = None,
) -> Axes:
    """Draw the polarisation ellipse of light as who looks at the source sees it.

    x of the frame of the light is to the right, y upwards, and z towards the eye, so that a
    right-handed field (S3 > 0, `Light.handedness`) turns counter-clockwise, from x to y. Each
    light is drawn over the root of its own S0: the squares of the half axes a and b add up to the
    DoP, and a dashed circle has the power of the part that is unpolarised.

    Parameters
    ----------
    light : Light, or mapping of str to Light
        One, a batch of shape (n,), or single ones by their names; six at most. One alone has
        its axes and its angle drawn.
    ax : Axes, optional
        Where; a figure of its own by default, ``.figure`` of what is returned.
    labels : str or sequence of str, optional
        The name of the one, or of each of the batch.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import optipath as op
    >>> ax = ellipse(op.Light([2.0, 0.0, 0.6, 0.8]))
    >>> print(ax.get_title())
    right-handed elliptical
    S0 = 2, DoP = 0.5, AoP = 45°, b/a = 0.5
    """
    several = lights_to_draw(light, labels)
    ax = own_axes(ax, (5.0, 5.8 + 0.3 * (len(several) - 1)))
    ax.axhline(0.0, color=FAINT, linewidth=0.6, zorder=0)
    ax.axvline(0.0, color=FAINT, linewidth=0.6, zorder=0)
    if len(several) == 1:
        keys = _draw_one(ax, *next(iter(several.items())))
    else:
        keys = _draw_several(ax, several)
    reach = max(_REACH, 1.1 * max(map(abs, (*ax.dataLim.min, *ax.dataLim.max))))
    ax.update_datalim([(-reach, -reach), (reach, reach)])
    ax.margins(0.0)
    # A box that shrinks instead is not known to what lays texts out.
    ax.set_aspect("equal", adjustable="datalim")
    ax.set_ylabel("Ey / √S0")
    ax.set(xticks=(-1, 0, 1), yticks=(-1, 0, 1))
    ax.set_xlabel(f"Ex / √S0\n{fitting(ax, _SIDE, 'medium', less=2)}")
    key_below(ax, keys, "small" if len(several) == 1 else "x-small")
    # Limits only grow while texts are laid out.
    ax.figure.figure.draw_without_rendering()
    ax.autoscale_view()
    return ax


def _draw_one(ax: Axes, name: str, light: Light) -> list[Any]:
    title = f"{name}: {state_text(light)}" if name else state_text(light)
    head(ax, f"{title}\n{figures_text(light)}")
    keys = []
    share = unpolarised_share(light)
    line: dict[str, Any] = {"edgecolor": FAINT, "facecolor": "#8a8a8a22", "linestyle": (0, (4, 3))}
    if circle := draw_unpolarised(ax, light, line):
        circle.set_label(fitting(ax, f"unpolarised: {_percent(share)} of S0", less=5))
        keys.append(circle)
    if not no_ellipse(light):
        curve = draw_ellipse(ax, light, {"color": LINES[0], "linewidth": 2.2})
        curve.set_label(fitting(ax, f"polarised: {_percent(float(light.dop))} of S0", less=5))
        keys.insert(0, curve)
        if not np.isnan(light.aop):
            draw_axes_of(ax, light)
    return keys


def _draw_several(ax: Axes, several: Mapping[str, Light]) -> list[Any]:
    keys: list[Any] = []
    for place, (name, light) in enumerate(several.items()):
        line: dict[str, Any] = {"color": LINES[place], "linestyle": DASHES[place]}
        message = fitting(
            ax, f"{name}: {state_text(light)}, {figures_text(light)}", "x-small", less=5
        )
        rest = {"edgecolor": LINES[place], "facecolor": "none"} | _DASHED
        circle = draw_unpolarised(ax, light, rest)
        if no_ellipse(light):
            seen = {"color": LINES[place]} | _DASHED if circle else {"linestyle": "none"}
            keys.append(Line2D([], [], label=message, **seen))
            continue
        curve = draw_ellipse(ax, light, line | {"linewidth": 1.8})
        curve.set_label(message)
        keys.append(curve)
    if any(unpolarised_share(light) > 0.0 for light in several.values()):
        keys.append(Line2D([], [], label="unpolarised part", color=INK, **_DASHED))
    return keys


def _percent(share: float) -> str:
    return f"{digits(100.0 * share, 3)} %"


_SEEN = 0.05
"""How wide an ellipse is at least, of which details are drawn."""

_ARC = 0.3
_SMALL = np.radians(40.0)

_BACKED = {"boxstyle": "round,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.8}


def draw_ellipse(ax: Axes, light: Light, line: Mapping[str, Any]) -> Any:
    """Draw the ellipse of one light, with heads that show how the field turns."""
    points = np.sqrt(float(light.dop)) * ellipse_points(light, 145)
    (curve,) = ax.plot(*points.T, solid_capstyle="round", zorder=4, **line)
    if light.handedness and np.hypot(*np.ptp(points, axis=0)) > _SEEN:
        for place in (14, 86):
            head = {"arrowstyle": "-|>,head_width=0.3,head_length=0.6", "color": line["color"]}
            head |= {"linewidth": 0.0, "shrinkA": 0.0, "shrinkB": 0.0, "mutation_scale": 14.0}
            ax.annotate("", points[place + 4], points[place], arrowprops=head, zorder=5)
    return curve


def draw_unpolarised(ax: Axes, light: Light, line: Mapping[str, Any]) -> Circle | None:
    """Draw the part without polarisation as the circle that has its power; none of others."""
    share = unpolarised_share(light)
    if not share > 0.0:
        return None
    return ax.add_patch(Circle((0.0, 0.0), np.sqrt(0.5 * share), zorder=1, **line))  # type: ignore[return-value]


def unpolarised_share(light: Light) -> float:
    """Return how much of S0 is unpolarised: 0 where it is no more than noise, NaN where unknown."""
    rounding = 4.0 * float(np.finfo(light.stokes.dtype).eps)
    share = 1.0 - float(light.dop)
    return 0.0 if share < rounding else share


def draw_axes_of(ax: Axes, light: Light) -> None:
    """Draw the axes of an ellipse with their names, and the angle of the major one."""
    size, angle = np.sqrt(float(light.dop)), float(light.aop)
    major = size * np.cos(float(light.ellipticity_angle))
    minor = size * abs(np.sin(float(light.ellipticity_angle)))
    if 2.0 * major < _SEEN:
        return
    # Names stand where the angle does not.
    across = angle + np.copysign(0.5 * np.pi, angle)
    for name, length, way in (("a", major, angle + np.pi), ("b", minor, across)):
        if length > 0.5 * _SEEN:
            end = length * _toward(way)
            ax.plot(*np.transpose([-end, end]), color=FAINT, linewidth=0.9, zorder=3)
            middle: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": "small"}
            x, y = end + 0.07 * _toward(way)
            ax.text(x, y, name, style="italic", color=INK, **middle)
    if angle == 0.0:
        return
    degrees, width = sorted((0.0, np.degrees(angle))), 2.0 * _ARC
    arc = Arc((0.0, 0.0), width, width, theta1=degrees[0], theta2=degrees[1])
    arc.set(color=INK, linewidth=1.2, zorder=5)
    ax.add_patch(arc)
    # The value of a small angle stands across x, where no axis of the ellipse is.
    small = abs(angle) < _SMALL
    x, y = (_ARC, -np.copysign(0.05, angle)) if small else (_ARC + 0.05) * _toward(0.5 * angle)
    place: dict[str, Any] = {"ha": "left", "va": "bottom" if y > 0.0 else "top", "zorder": 6}
    ax.text(x, y, angle_text(light), fontsize="small", color=INK, bbox=_BACKED, **place)


def _toward(angle: float) -> Numbers:
    return np.array([np.cos(angle), np.sin(angle)])
