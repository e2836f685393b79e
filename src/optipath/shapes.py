"""Shapes that must broadcast, and what to say where they do not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.array_likes import as_given
from optipath.errors import ShapeError
from optipath.jax_values import is_jax

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt


def broadcast_fault(shapes: Mapping[str, tuple[int, ...]]) -> list[str]:
    """Return the sentence that names shapes which do not broadcast, or nothing.

    Examples
    --------
    >>> broadcast_fault({"delta": (3,), "rho": (4,)})
    ['arrays do not broadcast together: delta (3,), rho (4,); make their axes equal or 1']
    """
    try:
        np.broadcast_shapes(*shapes.values())
    except ValueError:
        named = ", ".join(f"{owner} {shape}" for owner, shape in shapes.items() if shape)
        return [f"arrays do not broadcast together: {named}; make their axes equal or 1"]
    return []


def check_broadcast(shapes: Mapping[str, tuple[int, ...]]) -> tuple[int, ...]:
    """Return the shape that several shapes broadcast to.

    Raises
    ------
    ShapeError
        Naming each shape and its owner.
    """
    if faults := broadcast_fault(shapes):
        raise ShapeError(*faults)
    return np.broadcast_shapes(*shapes.values())


def real_array(what: str, value: Any, tail: tuple[int, ...]) -> npt.NDArray[Any]:
    """Return an array of real numbers whose last axes are given; what is JAX's stays so.

    Raises
    ------
    ShapeError
        If it is not real, or of another shape.

    Examples
    --------
    >>> real_array("a Stokes vector", [1, 0, 0, 0], (4,))
    array([1., 0., 0., 0.])
    """
    array = value if is_jax(value) else as_given(what, value, ShapeError)
    if array.dtype.kind in "iub":
        array = array.astype(np.float64)
    if array.dtype.kind != "f" or array.shape[-len(tail) :] != tail:
        shape = ", ".join(map(str, ("...", *tail)))
        raise ShapeError(f"{what} is real and of shape ({shape}), not {array.dtype} {array.shape}")
    return array
