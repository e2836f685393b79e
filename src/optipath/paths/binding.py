"""Binding: values, materials and curves in place of parameters, and nodes in the places chosen."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass, replace
from itertools import chain
from typing import TYPE_CHECKING, Any, Self

from optipath.composer.path_values import Values
from optipath.composer.placement import goes_straight
from optipath.composer.wiring import Wiring
from optipath.errors import OptipathError, ParameterError, PathError
from optipath.faults import Fault, shown, unknown
from optipath.materials.material import Material
from optipath.materials.named_materials import (
    extinctions_with,
    is_by_wavelength,
    of_complex,
    places_of,
    waits_for,
)
from optipath.paths.editing import (
    element_at,
    find_port,
    insert,
    natural_port,
    remove,
    turn_to,
    turns_to,
)
from optipath.plan.inputs import Inputs
from optipath.values.arrays import changed, same
from optipath.values.curve import Curve
from optipath.values.curve_value import CurveValue, curve_values
from optipath.values.parameters import ABSENT, Parameter, unknown_parameter
from optipath.values.use import axes_for, checked_later
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Container, Iterator, Sequence

    import networkx as nx

    from optipath.values.cases import Case
    from optipath.values.use import Use


def bind(known: Values, values: Mapping[str, Any], *, for_good: bool = True) -> Values:
    """Return the values of a copy of a path in which parameters have values."""
    if any(map(is_by_wavelength, values.values())):
        values, placed = _materials_placed(values, known.uses)
        if placed and not for_good:
            cure = f"other parameters; bind it, by path.bind({min(placed)}=...)"
            raise ParameterError(f"'{min(placed)}' has no default that depends on {cure}")
        known = exchanged(known, placed)
        # A material may follow from a wavelength to which the path is bound already.
        wholly = {name: p for name, p in known.parameters.items() if p.bound}
        known = exchanged(known, wholly)
    parameters = known.parameters
    known_names = [*parameters, *known.graph.graph["choices"]]
    bound: dict[str, Parameter] = {}
    faults: list[str] = []
    for name, value in values.items():
        if name not in parameters:
            faults.append(unknown_parameter(name, known_names))
        elif parameters[name].bound:
            bound_to = parameters[name].text(parameters[name].default)
            cure = "give the value where it is bound, or leave it open there"
            faults.append(f"parameter '{name}' is bound to {bound_to} already; {cure}")
        elif value is None:
            absent = f"; {name}='{ABSENT}' leaves its element out" * parameters[name].optional
            faults.append(f"parameter '{name}' is None, which is no value; give one{absent}")
        else:
            try:
                # Whether it is one of degrees is looked at below, where all is well.
                parameter = parameters[name].with_default(axes_for(name, value, known.open_uses))
                bound[name] = changed(parameter, bound=for_good)
            except OptipathError as fault:
                faults += of_complex(fault.faults, known.uses, name, value)
    result = exchanged(known, bound)
    faults += result.faults
    ParameterError.raise_for(faults)
    uses = [use for use in known.open_uses if use.value.name in values]
    Inputs(parameters, {}, tuple(uses), {}).warn_of_angles(values)
    return result


def _materials_placed(
    values: Mapping[str, Any], uses: Sequence[Use]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return what is bound once curves are in place, and materials give n and k."""
    placed: dict[str, Any] = {}
    plain, faults = dict(values), list[str]()
    for name, material in values.items():
        places = places_of(uses, name)
        known = not places or places[0].value.bound or isinstance(places[0].value, Wavelength)
        if known or not is_by_wavelength(material):
            continue
        if not isinstance(material, Material):
            curve = isinstance(material, Curve)
            placed[name] = curve_values(material, Wavelength())[0] if curve else material
            del plain[name]
            continue
        before, other = len(faults), extinctions_with(uses, name)
        with OptipathError.collecting(faults):
            for use in places:
                use.refuse_material(material)
        if len(faults) > before or not (other or waits_for(material)):
            continue  # Without both, it is one complex number.
        faults += _faults(name, material, other, places, values, uses)
        arguments: dict[str, Any] = {name: material.n if other else material}
        arguments |= {k.name: material.k for k in other.values() if isinstance(k, Parameter)}
        for part, value in arguments.items():
            plain.pop(part, None)
            is_number = not isinstance(value, (Parameter, Material))
            (plain if is_number else placed)[part] = value
    ParameterError.raise_for(faults)
    return plain, placed


