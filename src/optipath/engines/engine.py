"""Engine: what runs a path that has been composed; each says of itself what it can do."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from importlib.util import find_spec
from typing import TYPE_CHECKING, ClassVar, Generic, TypeVar

from optipath.extras import missing_extra

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
