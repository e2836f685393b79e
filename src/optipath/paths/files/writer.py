"""Writing a path as the text of a preset file."""

from __future__ import annotations

import json
import re
from dataclasses import fields
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.path_values import Values
from optipath.composer.plain_graph import LINK_VALUES
from optipath.composer.wiring import LOOPS
from optipath.errors import PathError
from optipath.faults import did_you_mean
from optipath.materials.index_domains import INDEX, IndexDomain
from optipath.paths.binding import choice_faults
from optipath.paths.files.schema import FORMAT, Faults
from optipath.paths.files.values import encode, entry_domain, wavelength_names
from optipath.values.cases import name_faults
from optipath.values.domains import Choice
from optipath.values.parameters import Parameter
from optipath.values.units import dimension_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    import networkx as nx

    from optipath.elements.element import Element
    from optipath.light.frame import Frame
    from optipath.values.cases import Case
    from optipath.values.domains import Domain


def to_toml(graph: nx.MultiDiGraph, description: str, cases: Mapping[str, Case]) -> str:
    """Return the text of a preset file."""
    faults = Faults()
    parameters = Values(graph).parameters
    top: dict[str, Any] = {"format": FORMAT, "description": description}
    if graph.graph["loops"] != LOOPS[0]:
        top["loops"] = graph.graph["loops"]
    tables: list[str] = [toml_lines("", top)]
    parts = complex_parts_of(graph)
    elements = {
        name: faults.attempt(name, _element, node["element"], node["frames"])
        for name, node in graph.nodes.items()
    }
    wavelengths = wavelength_names([*elements.values()])
    for name, parameter in parameters.items():
        row = _parameter(parameter, parts.get(name, INDEX.complex_parts))
        if name in wavelengths and dimension_of(parameter.unit) == "length":
            row.setdefault("range", [-np.inf, np.inf])  # Without it, it has that of wavelengths.
        tables.append(toml_lines(f"[parameters.{_key(name)}]", row))
    for name, described in elements.items():
        if described is not None:
            tables.append(toml_lines(f"[elements.{_key(name)}]", described))
    for (start, end, (leaves, enters)), about in graph.edges.items():
        link: dict[str, Any] = {"from": f"{start}.{leaves}", "to": f"{end}.{enters}"}
        said = {name: about[name] for name in LINK_VALUES if about.get(name) is not None}
        link |= {name: encode(one, LINK_VALUES[name].unit) for name, one in said.items()}
        if about["tap"]:
            link["tap"] = True
        tables.append(toml_lines("[[links]]", link))
    for name, choice in graph.graph["choices"].items():
        faults += [f"choice '{name}': {fault}" for fault in choice_faults(graph, choice)]
        row = {"element": choice.node, "behind": dict(choice.behind)}
        row |= {"help": choice.help} if choice.help else {}
        tables.append(toml_lines(f"[choices.{_key(name)}]", row))
    for name, case in cases.items():
        faults += name_faults(name)
        strange = {
            one: did_you_mean(one, parameters) for one in case.values if one not in parameters
        }
        gives = f"case '{name}' gives parameter"
        faults += [f"{gives} '{one}', which is unknown{near}" for one, near in strange.items()]
        tables.append(toml_lines(f"[cases.{_key(name)}]", _case(case, parameters, parts)))
    PathError.raise_for(faults)
    return "\n".join(tables)


def complex_parts_of(graph: nx.MultiDiGraph) -> dict[str, tuple[str, ...]]:
    """Return what the parts of complex numbers are called, for each parameter of such."""
    quantities = (quantity for _, e in graph.nodes(data="element") for quantity in e.quantities())
    parts = [(value, d.complex_parts) for _, value, d in quantities if d.complex_parts]
    return {value.name: each for value, each in parts if isinstance(value, Parameter)}


def _parameter(parameter: Parameter, complex_parts: tuple[str, ...]) -> dict[str, Any]:
    unit, default = parameter.unit, parameter.default
    limits = parameter.minimum, parameter.maximum
    row = {} if default is None else {"default": encode(default, unit, complex_parts)}
    others = {
        "unit": unit,
        "range": [encode(end, unit) for end in limits] if np.isfinite(limits).any() else None,
        "help": parameter.help,
        "words": {word: encode(value, unit) for word, value in parameter.words.items()},
        "optional": parameter.optional,
        "bound": parameter.bound,
    }
    return row | {key: value for key, value in others.items() if value}


def _element(element: Element, frames: Mapping[str, Frame]) -> dict[str, Any]:
    if not element.kind:
        name = type(element).__name__
        raise PathError(f'class {name} has no kind; define it as class {name}(Element, kind="...")')
    row: dict[str, Any] = {"kind": element.kind}
    for f in fields(element):  # type: ignore[arg-type]
        value = getattr(element, f.name)
        if value is not None:
            domain = element.domains()[f.name]
            is_choice = isinstance(domain, Choice)
            row[f.name] = domain.check(f.name, value) if is_choice else _field(value, domain)
    if frames:
        row["frames"] = {port: _frame(frame) for port, frame in frames.items()}
    return row


def _frame(frame: Frame) -> dict[str, Any]:
    axes = {axis: getattr(frame, axis).tolist() for axis in "xyz"}
    return axes | ({"rounding": frame.rounding} if frame.rounding else {})


def _field(value: Any, domain: Domain) -> Any:
    """Write a value of an element's field so that decoding gives it back."""
    each = entry_domain(domain)
    if each is not None and isinstance(value, tuple):
        return [_field(one, each) for one in value]
    is_pair = isinstance(value, np.ndarray) and value.shape == (2,) and value.dtype.kind == "f"
    if is_pair and isinstance(domain, IndexDomain):
        return {"n": encode(value, "")}  # A list of two is refused, as n and k of one index.
    return encode(value, domain.unit, domain.complex_parts or INDEX.complex_parts)


def _case(
    case: Case, parameters: Mapping[str, Parameter], parts: Mapping[str, tuple[str, ...]]
) -> dict[str, Any]:
    values = {}
    for name, value in case.values.items():
        unit = parameters[name].unit if name in parameters else ""
        values[name] = encode(value, unit, parts.get(name, INDEX.complex_parts))
    published = {name: list(stokes) for name, stokes in case.published.items()}
    others = {"published": published, "note": case.note}
    return {"values": values} | {key: value for key, value in others.items() if value}


def toml_lines(header: str, row: Mapping[str, Any]) -> str:
    """Return a table of a file, with a line for each of its keys."""
    pairs = [f"{_key(key)} = {as_toml(value)}\n" for key, value in row.items()]
    return "".join([f"{header}\n" if header else "", *pairs])


def _key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else _string(key)


def as_toml(value: Any) -> str:
    """Write a text, a number, or a list or a table of such, on one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _string(value)
    if isinstance(value, dict) and not value:
        return "{}"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_key(k)} = {as_toml(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(as_toml, value)) + "]"
    return repr(value)


def _string(text: str) -> str:
    # JSON's escapes are TOML's, but for the delete character, which TOML forbids unescaped.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
