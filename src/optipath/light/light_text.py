"""Light as it is shown: as one writes it, and a few of very many."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.light.frames import Frame
from optipath.values.arrays.jax_values import is_traced

if TYPE_CHECKING:
    from optipath.values.roundings import Array

_SHOWN = 6
"""How many lights of a batch are shown."""


def text_of(numbers: Any, frame: Frame, exponent: Array) -> str:
    """Return light as one writes it.

    Shapes: numbers (..., 4); exponent (...).

    Examples
    --------
    >>> text_of(np.array([1.0, 0.0, 0.0, 0.5]), Frame(), np.array(-5000))
    'Light([1. , 0. , 0. , 0.5], exponent=-5000)'
    """
    told = [_text(numbers)]
    if frame != Frame():
        told.append("frame=" + repr(frame))
    if exponent.any():
        told.append(f"exponent={_text(exponent)}")
    if exponent.size > _SHOWN:
        told.append(f"shape={exponent.shape}")
    return f"Light({', '.join(told)})"


def _text(numbers: Any) -> str:
    """Return numbers as they are shown, a few of very many."""
    if is_traced(numbers):
        return repr(numbers)
    most = _SHOWN * (4 if numbers.dtype.kind == "f" else 1)
    return np.array2string(numbers, separator=", ", threshold=most, edgeitems=2, prefix="Light(")
