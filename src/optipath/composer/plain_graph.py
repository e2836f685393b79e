"""Plain graphs: networkx graphs of elements, as others make and read them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from difflib import SequenceMatcher
from typing import TYPE_CHECKING, Any

import networkx as nx
import numpy as np

from optipath.composer.wiring import LOOPS, link_text
from optipath.elements.element import Element, natural_of
from optipath.errors import OptipathError, PathError
from optipath.faults import closest, did_you_mean, shown, unknown
from optipath.light.frame import Frame
from optipath.materials.quantities import ANGLE
from optipath.values.arrays import entries_of
from optipath.values.cases import Case
from optipath.values.domains import Domain
from optipath.values.use import Use, stored_value

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from optipath.composer.wiring import Link


_NODE = frozenset({"element", "frames"})
_PORTS = frozenset({"out_port", "in_port"})
_LINK = _PORTS | {"azimuth", "length", "tap"}
_WHOLE = {"description": "", "cases": {}, "declared": (), "loops": LOOPS[0], "choices": {}}
"""The attributes of a node, a link, and a whole path; others are somebody else's."""

_CURE = "build an nx.MultiDiGraph or nx.DiGraph whose edges lead along the light"


class _KnownLength(Domain):
    """A length that nothing computes with yet, so that no run could give it."""

    takes_parameters = False


LINK_VALUES = {
    "azimuth": ANGLE,
    "length": _KnownLength("length", "length", minimum=0.0, own_unit="mm"),
}
"""The numbers that a link may have."""


def completed(graph: Any, graph_class: type[nx.MultiDiGraph] = nx.MultiDiGraph) -> nx.MultiDiGraph:
    """Return a graph as the composer reads it, or raise with all that is wrong.

    Links are keyed by (out-port, in-port). Attributes of other names stay as they are.
    """
    if not isinstance(graph, nx.Graph):
        raise PathError(f"a path is made of a networkx graph, not {shown(graph)}; {_CURE}")
    if not graph.is_directed():
        raise PathError(f"a networkx {type(graph).__name__} has no directions; {_CURE}")
    faults = [*_misspelt("the graph", graph.graph, _WHOLE), *_name_faults([*graph])]
    result = graph_class()
    result.graph.update({**graph.graph, **whole(graph.graph, faults)})
    for name, about in graph.nodes.items():
        if len(about) > 1 or not isinstance(about.get("element"), Element):
            faults += _node_faults(name, about)
        given = about.get("frames")
        frames = result.node_attr_dict_factory(given if isinstance(given, Mapping) else ())
        result.add_nodes_from([(name, {**about, "frames": frames})])
    _add_links(graph, result, faults)
    PathError.raise_for(faults)
    return result


def plain(graph: nx.MultiDiGraph, **others: Any) -> nx.MultiDiGraph:
    """Return a graph of elements, and what else is known of its path, for anybody to read.

    Attributes that say nothing are left out; keys of links are as networkx counts them.
    """
    result = nx.MultiDiGraph()
    about = {**graph.graph, **others}
    unsaid = {name for name, usual in _WHOLE.items() if about[name] == usual}
    result.graph.update({name: one for name, one in about.items() if name not in unsaid})
    # By dicts, since the attributes of others have any names.
    result.add_nodes_from((name, _said(node, _NODE)) for name, node in graph.nodes.items())
    result.add_edges_from(
        (start, end, {"out_port": leaves, "in_port": enters, **_said(link, _LINK)})
        for (start, end, (leaves, enters)), link in graph.edges.items()
    )
    return result


