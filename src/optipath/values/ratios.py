"""Ratios as they are written: ``"1000:1"``, without end, and in decibels."""

from __future__ import annotations

import math
import re
from typing import Any

from optipath.errors import UnitError

# Written so that no text matches in two ways, and long ones take no longer than they are.
NUMBER = r"(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d{1,9})?"
"""The pattern of a number without a sign."""

INFINITE = "inf"
"""What is written for a ratio without end."""

_RATIO = re.compile(rf"({NUMBER})\s*:\s*({NUMBER})", re.ASCII)
_LARGEST = 300.0
"""The largest power of ten that decibels are written down as."""


def ratio_of(text: str) -> float | None:
    """Return the number that a ratio is, or None for a text that is none.

    Examples
    --------
    >>> ratio_of("1000:1"), ratio_of("inf"), ratio_of("20")
    (1000.0, inf, None)
    """
    if text == INFINITE:
        return math.inf
    if ":" not in text:
        return None
    match = _RATIO.fullmatch(text)
    wanted, other = map(float, match.groups()) if match else (0.0, 0.0)
    ratio = wanted / other if other else 0.0
    if 0.0 < ratio < math.inf:
        return ratio
    raise UnitError(f"'{text}' is no ratio of two positive numbers; write one such as '1000:1'")


def without_unit(number: str, unit: str) -> str:
    """Return the cure for a unit where a pure number is asked for; decibels are a ratio.

    Examples
    --------
    >>> without_unit("30", "dB")
    'write 1000, which is 10 ** (30 / 10), for a ratio of intensities (0.001 for a loss of as much)'
    >>> without_unit("30", "mm")
    'leave it out'
    """
    if not is_of_decibels(unit) or not abs(power := float(number) / 10.0) < _LARGEST:
        return "leave it out"
    loss = f" ({10.0**-power:.10g} for a loss of as much)" if power > 0.0 else ""
    ratio = f"write {10.0**power:.10g}, which is 10 ** ({number} / 10), for a ratio of intensities"
    return ratio + loss


def is_of_decibels(unit: str) -> bool:
    """Tell whether what stands behind a number says decibels, which are no unit here."""
    return unit.lower() == "db"


def finite_number(value: Any, unit: str) -> str:
    """Return what to give in place of a number that is not finite.

    Examples
    --------
    >>> finite_number(math.nan, ""), finite_number(math.inf, "")
    ('a finite number', 'a finite number, 1e30 for an extinction ratio without end')
    """
    if unit or value != math.inf:
        return "a finite number"
    return "a finite number, 1e30 for an extinction ratio without end"