def from_materials(graph: nx.MultiDiGraph, values: Mapping[str, Any]) -> set[str]:
    """Return the parameters that are the k of materials among some values."""
    names = [name for name, value in values.items() if isinstance(value, Material)]
    uses = Values(graph).uses if names else ()
    results = [k for name in names for k in extinctions_with(uses, name).values()]
    return {k.name for k in results if isinstance(k, Parameter)}


def _faults(
    name: str,
    material: Material,
    extinctions: Mapping[str, Any],
    places: Sequence[Use],
    values: Mapping[str, Any],
    uses: Sequence[Use],
) -> Iterator[str]:
    """Yield why a material cannot stand where the parameter does, or give its k there."""
    for use in places:
        if not use.value.is_signed or use.value.is_negative:
            cure = f"for which no Material can be given; let '{name}' itself stand there"
            yield f"parameter '{name}' stands as {use.value.formula} at {use.owner}, {cure}"
    for owner, k in extinctions.items():
        is_open = isinstance(k, Parameter) and not k.bound and k.is_signed and not k.is_negative
        if is_open and k.name in values:
            cure = f"which has its own k; leave {k.name} out, or make a Material of that k"
            yield f"parameter '{k.name}' is given by '{name}', a Material, {cure}"
        elif is_open and {use.owner for use in places_of(uses, k.name)} <= {*extinctions}:
            continue
        elif isinstance(k, Parameter) or not same(k, material.k):
            k_text = k.formula if isinstance(k, Parameter) else k
            cure = "let an open parameter stand there, and nowhere else"
            yield f"{owner} is {k_text}, but {material} for '{name}' has a k of its own; {cure}"
    if extinctions and len({use.owner for use in places}) > len(extinctions):
        yield f"parameter '{name}' is n beside a k, and without a k elsewhere; use two names"


def cases_left(cases: Mapping[str, Case], known: Container[str]) -> dict[str, Case]:
    """Return the cases of a path in which parameters are there no more."""
    results = {}
    for name, case in cases.items():
        left = {argument: value for argument, value in case.values.items() if argument in known}
        same_values = len(left) == len(case.values)
        results[name] = case if same_values else replace(case, values=left, published={}, note="")
    return results


def exchanged(known: Values, values: Mapping[str, Any]) -> Values:
    """Return the values of a copy of a path in which others stand for parameters."""
    copy = known.graph.copy()
    uses = [use for use in known.parameter_uses if use.value.name in values]
    owners = known.alike.keys() & {use.owner.partition(".")[0] for use in uses}
    with checked_later():  # The check of the whole path names parameters and nodes.
        # Of equal elements, uses name the first.
        made = {id(e): _with_other_fields(e, values) for e in map(known.alike.get, owners)}
    for name, node in copy.nodes.items():
        if (element := made.get(id(known.alike[name]))) is not None:
            dict.update(node, element=element)
    for *_, link in copy.edges(data=True):
        if link["azimuth"] is not None:
            dict.update(link, azimuth=_exchanged(link["azimuth"], values))
    return Values(copy)


def _with_other_fields(whole: Any, values: Mapping[str, Any]) -> Any:
    others = {f.name: _exchanged(getattr(whole, f.name), values) for f in fields(whole)}
    same = all(others[name] is getattr(whole, name) for name in others)
    return whole if same else replace(whole, **others)


def _exchanged(value: Any, values: Mapping[str, Any]) -> Any:
    if isinstance(value, CurveValue):
        return value.bound_to(values)
    if isinstance(value, Parameter):
        result = values.get(value.name, value)
        stored = result is value or not isinstance(result, Parameter)
        if stored or not isinstance(result, CurveValue):
            return result if stored else result.like(value)
        return changed(
            result,
            scale=value.scale * result.scale,
            offset=value.scale * result.offset + value.offset,
            offset_dimension=value.offset_dimension or result.offset_dimension,
        )
    if isinstance(value, tuple):
        return tuple(_exchanged(one, values) for one in value)
    # What is made of several values, as a material and a chain of vertices are.
    return _with_other_fields(value, values) if is_dataclass(value) else value


