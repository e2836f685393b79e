"""Engines: each does what a formula says, and knows nothing else."""

from optipath.engines.array_path import ArrayPath
from optipath.engines.automatic import (
    COMPILED,
    ENGINES,
    LARGE,
    NUMPY_STEPS,
    batches,
    compile_array_path,
    engine_for,
    is_installed,
    jax_path,
    missing,
)

__all__ = [
    "COMPILED",
    "ENGINES",
    "LARGE",
    "NUMPY_STEPS",
    "ArrayPath",
    "batches",
    "compile_array_path",
    "engine_for",
    "is_installed",
    "jax_path",
    "missing",
]