def whole(about: Mapping[Any, Any], faults: list[str]) -> dict[str, Any]:
    """Return the attributes of a whole path, the usual ones for those that are missing."""
    result = _WHOLE | {name: about[name] for name in _WHOLE if name in about}
    result["cases"] = {} if result["cases"] is None else result["cases"]
    described, cases, choices = result["description"], result["cases"], result["choices"]
    if not isinstance(described, str):
        faults.append(f"the description of a path must be a text, not {shown(described)}")
    if not isinstance(cases, Mapping) or [c for c in cases.values() if not isinstance(c, Case)]:
        faults.append(f"cases of a path must be a Case for each name, not {shown(cases)}")
    # What a choice is, is known above.
    offers = choices.values() if isinstance(choices, Mapping) else [choices]
    if not all(hasattr(one, "behind") for one in offers):
        faults.append(f"choices of a path must be as path.offer makes them, not {shown(choices)}")
    faults += unknown("loops", result["loops"], LOOPS)
    with PathError.collecting(faults):
        names = entries_of("declared", "names of parameters", result["declared"], PathError)
        if [name for name in names if not isinstance(name, str)]:
            faults.append(f"declared must be a sequence of names, not {shown(names)}")
        result["declared"] = names
    return result


def check_element(name: Any, element: Any) -> None:
    """Raise unless what is given for a node is an element."""
    if not isinstance(element, Element):
        raise PathError(f"node '{name}' must be an element, as Polarizer(), not {shown(element)}")


def frames_faults(name: str, element: Element, frames: Any) -> Iterator[str]:
    """Yield what is wrong with the world frames that are given for a node, a sentence each."""
    if not isinstance(frames, Mapping) or [f for f in frames.values() if not isinstance(f, Frame)]:
        wrong = f"such as {{'in': Frame()}}, not {shown(frames)}"
        yield f"frames of '{name}' must be a Frame for each port, {wrong}"
        return
    ports = *element.inputs, *element.outputs
    for port in frames:
        if port not in ports:
            near = did_you_mean(f"{name}.{port}", [f"{name}.{one}" for one in ports])
            yield f"frames of '{name}': port '{name}.{port}' does not exist{near}"


def _name_faults(names: list[Any]) -> Iterator[str]:
    """Yield what is wrong with the names of nodes; of numbers, as networkx has them, at once."""
    must = "must be a text without a dot; rename it, nx.relabel_nodes(graph, {})".format
    if others := [name for name in names if not isinstance(name, str)]:
        more = f", as {len(others) - 1:,} others," if len(others) > 1 else ""
        yield f"node name {shown(others[0])}{more} {must('str')}"
    for name in names:
        if isinstance(name, str) and (not name or "." in name):
            other = name.replace(".", "-") or "lamp"
            yield f"node name {shown(name)} {must(f'{{{shown(name)}: {shown(other)}}}')}"


def _is_unset(value: Any) -> bool:
    return value is None or value is False or (isinstance(value, dict) and not value)


def _said(about: Mapping[Any, Any], known: Collection[str]) -> dict[Any, Any]:
    """Return attributes without those of known names that say nothing."""
    return {
        name: one.copy() if isinstance(one, dict) else one
        for name, one in about.items()
        if name not in known or not _is_unset(one)
    }


def _node_faults(name: Any, about: Mapping[Any, Any]) -> Iterator[str]:
    """Yield what is wrong with a node, a sentence each."""
    misspelt = [*_misspelt(f"node {shown(name)}", about, _NODE)]
    yield from misspelt
    element, frames = about.get("element"), about.get("frames")
    if element is None:
        if not misspelt:
            yield f"node {shown(name)} has no 'element'; give one, as element=Polarizer()"
    elif not isinstance(element, Element):
        yield f"node {shown(name)} must be an element, as Polarizer(), not {shown(element)}"
    elif frames is not None:
        yield from frames_faults(name, element, frames)


def _misspelt(owner: str, about: Mapping[Any, Any], known: Collection[str]) -> Iterator[str]:
    """Yield the attributes that are meant for known ones, of which nothing is said."""
    for word in about:
        if not isinstance(word, str) or word in known:
            continue
        if known is _LINK and re.search(r"(\b|_)port$", word.lower()):
            if any(_is_unset(about.get(port)) for port in _PORTS):
                yield f"{owner} has an attribute '{word}'; did you mean 'out_port' or 'in_port'?"
        elif near := closest(word, known):
            letters = word.lower()
            alike = letters[0] == near[0] or SequenceMatcher(None, letters, near).ratio() >= _ALIKE
            # Three letters are soon alike: `tag` is no `tap`.
            sure = len(word) != 3 or near.startswith(letters) or sorted(letters) == sorted(near)
            if alike and sure and (known is _WHOLE or _is_unset(about.get(near))):
                yield f"{owner} has an attribute '{word}'; did you mean '{near}'?"


