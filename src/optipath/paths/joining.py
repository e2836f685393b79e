"""Joining: graphs of elements put one behind the other, as ``>>`` does."""

from __future__ import annotations

import re
from itertools import count
from typing import TYPE_CHECKING

from optipath.composer.wiring import LOOPS, Wiring
from optipath.errors import PathError
from optipath.paths.port_names import element_at, find_port, natural_of, natural_port

if TYPE_CHECKING:
    import networkx as nx

    from optipath.composer.travel import Port
    from optipath.elements.element import Element

_LONGEST = 12
"""How many nodes a path may have that is shown as a chain."""


def name_by_kind(element: Element) -> str:
    """Return what a node of an element is called in a chain: its kind, or that of its class.

    Examples
    --------
    >>> from optipath.elements.beam_splitter import BeamSplitter
    >>> from optipath.elements.element import Element
    >>> class WavePlate(Element): ...
    >>> name_by_kind(BeamSplitter()), name_by_kind(WavePlate())
    ('beam-splitter', 'wave-plate')
    """
    words = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "-", type(element).__name__).lower()
    return (element.kind or words).replace(".", "-")


def join(
    first: nx.MultiDiGraph, second: nx.MultiDiGraph, leaves: Port | None = None
) -> dict[str, str]:
    """Put a graph of elements behind another, in place: its nodes and links, and one link more."""
    faults: list[str] = []
    link = []
    for given, graph, out in ((leaves, first, True), (None, second, False)):
        try:
            link.append(given or _open_port(graph, out=out))
        except PathError as fault:
            faults += fault.faults
    names = _names(first, second)
    faults += [
        f"node '{name}' stands on both sides of >>; give one of them another name"
        for name in names.values()
        if name in first
    ]
    choices = [graph.graph.get("choices", {}) for graph in (first, second)]
    faults += [
        f"choice '{name}' stands on both sides of >>; use two names"
        for name in sorted(choices[0].keys() & choices[1].keys())
    ]
    if faults:
        raise PathError(*faults)
    _add(first, second, names)
    (start, out_port), (end, in_port) = link
    first.add_edge(start, names[end], key=(out_port, in_port), azimuth=None, tap=False)
    return names


def append(graph: nx.MultiDiGraph, port: str, others: nx.MultiDiGraph) -> str:
    """Put other elements behind a port, in place, and return what the last of them is called."""
    if others is graph:
        raise PathError(f"what is put behind '{port}' is the path that it stands in; use a copy")
    names = join(graph, others, find_port(graph, port, out=True))
    return list(names.values())[-1]


def as_chain(graph: nx.MultiDiGraph) -> list[str]:
    """Return the nodes of a path that `>>` alone can make, in order; none for any other."""
    starts = [name for name in graph if not graph.in_degree(name)]
    if len(starts) != 1 or len(graph) > _LONGEST or graph.number_of_edges() != len(graph) - 1:
        return []
    chain = starts
    for name in chain:
        links = list(graph.out_edges(name, keys=True, data="tap"))
        if len(links) > 1:
            return []
        for _, end, (leaves, enters), tap in links:
            natural = (
                natural_of(element_at(graph, name), out=True),
                natural_of(element_at(graph, end), out=False),
            )
            if tap or (leaves, enters) != natural:
                return []
            chain.append(end)
    return chain if len(chain) == len(graph) else []


def _open_port(graph: nx.MultiDiGraph, *, out: bool) -> Port:
    """Return the only natural port of a graph that no link uses."""
    elements = dict(graph.nodes(data="element"))
    if len(elements) == 1:
        ((name, element),) = elements.items()
        return name, natural_port(element, name, out=out)
    wiring = Wiring(graph)
    used = wiring.links_from if out else wiring.links_to
    unused = [
        (name, port)
        for name, element in elements.items()
        for port in (element.outputs if out else element.inputs)
        if (name, port) not in used
    ]
    found = [port for port in unused if natural_of(elements[port[0]], out=out) == port[1]]
    if len(found) == 1:
        return found[0]
    place, way = ("in front of", "out") if out else ("behind", "in")
    if not unused:
        raise PathError(f"the path {place} >> has no way {way} that is open; >> cannot go on there")
    what = f"{len(found)} natural ways {way} that are open" if found else f"no natural way {way}"
    several = ", ".join(f"'{name}.{port}'" for name, port in found or unused)
    raise PathError(f"the path {place} >> has {what}; connect one by its name: {several}")


def _names(first: nx.MultiDiGraph, second: nx.MultiDiGraph) -> dict[str, str]:
    """Return what the nodes of the second are called behind the first."""
    names: dict[str, str] = {}
    taken = {*first, *second}
    for name, element in second.nodes(data="element"):
        kind = name_by_kind(element)
        numbered = re.fullmatch(rf"{re.escape(kind)}(-\d+)?", name)
        names[name] = name
        if name in first and numbered:
            names[name] = next(new for n in count(2) if (new := f"{kind}-{n}") not in taken)
            taken.add(names[name])
    return names


def _add(first: nx.MultiDiGraph, second: nx.MultiDiGraph, names: dict[str, str]) -> None:
    for name, about in second.nodes.items():
        first.add_node(names[name], **about)
    for (start, end, key), about in second.edges.items():
        first.add_edge(names[start], names[end], key=key, **about)
    both = [graph.graph for graph in (first, second)]
    names_of_all = [name for one in both for name in one["declared"]]
    first.graph["declared"] = tuple(dict.fromkeys(names_of_all))
    moved = {
        name: choice.renamed(names) for name, choice in second.graph.get("choices", {}).items()
    }
    first.graph["choices"] = first.graph.get("choices", {}) | moved
    first.graph["loops"] = LOOPS[any(one["loops"] == LOOPS[1] for one in both)]
