"""Arithmetic with light: sums, products with numbers, and NumPy functions it accepts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np

from optipath.errors import LightError, shown
from optipath.light.array_axes import ArrayAxes
from optipath.values.arrays import as_argument, locked
from optipath.values.jax_values import is_traced, known, namespace

if TYPE_CHECKING:
    from optipath.values.precision import Array


_CURE = "light adds up, light + light, and is taken times numbers >= 0, 0.5 * light, light / 2"


def factor_of_light(factor: Any, *, dark: bool) -> Any:
    """Return an array of finite numbers above 0, or of 0 where that makes light dark."""
    if hasattr(factor, "mueller") or isinstance(factor, ArrayAxes):
        raise LightError(
            f"{shown(factor)} is what light meets; write element @ light, matrix @ light or "
            f"path.mueller() @ light"
        )
    if is_traced(factor):
        array = factor
    else:
        array = as_argument("a factor of light", known(factor), LightError)
    if array.dtype.kind not in "biuf":
        refuse(f"{shown(factor)} is no real number")
    allowed = (array >= 0.0 if dark else array > 0.0) & (array < np.inf)
    if is_traced(array):
        # A product, since a choice would have slopes of 0.
        array = array * namespace(array).where(allowed, 1.0, np.nan)
    elif not np.all(allowed):
        bad = array[~allowed].ravel()[0]
        refuse(f"light has no {bad!s}-fold" if dark else f"{bad!s} divides none")
    return array if array.dtype.kind == "f" else array.astype(np.float64)


def refuse(problem: str) -> NoReturn:
    """Raise what is wrong, with what there is instead."""
    raise LightError(f"{problem}; {_CURE}; for other sums take light.stokes")


OPERATORS = {
    np.add: "add",
    np.subtract: "sub",
    np.multiply: "mul",
    np.true_divide: "truediv",
    np.matmul: "matmul",
}


_COMPARES = "allclose array_equal array_equiv isclose may_share_memory shares_memory"
_JOINS = "atleast_1d atleast_2d atleast_3d concatenate stack vstack copy copyto"
_WRITES = "array2string array_repr array_str save savetxt savez"
TAKES_NUMBERS = frozenset(f"{_COMPARES} {_JOINS} {_WRITES}".split())
"""The functions of NumPy that mix no components: they take the numbers of light."""


def numbers_within(arguments: Any) -> Any:
    """Return arguments with the numbers of light in place of it."""
    if isinstance(arguments, (list, tuple)):
        return [numbers_within(each) for each in arguments]
    if isinstance(arguments, dict):
        return {name: numbers_within(each) for name, each in arguments.items()}
    return np.asarray(arguments) if isinstance(arguments, ArrayAxes) else arguments


_COPIED = 1 << 16
"""Of how many lights components are copied when somebody asks for them."""


def handed_out(component: Any) -> Any:
    """Return a component of light as it is given to whoever asks for it.

    >>> kept = np.ones(3)
    >>> mine = handed_out(kept)
    >>> mine *= 2.0
    >>> kept
    array([1., 1., 1.])
    """
    if isinstance(component, float):
        return np.array(component)
    stored = is_traced(component) or component.size > _COPIED
    return locked(component) if stored else np.array(component)


def stacked_components(components: tuple[Any, Any, Any, Any]) -> Array:
    """Return four components, floats or arrays of one shape, as one array (..., 4).

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
