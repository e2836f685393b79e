"""State of the page: what a request contains, read and checked."""

from __future__ import annotations

import json
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from optipath.errors import OptipathError, ParameterError
from optipath.faults import Fault, listed, printable, shown, unknown
from optipath.materials.material import Material
from optipath.materials.named_materials import (
    WAVELENGTH,
    extinction_with,
    is_material,
    material_named,
    single_value,
)
from optipath.paths.binding import from_materials
from optipath.paths.files.presets import beside
from optipath.values.parameters import unknown_parameter

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.explorer.paths import ExploredPath, ExploredPresets
    from optipath.values.parameters import Parameter


WANTED = ("scene", "energy", "explanation")
"""What is answered only where it is asked for."""

FORMS = ("csv", "toml", "python")
"""What the state may be exported as."""

MOST_POINTS = 2001
"""How many values a curve has at most."""

_LONGEST, _SHOWN = 2000, 60
_MOST = 500


@dataclass(frozen=True)
class RequestedCurve:
    """A curve of some quantities over a parameter."""

    x: str
    first: str
    last: str
    count: int
    y: tuple[str, ...]


@dataclass(frozen=True)
class RequestedState:
    """What the page shows, or wants to."""

    preset: str
    case: str | None = None
    places: Mapping[str, str] = field(default_factory=dict)
    values: Mapping[str, str] = field(default_factory=dict)
    detector: str | None = None
    curve: RequestedCurve | None = None
    want: tuple[str, ...] = ()
    form: str = ""


def requested_state(
    argument: Any, allowed: Sequence[str], needed: Sequence[str] = ()
) -> RequestedState:
    """Return what a request asks for."""
    readers = {name: _READERS[name] for name in ("preset", *allowed)}
    return RequestedState(**_parts("", argument, readers, ("preset", *needed)))


def _parts(
    where: str, argument: Any, readers: Mapping[str, Any], needed: Sequence[str]
) -> dict[str, Any]:
    """Return the parts of an object, each read; what is null is left out unless it is needed."""
    names = [*readers]
    if not isinstance(argument, dict):
        what = where or "a request"
        raise ParameterError(f"{what} is an object with {listed(names)}, not {_as_json(argument)}")
    prefix = f"{where}." if where else ""
    what = f"name in {where}" if where else "name"
    faults = [sentence for name in argument for sentence in unknown(what, name, names)]
    faults += [f"{prefix}{name} is missing; give it" for name in needed if name not in argument]
    read: dict[str, Any] = {}
    for name in names:
        if name in argument and (name in needed or argument[name] is not None):
            with ParameterError.collecting(faults):
                read[name] = readers[name](f"{prefix}{name}", argument[name])
    ParameterError.raise_for(faults)
    return read


def _text(name: str, argument: Any) -> str:
    if not isinstance(argument, str):
        raise ParameterError(f"{name} must be a text, not {_as_json(argument)}")
    if len(argument) > _LONGEST:
        raise ParameterError(f"{name} has {len(argument)} characters; {_LONGEST} are the most")
    return argument


def _as_json(argument: Any) -> str:
    """Return what was sent as JSON writes it, cut where it is long; texts as sentences quote."""
    if isinstance(argument, str):
        return shown(argument)
    text = printable(json.dumps(argument, ensure_ascii=False))
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}..."


def _texts(name: str, argument: Any) -> dict[str, str]:
    if not isinstance(argument, dict) or len(argument) > _MOST:
        what = f"an object of {len(argument)}" if isinstance(argument, dict) else _as_json(argument)
        raise ParameterError(f"{name} must be an object of at most {_MOST} texts, not {what}")
    return {key: _text(f"{name}.{shown(key)[1:-1]}", value) for key, value in argument.items()}


def _words(name: str, argument: Any) -> tuple[str, ...]:
    if not isinstance(argument, list) or len(argument) > _MOST:
        raise ParameterError(f"{name} must be a list of texts, not {_as_json(argument)}")
    words = [_text(f"{name}[{at}]", each) for at, each in enumerate(argument)]
    return tuple(dict.fromkeys(words))


def _want(name: str, argument: Any) -> tuple[str, ...]:
    words = _words(name, argument)
    ParameterError.raise_for(sentence for word in words for sentence in unknown(name, word, WANTED))
    return words


def _form(name: str, argument: Any) -> str:
    ParameterError.raise_for(unknown(name, _text(name, argument), FORMS))
    return str(argument)


def _count(name: str, argument: Any) -> int:
    if type(argument) is not int or not 2 <= argument <= MOST_POINTS:
        what = f"a whole number from 2 to {MOST_POINTS}"
        raise ParameterError(f"{name} must be {what}, not {_as_json(argument)}")
    return argument


def _curve(name: str, argument: Any) -> RequestedCurve:
    readers = {"x": _text, "from": _text, "to": _text, "count": _count, "y": _words}
    return RequestedCurve(*_parts(name, argument, readers, [*readers]).values())


_READERS: dict[str, Any] = {
    "preset": _text,
    "case": _text,
    "places": _texts,
    "values": _texts,
    "detector": _text,
    "curve": _curve,
    "want": _want,
    "form": _form,
}


def faults_as_json(error: OptipathError) -> list[dict[str, Any]]:
    """Return what is wrong as the page writes it, each beside its field; null is none of them."""
    faults = [(fault.subject or None, fault.written("page")) for fault in error.faults]
    return [{"field": name, "sentence": text} for name, text in dict.fromkeys(faults)]


