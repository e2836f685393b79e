"""The media of chains of a batch, by an id for each vertex: an entry of a palette."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault
from optipath.paths.histories.chain_lengths import number_of, whole_numbers
from optipath.values.arrays.jax_values import is_traced
from optipath.values.arrays.read_only import locked
from optipath.values.arrays.shapes import first_place
from optipath.values.domains.indices import INDEX
from optipath.values.materials import Material
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    Floats = npt.NDArray[np.float64]


def rows_of_ids(ids: Any) -> npt.NDArray[Any]:
    """Return ids as an array of real numbers, shape (..., m)."""
    numbers = whole_numbers("ids", ids)
    if not numbers.ndim or not numbers.shape[-1]:
        raise ValueFault(f"ids must have shape (..., m), one for each vertex, not {numbers.shape}")
    return numbers


def ids_within(numbers: npt.NDArray[Any], media: int, ended: Any) -> npt.NDArray[Any]:
    """Return which medium stands behind each vertex of each chain.

    Shapes: numbers (..., m); ended (..., m).

    Examples
    --------
    >>> ended = np.array([[False, False], [False, True]])
    >>> ids_within(np.array([[0, 1], [1, -1]]), 2, ended).tolist()
    [[0, 1], [1, 0]]
    """
    bad = (numbers < 0) | (numbers >= media)
    if numbers.dtype.kind == "f":
        bad |= numbers != np.rint(numbers)
    there = True if ended is None else ~ended
    bad = bad & there
    if np.any(bad):
        every = np.broadcast_to(numbers, bad.shape)
        raise ValueFault(
            f"ids is {number_of(every, bad)}{first_place(bad)}; give the place of one of the "
            f"materials, 0 .. {media - 1}"
        )
    with np.errstate(invalid="ignore"):  # Behind the end of a chain.
        few = numbers.astype(np.min_scalar_type(media - 1))
    return few * there


def media_by_ids(materials: Sequence[Any], ids: npt.NDArray[Any] | None) -> tuple[Any, ...] | None:
    """Return the medium behind each vertex, an array over chains for each.

    Shape: ids (..., m).

    Examples
    --------
    >>> media_by_ids([1.5, 1.0], np.array([[0, 1], [1, 1]]))
    (array([1.5, 1. ]), array([1., 1.]))
    """
    faults: list[str] = []
    n, k = np.ones(len(materials)), np.zeros(len(materials))
    for place, material in enumerate(materials):
        name = f"materials[{place}]"
        try:
            one_n, one_k = index_parts(name, material, "ids choose from numbers")
        except ValueFault as fault:
            faults += fault.faults
            continue
        if one_n.ndim or one_k.ndim:
            faults.append(f"{name} is an array, and ids choose from numbers; give one number")
        else:
            n[place], k[place] = one_n, one_k
    if faults:
        raise ValueFault(*faults)
    if ids is None:
        return None
    # Row by row, which is read faster than with a stride.
    rows = np.ascontiguousarray(np.moveaxis(ids, -1, 0))
    each = ((locked(n.take(row)), locked(k.take(row)) if np.any(k) else k[:1]) for row in rows)
    return tuple(Material(*parts) if np.any(parts[1]) else parts[0] for parts in each)


def index_parts(name: str, medium: Any, why: str) -> tuple[Floats, Floats]:
    """Return n and k of a medium as numbers.

    Examples
    --------
    >>> index_parts("gold", 0.2 + 3j, "")
    (array(0.2), array(3.))
    """
    parts = (medium.n, medium.k) if isinstance(medium, Material) else (medium,)
    if any(isinstance(part, Parameter) or is_traced(part) for part in parts):
        raise ValueFault(
            f"{name} is given when the path runs, but {why}; give a number here, and make a path "
            f"for each value"
        )
    if isinstance(medium, Material):
        n, k = (domain.check(part, value) for part, value, domain in INDEX.parts(name, medium))
    else:
        index = INDEX.check(name, medium)
        n, k = index.real, index.imag if index.dtype.kind == "c" else np.zeros(())
    return locked(np.asarray(n)), locked(np.asarray(k))
