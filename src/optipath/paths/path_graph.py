"""PathGraph: named elements and links, the face that users touch."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Literal, overload

import networkx as nx

from optipath.composer import KEPT, LOOPS, Composer, parameters_of, validate
from optipath.elements import Detector, Element
from optipath.errors import ParameterError, PathError, shown, unknown
from optipath.light.frames import Frame
from optipath.paths.binding import bind
from optipath.paths.port_names import check_port, element_at, find_port
from optipath.values.arrays.array_likes import entries_of
from optipath.values.arrays.read_only import read_only, same
from optipath.values.cases import Case
from optipath.values.domains import ANGLE, in_unit_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.light.light import Light
    from optipath.light.mueller import Mueller
    from optipath.plan.light_paths import LightPath
    from optipath.plan.plan import Plan
    from optipath.values.parameters import Parameter


@dataclass(frozen=True)
class Node:
    """A named element in its path; ``a >> b`` links the natural way out of a to b."""

    path: PathGraph
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


class PathGraph:
    """An optical path: named elements, linked from out-port to in-port.

    Parameters
    ----------
    description : str, optional
        One line about the path.
    cases : mapping of str to Case, optional
        Named sets of parameter values.
    declared : sequence of str, optional
        The order in which parameters are listed; others follow as they are met.
    loops : {"refuse", "sum"}, optional
        Whether light may go round in a cycle; ``"sum"`` adds up the intensities of all rounds.

    Examples
    --------
    >>> import optipath as op
    >>> path = op.PathGraph()
    >>> lamp = path.add("lamp", op.Source(100.0))
    >>> glass = path.add("glass", op.Interface(index=1.5, incidence=op.Parameter("theta")))
    >>> eye = path.add("eye", op.Detector())
    >>> lamp >> glass >> eye
    Node 'eye'
    >>> print(path.trace(theta=0.0).intensity.round(12))
    4.0
    """

    def __init__(
        self,
        description: str = "",
        cases: Mapping[str, Case] | None = None,
        declared: Sequence[str] = (),
        loops: str = "refuse",
    ) -> None:
        if not isinstance(description, str):
            raise PathError(f"the description of a path must be a text, not {shown(description)}")
        cases = {} if cases is None else cases
        if not isinstance(cases, Mapping) or not all(isinstance(c, Case) for c in cases.values()):
            raise PathError(f"cases of a path must be a Case for each name, not {shown(cases)}")
        self.description = description
        self.cases = dict(cases)
        if faults := unknown("loops", loops, LOOPS):
            raise PathError(*faults)
        names = entries_of("declared", "names of parameters", declared, PathError)
        if not all(isinstance(name, str) for name in names):
            raise PathError(f"declared must be a sequence of names, not {shown(declared)}")
        self._graph = nx.MultiDiGraph(declared=names, loops=loops)
        self._plan: Plan | None = None
        self._plan_of_all: Plan | None = None

    @property
    def graph(self) -> nx.MultiDiGraph:
        """The networkx graph, to query and not to change.

        Nodes carry ``element`` and ``frames``; links are keyed by (out-port, in-port)
        and carry ``azimuth``.
        """
        return self._graph.copy(as_view=True)

    def __copy__(self) -> PathGraph:
        path = PathGraph(self.description, self.cases)
        path._graph = self._graph.copy()
        return path

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
        self._plan = self._plan_of_all = None
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
        self._plan = self._plan_of_all = None

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

    def compose(self) -> Plan:
        """Return the plan of a default `Composer`, composed once and kept."""
        if self._plan is None:
            self._plan = Composer().compose(self._graph)
        return self._plan

    @overload
    def trace(self, /, keep: Literal["ends"] = ..., **parameters: Any) -> Light: ...
    @overload
    def trace(self, /, keep: Literal["all"], **parameters: Any) -> dict[str, Light]: ...
    def trace(self, /, keep: str = "ends", **parameters: Any) -> Light | dict[str, Light]:
        """Return the light at the only detector; see `Plan.run`.

        Parameters
        ----------
        keep : {"ends", "all"}, optional
            With ``"all"``, the light at every end, on every link, such as
            ``"lamp.out -> eye.in"``, and at every outlet, such as ``"glass.transmitted"``, by
            name, each in the frame in which it leaves its element. A path with an open
            parameter called ``keep`` takes it for that; compose it by ``Composer(keep="all")``.
        **parameters : float or array_like
            The values of open parameters. Those that JAX traces cannot be refused: light is NaN
            where they are outside their domain.

        Raises
        ------
        ParameterError
            With every unknown, missing or unsuitable parameter.
        """
        plan = self.compose()
        if "keep" in plan.inputs.open and not _is(keep, KEPT[0]):
            return plan.run(keep=keep, **parameters)
        if _is(keep, KEPT[0]):
            return plan.run(**parameters)
        if faults := unknown("keep", keep, KEPT):
            raise ParameterError(*faults)
        if self._plan_of_all is None:
            self._plan_of_all = Composer(keep="all").compose(self._graph)
        return self._plan_of_all.run_all(**parameters)

    def paths(
        self, /, limit: int | None = None, bounces: int | None = None, **parameters: Any
    ) -> list[LightPath]:
        """Return the ways of light one by one, the brightest first; see `Plan.paths`."""
        return self.compose().paths(limit, bounces, **parameters)

    def trace_all(self, /, **parameters: Any) -> dict[str, Light]:
        """Return the light at every detector and dump by name; see `Plan.run_all`."""
        return self.compose().run_all(**parameters)

    def mueller(
        self, source: str | None = None, detector: str | None = None, /, **parameters: Any
    ) -> Mueller:
        """Return the Mueller matrix from a source to a detector; see `Plan.mueller`."""
        return self.compose().mueller(source, detector, **parameters)

    def bind(self, /, **values: Any) -> PathGraph:
        """Return a copy of the path in which parameters have these values for good.

        Raises
        ------
        ParameterError
            With every unknown parameter and every value that is not allowed.
        """
        path = PathGraph(self.description, self.cases)
        path._graph = bind(self._graph, values)
        return path

    def reading(self, reads: str) -> PathGraph:
        """Return a copy of the path whose detectors and dumps all read this, and no more.

        Parameters
        ----------
        reads : {"stokes", "linear", "intensity"}
            As `Detector` takes it.

        Raises
        ------
        PathError
            If there is no such reading.

        Examples
        --------
        >>> import optipath as op
        >>> op.load_preset("malus").reading("intensity").trace().stokes
        array([0.375,   nan,   nan,   nan])
        """
        if faults := Detector(reads).faults("path.reading(...)"):
            raise PathError(*faults)
        path = PathGraph(self.description, self.cases)
        path._graph = self._graph.copy()
        for name, element in self._graph.nodes(data="element"):
            if hasattr(element, "reads"):
                path._graph.nodes[name]["element"] = replace(element, reads=reads)
        return path

    def to_toml(self) -> str:
        """Return the path as the text of a preset file; loading it gives the path back.

        Raises
        ------
        PathError
            If an element has no kind, or a value has no form in TOML.
        """
        from optipath.paths.format import to_toml  # noqa: PLC0415 - not for every import

        return to_toml(self._graph, self.description, self.cases)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, PathGraph):
            return NotImplemented
        mine, theirs = self._graph, other._graph
        return (
            self.description == other.description
            and self.loops == other.loops
            and self.cases == other.cases
            and dict(mine.nodes(data=True)) == dict(theirs.nodes(data=True))
            and _links(mine).keys() == _links(theirs).keys()
            and all(same(turn, _links(theirs)[link]) for link, turn in _links(mine).items())
        )

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        nodes, links = self._graph.number_of_nodes(), self._graph.number_of_edges()
        return f"<PathGraph with {nodes} nodes and {links} links>"


def _is(given: Any, word: str) -> bool:
    return isinstance(given, str) and given == word


def _links(graph: nx.MultiDiGraph) -> dict[Any, Any]:
    return {
        (start, end, key): turn for start, end, key, turn in graph.edges(keys=True, data="azimuth")
    }
