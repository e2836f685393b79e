"""One polarisation ellipse in axes: its curve, its axes, its angle, what is unpolarised."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.patches import Arc, Circle

from optipath.plots.line_colours import FAINT, INK
from optipath.plots.states.ellipse_points import ellipse_points
from optipath.plots.states.state_words import angle_text, no_ellipse

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt
    from matplotlib.axes import Axes

    from optipath.light.light import Light

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
    """Return how much of S0 is unpolarised: 0 where it is no more than noise, NaN where unknown.

    Examples
    --------
    >>> import optipath as op
    >>> unpolarised_share(op.Light([2.0, 0.0, 0.6, 0.8]))
    0.5
    """
    rounding = 4.0 * float(np.finfo(light.mantissa.dtype).eps)
    share = 1.0 - float(light.dop)
    return 0.0 if share < rounding else share


def draw_axes_of(ax: Axes, light: Light) -> None:
    """Draw the axes of an ellipse with their names, and the angle of the major one."""
    if no_ellipse(light) or np.isnan(light.aop):
        return
    size, angle = np.sqrt(float(light.dop)), float(light.aop)
    major = size * np.cos(float(light.ellipticity_angle))
    minor = size * abs(np.sin(float(light.ellipticity_angle)))
    if 2.0 * major < _SEEN:
        return
    # Names stand where the angle does not.
    side = np.copysign(0.5 * np.pi, angle)
    _half_axes(ax, major, angle + np.pi, "a")
    if minor > 0.5 * _SEEN:
        _half_axes(ax, minor, angle + side, "b")
    _draw_angle(ax, angle, angle_text(light))


def _half_axes(ax: Axes, length: float, angle: float, name: str) -> None:
    end = length * _toward(angle)
    ax.plot(*np.transpose([-end, end]), color=FAINT, linewidth=0.9, zorder=3)
    x, y = end + 0.07 * _toward(angle)
    ax.text(x, y, name, ha="center", va="center", fontsize="small", style="italic", color=INK)


def _draw_angle(ax: Axes, angle: float, text: str) -> None:
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
    ax.text(x, y, text, fontsize="small", color=INK, bbox=_BACKED, **place)


def _toward(angle: float) -> npt.NDArray[np.float64]:
    return np.array([np.cos(angle), np.sin(angle)])
