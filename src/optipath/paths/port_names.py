"""The names of ports, and what to say where one is wrong."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import PathError, closest, did_you_mean, shown, there_are

if TYPE_CHECKING:
    from collections.abc import Sequence

    import networkx as nx

    from optipath.elements.element import Element


_REFRACTED = "refracted"
"""What is near ``reflected`` by its letters, and means ``transmitted``."""


def check_port(element: Element, owner: str, port: str, ports: Sequence[str]) -> None:
    """Raise unless a port of a node is one of those given.

    >>> from optipath.elements.splitters import BeamSplitter
    >>> try:
    ...     check_port(BeamSplitter(), "bs", "transmited", BeamSplitter.outputs)
    ... except PathError as error:
    ...     print(error)
    port 'bs.transmited' does not exist; did you mean 'bs.transmitted'?
    """
    if port in ports:
        return
    if port in (*element.inputs, *element.outputs):
        way = "in" if port in element.inputs else "out"
        raise PathError(
            f"port '{owner}.{port}' lets light {way}; a link goes from an out-port to an in-port"
        )
    known = [f"{owner}.{name}" for name in ports]
    refracted = closest(port, [_REFRACTED, *ports]) == _REFRACTED
    cure = there_are(known) if refracted else did_you_mean(f"{owner}.{port}", known)
    raise PathError(f"port '{owner}.{port}' does not exist{cure}")


def natural_of(element: Element, *, out: bool) -> str:
    """Return the port by which ``>>`` leaves an element, or enters it; empty for none."""
    ports, said, unsaid = (
        (element.outputs, element.natural, "out") if out else (element.inputs, element.entry, "")
    )
    if said in ports:
        return said
    return ports[0] if len(ports) == 1 and said == unsaid else ""


def natural_port(element: Element, owner: str, *, out: bool) -> str:
    """Return the natural port of a node.

    >>> from optipath.elements.splitters import BeamSplitter
    >>> natural_port(BeamSplitter(), "bs", out=False)
    'in'
    >>> try:
    ...     natural_port(BeamSplitter(), "bs", out=True)
    ... except PathError as error:
    ...     print(error)
    'bs' has no one natural way out; connect one of its out-ports: 'bs.reflected', 'bs.transmitted'
    """
    result = natural_of(element, out=out)
    if result:
        return result
    way, ports = ("out", element.outputs) if out else ("in", element.inputs)
    if not ports:
        reason = "ends there; let it stand last" if out else "begins there; let it stand first"
        raise PathError(f"'{owner}' has no way {way}, since light {reason}")
    names = ", ".join(f"'{owner}.{port}'" for port in ports)
    raise PathError(
        f"'{owner}' has no one natural way {way}; connect one of its {way}-ports: {names}"
    )


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
