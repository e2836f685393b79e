"""GraphFace: what a path is made of: nodes, links, parameters and frames; its plain graph."""

from __future__ import annotations

from contextlib import suppress
from threading import RLock
from typing import TYPE_CHECKING, Any, Never, Self
from weakref import ref

from optipath.composer.path_values import Values
from optipath.composer.plain_graph import plain
from optipath.composer.port_frames import PathFrames
from optipath.composer.wiring import Wiring
from optipath.elements.element import Chainable
from optipath.errors import PathError
from optipath.paths import editing
from optipath.paths.binding import with_arguments
from optipath.paths.drawing import with_texts
from optipath.values.parameters import check_named

if TYPE_CHECKING:
    from collections.abc import Iterator

    import networkx as nx
    from networkx.classes.reportviews import NodeView, OutMultiEdgeView

    from optipath.composer.wiring import Loops
    from optipath.elements.element import Element
    from optipath.paths.binding import PlaceChoice
    from optipath.values.cases import Case
    from optipath.values.parameters import Parameter


LENDING = RLock()
"""Held while a path grows out of another, and while what is left to that one is copied."""


class GraphFace(Chainable):
    """What can be asked of a path that is not composed."""

    description: str
    cases: dict[str, Case]
    _own: nx.MultiDiGraph[str] | None
    _is_read: bool
    _gathered: Values | None

    @property
    def graph(self) -> nx.MultiDiGraph[str]:
        """The networkx graph, to query and not to change.

        Nodes carry ``element`` and ``frames``; links are keyed by (out-port, in-port)
        and carry ``azimuth`` and ``tap``.
        """
        return self._graph.copy(as_view=True)

    @property
    def nodes(self) -> NodeView[str]:
        """The nodes as networkx has them, ``path.nodes["X1"]["element"]``; not to be changed."""
        return self.graph.nodes

    @property
    def edges(self) -> OutMultiEdgeView[str]:
        """The links as networkx has them, keyed as in `graph`; not to be changed."""
        return self.graph.edges

    def to_networkx(self, *, text: bool = False) -> nx.MultiDiGraph[str]:
        """Return a plain networkx graph of the path, which is a copy and anybody's to change.

        Parameters
        ----------
        text : bool, optional
            Whether values are texts, for files such as GraphML and JSON: ``element`` is the kind,
            and its fields follow by name. It is not read back; `to_toml` is.

        Returns
        -------
        networkx.MultiDiGraph
            With the attributes that `from_networkx` takes, where there is something to say.

        Examples
        --------
        >>> import networkx as nx
        >>> import optipath as op
        >>> graph = (op.Source() >> op.Polarizer("30 deg") >> op.Detector()).to_networkx()
        >>> print(*nx.topological_sort(graph))
        source polarizer detector
        >>> graph.edges["source", "polarizer", 0]
        {'out_port': 'out', 'in_port': 'in'}
        """
        own = {"cases": dict(self.cases), "choices": self.choices}
        graph = plain(self._graph, description=self.description, **own)
        return with_texts(graph) if text else graph

    def frames(self, /, *unnamed: Never, **parameters: Any) -> PathFrames:
        """Return the frame of each port, and the turn on each link.

        Parameters
        ----------
        *unnamed, **parameters : float or array_like
            By name, the values of open parameters that frames depend on; their defaults otherwise.

        Returns
        -------
        PathFrames
            By node and port, with the turns of links as ``turns`` and the names of relative ports
            as ``relative``. Ports with frames or points of their own, and ports next to these,
            have their frames in space. Others are relative: the unit frame where light begins,
            where it leaves an element on another way, and where it meets other light; from there
            on, turned by each link. The z of the unit frame is the direction of the light.

        Raises
        ------
        ParameterError
            With every value that is missing, unknown or unsuitable.

        Examples
        --------
        >>> import optipath as op
        >>> path = op.load_preset("npgr026", case=7)
        >>> frames = path.frames(rho="90 deg")
        >>> frames["X1"]["in"].x.round(12), frames["X1"]["reflected"] == op.Frame()
        (array([ 0., -1.,  0.]), True)
        >>> print(frames.turns["X2.reflected -> X1.in"].round(6), path["X1"].frames["in"].x)
        -1.570796 [ 0.82903757 -0.5591929   0.        ]
        """
        check_named("frames", unnamed, self.parameters)
        return PathFrames.of(wiring_at_defaults(self._values, parameters))

    @property
    def parameters(self) -> dict[str, Parameter]:
        """The parameters of all elements and links, by name, bound ones included."""
        return dict(self._values.parameters)

    @property
    def choices(self) -> dict[str, PlaceChoice]:
        """What is chosen by word before the path is composed, as `bind` takes it, by name."""
        return dict(self._graph.graph["choices"])

    @property
    def loops(self) -> Loops:
        """What becomes of light that goes round in a cycle: ``"refuse"`` or ``"sum"``."""
        return self._graph.graph["loops"]  # type: ignore[no-any-return]

    def element(self, name: str) -> Element:
        """Return the element of a node.

        Raises a `PathError` if there is no such node.
        """
        return editing.element_at(self._graph, name)

    def __contains__(self, name: object) -> bool:
        return name in self._graph

    def __iter__(self) -> Iterator[str]:
        """Go through the names of the nodes, in the order in which they were added."""
        return iter(self._graph)

    def __len__(self) -> int:
        with LENDING:
            return self._lent[1] if self._own is None else len(self._own)

    @property
    def _values(self) -> Values:
        """The values of the path, gathered once until it changes."""
        if self._gathered is None:
            self._gathered = Values(self._graph)
        return self._gathered

    @property
    def _graph(self) -> nx.MultiDiGraph[str]:
        """The graph; who has it may read it at any time, so that no path grows out of it then."""
        with LENDING:
            self._is_read = True
            if self._own is None:
                self._own = editing.beginning(*self._lent)
            return self._own

    @_graph.setter
    def _graph(self, graph: nx.MultiDiGraph[str]) -> None:
        self._own, self._is_read = graph, False
        # The only open way out where known, who has lent the graph, and what was lent of it.
        self._tip: tuple[str, str] | None = None
        self._lenders: list[ref[GraphFace]] = []
        self._lent: tuple[nx.MultiDiGraph[str], int, dict[str, Any]]

    def _lent_graph(self) -> tuple[Self, nx.MultiDiGraph[str]]:
        """Return a path and its graph, that of this one, to put more behind it.

        A chain takes no time then that grows with its length. Of the graph, this path keeps the
        beginning, and makes a copy of that should anybody ask.
        """
        if self._own is None or self._is_read or self._gathered is not None:
            graph = editing.beginning(*self._lent) if self._own is None else self._own.copy()
            return self._with(graph), graph
        graph = self._own
        path = self._with(graph)
        lenders = [lender for lender in self._lenders if lender() is not None]
        path._lenders = [*lenders, ref(self)]  # noqa: SLF001 - its own
        self._lent, self._own = (graph, len(graph), dict(graph.graph)), None
        self._lenders = []
        return path, graph

    def _changing(self) -> nx.MultiDiGraph[str]:
        """Return the graph for a change, which no other path sees."""
        with LENDING:
            lenders, self._lenders, self._tip = self._lenders, [], None
            for path in [lender() for lender in lenders]:
                if path is not None and path._own is None:  # noqa: SLF001 - its own
                    path._own = editing.beginning(*path._lent)  # noqa: SLF001
            return self._graph

    @property
    def _open_end(self) -> tuple[str, str] | None:
        """The only open way out, if there is one."""
        if self._tip is None:
            with suppress(PathError):
                self._tip = editing.open_port(self._graph, out=True)
        return self._tip

    def __getstate__(self) -> dict[str, Any]:
        state = {**vars(self), "_own": self._graph, "_gathered": None, "_lenders": []}
        state.pop("_lent", None)
        return state

    def _with(self, graph: nx.MultiDiGraph[str]) -> Self:
        """Return a path like it with another graph."""
        raise NotImplementedError


def wiring_at_defaults(known: Values, values: dict[str, Any]) -> Wiring:
    """Return the wiring of a path whose parameters have values, or else their defaults."""
    usual = {name: p.default for name, p in known.parameters.items() if not p.bound}
    values = {name: value for name, value in usual.items() if value is not None} | values
    return Wiring(with_arguments(known, values, for_good=True).graph)
