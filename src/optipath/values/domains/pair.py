"""Pairs of numbers, which may be the two parts of one."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from optipath.values.domains.domain import Domain

_REAL = (float, int, np.floating, np.integer)
_LARGEST = sys.float_info.max


def is_pair(value: Any) -> bool:
    """Tell whether a value is two real numbers written by hand; arrays are of several paths.

    Examples
    --------
    >>> is_pair((0.2, 3.4)), is_pair(["0.2", "3.4"]), is_pair((1.5, 1.6, 1.7))
    (True, True, False)
    >>> is_pair(np.array([0.2, 3.4]))
    False
    """
    return isinstance(value, (tuple, list)) and len(value) == 2 and None not in _numbers(value)


def pair_in(value: Any, domain: Domain) -> tuple[float, float] | None:
    """Return two real numbers written by hand that may be the parts of one; None for all else."""
    if not is_pair(value):
        return None
    first, second = _numbers(value)
    one = np.asarray(complex(first, second))
    return (first, second) if domain.allows(one) else None


def is_real(number: Any) -> bool:
    """Tell whether something is a finite real number, and no array of it.

    Examples
    --------
    >>> is_real(2), is_real(True), is_real(np.nan), is_real("2")
    (True, False, False, False)
    """
    of_type = isinstance(number, _REAL) and not isinstance(number, bool)
    return of_type and -_LARGEST <= number <= _LARGEST


def _numbers(value: Any) -> list[Any]:
    """Return the real number that each entry is, or stands for; None for what is none."""
    read = [_read(entry) if isinstance(entry, str) else entry for entry in value]
    return [number if is_real(number) else None for number in read]


def _read(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None
