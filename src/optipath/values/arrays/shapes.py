"""Shapes that must broadcast, and what to say where they do not."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ShapeError
from optipath.values.arrays.array_likes import as_given
from optipath.values.arrays.jax_values import is_jax
from optipath.values.arrays.memory import refuse_too_large

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    import numpy.typing as npt


_STOKES = 32
"""How many bytes four doubles have."""

MOST_AXES = 30
"""How many axes a batch may have: NumPy goes along 32, and a matrix has two."""

MOST_PATHS = 2**53
"""How many paths a batch may have, be it never laid out as a whole."""


def joint_shape(*shapes: tuple[int, ...]) -> tuple[int, ...]:
    """Return the shape that shapes broadcast to.

    Examples
    --------
    >>> joint_shape((3, 1), (), (4,))
    (3, 4)
    """
    found = _joint(shapes)
    if found is None or len(found) > MOST_AXES or prod(found) > MOST_PATHS:
        raise ShapeError(*broadcast_fault({f"array {n}": s for n, s in enumerate(shapes, 1)}))
    return found


def broadcast_fault(shapes: Mapping[str, tuple[int, ...]]) -> list[str]:
    """Return the sentence that names shapes which do not broadcast, or nothing.

    Examples
    --------
    >>> print(*broadcast_fault({"delta": (7,), "rho": (4,)}))  # doctest: +NORMALIZE_WHITESPACE
    arrays do not broadcast together: delta (7,), rho (4,);
    make their axes equal or 1, as x[:, None] does
    """
    found = _joint(shapes.values())
    if found is None:
        named = ", ".join(f"{owner} {shape}" for owner, shape in shapes.items() if shape)
        cure = "make their axes equal or 1, as x[:, None] does"
        return [f"arrays do not broadcast together: {named}; {cure}"]
    if len(found) > MOST_AXES:
        owner = max(shapes, key=lambda owner: len(shapes[owner]))
        return [f"{owner} has {len(found)} axes, and a batch has {MOST_AXES} at most; join some"]
    if prod(found) > MOST_PATHS:
        paths = f"{prod(found):.2g} paths, of shape {found}"
        return [f"a batch has {MOST_PATHS:.2g} paths at most, not {paths}; give fewer values"]
    return []


def _joint(shapes: Iterable[tuple[int, ...]]) -> tuple[int, ...] | None:
    """Return the shape that shapes broadcast to; None where they do not."""
    several = tuple(shapes)
    found = [1] * max(map(len, several), default=0)
    for shape in several:
        for axis, length in enumerate(shape, len(found) - len(shape)):
            if found[axis] == 1:
                found[axis] = length
            elif length not in (1, found[axis]):
                return None
    return tuple(found)


def check_broadcast(shapes: Mapping[str, tuple[int, ...]]) -> tuple[int, ...]:
    """Return the shape that several shapes broadcast to."""
    if faults := broadcast_fault(shapes):
        raise ShapeError(*faults)
    batch = joint_shape(*shapes.values())
    refuse_too_large(batch, _STOKES)
    return batch


def real_array(what: str, value: Any, tail: tuple[int, ...]) -> npt.NDArray[Any]:
    """Return an array of real numbers whose last axes are given; what is JAX's stays so.

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


def place_text(shape: tuple[int, ...], at: int) -> str:
    """Say where something stands in an array, ready to be put behind it; nothing of one alone.

    Examples
    --------
    >>> place_text((5,), 3), place_text((2, 3), 4), place_text((), 0)
    (' at 3', ' at (1, 1)', '')
    """
    place = tuple(int(i) for i in np.unravel_index(at, shape))
    return f" at {place if len(place) > 1 else place[0]}" if place else ""


def first_place(bad: npt.NDArray[np.bool_]) -> str:
    """Say where the first of an array is true, as `place_text` does.

    Examples
    --------
    >>> first_place(np.array([False, True, True]))
    ' at 1'
    """
    return place_text(bad.shape, int(np.argmax(bad)))
