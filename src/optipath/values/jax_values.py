"""Values that JAX traces: arrays of its own, and numbers that it does not know yet."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np

from optipath.errors import ParameterError


def is_jax(value: Any) -> bool:
    """Tell whether a value is JAX's, without importing it."""
    jax = sys.modules.get("jax")
    return jax is not None and isinstance(value, jax.Array)


def is_traced(value: Any) -> bool:
    """Tell whether a value is one that JAX does not know yet, and so cannot be checked."""
    # As `is_jax`, which it does not call: it is asked of nearly every value.
    jax = sys.modules.get("jax")
    return jax is not None and isinstance(value, jax.Array) and isinstance(value, jax.core.Tracer)


def known(value: Any) -> Any:
    """Return JAX's known numbers as NumPy's array: JAX without x64 would round to float32."""
    return np.asarray(value) if is_jax(value) and not is_traced(value) else value


def check_known(what: str, value: Any) -> None:
    """Raise where a value is one that JAX does not know yet."""
    if is_traced(value):
        raise ParameterError(
            f"{what} takes numbers, not values that JAX traces; do it outside of jit and grad"
        )


def namespace(value: Any) -> Any:
    """Return the module whose functions take a value: ``numpy`` or ``jax.numpy``."""
    return sys.modules["jax"].numpy if is_jax(value) else np
