"""Which engine runs a batch: the one that is asked for, or the one that costs least.

Costs are counted, not timed, so that equal runs choose equal engines: seconds per operation and
path as floats, by NumPy (plus an overhead per operation and batch) and by Numba (plus compiling).
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, get_args

from optipath.engines.formula import Engine
from optipath.engines.llvm_engine import LlvmEngine
from optipath.engines.numpy_engine import NumpyEngine

if TYPE_CHECKING:
    from optipath.engines.jax_path import JaxPath


class JaxEngine(Engine):
    """Traces the steps of a program, so that it can be differentiated and run on a GPU."""

    name = extra = "jax"

    def compiled(self, formula: Any) -> JaxPath:
        """Return the path of a program, a carrier, and a precision; each batch is compiled."""
        if not self.is_installed:
            raise self.missing
        from optipath.engines.jax_path import JaxPath  # noqa: PLC0415 - an extra

        return JaxPath(*formula)


REGISTRY: dict[str, Engine] = {
    engine.name: engine for engine in (NumpyEngine(), LlvmEngine(), JaxEngine())
}


EngineName: TypeAlias = Literal["auto", "numpy", "numba", "jax"]
ENGINES: tuple[EngineName, ...] = get_args(EngineName)

FLOATS = "floats"
"""What runs one path, and a handful one by one: functions of plain Python floats."""

NUMPY_STEPS = "numpy, step by step"
"""What runs batches that are too small, or paths that are too long, to be compiled for."""

COMPILER = "numba"
"""The engine that compiles for "auto", where that pays."""

LARGE = 1 << 30
"""A batch for which any engine is worth its while."""

FEW, SEVERAL = 1 << 10, 3
"""From how many paths, or after how many runs, a formula is worth its while."""

# Measured on one core at 3 GHz, with formulas of 20 to 1,500 operations.
_BY_FLOATS, _BY_NUMPY = 9e-9, 0.3e-9
_CALL = 0.5e-6
_LOOKING, _LOOKING_AGAIN = 0.15, 0.02
_BEGINNING, _COMPILING, _OPTIMIZING = 0.1, 0.5e-3, 0.5e-6

HANDFUL = int(_CALL / (_BY_FLOATS - _BY_NUMPY)) + 1
"""From how many paths NumPy takes less time than floats one by one, of formulas of any length."""

FORESIGHT = 8.0
"""A plan that has been given many paths is taken to be given so many times as many in all."""


class EngineChoice:
    """Chooses an engine for each batch of one kind, and keeps count of what others have cost.

    The work is a `BatchKind`, or what says as much of itself.

    >>> EngineChoice("numpy", floats=True).of(10, ...)
    'numpy, step by step'
    """

    def __init__(self, engine: str, *, floats: bool, dtype: str = "float64", runs: int = 0) -> None:
        self.engine = engine
        self.compiler = COMPILER if engine == "auto" else engine
        taken = engine != "numpy" and dtype in REGISTRY[self.compiler].precisions
        able = taken and is_installed(self.compiler)
        self.most = REGISTRY[self.compiler].longest if able else -1
        self.floats = floats
        self.decided = NUMPY_STEPS if engine == "jax" else ""
        # For how many paths something is made, be it never asked for again.
        self._least = FEW if engine in ("auto", "numpy") else 0
        self._runs = runs
        self._cost = 0.0
        self._looked = False

    def of(self, count: int, work: Any, ahead: int = 0) -> str:
        """Return what runs so many paths."""
        if self.decided:
            return self.decided
        self._runs += 1
        few = self.engine == "auto" and self.floats and count < HANDFUL
        if self._runs > SEVERAL and self.engine == "auto":
            self._least = 0 if self.floats else HANDFUL
        if count < self._least and not (few and work.has_floats):
            return NUMPY_STEPS
        operations = work.operations(floats=few)
        if operations is None:
            self.decided = NUMPY_STEPS
        elif operations <= self.most and self._pays(operations, count, ahead, work):
            self.decided = self.compiler
        elif self.engine not in ("auto", "numpy"):
            self.decided = "numpy"
        return self.decided or (FLOATS if few else "numpy")

    def _pays(self, operations: int, count: int, ahead: int, work: Any) -> bool:
        """Tell whether the compiler is worth its while; one that is asked for by name is."""
        if self.engine != "auto":
            return True
        self._cost += cost(operations, count)
        earned = FORESIGHT * (self._cost + cost(operations, max(0, ahead - count)))
        if not self._looked:
            loaded = "llvmlite" in sys.modules
            self._looked = earned > (_LOOKING_AGAIN if loaded else _LOOKING)
            if self._looked and work.is_stored:
                return True
        return earned > compiling(operations)


def cost(operations: int, count: int) -> float:
    """Return how many seconds so many paths take without Numba."""
    return operations * min(_BY_FLOATS * count, _CALL + _BY_NUMPY * count)


def compiling(operations: int) -> float:
    """Return how many seconds it takes to compile so many operations."""
    return _BEGINNING + _COMPILING * operations + _OPTIMIZING * operations**2


def is_installed(engine: str) -> bool:
    """Tell whether what an engine needs is installed, without importing it."""
    return engine == "auto" or REGISTRY[engine].is_installed
