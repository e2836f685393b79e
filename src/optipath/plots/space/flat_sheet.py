"""A set-up that lies in one plane, laid flat on a sheet; long straight ones in rows."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from optipath.errors import PathError
from optipath.values.cures import cure

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.plots.space.scene import Scene, SceneNode

    Array = npt.NDArray[np.float64]

_IN_PLANE = 1e-7
"""The sine of an angle out of the plane that is rounding."""


_FROM_EDGE = 0.2
"""How far from the edge polarisation is drawn, in lengths of a link."""


class FlatRay(NamedTuple):
    """A ray on a sheet.

    Shapes: pieces (2, 2); middle (2,).
    """

    pieces: tuple[Array, ...]
    middle: Array


class FlatSheet(NamedTuple):
    """A scene on a sheet, a link being about 1 long.

    Shapes: sheet (2, 3); at (2,).
    """

    sheet: Array
    at: dict[str, Array]
    rays: tuple[FlatRay, ...]
    straight: bool
    unit: float

    def in_dial(self, axes: Array, vectors: Array) -> Array:
        """Return what lies across light as who looks at the source sees it.

        Shapes: axes (3, 3); vectors (..., 3); returns (..., 2).
        """
        right = np.cross(self.sheet[1], self.sheet[0])
        return np.asarray(vectors @ np.array([right, np.cross(axes[2], right)]).T)


def flat_sheet(scene: Scene) -> FlatSheet:
    """Return a scene laid flat."""
    right = scene.rays[0].axes[2] if scene.rays else np.eye(3)[0]
    ways = np.array([ray.axes[2] for ray in scene.rays]).reshape(-1, 3)
    aside = ways - np.outer(ways @ right, right)
    largest = int(np.argmax(np.linalg.norm(aside, axis=1))) if len(aside) else 0
    straight = not len(aside) or bool(np.linalg.norm(aside[largest]) < _IN_PLANE)
    first = scene.rays[0].axes if scene.rays else np.eye(3)
    up = first[1] if straight else aside[largest] / np.linalg.norm(aside[largest])
    if not straight and up @ first[1] < -_IN_PLANE:
        up = -up
    normal = np.cross(right, up)
    out = [ray.end or ray.start for ray in scene.rays if abs(ray.axes[2] @ normal) > _IN_PLANE]
    if out:
        raise PathError(
            f"bench draws set-ups that lie in one plane, but light leaves that at '{out[0]}'; "
            f"{cure('op.plots.geometry(path)', '--kind geometry')} draws this path in space"
        )
    sheet, origin = np.array([right, up]), scene.nodes[0].at
    at = {n.name: sheet @ (n.at - origin) / scene.unit for n in scene.nodes}
    ends = [
        np.array([ray.tail - origin, ray.head - origin]) @ sheet.T / scene.unit
        for ray in scene.rays
    ]
    flat = tuple(FlatRay((both,), both.mean(axis=0)) for both in ends)
    back = any(way @ right < 0.0 for way in ways)
    return FlatSheet(sheet, at, flat, straight and not back, scene.unit)


def in_rows(flat: FlatSheet, scene: Scene, each: int, apart: tuple[float, float]) -> FlatSheet:
    """Return a straight set-up in rows."""
    step, down = apart
    order = sorted(flat.at, key=lambda name: float(flat.at[name][0]))
    at = {
        name: np.array([step * (place % each), -down * (place // each)])
        for place, name in enumerate(order)
    }
    rays, half = [], np.array([step / 2.0, 0.0])
    for ray in scene.rays:
        tail = at[ray.start]
        head = at[ray.end] if ray.end else tail + half
        if tail[1] == head[1]:
            rays.append(FlatRay((np.array([tail, head]),), (tail + head) / 2.0))
            continue
        # What goes on in the next row goes as far as the middle between two nodes.
        pieces = np.array([tail, tail + half]), np.array([head - half, head])
        rays.append(FlatRay(pieces, head - half + [min(_FROM_EDGE, 0.5 * half[0]), 0.0]))
    return flat._replace(at=at, rays=tuple(rays))


def direction_at(node: SceneNode, scene: Scene, flat: FlatSheet) -> Array:
    """Return the way on the sheet in which light arrives at a node, or leaves a source.

    Shape: returns (2,).
    """
    rays = [ray for ray in scene.rays if ray.end == node.name]
    rays += [ray for ray in scene.rays if ray.start == node.name]
    return np.asarray(flat.sheet @ rays[0].axes[2] if rays else np.array([1.0, 0.0]))


def nearest_symbols(scene: Scene, flat: FlatSheet) -> float:
    """Return how near two symbols are whose middles are nearest, dials of light included."""
    rays = zip(scene.rays, flat.rays, strict=True)
    dials = [drawn.middle for ray, drawn in rays if not (ray.leaves or ray.is_dark)]
    return min(
        (float(np.linalg.norm(a - b)) for a, b in combinations([*flat.at.values(), *dials], 2)),
        default=np.inf,
    )
