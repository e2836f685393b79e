"""Editing: ports by name, graphs joined by ``>>``, nodes and links added, replaced and removed."""

from __future__ import annotations

import dataclasses
import re
from bisect import bisect_left
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.placement import (
    azimuth_of,
    frame_at,
    goes_straight,
    is_zero,
    placement_faults,
    turn_text,
)
from optipath.composer.plain_graph import check_element, frames_faults, link_value
from optipath.composer.wiring import LOOPS, Wiring, link_text
from optipath.elements.element import Element, natural_of
from optipath.elements.frame_checks import azimuth_at
from optipath.errors import OptipathError, PathError
from optipath.faults import did_you_mean, listed, shown, there_are
from optipath.paths.element_graph import Attributes
from optipath.values.arrays import changed, joint_shape, read_only, same
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Callable, Container, Iterable, Sequence

    import networkx as nx

    from optipath.composer.wiring import Link, Port


_ROUNDING = 4e-15
"""Up to what angle two turns are one, or share of it beyond 1 rad."""

_LONGEST = 12
"""How many nodes a path may have that is shown as a chain."""


def name_by_kind(element: Element) -> str:
    """Return what a node of an element is called in a chain: its kind, or that of its class."""
    words = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "-", type(element).__name__).lower()
    return (element.kind or words).replace(".", "-")


def join(
    first: nx.MultiDiGraph, second: nx.MultiDiGraph, leaves: Port | None = None
) -> dict[str, str]:
    """Put a graph of elements behind another, in place: its nodes and links, and one link more.

    None is added where one of them is empty.
    """
    faults: list[str] = []
    ends = []
    if first and second:
        for argument, graph, out in ((leaves, first, True), (None, second, False)):
            with PathError.collecting(faults):
                ends.append(argument or open_port(graph, out=out))
    names = _names(first, second)
    shared = [("node", name) for name in names.values() if name in first]
    shared += [
        ("choice", name) for name in first.graph["choices"] if name in second.graph["choices"]
    ]
    faults += [
        f"{what} '{name}' stands on both sides of >>; use two names" for what, name in shared
    ]
    PathError.raise_for(faults)
    first.add_nodes_from((names[name], about) for name, about in second.nodes.items())
    first.add_edges_from(
        (names[start], names[end], key, about) for (start, end, key), about in second.edges.items()
    )
    if ends:
        (start, out_port), (end, in_port) = ends
        first.add_edge(start, names[end], key=(out_port, in_port), azimuth=None, tap=False)
    both = first.graph, second.graph
    moved = {name: choice.renamed(names) for name, choice in second.graph["choices"].items()}
    first.graph["choices"] = first.graph["choices"] | moved
    first.graph["declared"] = tuple(dict.fromkeys(name for one in both for name in one["declared"]))
    first.graph["loops"] = LOOPS[any(one["loops"] == LOOPS[1] for one in both)]
    return names


def append(graph: nx.MultiDiGraph, port: str, others: nx.MultiDiGraph) -> str:
    """Put other elements behind a port, in place, and return what the last of them is called."""
    if others is graph:
        raise PathError(f"what is put behind '{port}' is the path that it stands in; use a copy")
    return [*join(graph, others, find_port(graph, port, out=True)).values()][-1]


def as_chain(graph: nx.MultiDiGraph) -> list[str]:
    """Return the nodes of a path that `>>` alone can make, in order; none for any other."""
    chain = [name for name in graph if not graph.in_degree(name)]
    if len(chain) != 1 or len(graph) > _LONGEST or graph.number_of_edges() != len(graph) - 1:
        return []
    for name in chain:
        leaves = natural_of(element_at(graph, name), out=True)
        for _, end, ports, tap in graph.out_edges(name, keys=True, data="tap"):
            if tap or ports != (leaves, natural_of(element_at(graph, end), out=False)):
                return []
            chain.append(end)
    # One link fewer than nodes, so that none is met twice; a fork has more than one end.
    ends = [name for name in graph if not graph.out_degree(name)]
    return chain if len(chain) == len(graph) and len(ends) == 1 else []


