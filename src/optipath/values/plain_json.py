"""Values as JSON can hold them."""

from __future__ import annotations

import math
from types import NoneType
from typing import Any

import numpy as np

from optipath.values.domains.quantities import AMPLITUDE
from optipath.values.units import in_unit


def plain(
    value: Any, unit: str = "", complex_parts: tuple[str, ...] = AMPLITUDE.complex_parts
) -> Any:
    """Return a value as JSON can hold it, in a unit; what is not finite is None.

    Examples
    --------
    >>> plain(0.5 + 0.1j), plain(1.5 + 0.1j, "", ("n", "k"))
    ({'re': 0.5, 'im': 0.1}, {'n': 1.5, 'k': 0.1})
    """
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, list):
        return [plain(entry, unit, complex_parts) for entry in value]
    if isinstance(value, complex):
        return dict(zip(complex_parts, (value.real, value.imag), strict=True))
    if isinstance(value, (str, NoneType)):
        return value
    # JSON has no NaN: what is not read is null, and so is the logarithm of the dark. Adding 0
    # turns -0 into 0.
    return None if not math.isfinite(value) else in_unit(value, unit) + 0.0
