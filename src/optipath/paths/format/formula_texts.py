"""Arithmetic with parameters that is written as a text, such as ``"2 * $theta + 10 deg"``."""

from __future__ import annotations

import re

_NUMBER = r"\d+\.?\d*(?:e[-+]?\d+)?|\.\d+(?:e[-+]?\d+)?"
_AFFINE = re.compile(
    rf"""
    (?P<sign>-?) \s* (?:(?P<before>{_NUMBER}) \s* \*? \s*)?
    \$?(?P<name>[^\W\d]\w*) \s* (?:(?P<way>[*/]) \s* (?P<behind>{_NUMBER}))? \s*
    (?:(?P<plus>[-+]) \s* (?P<offset>(?:{_NUMBER}) [^$*/()+]*))?
    """,
    re.VERBOSE | re.IGNORECASE | re.ASCII,
)
_OFFSET_FIRST = re.compile(
    rf"((?:{_NUMBER})[^$*/()+-]*)([-+])\s*([\d$.].*)", re.IGNORECASE | re.ASCII
)
_SIGNS = re.compile(r"[*/+()^\s\d]|(?<=.)-|\$.*\$")


def table_for(text: str) -> str:
    """Return how a file writes a multiple of a parameter with an offset; an example for others.

    Examples
    --------
    >>> table_for("$theta/2"), table_for("10 * $a - 5 deg")
    ('{ parameter = "theta", scale = 0.5 }', '{ parameter = "a", scale = 10, offset = "-5 deg" }')
    >>> table_for("90 deg - $theta")
    '{ parameter = "theta", scale = -1, offset = "90 deg" }'
    """
    text = text.strip()
    if first := _OFFSET_FIRST.fullmatch(text):
        text = f"{first[2].replace('+', '')}{first[3]} + {first[1].strip()}"
    found = _AFFINE.fullmatch(text)
    if found is None:
        return '{ parameter = "NAME", scale = 0.5, offset = ... }'
    scale = float(found["before"] or 1.0) * (-1.0 if found["sign"] else 1.0)
    number = float(found["behind"] or 1.0)
    if found["way"] == "*":
        scale *= number
    elif number:
        scale /= number
    row = f'{{ parameter = "{found["name"]}"'
    if scale != 1.0:
        row += f", scale = {scale:.12g}"
    if found["offset"]:
        offset = (found["plus"].replace("+", "") + found["offset"]).strip()
        row += f', offset = "{offset}"' if offset[-1].isalpha() else f", offset = {offset}"
    return row + " }"


def is_arithmetic(text: str) -> bool:
    """Tell whether a text with a ``$`` is more than one name.

    Examples
    --------
    >>> is_arithmetic("$theta/2"), is_arithmetic("$a + $b"), is_arithmetic("-$thta")
    (True, True, False)
    """
    return _SIGNS.search(text.partition("$")[2] if text[:2] == "-$" else text) is not None
