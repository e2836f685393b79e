"""Values that JAX traces: arrays of its own, and numbers that it does not know yet."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np


def is_jax(value: Any) -> bool:
    """Tell whether a value is JAX's, without importing it.

    Examples
    --------
    >>> is_jax(1.0)
    False
    """
    jax = sys.modules.get("jax")
    return jax is not None and isinstance(value, jax.Array)


def is_traced(value: Any) -> bool:
    """Tell whether a value is one that JAX does not know yet, and so cannot be checked.

    Examples
    --------
    >>> is_traced(1.0)
    False
    """
    return is_jax(value) and isinstance(value, sys.modules["jax"].core.Tracer)


def namespace(value: Any) -> Any:
    """Return the module whose functions take a value: ``numpy`` or ``jax.numpy``."""
    return sys.modules["jax"].numpy if is_jax(value) else np