@dataclass(frozen=True)
class PlaceChoice:
    """Behind which port a node stands, by word."""

    node: str
    behind: Mapping[str, str] = field(default_factory=dict)
    help: str = ""

    def __post_init__(self) -> None:
        pairs = self.behind.items() if isinstance(self.behind, Mapping) else ()
        texts = [self.node, *chain(*pairs)]
        unnamed = [text for text in texts if not isinstance(text, str) or not text.strip()]
        if not pairs or unnamed or not isinstance(self.help, str):
            given = f"for each word, not {shown(self.node)} and {shown(self.behind)}"
            raise PathError(f"a choice of places is a node and, behind, a port {given}")
        object.__setattr__(self, "behind", dict(self.behind))

    @classmethod
    def named(cls, name: Any, known: Values, *said: Any) -> Self:
        """Return a choice for the nodes of a path, or raise if its name or a place cannot be."""
        if not isinstance(name, str) or not name.isidentifier():
            raise PathError(f"choice name {shown(name)} must be letters, digits and underscores")
        if name in known.graph.graph["choices"] or name in known.parameters:
            raise PathError(f"choice or parameter '{name}' is there already; use another name")
        choice = cls(*said)
        PathError.raise_for(choice_faults(known.graph, choice))
        return choice

    def renamed(self, names: Mapping[str, str]) -> PlaceChoice:
        """Return the same choice where nodes are called otherwise."""
        ports = {word: port.partition(".") for word, port in self.behind.items()}
        behind = {
            word: names.get(name, name) + dot + way for word, (name, dot, way) in ports.items()
        }
        return replace(self, node=names[self.node], behind=behind)

    def place(self, graph: nx.MultiDiGraph) -> str:
        """Return the word of the place where the node stands; empty if it is none of them."""
        before = [(start, leaves) for start, _, (leaves, _) in graph.in_edges(self.node, keys=True)]
        ports = {word: find_port(graph, port, out=True) for word, port in self.behind.items()}
        return next((word for word, port in ports.items() if [port] == before), "")


def put_in_place(graph: nx.MultiDiGraph, name: str, word: Any) -> None:
    """Move the node of a choice, in place."""
    choice: PlaceChoice = graph.graph["choices"][name]
    PathError.raise_for(unknown(f"{name}", word, choice.behind))
    element = element_at(graph, choice.node)
    if choice.place(graph) != word:
        with PathError.wrapping(f"'{choice.node}' cannot be moved to {name}={shown(word)}"):
            turns = turns_to(graph, choice.node) if graph.in_degree(choice.node) else None
            remove(graph, choice.node)
            insert(graph, choice.node, element, choice.behind[word], None)
            if turns is not None:
                turn_to(graph, choice.node, turns)


def choice_faults(graph: nx.MultiDiGraph, choice: PlaceChoice) -> list[str]:
    """Return why the node of a choice cannot be put in its places, a sentence each."""
    node, faults = choice.node, list[str]()
    with PathError.collecting(faults):
        element = element_at(graph, node)
        enters, leaves = (natural_port(element, node, out=out) for out in (False, True))
        if not goes_straight(element, enters, leaves):
            faults.append(f"light does not go straight through '{node}', so it has no other place")
    # What has no place at all says nothing of links.
    links = None if faults else Wiring(graph).links_from
    for word, port in choice.behind.items():
        at = f"place '{word}'"
        with PathError.collecting(faults, at):
            start, way = find_port(graph, port, out=True)
            if links is not None and (start == node or len(links.get((start, way), [])) != 1):
                no_place = f"'{start}.{way}' feeds no one link that '{node}' could be put into"
                faults.append(Fault(no_place, place=at))
    return faults


def check_choices(graph: nx.MultiDiGraph) -> None:
    """Raise with all that is wrong with the choices of a graph."""
    PathError.raise_for(
        Fault.of(fault).under(f"choice '{name}'")
        for name, choice in graph.graph["choices"].items()
        for fault in choice_faults(graph, choice)
    )


def with_arguments(known: Values, values: dict[str, Any], *, for_good: bool) -> Values:
    """Return the values of a path with nodes in the places chosen, and other values given."""
    faults: list[str] = []
    if places := [name for name in known.graph.graph["choices"] if name in values]:
        known = Values(known.graph.copy())
        for name in places:
            with PathError.collecting(faults):
                put_in_place(known.graph, name, values.pop(name))
    with ParameterError.collecting(faults):
        known = bind(known, values, for_good=for_good)
    ParameterError.raise_for(faults)
    return known


def wiring_at_defaults(known: Values, values: dict[str, Any]) -> Wiring:
    """Return the wiring of a path whose parameters have values, or else their defaults."""
    usual = {name: p.default for name, p in known.parameters.items() if not p.bound}
    values = {name: value for name, value in usual.items() if value is not None} | values
    return Wiring(with_arguments(known, values, for_good=True).graph)
