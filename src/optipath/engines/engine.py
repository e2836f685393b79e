"""Engine: what runs a path that has been composed; each says of itself what it can do."""

from __future__ import annotations

import ctypes
import math
from abc import ABC, abstractmethod
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, ClassVar, Generic, Protocol, TypeVar

from optipath.errors import missing_extra

if TYPE_CHECKING:
    from optipath.errors import MissingExtraError


FormulaT = TypeVar("FormulaT")
PathT = TypeVar("PathT")


class Engine(ABC, Generic[FormulaT, PathT]):
    """Makes a function of a formula: the one entry of an engine, in a file of its own.

    An engine takes a `Formula` and gives a function of numbers. JAX alone takes what stands
    behind it, the steps of the program with their kernels: of a record it would know neither
    where a kernel ends, which XLA compiles by itself, nor what a slope is at an edge.
    """

    name: ClassVar[str]
    extra: ClassVar[str] = ""
    precisions: ClassVar[tuple[str, ...]] = ("float64", "float32")
    longest: ClassVar[float] = math.inf

    @abstractmethod
    def compiled(self, formula: FormulaT) -> PathT:
        """Return the function of a formula."""

    def is_ready(self, formula: FormulaT) -> bool:
        """Tell whether a formula can be run at once: nothing is left to compile that takes time.

        Of what an extra brings, it is not known unless the engine says so.
        """
        del formula
        return not self.extra

    @property
    def is_installed(self) -> bool:
        """Whether what it needs is there, found without importing it."""
        return not self.extra or find_spec(self.name) is not None

    @property
    def missing(self) -> MissingExtraError:
        """The error that it is not installed."""
        return missing_extra(f"plans of engine '{self.name}'", self.name)


class ArrayPath(Protocol):
    """A formula that can be done to arrays.

    Called with a range of rows and of columns; what is given in the order of the formula's
    inputs, each a number or an array along one axis: of all rows, of all columns, or of the
    cells of the range (`Formula.place_of`); an array of shape (results, paths) to be filled;
    and the column of it for the first cell. Returns whether the formula holds for all of the
    range. Where the formula has no inner loop of its own, there is one row.
    """

    def __call__(
        self,
        rows: tuple[int, int],
        columns: tuple[int, int],
        arguments: list[Any],
        out: Any,
        at: int,
    ) -> bool:
        """Fill a range of the results."""


def address(array: Any) -> int:
    """Return the address of the first number of an array."""
    try:
        return ctypes.addressof(ctypes.c_char.from_buffer(array))
    except (TypeError, ValueError):  # The array is read-only, or empty.
        result: int = array.__array_interface__["data"][0]
        return result
