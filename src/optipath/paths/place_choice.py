"""PlaceChoice: the places of which a node may take one, before the path is composed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from optipath.composer.path_values import Values
from optipath.composer.placement import goes_straight
from optipath.composer.wiring import Wiring
from optipath.errors import Fault, ParameterError, PathError, collecting, shown, unknown
from optipath.paths.binding import bind
from optipath.paths.editing import insert, remove
from optipath.paths.joining import element_at, find_port, natural_port, turn_to, turns_to

if TYPE_CHECKING:
    import networkx as nx


@dataclass(frozen=True)
class PlaceChoice:
    """Behind which port a node stands, by word."""

    node: str
    behind: Mapping[str, str] = field(default_factory=dict)
    help: str = ""

    def __post_init__(self) -> None:
        pairs = self.behind.items() if isinstance(self.behind, Mapping) else ()
        texts = [self.node, *(text for pair in pairs for text in pair)]
        named = pairs and all(isinstance(text, str) and text.strip() for text in texts)
        if not named or not isinstance(self.help, str):
            raise PathError(
                f"a choice of places is a node and, behind, a port for each word, not "
                f"{shown(self.node)} and {shown(self.behind)}"
            )
        object.__setattr__(self, "behind", dict(self.behind))

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
    if faults := unknown(f"{name}", word, choice.behind):
        raise PathError(*faults)
    element = element_at(graph, choice.node)
    if choice.place(graph) != word:
        try:
            turns = turns_to(graph, choice.node) if graph.in_degree(choice.node) else None
            remove(graph, choice.node)
            insert(graph, choice.node, element, choice.behind[word], None)
            if turns is not None:
                turn_to(graph, choice.node, turns)
        except PathError as fault:
            wrong = f"'{choice.node}' cannot be moved to {name}={shown(word)}"
            raise PathError(*(each.under(wrong) for each in fault.faults)) from None


def choice_faults(graph: nx.MultiDiGraph, choice: PlaceChoice) -> list[str]:
    """Return why the node of a choice cannot be put in its places, a sentence each."""
    node, faults = choice.node, list[str]()
    with collecting(faults, PathError):
        element = element_at(graph, node)
        enters, leaves = (natural_port(element, node, out=out) for out in (False, True))
        if not goes_straight(element, enters, leaves):
            faults.append(f"light does not go straight through '{node}', so it has no other place")
    # What has no place at all says nothing of links.
    links = None if faults else Wiring(graph).links_from
    for word, port in choice.behind.items():
        at = f"place '{word}'"
        with collecting(faults, PathError, at):
            start, way = find_port(graph, port, out=True)
            if links is not None and (start == node or len(links.get((start, way), [])) != 1):
                no_place = f"'{start}.{way}' feeds no one link that '{node}' could be put into"
                faults.append(Fault(no_place, place=at))
    return faults


def with_arguments(known: Values, values: dict[str, Any], *, for_good: bool) -> Values:
    """Return the values of a path with nodes in the places chosen, and other values given."""
    faults: list[str] = []
    if places := [name for name in known.graph.graph["choices"] if name in values]:
        known = Values(known.graph.copy())
        for name in places:
            with collecting(faults, PathError):
                put_in_place(known.graph, name, values.pop(name))
    with collecting(faults, ParameterError):
        known = bind(known, values, for_good=for_good)
    if faults:
        raise ParameterError(*faults)
    return known
