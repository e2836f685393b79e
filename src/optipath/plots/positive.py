"""Positive numbers that say how something is drawn."""

from __future__ import annotations

from numbers import Real
from typing import Any

from optipath.errors import shown


def positive(what: str, number: Any) -> list[str]:
    """Return the sentence for what is no number above 0; none for one that is, or for None.

    Examples
    --------
    >>> positive("largest", -1.0), positive("largest", 2), positive("largest", None)
    (['largest is -1.0; give a number above 0'], [], [])
    """
    real = isinstance(number, Real) and not isinstance(number, bool)
    if number is None or (real and float(number) > 0.0):
        return []
    return [f"{what} is {shown(number)}; give a number above 0"]
