"""Scenes: a path in space with every value a number, and the names of values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.composer.followed_values import with_followed
from optipath.composer.path_values import Values
from optipath.composer.wiring import Wiring
from optipath.errors import OptipathError, PathError, shown
from optipath.materials.quantities import plain
from optipath.paths.energy import lights_along
from optipath.values.operands import Operand
from optipath.values.parameters import Parameter
from optipath.values.units import in_unit

if TYPE_CHECKING:
    from optipath.elements.element import Element
    from optipath.light.light import Light
    from optipath.paths.energy import LightOnLink
    from optipath.paths.path_graph import PathGraph
    from optipath.values.precision import Numbers


class SceneNode(NamedTuple):
    """An element where it stands. Shapes: at (3,); normal, across (3,); axis (3,)."""

    name: str
    kind: str
    at: Numbers
    normal: Numbers | None
    across: Numbers | None
    role: str
    element: Element
    axis: Numbers | None


class SceneRay(NamedTuple):
    """The light of a link, or what leaves the path; tail, head (3,), ellipse (points, 3)."""

    name: str
    start: str
    end: str
    tail: Numbers
    head: Numbers
    axes: Numbers
    ellipse: Numbers | None
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
    """A plane of incidence, as a rectangle. Shape: corners (4, 3)."""

    node: str
    corners: Numbers


class SceneFrame(NamedTuple):
    """The frame of a port. Shapes: at (3,); axes (3, 3)."""

    port: str
    at: Numbers
    axes: Numbers


class SceneAngle(NamedTuple):
    """An angle that has a name. Shapes: arc (points, 3); at (3,); centre (3,)."""

    name: str
    text: str
    arc: Numbers
    at: Numbers
    centre: Numbers
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
    def bounds(self) -> Numbers:
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
            "nodes": [_as_dict(node, "element", "axis") for node in self.nodes],
            "rays": [
                {
                    **_as_dict(ray, "tail", "head", "axes", "light"),
                    "from": _list(ray.tail),
                    "to": _list(ray.head),
                    "frame": _axes(ray.axes),
                    "intensity": plain(float(ray.light.intensity)),
                    "dop": plain(float(ray.light.dop)),
                }
                for ray in self.rays
            ],
            "planes": [_as_dict(plane) for plane in self.planes],
            "frames": [
                {"port": each.port, "at": _list(each.at), **_axes(each.axes)}
                for each in self.frames
            ],
            "angles": [_as_dict(angle, "centre", "about") for angle in self.angles],
            "bounds": _list(self.bounds),
        }


def _as_dict(message: Any, *stored: str) -> dict[str, Any]:
    """Return what is told but for what is kept."""
    pairs = [(name, value) for name, value in message._asdict().items() if name not in stored]
    return {name: _list(v) if isinstance(v, np.ndarray) else v for name, v in pairs}


def _axes(axes: Numbers) -> dict[str, Any]:
    return dict(zip("xyz", _list(axes), strict=True))


def _list(numbers: Numbers) -> Any:
    return (np.asarray(numbers, float) + 0.0).tolist()


_SAME_ANGLE = 1e-9
"""By how much angles differ that are the same but for rounding, in radians."""


class ShownAngle(NamedTuple):
    """An angle of a path by its name. Units: angle in radians."""

    name: str
    angle: float
    there: bool = True
    unit: str = "deg"

    @property
    def text(self) -> str:
        """The name, and the value in its unit.

        >>> ShownAngle("tilt", np.pi / 1080.0, unit="arcmin").text
        'tilt = 10 arcmin'
        """
        value = quantity_text(self.angle, self.unit) if self.there else "none"
        return f"{self.name} = {value}" if self.name else value


def known_path(
    path: PathGraph, what: str, values: dict[str, Any]
) -> tuple[Wiring, list[LightOnLink]]:
    """Return the wiring of a path with all its values, one number each, and its lights."""
    # What keeps the light of a path stands for it as well.
    if not hasattr(path, "graph"):
        raise OptipathError(f"{what} draws a path, not {shown(path)}; give a PathGraph")
    lights = lights_along(path, **values)
    parameters = path.parameters.items()
    defaults = {n: p.default for n, p in parameters if not p.bound and p.default is not None}
    graph = path.bind(**{**defaults, **values}).graph
    shapes = Values(graph).known_shapes | {each.name: each.light.shape for each in lights}
    for name, shape in shapes.items():
        if shape:
            raise PathError(
                f"{what} draws one path, but {name} has the shape {shape}; give single values"
            )
    for each in lights:
        if not np.isfinite(each.light.stokes).all():
            raise PathError(
                f"{what} draws ways that light can go, but on '{each.name}' the light is not a "
                "number; give values that there are"
            )
    return Wiring(with_followed(graph)[0], keep="all"), lights


def number(value: Any) -> float:
    """Return the number of a value that is known."""
    return float(Operand(value).numbers())


def quantity_text(value: float, unit: str) -> str:
    """Return a value in base units as pictures write it: five digits, and the unit.

    >>> quantity_text(-0.0, "deg"), quantity_text(1.164278e-3, "um")
    ('0 deg', '1164.3 um')
    """
    return f"{in_unit(value, unit) + 0.0:.5g} {unit}".strip()


def shown_angle(value: Any, *, signed: bool = True) -> ShownAngle:
    """Return an angle in radians by the name of its parameter, or the formula of a multiple."""
    if not isinstance(value, Parameter):
        return ShownAngle("", number(value))
    unit = value.unit or "deg"
    if not bool(Operand(value, "present").numbers()):
        return ShownAngle(value.name, 0.0, there=False, unit=unit)
    if value.is_signed and not (signed and value.is_negative):
        return ShownAngle(value.name, number(value.alone()), unit=unit)
    return ShownAngle(value.formula, number(value), unit=unit)


def shown_incidence(value: Any, front: float) -> ShownAngle:
    """Return the incidence in radians at a surface, by its name if it is given."""
    message = shown_angle(value)
    if message.name and abs(number(value) - front) <= _SAME_ANGLE:
        return message
    return ShownAngle("incidence", front if front > _SAME_ANGLE else 0.0)