@dataclass(frozen=True)
class ReadState:
    """What the page shows, read."""

    asked: RequestedState
    base: ExploredPath
    explored: ExploredPath
    places: Mapping[str, str] = field(default_factory=dict)
    values: Mapping[str, Any] = field(default_factory=dict)
    given: Mapping[str, Any] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    @property
    def materials(self) -> dict[str, Material]:
        """The materials that are given, by parameter."""
        return {name: m for name, m in self.given.items() if isinstance(m, Material)}

    @property
    def published(self) -> Mapping[str, tuple[float, ...]]:
        """What was published for these very values."""
        if self.asked.case is None or self.given or self.asked.places:
            return {}
        return self.explored.path.cases[self.asked.case].published

    def faults(self, error: OptipathError) -> list[Fault]:
        """Return what is wrong, each beside the field that it is about."""
        known = {WAVELENGTH.name, *self.explored.parameters, *self.asked.values}
        media = [*self.materials]
        # Sentences on a medium name the element that it is in.
        other = media[0] if len(media) == 1 else ""
        return [each if each.subject in known else each.but(subject=other) for each in error.faults]


def read_state(presets: ExploredPresets, request: RequestedState) -> ReadState:
    """Return what the texts of the page stand for."""
    faults: list[str] = []
    explored, places = _opened(presets, request, faults)
    case = explored.path.cases.get(request.case or "")
    arguments = {
        name: value
        for name, text in request.values.items()
        if (value := _value(explored, name, request.values, faults)) is not None
    }
    state = ReadState(request, explored, explored, places, {}, arguments)
    known = {} if case is None else case.values
    try:
        state = _placed(presets, state, {n: v for n, v in known.items() if n not in places})
    except OptipathError as error:
        faults += state.faults(error)
    ParameterError.raise_for(faults)
    return state


def read_path(presets: ExploredPresets, request: RequestedState) -> ExploredPath:
    """Return the path that is asked for, its places chosen, and no values looked at."""
    faults: list[str] = []
    explored, _ = _opened(presets, request, faults)
    ParameterError.raise_for(faults)
    return explored


def _opened(
    presets: ExploredPresets, request: RequestedState, faults: list[str]
) -> tuple[ExploredPath, dict[str, str]]:
    """Return the path with its places, those of the case among them, as far as there are any."""
    try:
        base = presets.base(request.preset)
    except OptipathError as error:
        raise ParameterError(*(each.but(subject="preset") for each in error.faults)) from None
    case = base.cases.get(request.case or "")
    if case is None and request.case is not None:
        wrong = unknown(f"case of '{request.preset}'", request.case, base.cases)
        faults += [Fault(sentence, subject="case") for sentence in wrong]
    known, choices = {} if case is None else case.values, base.choices
    places = {name: str(word) for name, word in known.items() if name in choices}
    for name, word in request.places.items():
        if wrong := unknown("choice", name, choices) or unknown(name, word, choices[name].behind):
            faults += [Fault(each, subject=name if name in choices else "") for each in wrong]
        else:
            places[name] = word
    return presets.explored(request.preset, places), places


def _value(
    explored: ExploredPath, name: str, arguments: Mapping[str, str], faults: list[str]
) -> Any:
    """Return what the text of a field stands for; None where it is faulty."""
    known, text = explored.parameters, arguments[name].strip()
    if name in explored.path.choices:
        faults.append(Fault(f"'{name}' is a choice of places; give it among places", subject=name))
        return None
    if name not in known and name != WAVELENGTH.name:
        faults.append(unknown_parameter(name, known))
        return None
    parameter = known.get(name, WAVELENGTH)
    with OptipathError.collecting(faults, subject=name):
        if not is_material(parameter, text, explored.uses):
            return single_text(explored, parameter, text)
        k = extinction_with(explored.uses, name)
        own = single_text(explored, known[k], arguments[k]) if k in arguments else None
        return material_named(name, text, own)
    return None


def single_text(explored: ExploredPath, parameter: Parameter, text: str) -> Any:
    """Return what a text stands for, a bare number being in the unit of the parameter."""
    value = single_value(parameter, text, explored.uses, parameter.unit)
    if not isinstance(value, complex):
        parameter.resolve(value)
    return value


def _placed(presets: ExploredPresets, state: ReadState, known: Mapping[str, Any]) -> ReadState:
    """Return the state with materials in their places, and looked at as a whole."""
    argument, explored, notes = dict(state.given), state.explored, []
    values = beside(explored.path, known, argument)
    if media := {name: m for name, m in values.items() if isinstance(m, Material)}:
        within, asked = from_materials(explored.path.graph, media), state.asked
        for name in within:
            values.pop(name, None)
            argument.pop(name, None)
        stored = {*media, *within}
        texts = [f"{name}={text}" for name, text in asked.values.items() if name in stored]
        explored = presets.explored(asked.preset, state.places, media, (asked.case or "", *texts))
        values = {name: value for name, value in values.items() if name not in media}
    name = WAVELENGTH.name
    if name in values and name not in explored.parameters:
        notes.append("nothing depends on the wavelength here; it is not used")
        del values[name], argument[name]
    explored.plan.inputs.resolve(values)
    return replace(state, explored=explored, values=values, given=argument, notes=tuple(notes))
