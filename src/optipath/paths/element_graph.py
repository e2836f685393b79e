"""ElementGraph: named elements, and the links between their ports."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import networkx as nx

from optipath.composer.path_values import parameters_of
from optipath.composer.validate import validate
from optipath.composer.wiring import LOOPS
from optipath.elements.element import Element
from optipath.errors import PathError, shown, unknown
from optipath.light.frames import Frame
from optipath.paths.port_names import check_port, element_at, find_port
from optipath.values.arrays.array_likes import entries_of
from optipath.values.arrays.read_only import read_only, same
from optipath.values.domains.domain import in_unit_of
from optipath.values.domains.quantities import ANGLE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.values.parameters import Parameter


@dataclass(frozen=True)
class Node:
    """A named element in its path; ``a >> b`` links the natural way out of a to b.

    Parameters
    ----------
    path : ElementGraph
        Where it stands.
    name : str
        What it is called there.
    """

    path: ElementGraph
    name: str

    def __rshift__(self, other: object) -> Node:
        if not isinstance(other, Node):
            return NotImplemented
        if other.path is not self.path:
            raise PathError(f"'{self.name}' and '{other.name}' stand in different paths; use one")
        start, end = self.path.element(self.name), self.path.element(other.name)
        if not start.natural:
            ports = ", ".join(f"'{self.name}.{port}'" for port in start.outputs) or "none"
            raise PathError(
                f"'{self.name}' has no one natural way out; connect one of its out-ports: {ports}"
            )
        entry = end.inputs[0] if len(end.inputs) == 1 else end.entry
        if not entry:
            ports = ", ".join(f"'{other.name}.{port}'" for port in end.inputs) or "none"
            raise PathError(
                f"'{other.name}' has no one way in; connect one of its in-ports: {ports}"
            )
        self.path.connect(f"{self.name}.{start.natural}", f"{other.name}.{entry}")
        return other

    def __repr__(self) -> str:
        return f"Node '{self.name}'"


class ElementGraph:
    """Elements by name, linked from out-port to in-port.

    Parameters
    ----------
    declared : sequence of str
        The order in which parameters are listed; others follow as they are met.
    loops : {"refuse", "sum"}
        Whether light may go round in a cycle.
    """

    def __init__(self, declared: Sequence[str], loops: str) -> None:
        if faults := unknown("loops", loops, LOOPS):
            raise PathError(*faults)
        names = entries_of("declared", "names of parameters", declared, PathError)
        if not all(isinstance(name, str) for name in names):
            raise PathError(f"declared must be a sequence of names, not {shown(declared)}")
        self._graph = nx.MultiDiGraph(declared=names, loops=loops)
        # What the graph has been composed to, until it changes.
        self._plans: dict[str, Any] = {}

    @property
    def graph(self) -> nx.MultiDiGraph:
        """The networkx graph, to query and not to change.

        Nodes carry ``element`` and ``frames``; links are keyed by (out-port, in-port)
        and carry ``azimuth``.
        """
        return self._graph.copy(as_view=True)

    @property
    def loops(self) -> str:
        """What becomes of light that goes round in a cycle: ``"refuse"`` or ``"sum"``."""
        return str(self._graph.graph["loops"])

    @property
    def parameters(self) -> dict[str, Parameter]:
        """The parameters of all elements and links, by name, bound ones included."""
        return parameters_of(self._graph)

    def add(self, name: str, element: Element, frames: Mapping[str, Frame] | None = None) -> Node:
        """Add a named element.

        Parameters
        ----------
        name : str
            Not empty, without a dot, and new to the path.
        element : Element
            The same element may stand in several places.
        frames : mapping of str to Frame, optional
            The world frame of each port, for an element that stands in space rather
            than relative to the one before it. One frame will do for an element that
            light goes straight through.

        Returns
        -------
        Node
            For ``>>``.

        Raises
        ------
        PathError
            If the name is taken or not allowed, the element is no Element, or a port
            does not exist.
        """
        if not isinstance(name, str) or not name or "." in name:
            raise PathError(f"node name {shown(name)} must be a text without a dot; choose another")
        if name in self._graph:
            raise PathError(f"node '{name}' is there already; choose another name")
        if not isinstance(element, Element):
            raise PathError(
                f"node '{name}' must be an element such as Polarizer(), not {shown(element)}"
            )
        frames = {} if frames is None else frames
        if not isinstance(frames, Mapping) or not all(
            isinstance(frame, Frame) for frame in frames.values()
        ):
            raise PathError(
                f"frames of '{name}' must be a Frame for each port, such as "
                f"{{'in': Frame()}}, not {shown(frames)}"
            )
        frames = dict(frames)
        for port in frames:
            check_port(element, name, port, (*element.inputs, *element.outputs))
        self._graph.add_node(name, element=element, frames=frames)
        self._plans.clear()
        return Node(self, name)

    def connect(self, leaves: str, enters: str, azimuth: Any = None) -> None:
        """Link an out-port to an in-port.

        Parameters
        ----------
        leaves, enters : str
            The ports, as ``"node.port"``.
        azimuth : float, array_like or Parameter, optional
            The turn of the in-port's frame against the out-port's about the direction
            of travel, in radians; by default the azimuth of the element.

        Raises
        ------
        PathError
            If a node or port does not exist, runs the other way, or the link is there
            already.
        """
        faults: list[str] = []
        ends = []
        for text, out in ((leaves, True), (enters, False)):
            try:
                ends.append(find_port(self._graph, text, out=out))
            except PathError as fault:
                faults += fault.faults
        if faults:
            raise PathError(*faults)
        (start, out_port), (end, in_port) = ends
        if self._graph.has_edge(start, end, key=(out_port, in_port)):
            raise PathError(f"link '{leaves} -> {enters}' is there already; remove the second one")
        self._graph.add_edge(
            start, end, key=(out_port, in_port), azimuth=in_unit_of(read_only(azimuth), ANGLE)
        )
        self._plans.clear()

    def element(self, name: str) -> Element:
        """Return the element of a node.

        Raises
        ------
        PathError
            If there is no such node.
        """
        return element_at(self._graph, name)

    def __getitem__(self, name: str) -> Node:
        self.element(name)
        return Node(self, name)

    def check(self) -> None:
        """Raise with every fault of the path, if it has any.

        Raises
        ------
        PathError
            A sentence for each fault.
        """
        validate(self._graph)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ElementGraph):
            return NotImplemented
        mine, theirs = _links(self._graph), _links(other._graph)
        return (
            self.loops == other.loops
            and dict(self._graph.nodes(data=True)) == dict(other._graph.nodes(data=True))
            and mine.keys() == theirs.keys()
            and all(same(turn, theirs[link]) for link, turn in mine.items())
        )

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        nodes, links = self._graph.number_of_nodes(), self._graph.number_of_edges()
        return f"<{type(self).__name__} with {nodes} nodes and {links} links>"


def _links(graph: nx.MultiDiGraph) -> dict[Any, Any]:
    return {
        (start, end, key): turn for start, end, key, turn in graph.edges(keys=True, data="azimuth")
    }
