"""A path laid out in space: what stands where, which way light goes, and what angles there are."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.materials.quantities import plain

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.light.light import Light

    Vector = npt.NDArray[np.float64]


class SceneNode(NamedTuple):
    """An element where it stands.

    Shapes: at (3,); normal, across (3,); axis (3,).
    """

    name: str
    kind: str
    at: Vector
    normal: Vector | None
    across: Vector | None
    role: str
    axis: Vector | None = None


class SceneRay(NamedTuple):
    """The light of a link, or what leaves the path.

    Shapes: tail, head (3,); axes (3, 3); ellipse (points, 3).
    """

    name: str
    start: str
    end: str
    tail: Vector
    head: Vector
    axes: Vector
    ellipse: Vector | None
    light: Light
    leaves: bool
    tap: bool

    @property
    def turns(self) -> bool:
        """Whether its field turns, and is no line."""
        return self.ellipse is not None and bool(self.light.handedness)

    @property
    def is_dark(self) -> bool:
        """Whether there is no light, but for rounding."""
        return bool(np.isnan(self.light.dop))


class ScenePlane(NamedTuple):
    """A plane of incidence, as a rectangle.

    Shape: corners (4, 3).
    """

    node: str
    corners: Vector


class SceneFrame(NamedTuple):
    """The frame of a port.

    Shapes: at (3,); axes (3, 3).
    """

    port: str
    at: Vector
    axes: Vector


class SceneAngle(NamedTuple):
    """An angle that has a name.

    Shapes: arc (points, 3); at (3,); centre (3,).
    """

    name: str
    text: str
    arc: Vector
    at: Vector
    centre: Vector
    about: str


class Scene(NamedTuple):
    """A path laid out in space."""

    notes: tuple[str, ...]
    schematic: bool
    unit: float
    nodes: tuple[SceneNode, ...]
    rays: tuple[SceneRay, ...]
    planes: tuple[ScenePlane, ...]
    frames: tuple[SceneFrame, ...]
    angles: tuple[SceneAngle, ...]

    @property
    def bounds(self) -> Vector:
        """The least and the largest coordinates of nodes and rays, shape (2, 3)."""
        ends = [point for ray in self.rays for point in (ray.tail, ray.head)]
        points = np.array([*(node.at for node in self.nodes), *ends])
        return np.array([points.min(axis=0), points.max(axis=0)])

    def as_json(self) -> dict[str, Any]:
        """Return lists and dictionaries of plain numbers, for `json.dumps`; no NaN among them.

        >>> import json
        >>> import optipath as op
        >>> from optipath.plots.scene.layout import scene_of
        >>> told = scene_of(op.load_preset("malus")).as_json()
        >>> told["nodes"][0]["name"], json.loads(json.dumps(told)) == told
        ('lamp', True)
        """
        return {
            "notes": [*self.notes],
            "schematic": self.schematic,
            "nodes": [_as_dict(node, "axis") for node in self.nodes],
            "rays": [_ray(ray) for ray in self.rays],
            "planes": [_as_dict(plane) for plane in self.planes],
            "frames": [
                {"port": each.port, "at": _list(each.at), **_axes(each.axes)}
                for each in self.frames
            ],
            "angles": [_as_dict(angle, "centre", "about") for angle in self.angles],
            "bounds": _list(self.bounds),
        }


def _ray(ray: SceneRay) -> dict[str, Any]:
    return {
        "name": ray.name,
        "start": ray.start,
        "end": ray.end,
        "from": _list(ray.tail),
        "to": _list(ray.head),
        "frame": _axes(ray.axes),
        "ellipse": None if ray.ellipse is None else _list(ray.ellipse),
        "intensity": plain(float(ray.light.intensity)),
        "dop": plain(float(ray.light.dop)),
        "leaves": ray.leaves,
        "tap": ray.tap,
    }


def _as_dict(message: Any, *stored: str) -> dict[str, Any]:
    """Return what is told but for what is kept."""
    pairs = [(name, value) for name, value in message._asdict().items() if name not in stored]
    return {name: _list(v) if isinstance(v, np.ndarray) else v for name, v in pairs}


def _axes(axes: Vector) -> dict[str, Any]:
    return dict(zip("xyz", _list(axes), strict=True))


def _list(numbers: Vector) -> Any:
    return (np.asarray(numbers, float) + 0.0).tolist()
