"""Engine: what runs a composed path; the engine of plain floats, for one path."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, ClassVar, Generic, Protocol, TypeVar

import numpy as np

from optipath.engines.symbols import OPERATIONS, Symbol
from optipath.errors import missing_extra
from optipath.kernels.primitives import FLOAT

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.engines.formula import Formula
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


_DEEPEST = 30
_TWICE = ("maximum", "minimum")
"""Operations whose text names an operand twice."""

_SPACE = {
    "atan2": math.atan2,
    "cos": math.cos,
    "exp": math.exp,
    "exponent": FLOAT.scaling,
    "inf": math.inf,
    "ldexp": math.ldexp,
    "nan": math.nan,
    "product_rest": lambda a, b: FLOAT.two_product(a, b)[1],
    "sin": math.sin,
    "sqrt": math.sqrt,
}


class FloatEngine(Engine["Formula", "Callable[..., tuple[Any, ...] | None]"]):
    """Runs one path; nobody asks for it by name, since it is the fastest for one."""

    name = "floats"
    precisions = ("float64",)

    def compiled(self, formula: Formula) -> Callable[..., tuple[Any, ...] | None]:
        """Return a function of floats: None or ArithmeticError, ValueError where it fails."""
        space: dict[str, Any] = dict(_SPACE)
        exec(compile(source(formula), "<formula>", "exec"), space)  # noqa: S102 - our own text
        path: Callable[..., tuple[Any, ...] | None] = space["path"]
        return path


FLOAT_ENGINE = FloatEngine()


def source(formula: Formula) -> str:
    """Return the text of ``path(*given)``; what is used once is inlined, so choices are lazy."""
    texts: dict[int, str] = {}
    depth: dict[int, int] = {}
    lines: list[str] = []

    def written(operand: Any) -> str:
        if not isinstance(operand, Symbol):
            return f"({operand.item()!r})" if isinstance(operand, np.generic) else repr(operand)
        return texts.get(operand.index, f"t{operand.index}")

    used_twice = {
        o.index
        for s in formula.steps
        if s.operation in _TWICE
        for o in s.operands
        if isinstance(o, Symbol)
    }
    for step in formula.steps:
        text = OPERATIONS[step.operation].text.format(*map(written, step.operands))
        deep = 1 + max(
            (depth.get(o.index, 0) for o in step.operands if isinstance(o, Symbol)), default=0
        )
        if formula.uses[step.index] == 1 and step.index not in used_twice and deep < _DEEPEST:
            texts[step.index] = f"({text})"
            depth[step.index] = deep
        else:
            lines.append(f"t{step.index} = {text}")
    results = ", ".join(map(written, formula.results))
    lines += [f"if {written(formula.holds)}:", f"    return ({results},)", "return None"]
    argument = ", ".join(f"t{s.index}" for s in formula.inputs)
    body = "".join(f"    {line}\n" for line in lines)
    return f"def path({argument}):\n{body}"
