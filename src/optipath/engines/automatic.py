"""Which engine runs a batch: by what is asked for, its size, and what is installed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.engines.jax_engine import CarriedProgram
from optipath.engines.known_engines import REGISTRY

if TYPE_CHECKING:
    from optipath.engines.array_path import ArrayPath
    from optipath.engines.formulas import Formula
    from optipath.errors import MissingExtraError

ENGINES = ("auto", *REGISTRY)

COMPILED = ("numpy", "numba")
"""What formulas are compiled by."""

NUMPY_STEPS = "numpy, step by step"
"""What runs batches that are too small, or paths that are too long, to be compiled for."""

LARGE = 1 << 30
"""A batch for which any engine is worth its while."""

FEW, MANY = 1 << 10, 1 << 16
"""From how many paths a formula is worth its while, and from how many Numba is."""


def engine_for(engine: str, count: int, *, compilable: bool) -> str:
    """Return the engine for a batch of so many paths.

    Examples
    --------
    >>> engine_for("auto", 1, compilable=True)
    'numpy, step by step'
    >>> engine_for("numba", 1, compilable=True)
    'numba'
    """
    if engine == "jax":
        return "jax"
    if not compilable:
        return NUMPY_STEPS
    if engine == "numba" or (engine == "auto" and count >= MANY and is_installed("numba")):
        return "numba"
    return "numpy" if count >= FEW else NUMPY_STEPS


def batches(engine: str) -> str:
    """Return in words what runs batches of which size."""
    if engine == "numba":
        return "one path of floats is run as Python, every array by numba"
    runs = [f"less than {FEW:,} paths are run step by step", f"from {FEW:,} by numpy"]
    if engine == "auto" and is_installed("numba"):
        runs.append(f"from {MANY:,} by numba")
    return ", ".join(runs)


def is_installed(engine: str) -> bool:
    """Tell whether what an engine needs is installed, without importing it."""
    return engine == "auto" or REGISTRY[engine].is_installed


def jax_path(*program: Any) -> Any:
    """Return a program for JAX.

    Raises
    ------
    MissingExtraError
        If JAX is not installed.
    """
    return REGISTRY["jax"].compiled(CarriedProgram(*program))


def missing(engine: str) -> MissingExtraError:
    """Return the error that an engine is not installed."""
    return REGISTRY[engine].missing


def compile_array_path(engine: str, formula: Formula) -> ArrayPath:
    """Return a formula compiled by an engine."""
    path: ArrayPath = REGISTRY[engine].compiled(formula)
    return path
