"""What light has of an array besides its axes: components, and what NumPy does with it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np

from optipath.errors import LightError
from optipath.values.arrays.jax_values import is_traced
from optipath.values.arrays.read_only import locked

if TYPE_CHECKING:
    from optipath.values.roundings import Array

OPERATORS = {
    np.add: "add",
    np.subtract: "sub",
    np.multiply: "mul",
    np.true_divide: "truediv",
    np.matmul: "matmul",
}


_COMPARES = ("allclose", "array_equal", "array_equiv", "isclose", "may_share_memory")
_JOINS = (
    "atleast_1d",
    "atleast_2d",
    "atleast_3d",
    "concatenate",
    "stack",
    "vstack",
    "copy",
    "copyto",
    "save",
    "savetxt",
    "savez",
)
_SHAPES = ("shape", "ndim", "size", "flip", "reshape", "shares_memory")
_WRITES = ("array2string", "array_repr", "array_str")
TAKES_LIGHT = frozenset([*_COMPARES, *_JOINS, *_SHAPES, *_WRITES])
"""The functions of NumPy that mix no components."""

_COPIED = 1 << 16
"""Of how many lights components are copied when somebody asks for them."""


def handed_out(component: Any) -> Any:
    """Return a component of light as it is given to whoever asks for it.

    Shapes: component (...); returns (...).

    Examples
    --------
    >>> kept = np.ones(3)
    >>> mine = handed_out(kept)
    >>> mine *= 2.0
    >>> kept
    array([1., 1., 1.])
    """
    if isinstance(component, float):
        return np.array(component)
    kept = is_traced(component) or component.size > _COPIED
    return locked(component) if kept else np.array(component)


def stacked_components(components: tuple[Any, Any, Any, Any]) -> Array:
    """Return four components, floats or arrays of one shape, as one array (..., 4).

    Examples
    --------
    >>> stacked_components((1.0, 0.5, 0.0, 0.0))
    array([1. , 0.5, 0. , 0. ])
    """
    arrays = [component for component in components if isinstance(component, np.ndarray)]
    if not arrays:
        return np.array(components)
    stokes: Array = np.empty((4, *arrays[0].shape), arrays[0].dtype)
    for row, component in enumerate(components):
        stokes[row] = component
    return np.moveaxis(stokes, 0, -1)


def refuse_call(call: str) -> NoReturn:
    """Raise that a function of NumPy takes no light."""
    raise LightError(
        f"numpy.{call} takes numbers, and light has a frame besides; give it light.stokes, "
        f"whose last axis are the components, or one, light.S0; the mean of lights is "
        f"sum(lights) / len(lights)"
    )