def open_port(graph: nx.MultiDiGraph, *, out: bool) -> Port:
    """Return the only natural port of a graph that no link uses."""
    elements = dict(graph.nodes(data="element"))
    if len(elements) == 1:
        ((name, element),) = elements.items()
        return name, natural_port(element, name, out=out)
    wiring = Wiring(graph)
    used = wiring.links_from if out else wiring.links_to
    ports = [(name, e.outputs if out else e.inputs) for name, e in elements.items()]
    every = [(name, port) for name, each in ports for port in each]
    unused = [port for port in every if port not in used]
    results = [port for port in unused if natural_of(elements[port[0]], out=out) == port[1]]
    if len(results) == 1:
        return results[0]
    place, way = ("in front of", "out") if out else ("behind", "in")
    several = ", ".join(f"'{name}.{port}'" for name, port in results or unused)
    cure = f"; connect one by its name: {several}" if unused else ""
    raise PathError(
        f"the path {place} >> has {len(results)} natural ways {way} that are open{cure}"
    )


def _names(first: nx.MultiDiGraph, second: nx.MultiDiGraph) -> dict[str, str]:
    """Return what the nodes of the second are called behind the first."""
    names: dict[str, str] = {}
    others = {*second}
    for name, element in second.nodes(data="element"):
        new = next_by_kind(name, element, first, others) if name in first else ""
        names[name] = new or name
        others.add(names[name])
    return names


