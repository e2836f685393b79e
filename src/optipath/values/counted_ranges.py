"""Ranges of values as they are written: ``"400 nm:700 nm:61"``, start, stop and count."""

from __future__ import annotations

import re
from decimal import Decimal
from fractions import Fraction

from optipath.errors import UnitError, shown
from optipath.values.commas import without_comma
from optipath.values.ratios import NUMBER

MOST_WRITTEN = 1_000_000
"""How many values a text may stand for; more are given as an array."""

_END = re.compile(rf"([-+]?{NUMBER})\s*((?:1/)?[^\W\d_].*|[°'\"])?")
_COUNT = re.compile(r"\+?\d{1,18}", re.ASCII)
_LONGEST, _LEAST, _LARGEST = 100, -330, 309
"""How many characters an end may have, and which powers of ten floats have."""


def texts_of_range(text: str) -> list[str]:
    """Return the values of a range, each as somebody would write it.

    They are evenly spaced in the unit of the ends, exactly, and each is rounded once.

    Examples
    --------
    >>> texts_of_range("0:1:5")
    ['0', '0.25', '0.5', '0.75', '1']
    >>> texts_of_range("700 nm:400 nm:4")
    ['700 nm', '600.0 nm', '500.0 nm', '400 nm']
    """
    parts = [part.strip() for part in text.split(":")]
    if len(parts) != 3 or not all(parts):
        raise UnitError(_not_three(text, parts))
    first, last, _ = parts
    (start, unit), (stop, other) = _end(text, first), _end(text, last)
    if unit != other:
        raise UnitError(_two_units(text, parts, unit, other))
    count = _count(text, parts, start, stop)
    if count == 1:
        return [first]
    steps = count - 1
    denominator = start.denominator * stop.denominator * steps
    begin = start.numerator * stop.denominator * steps
    rise = stop.numerator * start.denominator - start.numerator * stop.denominator
    behind = f" {unit}" if unit else ""
    # The quotient of two integers is the float next to it.
    inner = [f"{(begin + rise * at) / denominator}{behind}" for at in range(1, steps)]
    return [first, *inner, last]


def _end(text: str, end: str) -> tuple[Fraction, str]:
    """Return the number and the unit of an end of a range."""
    if meant := without_comma(end):
        written = " or ".join(f"'{text.replace(end, each)}'" for each in meant)
        raise UnitError(f"'{text}' has a number with a comma; write {written}")
    match = _END.fullmatch(end) if len(end) <= _LONGEST else None
    if match is None:
        raise UnitError(
            f"{shown(end)} of {shown(text)} is no number with a unit; write start:stop:count, such "
            f"as '400 nm:700 nm:61'"
        )
    number = Decimal(match[1])
    if number and not _LEAST < number.adjusted() < _LARGEST:
        raise UnitError(f"'{end}' of '{text}' is beyond the numbers that floats are; give another")
    return Fraction(match[1]) if number else Fraction(0), match[2] or ""


def _count(text: str, parts: list[str], start: Fraction, stop: Fraction) -> int:
    first, last, counted = parts
    if _COUNT.fullmatch(counted) is None:
        raise UnitError(_no_count(text, parts, start, stop))
    count = int(counted)
    if count < 1:
        raise UnitError(f"'{text}' counts no values; the last of start:stop:count is 1 or more")
    if count == 1 and start != stop:
        raise UnitError(
            f"'{text}' counts one value from {first} to {last}; write '{first}:{last}:2'"
        )
    if count > MOST_WRITTEN:
        raise UnitError(
            f"'{text}' counts {count} values, and a text stands for {MOST_WRITTEN} at most; give "
            f"them as an array, such as np.linspace(...), in Python"
        )
    return count


def _no_count(text: str, parts: list[str], start: Fraction, stop: Fraction) -> str:
    """Return the sentence for what is no count, and may be a step or have the unit of the ends."""
    first, last, counted = parts
    match = _END.fullmatch(counted[:_LONGEST])
    if match is not None and (unit := match[2]) and _COUNT.fullmatch(match[1]):
        written = ":".join(_with_unit(end, unit) for end in (first, last))
        return f"'{counted}' of '{text}' is no count; write '{written}:{match[1]}'"
    cure = "write how many values there are, both ends included"
    if match is not None and not match[2] and _LEAST < Decimal(match[1]).adjusted() < _LARGEST:
        step = abs(Fraction(match[1]))
        steps = abs(stop - start) / step if step else Fraction(0)
        if steps.denominator == 1 and 0 < steps < MOST_WRITTEN:
            cure = f"for steps of {counted.lstrip('+-')} write '{first}:{last}:{steps + 1}'"
    return f"'{counted}' of '{text}' is no count, which is a whole number; {cure}"


def _not_three(text: str, parts: list[str]) -> str:
    if len(parts) == 2 and all(parts):
        return f"'{text}' does not say how many values there are; write '{text}:11' for eleven"
    return (
        f"{shown(text)} is no range; write start:stop:count, such as '0:90:91' or "
        f"'400 nm:700 nm:61'"
    )


def _two_units(text: str, parts: list[str], unit: str, other: str) -> str:
    if unit and other:
        return f"the ends of '{text}' are in {unit} and in {other}; write both in one unit"
    written = ":".join([*(_with_unit(end, unit or other) for end in parts[:2]), parts[2]])
    return f"'{text}' has a unit at one end alone; write '{written}'"


def _with_unit(end: str, unit: str) -> str:
    return end if (match := _END.fullmatch(end)) and match[2] else f"{end} {unit}"