_ALIKE = 0.75
"""How like a known word is that another letter begins: `strength` is no `length`."""


def _add_links(graph: nx.DiGraph, result: nx.MultiDiGraph, faults: list[str]) -> None:
    """Add the links of a graph to one that has its nodes, or tell what is wrong with them."""
    elements = {name: e for name, e in result.nodes(data="element") if isinstance(e, Element)}
    several = graph.is_multigraph()
    for *edge, about in graph.edges(data=True, **{"keys": True} if several else {}):
        start, end = edge[:2]
        leaves, enters = about.get("out_port"), about.get("in_port")
        key = edge[2] if several else None
        if leaves is None is enters and type(key) is tuple and [*map(type, key)] == [str, str]:
            leaves, enters = key  # As the graph of a `PathGraph` has them.
        out_port = _port_of(elements.get(start), edge, leaves, faults, out=True)
        in_port = _port_of(elements.get(end), edge, enters, faults, out=False)
        link = start, end, (out_port, in_port)
        is_new = not several or not result.has_edge(*link)
        if not is_new and out_port and in_port:
            faults.append(f"link '{link_text(link)}' is there already; remove the second one")
        if not about.keys() <= _PORTS:
            said = {**about, "out_port": leaves, "in_port": enters}
            others = _others(link, edge, said, faults)
            result.add_edges_from([(*link, others)] if is_new else ())
        elif is_new:
            result.add_edge(*link, azimuth=None, tap=False)


def _others(
    link: Link, edge: list[Any], about: Mapping[Any, Any], faults: list[str]
) -> dict[str, Any]:
    """Return what is said of a link besides its ports, or tell what is wrong with it."""
    named = f"link '{link_text(link)}'" if all(link[2]) else _text(edge)
    faults += _misspelt(_text(edge), about, _LINK)
    result = {name: value for name, value in about.items() if name not in _LINK}
    for name in LINK_VALUES:
        value = about.get(name)
        if value is not None:
            with OptipathError.collecting(faults):
                value = link_value(named, name, value)
        if value is not None or name == "azimuth":
            result[name] = value
    tap = about.get("tap")
    if not isinstance(tap, bool | np.bool_ | None):
        faults.append(f"{named} tap must be True or False, not {shown(tap)}")
    return result | {"tap": isinstance(tap, bool | np.bool_) and bool(tap)}


def link_value(owner: str, name: str, value: Any) -> Any:
    """Return a number of a link as it is stored, or raise with what is wrong with it."""
    value = stored_value(f"{owner} {name}", value, LINK_VALUES[name])
    Use(f"{owner} {name}", value, LINK_VALUES[name]).check()
    return value


def _text(edge: list[Any]) -> str:
    return f"edge {shown(tuple(edge))}"


def _port_of(
    element: Element | None, edge: list[Any], argument: Any, faults: list[str], *, out: bool
) -> str:
    """Return the port at one end of an edge, the natural one where none is given; else nothing."""
    if element is None:
        return ""  # Which is told of the node.
    ports = element.outputs if out else element.inputs
    if isinstance(argument, str) and argument in ports:
        return argument
    if argument is None and (natural := natural_of(element, out=out)):
        return natural
    way, ends = ("out", "ends") if out else ("in", "begins")
    name = shown(edge[not out])
    if not ports:
        leads = f"leads {'from' if out else 'to'} {name}, where light {ends}"
        faults.append(f"{_text(edge)} {leads}; remove the edge, or turn it round")
    elif argument is None:
        lacks = f"has no '{way}_port', and {name} has no one natural way {way}"
        several = " or ".join(map(repr, ports))
        faults.append(f"{_text(edge)} {lacks}; give {way}_port={several}")
    else:
        wrong = f"{way}_port {shown(argument)} is no {way}-port of {name}"
        faults.append(f"{_text(edge)}: {wrong}{did_you_mean(argument, ports)}")
    return ""
