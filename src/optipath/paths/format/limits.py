"""How long, how deep and how full the text of a preset may be, looked at before it is parsed.

The time of Python's reader of TOML grows with the square of the parts of a dotted key, and its
stack with the depth of brackets.
"""

from __future__ import annotations

import re
from itertools import accumulate, islice

from optipath.errors import PresetError

DEEPEST = 16
"""How many parts a key may have, and how many brackets may stand in each other."""

LONGEST_WORD = 1000
"""How many characters a number or a bare key may have."""

# Texts and comments, up to their end or that of what may hold them, so that none is met twice.
_SET_ASIDE = re.compile(
    r"""
    \"""(?:[^"\\]|\\.|"(?!""))*+"{0,5}
    | \'''(?:[^']|'(?!''))*+'{0,5}
    | "(?:[^"\\\n]|\\[^\n])*+"?
    | '[^'\n]*+'?
    | (?P<comment>\#[^\n]*)
    """,
    re.VERBOSE | re.DOTALL,
)
_DEEP_KEY = re.compile(rf"(?<![\w-])(?:[\w-]++[ \t]*+\.[ \t]*+){{{DEEPEST}}}")
_LONG_WORD = re.compile(rf"(?<![^\s\[\]{{}},=])[^\s\[\]{{}},=]{{{LONGEST_WORD + 1}}}")
_BRACKET = re.compile(r"[\[\]{}]")
_STEPS = {"[": 1, "{": 1, "]": -1, "}": -1}


def refuse_unwieldy(text: str) -> None:
    """Raise where a text would take long to parse, in time that grows with its length.

    Examples
    --------
    >>> try:
    ...     refuse_unwieldy("a = " + 20 * "[")
    ... except PresetError as error:
    ...     print(error)
    line 1 opens more than 16 brackets in each other; write it flatter
    """
    bare = _SET_ASIDE.sub(_placeholder, text)
    if found := _DEEP_KEY.search(bare):
        raise PresetError(
            f"line {_line(bare, found)} has a key of more than {DEEPEST} parts; use fewer dots"
        )
    if found := _LONG_WORD.search(bare):
        raise PresetError(
            f"line {_line(bare, found)} has a word of more than {LONGEST_WORD} characters; "
            f"make it shorter"
        )
    depths = list(accumulate(map(_STEPS.__getitem__, _BRACKET.findall(bare))))
    if max(depths, default=0) > DEEPEST:
        found = next(islice(_BRACKET.finditer(bare), depths.index(DEEPEST + 1), None))
        raise PresetError(
            f"line {_line(bare, found)} opens more than {DEEPEST} brackets in each other; write "
            f"it flatter"
        )


def _placeholder(found: re.Match[str]) -> str:
    # A text may be part of a key, and may have several lines.
    return "" if found["comment"] else "_" + "\n" * found[0].count("\n")


def _line(text: str, found: re.Match[str]) -> int:
    return text.count("\n", 0, found.start()) + 1
