"""Engine: what runs a composed path."""

from __future__ import annotations

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

    JAX takes the steps of the program with their kernels instead: of a formula it would know
    neither where a kernel ends, which XLA compiles by itself, nor what a slope is at an edge.
    """

    name: ClassVar[str]
    extra: ClassVar[str] = ""
    precisions: ClassVar[tuple[str, ...]] = ("float64", "float32")
    longest: ClassVar[float] = math.inf

    @abstractmethod
    def compiled(self, formula: FormulaT) -> PathT:
        """Return the function of a formula."""

    def is_ready(self, formula: FormulaT) -> bool:
        """Tell whether a formula runs without compiling; of an extra it is not known here."""
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

    Called with a range of rows and of columns; the inputs in the order of the formula, each a
    number or an array along one axis (`Formula.place_of`); an array of shape (results, paths) to be
    filled; and its column for the first cell. Returns whether the formula holds for all of the
    range.
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
