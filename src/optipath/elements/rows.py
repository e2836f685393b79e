"""A kernel out of the rows of a Mueller matrix, as an element of one's own gives them."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.class_faults import TURN
from optipath.elements.coupling import Coupling, numbers_of
from optipath.errors import PathError, shown
from optipath.kernels.carriers.kernel import Kernel
from optipath.kernels.carriers.own_code import guarded
from optipath.kernels.carriers.structures import FULL
from optipath.values.arrays.jax_values import is_traced
from optipath.values.operation import Operation

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import KernelFunction, Primitives

_ROUNDINGS = 256.0
"""How many roundings of the largest entry an imaginary part may be that is taken for 0."""


@dataclass(frozen=True)
class RowsFactory:
    """Makes the function of a kernel; a class, so that plans can be pickled."""

    name: str
    rows_of: Callable[..., Any]

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Return the function that gives the sixteen numbers of the matrix."""
        what = f"mueller_rows of element class {self.name}"
        return guarded(what, xp, lambda own: partial(self._numbers, what, own))

    def _numbers(self, what: str, xp: Primitives, *values: Any) -> tuple[Any, ...]:
        entries = _entries(what, self.rows_of(xp, *map(_unchanging, values)), values)
        _check_shapes(what, entries, values)
        return entries


def _unchanging(value: Any) -> Any:
    """Return a value that code of a user's own cannot write into; one number as a number."""
    if type(value) is not np.ndarray:
        return value
    if not value.ndim:
        return value[()]
    view = value.view()
    view.flags.writeable = False
    return view


def _check_shapes(what: str, entries: tuple[Any, ...], values: tuple[Any, ...]) -> None:
    """Refuse arrays that are not over the paths that the values are given for."""
    shapes = {entry.shape for entry in entries if getattr(entry, "shape", ())}
    if not shapes:
        return
    paths = np.broadcast_shapes(*(getattr(value, "shape", ()) for value in values))
    wrong = [shape for shape in shapes if not _is_within(shape, paths)]
    if wrong:
        of_paths = f"for paths of shape {paths}" if paths else "for one path"
        raise PathError(
            f"{what} gives an entry of shape {wrong[0]} {of_paths}; compute each entry of its "
            f"arguments alone, elementwise"
        )


def _is_within(shape: tuple[int, ...], paths: tuple[int, ...]) -> bool:
    try:
        return np.broadcast_shapes(shape, paths) == paths
    except ValueError:
        return False


def _entries(what: str, rows: Any, values: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return the sixteen numbers of four rows, which are for the paths of some values."""
    if isinstance(rows, np.ndarray):
        _check_array(what, rows, values, (4, 4))
        rows = np.asarray(rows)
    try:
        found = []
        # Each row before the next, which may be a generator that knows one at a time.
        for row in rows:
            _check_array(what, row, values, (4,))
            found.append(tuple(row))
    except TypeError:
        found = []
    if len(found) != 4 or any(len(row) != 4 for row in found):
        raise PathError(f"{what} must return four rows of four entries, not {shown(rows)}")
    entries = tuple(entry for row in found for entry in row)
    if any(map(_is_complex, entries)):
        return _real(what, entries, _rounding(entries + values))
    for entry in entries:
        if entry is None or isinstance(entry, (str, bytes, list, tuple, dict, Decimal, Fraction)):
            raise PathError(f"{what} gives the entry {shown(entry)}; give numbers")
    return entries


def _check_array(what: str, given: Any, values: tuple[Any, ...], shape: tuple[int, ...]) -> None:
    """Refuse an array in place of rows, or of a row, that may have paths among its axes."""
    own = getattr(given, "shape", ())
    many = " for many paths" if any(getattr(value, "shape", ()) for value in values) else ""
    # Of four paths, it may have the right shape all the same.
    if own and (many or own != shape):
        raise PathError(
            f"{what} gives an array of shape {own}{many}; return four rows, tuples of four "
            f"entries each, which may be arrays over paths"
        )


def _is_complex(entry: Any) -> bool:
    if type(entry) is float:
        return False
    kind = getattr(entry, "dtype", None)
    return isinstance(entry, complex) or (kind is not None and kind.kind == "c")


def _rounding(numbers: tuple[Any, ...]) -> float:
    """Return the rounding of the coarsest of numbers; those without a type are doubles."""
    kinds = {np.dtype(getattr(number, "dtype", np.float64)) for number in numbers}
    return max(float(np.finfo(kind).eps) for kind in kinds if kind.kind in "fc")


def _real(what: str, entries: tuple[Any, ...], rounding: float) -> tuple[Any, ...]:
    """Return the real parts of entries whose imaginary parts are 0 to rounding."""
    if not any(map(is_traced, entries)):
        sizes = np.broadcast_arrays(*[np.abs(entry) for entry in entries])
        largest = np.max(sizes, axis=0)
        for place, entry in enumerate(entries):
            if np.any(abs(np.imag(entry)) > _ROUNDINGS * rounding * largest):
                row, column = divmod(place, 4)
                raise PathError(
                    f"{what} gives the complex entry [{row}][{column}] = {shown(entry)}; a Mueller "
                    f"matrix is real: return .real, or abs(z)**2, where that is what is meant"
                )
    return tuple(entry.real if _is_complex(entry) else entry for entry in entries)


def rows_kernel(name: str, class_name: str, rows_of: Any) -> Kernel:
    """Return the kernel of an element that gives the rows of its Mueller matrix."""
    function = rows_of.__func__ if isinstance(rows_of, staticmethod) else rows_of
    return Kernel(name or class_name, FULL, RowsFactory(class_name, function))


def coupling_by_rows(element: Any, kernel: Kernel) -> Coupling:
    """Return the way from ``in`` to ``out`` of an element that gives its rows."""
    fields = [(getattr(element, name), d) for name, d in element.domains().items() if name != TURN]
    numbers = tuple(number for value, domain in fields for number in numbers_of(value, domain))
    return Coupling("in", "out", (Operation(kernel, numbers),))
