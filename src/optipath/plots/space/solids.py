"""What nodes look like in space: rectangles, discs and axes, as points."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.plots.space.scene import Scene, SceneNode

    Array = npt.NDArray[np.float64]

_HALF, _RADIUS = 0.3, 0.24
"""Half the side of a surface, and the radius of a plate, of the length of a link."""


def outline(scene: Scene, node: SceneNode) -> Array:
    """Return the outline of a surface or a plate.

    Shape: returns (points, 3).
    """
    normal, across = np.asarray(node.normal), np.asarray(node.across)
    along = np.cross(normal, across)
    if node.role == "plate":
        angle = np.linspace(0.0, 2.0 * np.pi, 49)[:, np.newaxis]
        circle = np.cos(angle) * across + np.sin(angle) * along
        return np.asarray(node.at + _RADIUS * scene.unit * circle)
    met = [ray.head for ray in scene.rays if ray.end == node.name]
    met += [ray.tail for ray in scene.rays if ray.start == node.name]
    half = _HALF * scene.unit
    low, high = _reach([float((point - node.at) @ along) for point in met], half)
    left, right = _reach([float((point - node.at) @ across) for point in met], half)
    corners = [(left, low), (right, low), (right, high), (left, high)]
    return np.array([node.at + a * across + b * along for a, b in corners])


def axis_line(scene: Scene, node: SceneNode) -> Array:
    """Return the line along the axis of a plate.

    Shape: returns (2, 3).
    """
    reach = 1.3 * _RADIUS * scene.unit * np.asarray(node.axis)
    return np.array([node.at - reach, node.at + reach])


def _reach(places: list[float], half: float) -> tuple[float, float]:
    return min([0.0, *places]) - half, max([0.0, *places]) + half
