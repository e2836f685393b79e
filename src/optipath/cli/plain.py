"""Values as JSON can hold them."""

from __future__ import annotations

import math
from types import NoneType
from typing import Any

import numpy as np

from optipath.units import in_unit


def plain(value: Any, unit: str = "") -> Any:
    """Return a value as JSON can hold it, in a unit; what is not finite is None."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, list):
        return [plain(entry, unit) for entry in value]
    if isinstance(value, complex):
        return {"n": value.real, "k": value.imag}
    if isinstance(value, (str, NoneType)):
        return value
    # JSON has no NaN: what is not read is null, and so is the logarithm of the dark. Adding 0
    # turns -0 into 0.
    return None if not math.isfinite(value) else in_unit(value, unit) + 0.0
