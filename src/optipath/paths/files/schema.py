"""Schema: the files of presets, the keys that their tables may have, and faults while reading."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

from optipath.errors import OptipathError, PresetError, UnitError
from optipath.faults import Fault, did_you_mean, listed, shown
from optipath.values.units import dimension_of, parse_quantity, with_article

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable


FORMAT = 1

TOP = {"format": int, "description": str, "parameters": dict, "elements": dict, "links": list}
TOP |= {"cases": dict, "choices": dict, "loops": str}
PARAMETER = {"default": object, "unit": str, "range": list, "help": str, "words": dict}
PARAMETER |= {"optional": bool, "bound": bool}
LINK = {"from": str, "to": str, "azimuth": object, "length": object, "tap": bool}
CHOICE = {"element": str, "behind": dict, "help": str}
CASE = {"values": dict, "published": dict, "note": str}

_EXAMPLES = {
    **{name: f"a list of tables, each headed [[{name}]]" for name in ("links", "layers")},
    **{name: f"tables headed [{name}.NAME]" for name in ("elements", "parameters", "cases")},
    "loops": 'a text, "refuse" or "sum"',
    "range": 'a list of two values, such as ["0 deg", "90 deg"]',
}
_WORDS = {
    int: "a whole number",
    str: "a text",
    dict: "a table",
    list: "a list",
    bool: "true or false",
}


def type_faults(where: str, table: Mapping[str, Any], known: Collection[str]) -> list[Fault]:
    """Return a fault for each key that is unknown, or has another type than a mapping says."""
    schema = known if isinstance(known, Mapping) else dict.fromkeys(known, object)
    faults = [
        f"key '{key}' is unknown{did_you_mean(key, known)}" for key in table if key not in known
    ]
    faults += [
        f"'{key}' must be {_EXAMPLES.get(key, _WORDS[kind])}, not {shown(table[key])}"
        for key, kind in schema.items()
        if key in table and kind not in (object, type(table[key]))
    ]
    return [Fault(fault, place=where) for fault in faults]


def checked_table(raw: Any, known: Collection[str], needed: Iterable[str] = ()) -> dict[str, Any]:
    """Return a table that has known keys alone, of their types, and those that it needs."""
    if not isinstance(raw, dict):
        raise PresetError(f"{shown(raw)} must be a table")
    missing = [Fault(f"'{key}' is missing") for key in needed if key not in raw]
    PresetError.raise_for(type_faults("", raw, known) or missing)
    return raw


def number_of(raw: Any, unit: str) -> float | complex:
    """Return a number in base units, which is written with its unit where it has one."""
    if isinstance(raw, str):
        return parse_quantity(raw, dimension_of(unit))
    if isinstance(raw, bool) or not isinstance(raw, (int, float)):
        written = str(raw).lower() if isinstance(raw, bool) else shown(raw)
        raise UnitError(f"{written} is not a number")
    try:
        number = float(raw)
    except OverflowError:
        raise UnitError(f"{shown(raw)} is too large a number") from None
    if unit and math.isfinite(number):
        request = f"{with_article(dimension_of(unit))} is asked for"
        raise UnitError(f"{shown(raw)} has no unit, but {request}; write '{raw} {unit}'")
    return number


T = TypeVar("T")
P = ParamSpec("P")

_MOST = 4
"""How many places are named where the same is wrong."""


class Faults(list[str]):
    """A list of sentences, each with its place in the file."""

    def attempt(
        self, where: str, action: Callable[P, T], *arguments: P.args, **keywords: P.kwargs
    ) -> T | None:
        """Return what an action gives, or None after keeping its faults."""
        try:
            return action(*arguments, **keywords)
        except OptipathError as error:
            self += [fault.under(where) for fault in error.faults]
            return None

    def refuse(self, most: int = 0) -> None:
        """Raise where there are more faults than so many."""
        if len(self) > most:
            raise PresetError(*joined(self))


def each_entry(entries: Iterable[Any], action: Callable[[Any], T], where: str = "") -> list[T]:
    """Return what an action makes of each entry of a list, or raise with all faults."""
    faults = Faults()
    results = [faults.attempt(f"{where}[{i}]", action, entry) for i, entry in enumerate(entries)]
    faults.refuse()
    return results  # type: ignore[return-value] # none without faults


def each_key(
    table: Mapping[str, Any], action: Callable[[str, Any], T], where: str = ""
) -> dict[str, T]:
    """Return what an action makes of each key of a table and its value, or raise all faults."""
    faults = Faults()
    results = {
        key: faults.attempt(f"{where}.{key}", action, key, raw) for key, raw in table.items()
    }
    faults.refuse()
    return results  # type: ignore[return-value] # none without faults


def joined(faults: Iterable[str]) -> list[Fault]:
    """Return faults, one for all the places where the same is wrong.

    >>> z, y = Fault("'z' is unknown"), Fault("'y' is unknown")
    >>> joined([z.under("a.x"), y.under("b"), z.under("c"), "no lamp"])
    ["a.x and c: 'z' is unknown", "b: 'y' is unknown", 'no lamp']
    """
    places: dict[Fault, list[str]] = {}
    for fault in map(Fault.of, dict.fromkeys(faults)):
        places.setdefault(fault.but(place=""), []).append(fault.place)
    for where in places.values():
        if len(where) > _MOST:
            where[_MOST - 1 :] = [f"{len(where) - _MOST + 1} more places"]
    return [fault.under(listed(where)) for fault, where in places.items()]


_LARGEST = 4 * 1024 * 1024

_DEEPEST = 16
"""How many tables and lists may stand in each other."""

_PART = r"""(?:[\w-]++|"(?:[^"\\\n]|\\.)*+"|'[^'\n]*+')[ \t]*+\.[ \t]*+"""
_DEEP_KEY = re.compile(rf"(?:^|[\[{{,])[ \t]*+(?:{_PART}){{{_DEEPEST}}}", re.MULTILINE)


