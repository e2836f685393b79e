"""Paths with every value a number, and the names of values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.composer.followed_values import with_followed
from optipath.composer.path_values import Values
from optipath.composer.wiring import Wiring
from optipath.errors import OptipathError, PathError, shown
from optipath.paths.energy import lights_along
from optipath.values.operands import Operand
from optipath.values.parameters import Parameter
from optipath.values.units import in_unit

if TYPE_CHECKING:
    from optipath.paths.path_graph import PathGraph


_SAME_ANGLE = 1e-9
"""By how much angles differ that are the same but for rounding, in radians."""


class ShownAngle(NamedTuple):
    """An angle of a path by its name.

    Units: angle in radians.
    """

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


class NumberPath:
    """A path with all its values, one number each."""

    def __init__(self, path: PathGraph, what: str, values: dict[str, Any]) -> None:
        # What keeps the light of a path stands for it as well.
        if not hasattr(path, "graph"):
            raise OptipathError(f"{what} draws a path, not {shown(path)}; give a PathGraph")
        self.lights = lights_along(path, **values)
        parameters = path.parameters.items()
        defaults = {n: p.default for n, p in parameters if not p.bound and p.default is not None}
        graph = path.bind(**{**defaults, **values}).graph
        shapes = Values(graph).known_shapes
        shapes |= {each.name: each.light.intensity.shape for each in self.lights}
        several = [f"{name} has the shape {shape}" for name, shape in shapes.items() if shape]
        if several:
            raise PathError(f"{what} draws one path, but {several[0]}; give single values")
        unknown = [each.name for each in self.lights if not np.isfinite(each.light.stokes).all()]
        if unknown:
            raise PathError(
                f"{what} draws ways that light can go, but on '{unknown[0]}' the light is not a "
                "number; give values that there are"
            )
        self.wiring = Wiring(with_followed(graph)[0], keep="all")


def number(value: Any) -> float:
    """Return the number of a value that is known."""
    return float(Operand(value).numbers())


def quantity_text(value: float, unit: str) -> str:
    """Return a value as pictures write it: five digits, and the unit.

    Units: value in radians.

    >>> quantity_text(-0.0, "deg"), quantity_text(1.164278e-3, "um")
    ('0 deg', '1164.3 um')
    """
    return f"{in_unit(value, unit) + 0.0:.5g} {unit}".strip()


def shown_angle(value: Any, *, signed: bool = True) -> ShownAngle:
    """Return an angle by the name of its parameter, or the formula that stands for a multiple.

    Units: value in radians.
    """
    if not isinstance(value, Parameter):
        return ShownAngle("", number(value))
    unit = value.unit or "deg"
    if not bool(Operand(value, "present").numbers()):
        return ShownAngle(value.name, 0.0, there=False, unit=unit)
    if value.is_signed and not (signed and value.is_negative):
        return ShownAngle(value.name, number(value.alone()), unit=unit)
    return ShownAngle(value.formula, number(value), unit=unit)


def shown_incidence(value: Any, front: float) -> ShownAngle:
    """Return the angle at which light meets a surface, by its name if it is what is given.

    Units: value in radians.
    """
    message = shown_angle(value)
    if message.name and abs(number(value) - front) <= _SAME_ANGLE:
        return message
    return ShownAngle("incidence", front if front > _SAME_ANGLE else 0.0)
