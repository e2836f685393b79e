"""Where a scene is seen from: what is in space becomes points of a sheet."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy.typing as npt

    from optipath.plots.space.scene import Scene

    Array = npt.NDArray[np.float64]

_ELEVATIONS, _AZIMUTHS = (15.0, 24.0, 34.0, 46.0), np.arange(-180.0, 180.0, 15.0)
"""In degrees; the views among which one is chosen."""


class View(NamedTuple):
    """A direction to look from; parallel lines stay parallel.

    Units: elevation, azimuth in degrees.
    """

    elevation: float
    azimuth: float

    @property
    def sheet(self) -> Array:
        """The directions to the right and up on the sheet, and towards who looks, a row each."""
        c, s = np.cos(np.radians(self.azimuth)), np.sin(np.radians(self.azimuth))
        flat, high = np.cos(np.radians(self.elevation)), np.sin(np.radians(self.elevation))
        right, up = (-s, c, 0.0), (-high * c, -high * s, flat)
        return np.array([right, up, (flat * c, flat * s, high)])

    def points(self, points: Array) -> Array:
        """Return points of space on the sheet.

        Shapes: points (..., 3); returns (..., 2).

        Examples
        --------
        >>> View(0.0, -90.0).points(np.array([2.0, 5.0, 3.0])).round(12)
        array([2., 3.])
        """
        return np.asarray(points) @ self.sheet[:2].T


def chosen_view(scene: Scene, aspect: float) -> View:
    """Return the view in which nodes and rays are farthest apart, and surfaces are seen best."""
    views = [View(elevation, float(azimuth)) for elevation in _ELEVATIONS for azimuth in _AZIMUTHS]
    return max(views, key=lambda view: _merit(scene, view, aspect))


def _merit(scene: Scene, view: View, aspect: float) -> float:
    nodes = view.points(np.array([node.at for node in scene.nodes]))
    ends = [view.points(np.array([ray.tail, ray.head])) for ray in scene.rays]
    size = np.ptp(np.concatenate([nodes, *ends]), axis=0)
    scale = 1.0 / max(size[0] / aspect, size[1], 1e-9)
    apart = min((*_distances(scene, nodes, ends), 1.0 / scale), default=1.0) * scale
    towards = view.sheet[2]
    # Ellipses and surfaces are seen from aside, and rays not along themselves.
    faces = [abs(float(ray.axes[2] @ towards)) for ray in scene.rays]
    faces += [abs(float(n.normal @ towards)) for n in scene.nodes if n.normal is not None]
    open_ones = float(np.mean(np.minimum(faces, 0.5))) if faces else 0.5
    least = min(faces, default=0.5)
    ahead = np.mean([ray.axes[2] @ view.sheet[0] for ray in scene.rays]) if scene.rays else 0.0
    return float(apart * (0.1 + open_ones + 0.8 * min(least, 0.3)) * (1.0 + 0.05 * ahead))


def _distances(scene: Scene, nodes: Array, ends: list[Array]) -> Iterator[float]:
    """Yield how far nodes are from one another, and from rays that pass them."""
    for one, other in combinations(nodes, 2):
        yield float(np.linalg.norm(one - other))
    for ray, (tail, head) in zip(scene.rays, ends, strict=True):
        for node, at in zip(scene.nodes, nodes, strict=True):
            if node.name not in (ray.start, ray.end):
                yield 1.5 * _from_segment(at, tail, head)


def _from_segment(point: Array, tail: Array, head: Array) -> float:
    way = head - tail
    share = np.clip((point - tail) @ way / max(float(way @ way), 1e-30), 0.0, 1.0)
    return float(np.linalg.norm(point - tail - share * way))
