"""A path in which every value is a number, and the names that people know the numbers by."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.composer.followed_values import with_followed
from optipath.composer.path_values import Values
from optipath.composer.wiring import Wiring
from optipath.errors import PathError
from optipath.paths.lights_along import lights_along
from optipath.values.operands import Operand
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from optipath.paths.path_graph import PathGraph


class ToldAngle(NamedTuple):
    """An angle of a path by its name.

    Attributes
    ----------
    name : str
        That of its parameter; empty for a number.
    angle : float
        In radians: the value of the parameter, or of its multiple if that has a name.
    there : bool
        Whether its element is in the path.
    """

    name: str
    angle: float
    there: bool = True

    @property
    def text(self) -> str:
        """The name and the value in degrees."""
        value = f"{round(np.degrees(self.angle), 2) + 0.0:g} deg" if self.there else "none"
        return f"{self.name} = {value}" if self.name else value


class ToldPath:
    """A path with all its values, one number each.

    Parameters
    ----------
    path : PathGraph
        The path.
    what : str
        The drawing that asks, as sentences name it.
    values : dict
        Those of open parameters that are not the defaults.

    Raises
    ------
    ParameterError, PathError
        If the path cannot be traced, or stands for several paths.
    """

    def __init__(self, path: PathGraph, what: str, values: dict[str, Any]) -> None:
        self.lights = lights_along(path, **values)
        parameters = path.parameters.items()
        defaults = {n: p.default for n, p in parameters if not p.bound and p.default is not None}
        graph = path.bind(**{**defaults, **values}).graph
        shapes = Values(graph).known_shapes
        shapes |= {each.name: each.light.intensity.shape for each in self.lights}
        several = [f"{name} has the shape {shape}" for name, shape in shapes.items() if shape]
        if several:
            raise PathError(f"{what} draws one path, but {several[0]}; give single values")
        self.wiring = Wiring(with_followed(graph)[0], keep="all")

    @cached_property
    def order(self) -> dict[tuple[str, str], int]:
        """The place of each port in the order of travel."""
        ports = [port for stretch in self.wiring.stretches for port in stretch.ports]
        return {port: place for place, port in enumerate(ports)}


def number(value: Any) -> float:
    """Return the number of a value that is known."""
    return float(Operand(value).numbers())


def told_angle(value: Any, *, signed: bool = True) -> ToldAngle:
    """Return an angle by the name of its parameter, or the formula that stands for a multiple.

    Parameters
    ----------
    value : float or Parameter
        In radians.
    signed : bool, optional
        Whether the negative of a parameter is told as that, and not by the parameter itself, as
        rho is, which people count against the light.

    Returns
    -------
    ToldAngle
    """
    if not isinstance(value, Parameter):
        return ToldAngle("", number(value))
    there = bool(Operand(value, "present").numbers())
    if value.is_signed and not (signed and value.is_negative):
        return ToldAngle(value.name, number(value.alone()) if there else 0.0, there)
    return ToldAngle(value.formula, number(value), there)
