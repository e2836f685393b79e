"""What was meant by a line that is not TOML."""

from __future__ import annotations

import re

from optipath.errors import shown
from optipath.values.commas import without_comma

_PLACE = re.compile(r"\(at line (\d+), column \d+\)")
_ASSIGNMENT = re.compile(r"""\s*([\w.$-]+|"[^"]*")\s*([=:])\s*(.*?)\s*(?:\#[^"']*)?""")
_WORDS = {"true": "true", "yes": "true", "on": "true", "false": "false", "no": "false"}
_WORDS |= {"off": "false"}
_COMMA = re.compile(r"[-+]?\d+,\d+")
_POINT = re.compile(r"[-+]?(?:\.\d+|\d+\.)")

_LONGEST = 200
"""No slip is looked for in a longer line."""


def likely_cure(text: str, reason: str) -> str:
    """Return the cure for a slip, ready to be put behind what the parser says.

    Examples
    --------
    >>> likely_cure("kind = interface", "Invalid value (at line 1, column 8)")
    '; write kind = "interface"'
    """
    place = _PLACE.search(reason)
    lines = text.splitlines()
    if place is None or int(place[1]) > len(lines):
        return "; close what is open: a quote or a bracket" if "end of document" in reason else ""
    line = lines[int(place[1]) - 1].strip()
    if "twice" in reason or "overwrite" in reason:
        return _doubled(line)
    if re.search(r"=\s*(None|null|nil)\s*$", line):
        return f"; leave {line.partition('=')[0].strip()} out"
    found = _ASSIGNMENT.fullmatch(line) if len(line) < _LONGEST else None
    meant = "" if found is None else _meant(found[3])
    if found and len(numbers := without_comma(found[3])) > 1:
        return (
            f"; a comma may be a point or part thousands: write {found[1]} = {' or '.join(numbers)}"
        )
    if found and meant and (meant != found[3] or found[2] == ":"):
        return f"; write {found[1]} = {meant}"
    return f"; look at {shown(line)}"


def _doubled(line: str) -> str:
    """Say what to do about a name that is there already."""
    header = line.strip("[] ")
    if header == "links":
        return "; write [[links]], in double brackets, above each link"
    if line.startswith("["):
        return f"; {header} is there already: give this one another name, or make them one"
    return f"; {line.partition('=')[0].strip()} is there already: leave one of them out"


def _meant(value: str) -> str:
    """Return a value as TOML has it; nothing where that is hard to tell."""
    if value.lower() in _WORDS:
        return _WORDS[value.lower()]
    if _COMMA.fullmatch(value):
        return without_comma(value)[0]
    if _POINT.fullmatch(value):
        return value.replace(".", "0.", 1) if value[-1] != "." else f"{value}0"
    if value.startswith(("'", '"')):
        quotes = value.count(value[0])
        whole = quotes == 2 and value.endswith(value[0])
        return value if whole else f"{value}{value[0]}" if quotes == 1 else ""
    if "(" in value or value.startswith(("np.", "math.")):
        return ""
    return "" if value.startswith(("[", "{")) or '"' in value or not value else f'"{value}"'
