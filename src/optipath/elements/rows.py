"""A kernel out of the rows of a Mueller matrix, as an element of one's own gives them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.errors import PathError
from optipath.kernels.carriers.kernel import Kernel
from optipath.kernels.carriers.structures import FULL

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


@dataclass(frozen=True)
class RowsFactory:
    """Makes the function of a kernel; a class, so that plans can be pickled.

    Parameters
    ----------
    name : str
        Of the element.
    rows_of : callable
        ``rows_of(xp, *values)``, the rows of its Mueller matrix.
    """

    name: str
    rows_of: Callable[..., Any]

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Return the function that gives the sixteen numbers of the matrix."""

        def numbers(*values: Any) -> tuple[Any, ...]:
            rows = self.rows_of(xp, *values)
            if rows is None or len(rows) != 4 or any(len(row) != 4 for row in rows):
                raise PathError(
                    f"the Mueller matrix of '{self.name}' must be four rows of four entries"
                )
            return tuple(entry for row in rows for entry in row)

        return numbers


def rows_kernel(name: str, rows_of: Any) -> Kernel:
    """Return the kernel of an element that gives the rows of its Mueller matrix.

    Parameters
    ----------
    name : str
        Of the element.
    rows_of : callable or staticmethod
        ``rows_of(xp, *values)``, the rows.

    Returns
    -------
    Kernel

    Raises
    ------
    PathError
        When it is called and gives no four rows of four entries.
    """
    function = rows_of.__func__ if isinstance(rows_of, staticmethod) else rows_of
    return Kernel(name, FULL, RowsFactory(name, function))
