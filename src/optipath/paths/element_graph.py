"""ElementGraph: named elements, and the links between their ports."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import networkx as nx

from optipath.composer.path_values import parameters_of
from optipath.composer.validate import validate
from optipath.composer.wiring import LOOPS
from optipath.elements.chaining import Chainable, begun
from optipath.errors import PathError, shown, unknown
from optipath.paths.editing import add, connect, disconnect, edit
from optipath.paths.joining import append, as_chain
from optipath.paths.port_names import check_port, element_at
from optipath.paths.splicing import insert, remove, replace
from optipath.values.arrays.array_likes import entries_of
from optipath.values.arrays.read_only import same

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from optipath.elements.element import Element
    from optipath.light.frames import Frame
    from optipath.values.parameters import Parameter


@dataclass(frozen=True)
class Node(Chainable):
    """A named element in its path; ``a >> b`` links the natural way out of a to b.

    What stands in no path yet, an element or a chain of them, is added to the path of a first.
    """

    path: ElementGraph
    name: str
    port: str = ""

    def __rshift__(self, behind: Any) -> Node:
        if not isinstance(behind, Node):
            last = self.path._append(self._text, begun(behind))
            return Node(self.path, last)
        if behind.path is not self.path:
            raise PathError(f"'{self.name}' and '{behind.name}' stand in different paths; use one")
        self.path.connect(self._text, behind._text)
        return Node(behind.path, behind.name)

    @property
    def _text(self) -> str:
        return f"{self.name}.{self.port}" if self.port else self.name

    def __repr__(self) -> str:
        return f"Node '{self._text}'"


class ElementGraph(Chainable):
    """Elements by name, linked from out-port to in-port."""

    def __init__(self, declared: Sequence[str], loops: str) -> None:
        if faults := unknown("loops", loops, LOOPS):
            raise PathError(*faults)
        names = entries_of("declared", "names of parameters", declared, PathError)
        if not all(isinstance(name, str) for name in names):
            raise PathError(f"declared must be a sequence of names, not {shown(declared)}")
        self._graph = nx.MultiDiGraph(declared=names, loops=loops)
        # What the graph has been composed to, until it changes.
        self._plans: dict[Any, Any] = {}

    @property
    def graph(self) -> nx.MultiDiGraph:
        """The networkx graph, to query and not to change.

        Nodes carry ``element`` and ``frames``; links are keyed by (out-port, in-port)
        and carry ``azimuth`` and ``tap``.
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

    def add(
        self,
        name: str,
        element: Element | None = None,
        frames: Mapping[str, Frame] | None = None,
    ) -> Node:
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
        add(self._graph, name, element, frames)
        self._plans.clear()
        return Node(self, name)

    def connect(self, leaves: str, enters: str, azimuth: Any = None, *, tap: bool = False) -> None:
        """Link an out-port to an in-port.

        Parameters
        ----------
        leaves, enters : str
            The ports, as ``"node.port"``, or ``"node"`` for its natural one, as ``>>`` has it.
        azimuth : float, array_like or Parameter, optional
            The turn of the in-port's frame against the out-port's about the direction
            of travel, in radians; by default the azimuth of the element.
        tap : bool, optional
            Whether the link reads all the light of the out-port and takes nothing of it. An
            out-port feeds one link, and any number of taps, each of which leads to ends of
            its own.

        Raises
        ------
        PathError
            If a node or port does not exist, runs the other way, or the link is there
            already.
        """
        connect(self._graph, leaves, enters, azimuth, tap)
        self._plans.clear()

    def disconnect(self, leaves: str, enters: str | None = None) -> None:
        """Take a link out.

        Parameters
        ----------
        leaves, enters : str
            The ports that it links, as `connect` takes them; the first will do where it feeds
            one link, taps included.

        Raises
        ------
        PathError
            If there is no such link, or there are several.
        """
        disconnect(self._graph, leaves, enters)
        self._plans.clear()

    def insert(
        self, name: str, element: Element, behind: str | None = None, *, before: str | None = None
    ) -> Node:
        """Put an element into a link, which is named by a port or by both.

        It stands in the frame of the port that light comes from, turned by its own azimuth. What
        stands behind is not turned by an element that light goes straight through; where it has
        an azimuth of its own, its link takes that over. Taps of the port stay, and read the light
        in front of the element.

        Parameters
        ----------
        name, element
            As `add` takes them. The element has one natural way through.
        behind, before : str, optional
            The port that the link leaves, or leads to, as ``"node.port"``, or ``"node"`` for its
            natural one.

        Returns
        -------
        Node
            For ``>>``.

        Raises
        ------
        PathError
            If the port has no one link, the element has no natural way through, or frames
            would not fit; the path is as it was then.

        Examples
        --------
        >>> import optipath as op
        >>> path = op.load_preset("npgr026", case=7)
        >>> path.insert("P2", op.Polarizer(0.3), behind="X1.reflected")
        Node 'P2'
        >>> path
        <PathGraph: L >> P >> X2 >> X1 >> P2 >> E>
        """
        self._edit(insert, name, element, behind, before)
        return Node(self, name)

    def remove(self, name: str) -> None:
        """Take a node out, and close the gap.

        What stood before it is linked with what stood behind it, where one link came to it,
        one left it, and light goes straight through. A node that no link comes to, or none
        leaves, goes with its links.

        Raises
        ------
        PathError
            If there is no such node, or the links in the way do not tell how to close the gap;
            the path is as it was then.
        """
        self._edit(remove, name)

    def replace(self, name: str, element: Element) -> Node:
        """Put another element in the place of one; its links and world frames stay.

        Its own azimuth turns it, as that of the old one did. Where light goes straight through
        both, nothing behind it is turned, as by `insert` and `remove`.

        Parameters
        ----------
        name : str
            The node.
        element : Element
            With all ports that links and frames of the node use.

        Returns
        -------
        Node
            For ``>>``.

        Raises
        ------
        PathError
            If a port is missing, frames would not fit, its link says another azimuth, or it lacks
            that of one that light does not go straight through; the path is as it was then.
        """
        self._edit(replace, name, element)
        return Node(self, name)

    def _edit(self, change: Callable[..., None], *arguments: Any) -> None:
        edit(self._graph, lambda graph: change(graph, *arguments))
        self._plans.clear()

    def _append(self, port: str, others: ElementGraph) -> str:
        """Add other elements behind a port, and return the name of the last of them."""
        last = append(self._graph, port, others._graph)
        self._plans.clear()
        return last

    def element(self, name: str) -> Element:
        """Return the element of a node.

        Raises
        ------
        PathError
            If there is no such node.
        """
        return element_at(self._graph, name)

    def __getitem__(self, name: str) -> Node:
        name, dot, port = name.partition(".") if isinstance(name, str) else (name, "", "")
        element = self.element(name)
        if dot:
            check_port(element, name, port, (*element.inputs, *element.outputs))
        return Node(self, name, port)

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
        mine, theirs = self._graph, other._graph
        return (
            self.loops == other.loops
            and same(dict(mine.nodes.items()), dict(theirs.nodes.items()))
            and same(dict(mine.edges.items()), dict(theirs.edges.items()))
        )

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        if chain := as_chain(self._graph):
            return f"<{type(self).__name__}: {' >> '.join(chain)}>"
        nodes, links = self._graph.number_of_nodes(), self._graph.number_of_edges()
        return f"<{type(self).__name__} with {nodes} nodes and {links} links>"
