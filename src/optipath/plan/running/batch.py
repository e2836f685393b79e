"""Layout: along which axes of a batch each array differs."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    Array = np.ndarray[Any, Any]

_THIN = 64
"""How long an axis must be for a loop of its own."""


class Layout:
    """The axes of a batch; neighbours that all arrays have together, or lack, are one.

    Examples
    --------
    >>> layout = Layout((4, 3, 2), {"a": np.ones((4, 1, 1)), "b": np.ones((3, 2))})
    >>> layout.shape, layout.axes["b"]
    ((4, 6), frozenset({1}))
    """

    def __init__(self, batch: tuple[int, ...], arrays: Mapping[str, Array]) -> None:
        own = {name: _differing(array.shape, len(batch)) for name, array in arrays.items()}
        groups: list[list[int]] = []
        last: Any = None
        for axis, length in enumerate(batch):
            members = frozenset(name for name, axes in own.items() if axis in axes)
            if length == 1:
                continue
            if groups and members == last:
                groups[-1].append(axis)
            else:
                groups.append([axis])
            last = members
        self.batch = batch
        self.paths = prod(batch)
        self.groups = groups
        self.shape = tuple(prod(batch[axis] for axis in group) for group in groups)
        self.axes = {
            name: frozenset(i for i, group in enumerate(groups) if group[0] in axes)
            for name, axes in own.items()
        }

    @property
    def all_axes(self) -> frozenset[int]:
        """The axes that are left."""
        return frozenset(range(len(self.shape)))

    @property
    def last(self) -> int | None:
        """The innermost axis, if it is long enough for a loop of its own."""
        if len(self.shape) < 2 or self.shape[-1] < _THIN:
            return None
        return len(self.shape) - 1

    @property
    def key(self) -> tuple[Any, ...]:
        """What layouts have in common that one formula serves."""
        return len(self.shape), self.last, tuple(sorted(self.axes.items(), key=lambda i: i[0]))

    def lengths(self, axes: Iterable[int]) -> tuple[int, ...]:
        """Return the lengths of some of the axes, in order."""
        return tuple(self.shape[axis] for axis in sorted(axes))

    def among(self, array: Array, own: frozenset[int], axes: frozenset[int]) -> Array:
        """Return an array with an axis for each of some, long where it differs along it."""
        return array.reshape([self.shape[axis] if axis in own else 1 for axis in sorted(axes)])

    def in_batch(self, array: Array, own: frozenset[int]) -> Array:
        """Return an array with an axis for each of the batch, long where it differs along it."""
        lengths = [1] * len(self.batch)
        for axis in own:
            for member in self.groups[axis]:
                lengths[member] = self.batch[member]
        return array.reshape(lengths)


def sliced(array: Array, batch: tuple[int, ...], where: tuple[Any, ...]) -> Array:
    """Return what belongs to a part of the batch, still without the axes along which it is one.

    Examples
    --------
    >>> sliced(np.ones((3, 1)), (3, 5), (slice(0, 2), slice(1, 4))).shape
    (2, 1)
    """
    found: Array
    if where and not isinstance(where[0], (int, slice)):
        found = np.broadcast_to(array, batch)[where]
    else:
        shape = (1,) * (len(batch) - array.ndim) + array.shape
        index = [_kept(at, own, whole) for at, own, whole in zip(where, shape, batch, strict=False)]
        found = array.reshape(shape)[tuple(index)]
    return found


def _kept(at: Any, own: int, whole: int) -> Any:
    """Return the index along an axis, along which the array may be one and the batch not."""
    if own != 1 or whole == 1:
        return at
    return 0 if isinstance(at, int) else slice(None)


def _differing(shape: tuple[int, ...], count: int) -> frozenset[int]:
    before = count - len(shape)
    return frozenset(before + axis for axis, length in enumerate(shape) if length != 1)
