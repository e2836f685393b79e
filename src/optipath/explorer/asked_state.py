"""What the page asks for, checked for its shape; what the values stand for is looked at later."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from optipath.errors import ParameterError, listed, printable, shown, unknown

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

WANTED = ("scene", "energy", "explanation")
"""What is answered only where it is asked for."""

FORMS = ("csv", "toml", "python")
"""What the state may be exported as."""

MOST_POINTS = 2001
"""How many values a curve has at most."""

_LONGEST, _SHOWN = 2000, 60
_MOST = 500


@dataclass(frozen=True)
class AskedCurve:
    """A curve of some quantities over a parameter."""

    x: str
    first: str
    last: str
    count: int
    y: tuple[str, ...]


@dataclass(frozen=True)
class AskedState:
    """What the page shows, or wants to."""

    preset: str
    case: str | None = None
    places: Mapping[str, str] = field(default_factory=dict)
    values: Mapping[str, str] = field(default_factory=dict)
    detector: str | None = None
    curve: AskedCurve | None = None
    want: tuple[str, ...] = ()
    form: str = ""


def asked_state(given: Any, allowed: Sequence[str], needed: Sequence[str] = ()) -> AskedState:
    """Return what a request asks for.

    Examples
    --------
    >>> asked_state({"preset": "malus", "values": {"angle": "30 deg"}}, ["values"]).values
    {'angle': '30 deg'}
    """
    names = ("preset", *allowed)
    if not isinstance(given, dict):
        raise ParameterError(
            f"a request is an object with {listed([*names])}, not {_as_json(given)}"
        )
    faults = [sentence for name in given for sentence in unknown("name", name, names)]
    faults += [f"{name} is missing; give it" for name in ("preset", *needed) if name not in given]
    read: dict[str, Any] = {}
    for name in names:
        if name in given and (name in needed or name == "preset" or given[name] is not None):
            try:
                read[name] = _READERS[name](name, given[name])
            except ParameterError as fault:
                faults += fault.faults
    if faults:
        raise ParameterError(*faults)
    return AskedState(**read)


def _text(name: str, given: Any) -> str:
    if not isinstance(given, str):
        raise ParameterError(f"{name} must be a text, not {_as_json(given)}")
    if len(given) > _LONGEST:
        raise ParameterError(f"{name} has {len(given)} characters; {_LONGEST} are the most")
    return given


def _as_json(given: Any) -> str:
    """Return what was sent as JSON writes it, cut where it is long; texts as sentences quote."""
    if isinstance(given, str):
        return shown(given)
    text = printable(json.dumps(given, ensure_ascii=False))
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}..."


def _texts(name: str, given: Any) -> dict[str, str]:
    if not isinstance(given, dict) or len(given) > _MOST:
        what = f"an object of {len(given)}" if isinstance(given, dict) else _as_json(given)
        raise ParameterError(f"{name} must be an object of at most {_MOST} texts, not {what}")
    return {key: _text(f"{name}.{shown(key)[1:-1]}", value) for key, value in given.items()}


def _words(known: Sequence[str] | None) -> Any:
    def read(name: str, given: Any) -> tuple[str, ...]:
        if not isinstance(given, list) or len(given) > _MOST:
            raise ParameterError(f"{name} must be a list of texts, not {_as_json(given)}")
        words = tuple(dict.fromkeys(_text(f"{name}[{at}]", each) for at, each in enumerate(given)))
        if known is not None and (faults := [s for w in words for s in unknown(name, w, known)]):
            raise ParameterError(*faults)
        return words

    return read


def _form(name: str, given: Any) -> str:
    if faults := unknown(name, _text(name, given), FORMS):
        raise ParameterError(*faults)
    return str(given)


def _count(name: str, given: Any) -> int:
    if type(given) is not int or not 2 <= given <= MOST_POINTS:
        what = f"a whole number from 2 to {MOST_POINTS}"
        raise ParameterError(f"{name} must be {what}, not {_as_json(given)}")
    return given


def _curve(name: str, given: Any) -> AskedCurve:
    readers = {"x": _text, "from": _text, "to": _text, "count": _count, "y": _words(None)}
    if not isinstance(given, dict):
        raise ParameterError(
            f"{name} must be an object with {listed([*readers])}, not {_as_json(given)}"
        )
    faults = [s for key in given for s in unknown(f"name in {name}", key, [*readers])]
    faults += [f"{name}.{key} is missing; give it" for key in readers if key not in given]
    read: list[Any] = []
    for key, reader in readers.items():
        try:
            read.append(reader(f"{name}.{key}", given[key]) if key in given else None)
        except ParameterError as fault:
            faults += fault.faults
    if faults:
        raise ParameterError(*faults)
    return AskedCurve(*read)


_READERS: dict[str, Any] = {
    "preset": _text,
    "case": _text,
    "places": _texts,
    "values": _texts,
    "detector": _text,
    "curve": _curve,
    "want": _words(WANTED),
    "form": _form,
}
