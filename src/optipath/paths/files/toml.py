"""TOML files: by name or path, within limits, with cures for slips.

The time of Python's TOML reader is quadratic in dotted keys, its stack as deep as brackets.
"""

from __future__ import annotations

import re
import tomllib
from itertools import accumulate, islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

from optipath.errors import PresetError, did_you_mean, shown
from optipath.values.units import without_comma

if TYPE_CHECKING:
    from collections.abc import Sequence


def parsed(text: str, source: str) -> dict[str, Any]:
    """Return what a text holds."""
    try:
        refuse_unwieldy(text)
    except PresetError as error:
        raise PresetError(f"'{source}' is not TOML as presets use it: {error}") from None
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # Numbers of 4300 digits are a ValueError.
        reason = "too deeply nested" if isinstance(error, RecursionError) else str(error)
        cure = likely_cure(text, reason)
        raise PresetError(f"'{source}' is not TOML: {reason}{cure}") from None


_NAME = re.compile(r"[a-z0-9-]+")
_LARGEST = 4 * 1024 * 1024


def names_in(folder: Path) -> list[str]:
    """Return the names of the files of a folder, sorted; none where there is no such folder."""
    return sorted([path.stem for path in folder.glob("*.toml")])


def file_of(argument: Any, what: str, folder: Path, see: str) -> Path:
    """Return the file that a name or a path stands for, which need not exist if it is a path."""
    names: Sequence[str] = names_in(folder)
    if isinstance(argument, str) and _NAME.fullmatch(argument):
        if argument not in names:
            raise PresetError(f"{what} '{argument}' is unknown{did_you_mean(argument, names)}")
        return folder / f"{argument}.toml"
    try:
        path = Path(argument)
    except TypeError:
        raise PresetError(
            f"a {what} is a name or the path of a file, not {shown(argument)}"
        ) from None
    if path.suffix.lower() != ".toml":
        cure = did_you_mean(path.stem, names)
        if not cure.startswith("; did you mean"):
            cure = f"; see the names with {see}"
        raise PresetError(
            f"'{argument}' is neither the name of a {what} (a-z, 0-9 and -) nor the path of a "
            f".toml file{cure}"
        )
    return path


def text_of(path: Path, what: str) -> str:
    """Return the text of a file."""
    try:
        if path.exists() and not path.is_file():
            raise PresetError(f"'{path}' cannot be read: it is no file")
        with path.open("rb") as file:
            data = file.read(_LARGEST + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise PresetError(f"'{path}' cannot be read: {reason}") from None
    if len(data) > _LARGEST:
        raise PresetError(f"'{path}' is larger than {_LARGEST // 1024**2} MiB; no {what} is")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise PresetError(
            f"'{path}' is not UTF-8: byte {error.start} is 0x{data[error.start]:02x}; "
            f"save it as UTF-8"
        ) from None


def presets_folder() -> Path:
    """Return the folder of the files that come with the library."""
    # Inside the package in an installed wheel; beside src/ where the project is installed in place.
    package = Path(__file__).resolve().parents[2]
    installed = package / "presets"
    return installed if installed.is_dir() else package.parents[1] / "presets"


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

    >>> try:
    ...     refuse_unwieldy("a = " + 20 * "[")
    ... except PresetError as error:
    ...     print(error)
    line 1 opens more than 16 brackets in each other; write it flatter
    """
    bare = _SET_ASIDE.sub(_placeholder, text)
    if result := _DEEP_KEY.search(bare):
        raise PresetError(
            f"line {_line(bare, result)} has a key of more than {DEEPEST} parts; use fewer dots"
        )
    if result := _LONG_WORD.search(bare):
        raise PresetError(
            f"line {_line(bare, result)} has a word of more than {LONGEST_WORD} characters; "
            f"make it shorter"
        )
    depths = list(accumulate(map(_STEPS.__getitem__, _BRACKET.findall(bare))))
    if max(depths, default=0) > DEEPEST:
        result = next(islice(_BRACKET.finditer(bare), depths.index(DEEPEST + 1), None))
        raise PresetError(
            f"line {_line(bare, result)} opens more than {DEEPEST} brackets in each other; write "
            f"it flatter"
        )


def _placeholder(result: re.Match[str]) -> str:
    # A text may be part of a key, and may have several lines.
    return "" if result["comment"] else "_" + "\n" * result[0].count("\n")


def _line(text: str, result: re.Match[str]) -> int:
    return text.count("\n", 0, result.start()) + 1


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
    result = _ASSIGNMENT.fullmatch(line) if len(line) < _LONGEST else None
    meant = "" if result is None else _meant(result[3])
    if result and len(numbers := without_comma(result[3])) > 1:
        ways = " or ".join(numbers)
        return f"; a comma may be a point or part thousands: write {result[1]} = {ways}"
    if result and meant and (meant != result[3] or result[2] == ":"):
        return f"; write {result[1]} = {meant}"
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
