"""Commas in numbers, which stand for a decimal point or part thousands."""

from __future__ import annotations

import re

_COMMA = re.compile(r"[-+]?\d+,\d+(?:[^\d,][^,]*)?", re.ASCII)
_THOUSANDS = re.compile(r"[-+]?[1-9]\d{0,2},\d{3}(?:\D.*)?", re.ASCII)


def without_comma(text: str) -> list[str]:
    """Return the numbers that one with a comma may be meant for; none where it has no comma.

    Examples
    --------
    >>> without_comma("30,5 deg"), without_comma("1,000"), without_comma("1.5")
    (['30.5 deg'], ['1.000', '1000'], [])
    """
    if _COMMA.fullmatch(text) is None:
        return []
    ways = (".", "") if _THOUSANDS.fullmatch(text) else (".",)
    return [text.replace(",", way) for way in ways]


def comma_cure(text: str) -> str:
    """Return the cure for a number with a comma, a part of a sentence; nothing for others.

    Examples
    --------
    >>> comma_cure("30,5 deg")
    "did you mean '30.5 deg'? (a text is one value; several are an array, in Python)"
    >>> comma_cure("1,000")
    "its comma may be a decimal point or part thousands; write '1.000' or '1000'"
    """
    found = without_comma(text)
    if len(found) > 1:
        written = " or ".join(f"'{number}'" for number in found)
        return f"its comma may be a decimal point or part thousands; write {written}"
    several = "(a text is one value; several are an array, in Python)"
    return f"did you mean '{found[0]}'? {several}" if found else ""
