"""Engines: each does what a formula says, and knows nothing else."""

from optipath.engines.array_path import ArrayPath
from optipath.engines.automatic import (
    ENGINES,
    FLOATS,
    LARGE,
    NUMPY_STEPS,
    EngineChoice,
    batches,
    compile_array_path,
    is_installed,
    is_kept,
    jax_path,
    missing,
    most_operations,
    usual_engine,
)

__all__ = [
    "ENGINES",
    "FLOATS",
    "LARGE",
    "NUMPY_STEPS",
    "ArrayPath",
    "EngineChoice",
    "batches",
    "compile_array_path",
    "is_installed",
    "is_kept",
    "jax_path",
    "missing",
    "most_operations",
    "usual_engine",
]