def next_by_kind(name: str, element: Element, *taken: Container[str]) -> str:
    """Return the next name by the kind of an element; empty where its name is of its own."""
    kind = name_by_kind(element)
    if not re.fullmatch(rf"{re.escape(kind)}(-\d+)?", name):
        return ""

    def is_free(number: int) -> bool:
        return not any(f"{kind}-{number}" in names for names in taken)

    # In few steps, as a long chain has many of a kind: one that is free, and taken just before.
    free = 2
    while not is_free(free):
        free *= 2
    first = bisect_left(range(free), x=True, lo=free // 2 + 1, key=is_free)
    return f"{kind}-{first}"


def turn_more(graph: nx.MultiDiGraph, link: Link, turn: Any) -> None:
    """Turn what a link leads to by more, in rad; its azimuth goes over to its links."""
    if is_zero(turn):
        return
    before = azimuth_of(Wiring(graph), link)
    try:
        total = _sum(before, turn)
    except OptipathError:
        turns = f"by {turn_text(before)} and by {turn_text(turn)}, and no one azimuth does for both"
        raise PathError(f"'{link[1]}' would be turned {turns}") from None
    _give_azimuth_to_links(graph, link)
    dict.update(graph.edges[link], azimuth=None if is_zero(total) else total)


def turns_to(graph: nx.MultiDiGraph, name: str) -> list[Any]:
    """Return the turns in rad of a node against the port that light comes straight from."""
    wiring, result, leaves, seen = Wiring(graph), [], "", set()
    while len(links := graph.in_edges(name, keys=True)) == 1:
        (link,) = links
        start, end, (port, enters) = link
        bends = leaves and not goes_straight(wiring.elements[end], enters, leaves)
        if bends or link in seen:  # A ring has no port to begin at.
            break
        result.append(azimuth_of(wiring, link))
        seen.add(link)
        name, leaves = start, port
    return [turn for turn in result if not is_zero(turn)]


def turn_to(graph: nx.MultiDiGraph, name: str, turns: list[Any]) -> None:
    """Turn a node, and nothing behind it, until it stands as `turns_to` told elsewhere."""
    (enters,), (passes,) = graph.in_edges(name, keys=True), graph.out_edges(name, keys=True)
    missing = [*turns]
    for turn in turns_to(graph, name):
        alike = next((at for at, one in enumerate(missing) if same(one, turn)), None)
        if alike is None:
            missing.append(-turn)
        else:
            del missing[alike]
    for turn in missing:
        turn_more(graph, enters, turn)
        turn_more(graph, passes, -turn)


def are_alike(first: Any, second: Any) -> bool:
    """Tell whether two turns, in rad, are the same but for rounding there and back."""
    try:
        rest = _sum(first, -second)
    except OptipathError:
        return False
    size = np.maximum(1.0, np.abs(getattr(first, "offset", first)))
    return not isinstance(rest, Parameter) and bool(np.all(np.abs(rest) < _ROUNDING * size))


def _give_azimuth_to_links(graph: nx.MultiDiGraph, link: Link) -> None:
    """Let the links that an element's azimuth turns say it, if it turns this one."""
    wiring, node = Wiring(graph), graph.nodes[link[1]]
    arriving = wiring.links_to[link[1], link[2][1]]
    unsaid = [one for one in arriving if graph.edges[one]["azimuth"] is None]
    links = [one for one in unsaid if not is_zero(azimuth_of(wiring, one))]
    if link in links:
        for one in links:
            dict.update(graph.edges[one], azimuth=azimuth_of(wiring, one))
        dict.update(node, element=dataclasses.replace(node["element"], azimuth=0.0))


def _sum(first: Any, second: Any) -> Any:
    """Return the sum of two turns."""
    if is_zero(first):
        return second
    if same(first, -second):
        return 0.0
    parameters = [turn for turn in (first, second) if isinstance(turn, Parameter)]
    if not parameters:
        joint_shape(np.shape(first), np.shape(second))
        return read_only(first + second)
    if len(parameters) == 2 and first.alone() == second.alone():
        if not (scale := first.scale + second.scale):
            return first.offset + second.offset
        return changed(
            first,
            scale=scale,
            offset=first.offset + second.offset,
            offset_dimension=first.offset_dimension or second.offset_dimension,
        )
    return first + second


def check_port(element: Element, owner: str, port: str, ports: Sequence[str]) -> None:
    """Raise unless a port of a node is one of those given."""
    if port in ports:
        return
    if port in (*element.inputs, *element.outputs):
        way = "in" if port in element.inputs else "out"
        raise PathError(f"port '{owner}.{port}' lets light {way}; link an out-port to an in-port")
    known = [f"{owner}.{name}" for name in ports]
    raise PathError(f"port '{owner}.{port}' does not exist{did_you_mean(f'{owner}.{port}', known)}")


def natural_port(element: Element, owner: str, *, out: bool) -> str:
    """Return the natural port of a node."""
    result = natural_of(element, out=out)
    if result:
        return result
    way, ports = ("out", element.outputs) if out else ("in", element.inputs)
    if not ports:
        raise PathError(f"'{owner}' has no way {way}: light {'ends' if out else 'begins'} there")
    names = ", ".join(f"'{owner}.{port}'" for port in ports)
    raise PathError(f"'{owner}' has no one natural way {way}; connect one of its ports: {names}")


def find_port(graph: nx.MultiDiGraph, text: Any, *, out: bool) -> tuple[str, str]:
    """Return the node and the port that a text names in a graph of elements."""
    if not isinstance(text, str) or text.count(".") > 1:
        way = "out" if out else "in"
        raise PathError(f"{shown(text)} is no {way}-port; write it as 'node.{way}'")
    name, dot, port = text.partition(".")
    element = element_at(graph, name)
    if not dot:
        return name, natural_port(element, name, out=out)
    check_port(element, name, port, element.outputs if out else element.inputs)
    return name, port


def element_at(graph: nx.MultiDiGraph, name: Any) -> Element:
    """Return the element of a node."""
    if not isinstance(name, str) or name not in graph:
        raise PathError(f"node {shown(name)} does not exist{did_you_mean(name, graph)}")
    return graph.nodes[name]["element"]  # type: ignore[no-any-return]


def edit(graph: nx.MultiDiGraph, change: Callable[..., None], *arguments: Any) -> None:
    """Change a graph in place, or raise and leave it as it was."""
    try:
        _try(graph.subgraph(_near(graph, arguments)), change, *arguments)
    except PathError:
        _try(graph, change, *arguments)  # Whose sentence knows all that is there.
    change(graph, *arguments)


def _try(graph: nx.MultiDiGraph, change: Callable[..., None], *arguments: Any) -> None:
    trial = graph.copy()
    change(trial, *arguments)
    known = placement_faults(Wiring(graph))
    PathError.raise_for([fault for fault in placement_faults(Wiring(trial)) if fault not in known])


def _near(graph: nx.MultiDiGraph, arguments: Iterable[Any]) -> Iterable[str]:
    """Return what a change may concern: its nodes and those near them, or all if some are placed.

    Frames in the world are compared along ways of any length.
    """
    if Wiring(graph).placed:
        return list(graph)
    near = {text.partition(".")[0] for text in arguments if isinstance(text, str)}
    for _ in range(2):
        known = [name for name in near if name in graph]
        near.update(*[[*graph.predecessors(name), *graph.successors(name)] for name in known])
    return near


def add(graph: nx.MultiDiGraph, name: Any, element: Any, frames: Any) -> None:
    """Add a node, as `PathGraph.add` does."""
    if not isinstance(name, str) or not name or "." in name:
        example = "path.add('filter', Polarizer())"
        raise PathError(f"node name {shown(name)} must be a text without a dot, as in {example}")
    if name in graph:
        raise PathError(f"node '{name}' is there already; choose another name")
    check_element(name, element)
    frames = {} if frames is None else frames
    PathError.raise_for(frames_faults(name, element, frames))
    graph.add_node(name, element=element, frames=Attributes(frames))


def connect(
    graph: nx.MultiDiGraph, leaves: Any, enters: Any, azimuth: Any, tap: Any, length: Any
) -> None:
    """Add a link, as `PathGraph.connect` does."""
    faults = [] if isinstance(tap, bool) else [f"tap must be True or False, not {shown(tap)}"]
    link = _link_of(graph, leaves, enters, faults)
    if graph.has_edge(*link):
        raise PathError(f"link '{link_text(link)}' is there already; remove the second one")
    values, named = {"azimuth": azimuth, "length": length}, f"link '{leaves} -> {enters}'"
    said = {n: link_value(named, n, one) for n, one in values.items() if one is not None}
    graph.add_edge(*link, **{"azimuth": None, **said, "tap": tap})


def disconnect(graph: nx.MultiDiGraph, leaves: Any, enters: Any) -> None:
    """Take a link out, as `PathGraph.disconnect` does."""
    find_port(graph, leaves, out=True)
    graph.remove_edge(*_link(graph, leaves, enters))


def _link(graph: nx.MultiDiGraph, leaves: Any, enters: Any, *, taps: bool = True) -> Link:
    """Return the link between two ports, or the only one of a port."""
    if None not in (leaves, enters):
        link = _link_of(graph, leaves, enters, [])
        if not graph.has_edge(*link):
            near = did_you_mean(link_text(link), sorted(map(link_text, graph.edges(keys=True))))
            raise PathError(f"there is no link '{link_text(link)}'{near}")
        return link
    out = enters is None
    node, port = find_port(graph, leaves if out else enters, out=out)
    near_by = (graph.out_edges if out else graph.in_edges)(node, keys=True)
    links: list[Link] = [link for link in near_by if link[2][not out] == port]
    if out and not taps:
        links = [link for link in links if not graph.edges[link]["tap"]]
    if len(links) != 1:
        every = sorted(map(link_text, links or graph.edges(keys=True)))
        feeds = f"'{node}.{port}' {'feeds' if out else 'is fed by'} {_listed(links)}"
        raise PathError(f"{feeds}; name both ends of one{there_are(every)}")
    return links[0]


def _link_of(graph: nx.MultiDiGraph, leaves: Any, enters: Any, faults: list[str]) -> Link:
    """Return the link between two ports, or raise with these faults and those of the ports."""
    ends = []
    for text, out in ((leaves, True), (enters, False)):
        with PathError.collecting(faults):
            ends.append(find_port(graph, text, out=out))
    PathError.raise_for(faults)
    (start, out_port), (end, in_port) = ends
    return start, end, (out_port, in_port)


def insert(
    graph: nx.MultiDiGraph, name: Any, element: Any, behind: Any, before: Any, frames: Any = None
) -> None:
    """Put an element into a link, as `PathGraph.insert` does."""
    check_element(name, element)
    enters, passes = (natural_port(element, name, out=out) for out in (False, True))
    if behind is before is None:
        cure = "give behind='node.port', where light leaves, or before='node.port'"
        raise PathError(f"path.insert('{name}', ...) names no link; {cure}, where it arrives")
    link = _link(graph, behind, before, taps=False)
    start, end, (leaves, arrives) = link
    frame = frame_at(Wiring(graph), start, leaves) if element.straight else None
    if frames is None and frame is not None:
        frames = {enters: frame}
    add(graph, name, element, frames)
    if element.straight and not frames:
        # What stands behind it stays as it was turned.
        turn_more(graph, link, -_own_turn(element))
    about = graph.edges[link]
    first, second = {"azimuth": None, "tap": about["tap"]}, {**about, "tap": False}
    if "length" in about:  # It stands at the port that is named.
        here, there = (first, second) if before is None else (second, first)
        here["length"], there["length"] = 0.0, about["length"]
    graph.remove_edge(*link)
    graph.add_edges_from([(start, name, (leaves, enters), first)])
    graph.add_edges_from([(name, end, (passes, arrives), second)])


def remove(graph: nx.MultiDiGraph, name: Any) -> None:
    """Take a node out, as `PathGraph.remove` does."""
    element_at(graph, name)
    before, behind = graph.in_edges(name, keys=True), graph.out_edges(name, keys=True)
    if before and behind:
        _close(graph, name, list(before), list(behind))
    graph.remove_node(name)


def replace(graph: nx.MultiDiGraph, name: Any, element: Any) -> None:
    """Put another element in the place of one, as `PathGraph.replace` does."""
    element_at(graph, name)
    check_element(name, element)
    entered = {enters for *_, (_, enters) in graph.in_edges(name, keys=True)}
    left = {leaves for *_, (leaves, _) in graph.out_edges(name, keys=True)}
    placed = {*graph.nodes[name]["frames"]} - {*element.inputs, *element.outputs}
    missing = (entered - {*element.inputs}) | (left - {*element.outputs}) | placed
    if missing:
        ports = ", ".join(f"'{name}.{port}'" for port in sorted(missing))
        lacks = f"the new element of '{name}' has no {ports}, which links or frames use"
        raise PathError(f"{lacks}; take '{name}' out and add it anew")
    old, turn = graph.nodes[name]["element"], _own_turn(element)
    before = {link: graph.edges[link]["azimuth"] for link in graph.in_edges(name, keys=True)}
    said = {link: azimuth for link, azimuth in before.items() if azimuth is not None}
    turned = [link for link in said if not is_zero(azimuth_at(element, link[2][1]))]
    twice = {link: said[link] for link in turned}
    for link, azimuth in twice.items():
        if not are_alike(azimuth, turn):
            turns = f"turns '{name}' by {turn_text(azimuth)}, and the new one by {turn_text(turn)}"
            cure = "leave its azimuth out to have it turned as the old one is"
            raise PathError(f"link '{link_text(link)}' {turns}; {cure}")
        dict.update(graph.edges[link], azimuth=None)
    if not twice and old.straight and element.straight:
        # World frames say how it stands; else, what is behind it stays as it was turned.
        behind = [] if graph.nodes[name]["frames"] else graph.out_edges(name, keys=True)
        for link in [link for link in behind if link[1] != name]:
            turn_more(graph, link, _own_turn(old))
            turn_more(graph, link, -turn)
    elif not twice and is_zero(turn):
        by_itself = [link[2][1] for link, azimuth in before.items() if azimuth is None]
        if any(not is_zero(azimuth_at(old, port)) for port in by_itself):
            why = f"'{name}' is turned by its azimuth {turn_text(_own_turn(old))}"
            cure = "give it that azimuth, or connect its link anew with azimuth=0.0"
            raise PathError(f"{why}, and the new element is not; {cure}")
    dict.update(graph.nodes[name], element=element)


def reading(graph: nx.MultiDiGraph, reads: str) -> nx.MultiDiGraph:
    """Return a graph whose detectors and dumps read something else."""
    result = graph.copy()
    for node in result.nodes.values():
        if hasattr(node["element"], "reads"):
            dict.update(node, element=dataclasses.replace(node["element"], reads=reads))
    return result


def _own_turn(element: Element) -> Any:
    return getattr(element, "azimuth", 0.0)


def _close(graph: nx.MultiDiGraph, name: str, before: list[Link], behind: list[Link]) -> None:
    """Link what stands before a node with what stands behind it."""
    ((start, _, (leaves, enters)), *more), ((_, end, (passes, arrives)), *others) = before, behind
    through = goes_straight(element_at(graph, name), enters, passes)
    several = more or others or start == name
    if several or not through:
        why = "several links meet there" if several else "light does not go straight through it"
        cure = f"disconnect {_listed([*before, *behind])} first"
        raise PathError(f"'{name}' cannot be taken out, since {why}; {cure}")
    if graph.has_edge(start, end, key=(leaves, arrives)):
        link = link_text((start, end, (leaves, arrives)))
        raise PathError(f"link '{link}' is there already; disconnect it first")
    turn_more(graph, behind[0], azimuth_of(Wiring(graph), before[0]))
    first, second = graph.edges[before[0]], graph.edges[behind[0]]
    about = {**first, **second, "tap": first["tap"] or second["tap"]}
    if "length" in first.keys() & second.keys():
        about["length"] = _sum(first["length"], second["length"])
    else:
        about.pop("length", None)
    graph.add_edges_from([(start, end, (leaves, arrives), about)])


def _listed(links: Iterable[Link]) -> str:
    return listed([f"'{link_text(link)}'" for link in links] or ["no link"])
