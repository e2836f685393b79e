"""Whole numbers that count something: what is one, and what to say of what is none."""

from __future__ import annotations

import math
from contextlib import suppress
from numbers import Integral
from operator import index

from optipath.errors import shown


def is_whole(number: object, least: int = 1, most: float = math.inf) -> bool:
    """Tell whether something is a whole number of any integer type, but no bool."""
    with suppress(TypeError):  # NumPy's durations are Integral, and index nothing
        return (
            isinstance(number, Integral)
            and not isinstance(number, bool)
            and least <= index(number) <= most
        )
    return False


def whole_number(what: str, number: object, least: int = 1) -> list[str]:
    """Return the sentence for what is no whole number, or too small; none for one that serves.

    Examples
    --------
    >>> whole_number("threads", 1.5), whole_number("threads", 2)
    (['threads must be a whole number of 1 or more, not 1.5'], [])
    """
    return (
        []
        if is_whole(number, least)
        else [f"{what} must be a whole number of {least} or more, not {shown(number)}"]
    )