def parsed(text: str, source: str) -> dict[str, Any]:
    """Return what a text holds."""
    deep = PresetError(f"'{source}' is nested more than {_DEEPEST} deep; write it flatter")
    if _DEEP_KEY.search(text):  # For which time and memory of tomllib are quadratic.
        raise deep
    try:
        document = tomllib.loads(text)
    except RecursionError:
        raise deep from None
    except ValueError as error:  # Also of numbers of more than 4300 digits.
        place = re.search(r"\(at line (\d+),", str(error))
        line = text.split("\n")[int(place[1]) - 1].strip() if place else ""
        where = f": {shown(line)}" if line else ""
        raise PresetError(f"'{source}' is not TOML: {error}{where}") from None
    level: list[Any] = [document]
    for _ in range(_DEEPEST):
        each = [one.values() if isinstance(one, dict) else one for one in level]
        level = [one for several in each for one in several if isinstance(one, dict | list)]
    if level:
        raise deep
    return document


def files_in(folder: Path) -> dict[str, Path]:
    """Return the files of a folder by name, sorted, but hidden ones; none where it is none."""
    return dict(sorted((path.stem, path) for path in folder.glob("[!.]*.toml")))


def is_name(text: str) -> bool:
    """Tell whether a text may name a file, which then is in a folder and not beyond it."""
    return re.fullmatch(r"[a-z0-9-]+", text) is not None


def file_of(argument: Any, what: str, files: Mapping[str, Path], see: str, where: str = "") -> Path:
    """Return the file that a name or a path stands for, which need not exist if it is a path."""
    if isinstance(argument, str) and is_name(argument):
        if argument not in files:
            cure = did_you_mean(argument, files)
            raise PresetError(f"{what} '{argument}' is unknown{where}{cure}")
        return files[argument]
    try:
        path = Path(argument)
    except TypeError:
        wrong = f"not {shown(argument)}"
        raise PresetError(f"a {what} is a name or the path of a file, {wrong}") from None
    if path.suffix.lower() != ".toml":
        neither = f"neither the name of a {what} (a-z, 0-9 and -) nor the path of a .toml file"
        raise PresetError(f"'{argument}' is {neither}; see the names with {see}")
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
        where = f"at byte {error.start}"
        raise PresetError(f"'{path}' is not UTF-8 {where}; save it as UTF-8") from None


def presets_folder() -> Path:
    """Return the folder of the files that come with the library."""
    # Inside the package in an installed wheel; beside src/ where the project is installed in place.
    package = Path(__file__).resolve().parents[2]
    installed = package / "presets"
    return installed if installed.is_dir() else package.parents[1] / "presets"
