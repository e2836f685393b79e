"""The symbols of an optical bench."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.patches import Circle, Polygon, Wedge

from optipath.plots.line_colours import FAINT, INK, LINES

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.axes import Axes

    from optipath.plots.space.scene import SceneNode

    Array = npt.NDArray[np.float64]

BLUE, ELLIPSE, _, _, FACE, LAMP = LINES
HIGH = 0.26
"""Half the height of a plate or the length of a surface."""

DIAL = 0.15
"""The radius of the dials in which axes and polarisation are seen face on."""

_LAYERS = {"layer-stack": 3}
_RETARDING = ("retarder", "waveplate", "elliptical-retarder", "medium")
_TURNING = ("rotator", "faraday-rotator")
_SPLITTING = ("beam-splitter", "polarizing-beam-splitter")


def draw_symbol(ax: Axes, node: SceneNode, at: Array, way: Array, face: Array | None) -> None:
    """Draw the symbol of an element.

    Shapes: at (2,); way (2,); face (3, 2).
    """
    if node.role == "source":
        _lamp(ax, at)
    elif node.role == "detector":
        angle = float(np.degrees(np.arctan2(way[1], way[0])))
        _add(ax, Wedge(tuple(at), 0.17, angle - 90.0, angle + 90.0, fc="#555555", ec=INK))
    elif node.role == "dump":
        _box(ax, at + 0.1 * way, way, (0.1, 0.14), fc="white", ec=INK)
    elif node.kind in _SPLITTING:
        _box(ax, at, way, (0.2, 0.2), fc=_pale(FACE), ec=BLUE)
        if face is not None:
            middle = (face[1] + face[2]) / 2.0
            ends = middle + 0.45 * (face[1:] - middle)
            ax.plot(*ends.T, color=BLUE, lw=1.6, zorder=5)
    elif node.role in ("surface", "mirror"):
        _boundary(ax, node, at, face)
    elif node.role == "plate":
        _plate(ax, node, at, way)
    else:
        _add(ax, Circle(tuple(at), 0.07, fc="white", ec=INK))


def dial(ax: Axes, at: Array, line: Array, colour: str, zorder: float = 6.0) -> Array:
    """Draw a dial with what is seen in it when one looks at the source.

    Shapes: at (2,); line (points, 2); returns (points, 2).
    """
    _add(ax, Circle(tuple(at), DIAL, fc="white", ec=FAINT, lw=0.7), zorder)
    # Who looks at the source has x to the right where y is up, and z comes to him.
    seen = at + 0.92 * DIAL * np.reshape(line, (-1, 2))
    if len(seen):
        style: Any = {"color": colour, "lw": 1.6, "solid_capstyle": "round"}
        ax.plot(*seen.T, zorder=zorder + 0.1, **style)
    return seen


def _lamp(ax: Axes, at: Array) -> None:
    # No name stands between its rays.
    ax.add_patch(Circle(tuple(at), 0.19, fc="none", ec="none"))
    for angle in np.arange(0.0, 2.0 * np.pi, np.pi / 4.0):
        way = np.array([np.cos(angle), np.sin(angle)])
        ax.plot(*np.array([at + 0.13 * way, at + 0.19 * way]).T, color=INK, lw=1.0, zorder=5)
    _add(ax, Circle(tuple(at), 0.1, fc=LAMP, ec=INK))


def _plate(ax: Axes, node: SceneNode, at: Array, way: Array) -> None:
    if node.kind in _RETARDING:
        _box(ax, at, way, (0.11, HIGH), fc=_pale(FACE), ec=BLUE)
    elif node.kind in _TURNING:
        _box(ax, at, way, (0.2, 0.2), fc="#f7ecd0", ec=INK)
    else:
        _box(ax, at, way, (0.045, HIGH), fc="#bbbbbb", ec=INK)


def _boundary(ax: Axes, node: SceneNode, at: Array, face: Array | None) -> None:
    if face is None or np.linalg.norm(face[0]) < 0.5:
        _add(ax, Circle(tuple(at), 0.07, fc="white", ec=INK))
        return
    normal, *ends = face
    layers = _LAYERS.get(node.kind, 1)
    depth = max(0.05 * (layers - 1), 0.09) * normal
    corners = np.array([ends[0], ends[1], ends[1] - depth, ends[0] - depth])
    is_mirror = node.role == "mirror"
    _add(ax, Polygon(corners, fc="#9a9a9a" if is_mirror else _pale(FACE), ec="none"), 4.0)
    for layer in range(layers):
        line = np.array(ends) - 0.05 * layer * normal
        ax.plot(*line.T, color=INK if is_mirror else BLUE, lw=1.6, zorder=5)


def _box(ax: Axes, at: Array, way: Array, halves: tuple[float, float], **style: Any) -> None:
    along, across = halves[0] * way, halves[1] * np.array([-way[1], way[0]])
    corners = [at - along - across, at + along - across, at + along + across, at - along + across]
    _add(ax, Polygon(np.array(corners), **style), 4.0)


def _add(ax: Axes, patch: Any, zorder: float = 5.0) -> None:
    patch.set_zorder(zorder)
    if patch.get_linewidth() > 0.9:
        patch.set_linewidth(0.9)
    ax.add_patch(patch)


def _pale(colour: str) -> tuple[float, ...]:
    return tuple(0.55 + 0.45 * part for part in to_rgb(colour))
