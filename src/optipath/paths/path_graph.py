"""PathGraph: a graph of elements that can be asked for its light, the face that users touch."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, Never, Self, overload

from optipath.composer.composer import Composer, checked, put_off
from optipath.composer.path_values import Values
from optipath.composer.plain_graph import completed, plain, whole
from optipath.composer.port_frames import PathFrames
from optipath.composer.wiring import KEEPABLE
from optipath.elements.element import Chainable, Element, NamedElement, begun
from optipath.elements.ends import Detector
from optipath.errors import ComposerError, ParameterError, PathError
from optipath.extras import needing
from optipath.faults import shown, unknown
from optipath.materials.named_materials import is_curve
from optipath.paths import editing
from optipath.paths.binding import (
    PlaceChoice,
    cases_left,
    check_choices,
    wiring_at_defaults,
    with_arguments,
)
from optipath.paths.drawing import with_texts
from optipath.paths.element_graph import ElementGraph
from optipath.paths.growing_graph import GrowingGraph
from optipath.paths.node import Node
from optipath.paths.reversed import reversed_cases, reversed_graph
from optipath.values.arrays import same
from optipath.values.parameters import check_named

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence
    from os import PathLike

    import networkx as nx
    import xarray as xr
    from networkx.classes.reportviews import NodeView, OutMultiEdgeView

    from optipath.composer.wiring import Loops
    from optipath.elements.ends import Source
    from optipath.light.frame import Frame
    from optipath.light.light import Light
    from optipath.light.mueller import Mueller
    from optipath.materials.quantities import Reading
    from optipath.plan.light_paths import LightPath
    from optipath.plan.plan import Plan
    from optipath.sweeps.propagation import Propagation
    from optipath.sweeps.uncertainty import UncertaintyMethod
    from optipath.values.cases import Case
    from optipath.values.parameters import Parameter


class PathGraph(Chainable):
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

    The same in one line, with names by kind, or those that elements are given:

    >>> op.Source(100.0) >> op.Interface(1.5, 0.0).named("glass") >> op.Detector()
    <PathGraph: source >> glass >> detector>
    """

    def __init__(
        self,
        description: str = "",
        cases: Mapping[str, Case] | None = None,
        declared: Sequence[str] = (),
        loops: Loops = "refuse",
    ) -> None:
        faults: list[str] = []
        given = {"description": description, "cases": cases, "declared": declared, "loops": loops}
        about = whole(given, faults)
        PathError.raise_for(faults)
        self.description: str = about.pop("description")
        self.cases: dict[str, Case] = dict(about.pop("cases"))
        self._growing = GrowingGraph(ElementGraph(**about))
        # What the graph has been composed to, until it changes.
        self._plans: dict[str | Composer, Plan] = {}

    @classmethod
    def from_networkx(cls, graph: nx.DiGraph[Any]) -> Self:
        """Return the path of a networkx graph of elements, which is copied.

        Parameters
        ----------
        graph : networkx.MultiDiGraph or networkx.DiGraph
            Nodes, named by texts without a dot, have an ``element``, and perhaps ``frames``. Edges
            have an ``out_port`` and an ``in_port``, the natural ones by default as ``>>`` takes
            them, and perhaps ``azimuth``, ``length`` and ``tap``; the graph perhaps ``loops``,
            ``description``, ``cases``, ``declared`` and ``choices``. Other attributes are kept.

        Raises
        ------
        PathError
            With everything that is missing, misspelt or wrong, by node or edge and attribute.

        Examples
        --------
        >>> import networkx as nx
        >>> import optipath as op
        >>> graph = nx.DiGraph([("lamp", "filter"), ("filter", "eye")])
        >>> elements = {"lamp": op.Source(2.0), "filter": op.Polarizer(), "eye": op.Detector()}
        >>> nx.set_node_attributes(graph, elements, "element")
        >>> op.PathGraph.from_networkx(graph)
        <PathGraph: lamp >> filter >> eye>
        """
        with put_off():
            own = completed(graph, ElementGraph)
        path = cls(own.graph.pop("description"), own.graph.pop("cases"))
        path._growing, own.graph["choices"] = GrowingGraph(own), dict(own.graph["choices"])
        check_choices(own)
        return path

    @property
    def graph(self) -> nx.MultiDiGraph[str]:
        """The networkx graph, to query; `to_networkx` gives one to change.

        Nodes carry ``element`` and ``frames``; links are keyed by (out-port, in-port)
        and carry ``azimuth``, ``tap`` and perhaps ``length``.
        """
        return self._graph.view()

    @property
    def nodes(self) -> NodeView[str]:
        """The nodes as networkx has them, ``path.nodes["X1"]["element"]``; to be read."""
        return self._graph.nodes

    @property
    def edges(self) -> OutMultiEdgeView[str]:
        """The links as networkx has them, keyed as in `graph`; to be read."""
        return self._graph.edges

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
            as ``relative``. Ports with frames or points of their own, and those next to them, have
            frames in space. Others are relative: the unit frame, whose z is the direction of the
            light, where light begins, is deflected or meets other light; then, turned by each link.

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
        return len(self._growing)

    def __getitem__(self, name: str) -> Node:
        name, dot, port = name.partition(".") if isinstance(name, str) else (name, "", "")
        element = self.element(name)
        if dot:
            editing.check_port(element, name, port, (*element.inputs, *element.outputs))
        return Node(self, name, port)

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
            It may stand in several places.
        frames : mapping of str to Frame, optional
            The world frame of each port, for an element that stands in space rather than relative
            to the one before it; one will do where light goes straight through.

        Returns
        -------
        Node

        Raises
        ------
        PathError
            If the name is taken or not allowed, or a port does not exist.
        """
        editing.add(self._changing(), name, element, frames)
        return Node(self, name)

    def connect(
        self,
        leaves: str,
        enters: str,
        azimuth: Any = None,
        *,
        tap: bool = False,
        length: float | str | None = None,
    ) -> None:
        """Link an out-port to an in-port.

        Parameters
        ----------
        leaves, enters : str
            The ports, as ``"node.port"``, or ``"node"`` for its natural one, as ``>>`` has it.
        azimuth : float, array_like or Parameter, optional
            The turn of the in-port's frame against the out-port's about the direction of travel,
            in radians; by default the azimuth of the element.
        tap : bool, optional
            Whether the link reads all the light of the out-port and takes nothing of it. An
            out-port feeds one link, and any number of taps that lead to ends of their own.
        length : float or str, optional
            How long the link is, in meters, which changes no light yet.

        Raises
        ------
        PathError
            If a port does not exist or runs the other way, or the link is there already.
        """
        editing.connect(self._changing(), leaves, enters, azimuth, tap, length)

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
        editing.disconnect(self._changing(), leaves, enters)

    def insert(
        self,
        name: str,
        element: Element,
        behind: str | None = None,
        *,
        before: str | None = None,
        frames: Mapping[str, Frame] | None = None,
    ) -> Node:
        """Put an element into a link, which is named by a port or by both.

        It stands in the frame of the port that light comes from, turned by its own azimuth. An
        element that light goes straight through does not turn what stands behind. Taps of the port
        read the light in front of the element.

        Parameters
        ----------
        name, element
            As `add` takes them. The element has one natural way through.
        behind, before : str, optional
            The port that the link leaves, or leads to, as `connect` takes them.
        frames : mapping of str to Frame, optional
            As `add` takes them; by default that of the port that light comes from, if it has one.

        Returns
        -------
        Node

        Raises
        ------
        PathError
            If there is no one link or natural way, or frames would not fit; the path stays then.

        Examples
        --------
        >>> import optipath as op
        >>> path = op.load_preset("npgr026", case=7)
        >>> path.insert("P2", op.Polarizer(0.3), behind="X1.reflected")
        Node 'P2'
        >>> path
        <PathGraph: L >> P >> X2 >> X1 >> P2 >> E>
        """
        editing.edit(self._changing(), editing.insert, name, element, behind, before, frames)
        return Node(self, name)

    def remove(self, name: str) -> None:
        """Take a node out, close the gap, and offer no places for it.

        What stood before it is linked with what stood behind it, where one link came to it, one
        left it, and light goes straight through. A node that no link comes to, or none leaves,
        goes with its links.

        Raises
        ------
        PathError
            If there is no such node, or the links in the way do not tell how to close the gap;
            the path is as it was then.
        """
        graph = self._changing()
        editing.edit(graph, editing.remove, name)
        choices = self.choices.items()
        graph.graph["choices"] = {word: one for word, one in choices if one.node != name}

    def replace(self, name: str, element: Element) -> Node:
        """Put another element in the place of one; its links and world frames stay.

        Its own azimuth turns it, as that of the old one did. Where light goes straight through
        both, nothing behind it is turned, as by `insert` and `remove`.

        Parameters
        ----------
        name, element
            The node, and an element with all ports that links and frames of it use.

        Returns
        -------
        Node

        Raises
        ------
        PathError
            If a port is missing, frames would not fit, its link says another azimuth, or it lacks
            that of one that light does not go straight through; the path is as it was then.
        """
        editing.edit(self._changing(), editing.replace, name, element)
        return Node(self, name)

    def offer(self, name: str, node: str, behind: Mapping[str, str], help: str = "") -> None:  # noqa: A002 - as parameters have it
        """Offer a choice of places for a node, which `bind` and `load_preset` take by name.

        Parameters
        ----------
        name : str
            That of the choice, which no parameter has.
        node : str
            What is moved, if anything is chosen; it has one natural way through.
        behind : mapping of str to str
            The port behind which it is put, for each word.
        help : str, optional
            What is chosen.

        Raises
        ------
        PathError
            If the node cannot be put there, or the name is taken.

        Examples
        --------
        >>> import optipath as op
        >>> path = op.Source() >> op.Polarizer() >> op.Mirror() >> op.Detector()
        >>> path.offer("place", "polarizer", {"light": "source.out", "eye": "mirror.reflected"})
        >>> path.bind(place="eye")
        <PathGraph: source >> mirror >> polarizer >> detector>
        """
        choices = {name: PlaceChoice.named(name, self._values, node, behind, help)}
        self._growing.change().graph["choices"] = self.choices | choices
        self._plans.clear()

    def __rshift__(self, behind: Element | NamedElement | PathGraph) -> Self:
        """Return the path in which light goes on from here to what stands behind.

        From the only open natural way out to the only natural way in; neither side changes.
        """
        others = begun(behind)
        if twice := sorted(self.cases.keys() & others.cases.keys()):
            raise PathError(f"case '{twice[0]}' stands on both sides of >>; take one of them out")
        growing, names = self._growing.followed_by(others._growing)
        path = self._with(growing)
        path.description = self.description or others.description
        for name, case in others.cases.items():
            published = {names.get(end, end): light for end, light in case.published.items()}
            path.cases[name] = replace(case, published=published)
        return path

    def check(self) -> None:
        """Raise with every fault of the path, if it has any.

        Raises a `PathError` with a sentence for each fault.
        """
        checked(self._values)

    def bind(self, /, *unnamed: Never, **values: Any) -> Self:
        """Return a copy of the path in which parameters have these values for good.

        Parameters
        ----------
        *unnamed, **values : float, str, array_like, Material or curve
            By name, in radians and metres, or texts with units. A `Material` for the n of an index
            gives its k as well. What depends on the wavelength, such as a `Spectrum`, makes that a
            parameter of the path.

        Returns
        -------
        PathGraph

        Raises
        ------
        ParameterError
            With every unknown parameter and every value that is not allowed.
        """
        if unnamed:
            opened = [name for name, p in self.parameters.items() if not p.bound]
            check_named("bind", unnamed, opened)
        path = self._with(with_arguments(self._values, values, for_good=True))
        if self.parameters.keys() - path.parameters.keys():
            path.cases = cases_left(self.cases, {*path.parameters, *self.choices})
        return path

    def with_defaults(self, /, **values: Any) -> Self:
        """Return a copy of the path in which parameters have these values by default.

        They stay open: whoever traces the path may give others. None takes a default away.

        Raises a `ParameterError` as `bind` does.

        Examples
        --------
        >>> import optipath as op
        >>> crossed = op.load_preset("malus").with_defaults(angle="90 deg")
        >>> crossed.trace().intensity, crossed.trace(angle=0.0).intensity
        (array(0.), array(0.5))
        """
        return self._with(with_arguments(self._values, values, for_good=False))

    def reading(self, reads: Reading) -> Self:
        """Return a copy of the path whose detectors and dumps read this, as `Detector` takes it.

        Examples
        --------
        >>> import optipath as op
        >>> op.load_preset("malus").reading("intensity").trace().stokes
        array([0.375,   nan,   nan,   nan])
        """
        PathError.raise_for(Detector(reads).faults("path.reading(...)"))
        return self._with(editing.reading(self._graph, reads))

    def reversed(self, source: Source | Mapping[str, Source] | None = None) -> Self:
        """Return the path in which light goes the other way, from the detector to the source.

        Each element is met from the other side, in mirrored frames (x, -y, -z); sources are
        detectors there, and detectors sources. Each link turns as before. Parameters, defaults and
        cases stay, but for those of sources, and what is published. ``path.reversed().mueller()``
        is ``path.mueller().reversed()``, unless there is a magnetic field (Sekera, J. Opt. Soc. Am.
        56, 1732 (1966)).

        Parameters
        ----------
        source : Source or mapping of str to Source, optional
            The light that begins at the detector, or at several by name; by default unpolarised
            light of intensity 1, and none at a dump.

        Raises
        ------
        PathError
            With all that has no way back: taps, lights that add up, elements that do not say.

        Examples
        --------
        >>> import optipath as op
        >>> path = op.Source() >> op.Polarizer(0.1) >> op.Rotator(0.5) >> op.Detector()
        >>> path.reversed()
        <PathGraph: detector >> rotator >> polarizer >> source>
        >>> print(path.reversed(op.Source(stokes=[1, 1, 0, 0])).trace().intensity.round(6))
        0.681179
        """
        path = self._with(reversed_graph(self._graph, source))
        path.cases = reversed_cases(self.cases, self.choices, {*path.parameters, *path.choices})
        return path

    def to_toml(self) -> str:
        """Return the path as the text of a preset file; loading it gives the path back.

        Raises a `PathError` if an element has no kind, or a value has no form in TOML.
        """
        from optipath.paths.files.writer import to_toml  # noqa: PLC0415 - not for every import

        return to_toml(self._graph, self.description, self.cases)

    @overload
    def trace(self, /, *, keep: Literal["ends"] = ..., **parameters: Any) -> Light: ...
    @overload
    def trace(self, /, *, keep: Literal["all"], **parameters: Any) -> dict[str, Light]: ...
    def trace(
        self, /, *unnamed: Never, keep: str = "ends", **parameters: Any
    ) -> Light | dict[str, Light]:
        """Return the light at the only detector; see `Plan.run`.

        Parameters
        ----------
        keep : {"ends", "all"}, optional
            With ``"all"``, the light at every end, link and outlet by name, as `Composer` has it.
            A path with an open parameter called ``keep`` takes it for that.
        *unnamed, **parameters : float or array_like
            By name, the values of open parameters; of those that JAX traces, light is NaN where
            they are outside their domain.

        Returns
        -------
        Light or dict of str to Light

        Raises
        ------
        ParameterError
            With every unknown, missing or unsuitable parameter, or if there are several detectors.
        """
        plan = self.compose()
        check_named("trace", unnamed, plan.inputs.open)
        ends = isinstance(keep, str) and keep == KEEPABLE[0]
        if not ends and "keep" not in plan.inputs.open:
            if path := self._with_curves(parameters):
                return path.trace(keep="all", **parameters)
            ParameterError.raise_for(unknown("keep", keep, KEEPABLE))
            return self.plan_by(Composer(keep="all")).run_all(**parameters)
        if not ends:
            parameters["keep"] = keep
        try:
            return plan.run(**parameters)
        except ParameterError:
            if path := self._with_curves(parameters):
                light: Light = path.trace(**parameters)
                return light
            plan.only_detector("trace_all()")
            raise

    def trace_all(self, /, *unnamed: Never, **parameters: Any) -> dict[str, Light]:
        """Return the light at every detector and dump by name; see `Plan.run_all`.

        Parameters
        ----------
        *unnamed, **parameters
            By name, as in `trace`.

        Returns
        -------
        dict of str to Light
        """
        plan = self.compose()
        check_named("trace_all", unnamed, plan.inputs.open)
        try:
            return plan.run_all(**parameters)
        except ParameterError:
            if path := self._with_curves(parameters):
                return path.trace_all(**parameters)
            raise

    def paths(
        self,
        /,
        limit: int | None = None,
        bounces: int | None = None,
        *unnamed: Never,
        **parameters: Any,
    ) -> list[LightPath]:
        """Return the ways of light one by one, the brightest first; see `Plan.paths`.

        Parameters
        ----------
        limit, bounces : int, optional
            How many ways at most, and how often light may be reflected on each.
        *unnamed, **parameters
            By name, as in `trace`.

        Returns
        -------
        list of LightPath
        """
        return self.compose().paths(limit, bounces, *unnamed, **parameters)

    def mueller(
        self,
        source: str | None = None,
        detector: str | None = None,
        /,
        *unnamed: Never,
        **parameters: Any,
    ) -> Mueller:
        """Return the Mueller matrix from a source to a detector; see `Plan.mueller`.

        Parameters
        ----------
        source, detector : str, optional
            Their names; needed only where there are several.
        *unnamed, **parameters
            By name, as in `trace`.

        Returns
        -------
        Mueller
        """
        return self.compose().mueller(source, detector, *unnamed, **parameters)

    def compose(self) -> Plan:
        """Return the plan of a default `Composer`, composed once and kept."""
        # By a word, which costs each run less to look up than a composer.
        if "usual" not in self._plans:
            self._plans["usual"] = Composer().compose(self._values)
        return self._plans["usual"]

    def plan_by(self, composer: Composer) -> Plan:
        """Return the plan that a composer makes of the path, composed once and kept.

        Raises a `ComposerError` if it is none.
        """
        if not isinstance(composer, Composer):
            argument, example = shown(composer), "op.Composer(engine='numpy')"
            raise ComposerError(f"a plan is made by a Composer, not {argument}; write {example}")
        if composer not in self._plans:
            self._plans[composer] = composer.compose(self._values)
        return self._plans[composer]

    def sweep(
        self,
        /,
        *unnamed: Never,
        zip: Sequence[str] | Sequence[Sequence[str]] | Mapping[str, Sequence[str]] = (),  # noqa: A002 - what it does
        coords: str | PathLike[str] | Any = None,
        chunks: int | str | Mapping[str, int] | None = None,
        store: str | PathLike[str] | None = None,
        scheduler: Any = None,
        progress: bool | Callable[[int, int], None] = False,
        composer: Composer | None = None,
        **axes: Any,
    ) -> xr.Dataset:
        """Return the light for every combination of some values, with named axes.

        Parameters
        ----------
        zip : sequence of str, or several, optional
            Parameters whose values vary together, along one dimension: ``zip=("delta", "rho")``,
            or a mapping of its name to them.
        coords : str, PathLike, Dataset, DataArray or mapping, optional
            More axes: a CSV file with a column for each parameter and its unit in the heading, a
            Dataset, or a mapping.
        chunks : int, str or mapping of str to int, optional
            The variables are Dask arrays of so many values along each dimension; ``"auto"`` for
            blocks of about a million.
        store : str or PathLike, optional
            A Zarr store (``.zarr``), which goes on where it stopped, or a NetCDF file (``.nc``).
        scheduler : str or distributed.Client, optional
            What computes the blocks: ``"threads"``, ``"processes"``, ``"synchronous"``, a client,
            or the address of a cluster.
        progress : bool or callable, optional
            Whether a bar is shown; or what is called with the blocks that are done, and all.
        composer : Composer, optional
            How the path is composed.
        *unnamed, **axes : array_like
            The values of parameters by name, in radians and metres, texts with units, a range
            ``"0 deg:90 deg:91"``, or a DataArray with ``attrs["units"]``; a single value that
            stands in no list is no axis.

        Returns
        -------
        xarray.Dataset
            The dimensions are called as the parameters, in the order given.

        Raises
        ------
        ParameterError, ShapeError, MissingExtraError
            With all that is wrong with the axes, as `Plan.run`, or if xarray is not installed.
        """
        own: dict[str, Any] = {"zip": zip, "coords": coords, "chunks": chunks, "store": store}
        more: dict[str, Any] = {"scheduler": scheduler, "progress": progress, "composer": composer}
        with needing("sweeps"):
            from optipath.sweeps.sweep import sweep  # noqa: PLC0415 - sweeps stand above paths

            return sweep(self, unnamed, axes, **own, **more)

    def propagate(
        self,
        /,
        *unnamed: Never,
        method: UncertaintyMethod = "auto",
        samples: int | None = None,
        seed: int | None = None,
        correlation: Mapping[tuple[str, str], float] | None = None,
        detector: str | None = None,
        composer: Composer | None = None,
        **values: Any,
    ) -> Propagation:
        """Return the light with its uncertainty, which follows from those of values.

        To the first order by slopes (JCGM 100:2008, the GUM, eqs. 10 and 13), or by samples (its
        Supplement 1, JCGM 101:2008). What is doubtful is told in `Propagation.notes`.

        Parameters
        ----------
        method : {"auto", "gradients", "differences", "monte-carlo"}, optional
            Slopes by JAX where it is installed and quick, else by differences; by JAX; by
            differences; or samples of normal distributions, cut off at the ends of ranges.
        samples, seed : int, optional
            Of ``"monte-carlo"``: 10,000, and what random numbers begin with, 0, by default.
        correlation : mapping of pairs of str to float, optional
            Coefficients of correlation, ``{("n1", "k1"): 0.3}``; 0 for other pairs.
        detector, composer : optional
            As `mueller` and `sweep` take them; slopes are in float64, and exact.
        *unnamed, **values : tuple of two, or array_like
            By name, a value and its standard uncertainty, in radians, metres or texts with units,
            ``delta=("48 deg", "0.1 deg")``, or arrays of both. What is no tuple is exact.

        Returns
        -------
        Propagation

        Raises
        ------
        ParameterError, MissingExtraError
            With everything that is wrong, or if JAX is asked for and not installed.

        Examples
        --------
        >>> import optipath as op
        >>> found = op.load_preset("malus").propagate(
        ...     angle=("30 deg", "0.1 deg"), intensity=(1.0, 0.002), method="differences"
        ... )
        >>> print(found.light.intensity.round(6), found.uncertainty_of("intensity").round(6))
        0.375 0.001065
        >>> {name: float(share.round(3)) for name, share in found.contributions_to("S0").items()}
        {'angle': 0.504, 'intensity': 0.496}
        """
        # Sweeps stand above paths.
        from optipath.sweeps.uncertainty import propagate  # noqa: PLC0415

        options = method, samples, seed, correlation, detector, composer
        return propagate(self, unnamed, values, *options)

    def __getstate__(self) -> dict[str, Any]:
        return {name: one for name, one in vars(self).items() if name != "_values"}

    def __copy__(self) -> Self:
        return self._with(self._graph.copy())

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, PathGraph):
            return NotImplemented
        mine, theirs = (
            (p.description, p.cases, p.choices, p.loops, dict(p.nodes), dict(p.edges.items()))
            for p in (self, other)
        )
        return same(mine, theirs)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        if chain := editing.as_chain(self._graph):
            return f"<{type(self).__name__}: {' >> '.join(chain)}>"
        nodes, links = len(self), self._graph.number_of_edges()
        return f"<{type(self).__name__} with {nodes} nodes and {links} links>"

    @cached_property
    def _values(self) -> Values:
        """The values of the path, gathered once until it changes."""
        return Values(self._graph)

    @property
    def _graph(self) -> ElementGraph:
        """The graph, to be read."""
        return self._growing.read()

    def _changing(self) -> ElementGraph:
        """Return the graph for a change, and forget what followed from it."""
        self._plans.clear()
        vars(self).pop("_values", None)
        return self._growing.change()

    def _append(self, port: str, others: PathGraph) -> str:
        """Add other elements behind a port, and return the name of the last of them."""
        return editing.append(self._changing(), port, others._graph)

    def _with(self, graph: ElementGraph | GrowingGraph | Values) -> Self:
        """Return a path like this one with another graph, or one whose values are known."""
        path = type(self)(self.description, self.cases)
        if isinstance(graph, Values):
            path._values, path._growing = graph, GrowingGraph(graph.graph)  # noqa: SLF001
        else:
            path._growing = graph if isinstance(graph, GrowingGraph) else GrowingGraph(graph)  # noqa: SLF001
        return path

    def _with_curves(self, parameters: dict[str, Any]) -> PathGraph | None:
        """Return the path bound to what depends on the wavelength, which is taken out; or none."""
        curves = {n: parameters.pop(n) for n in [*parameters] if is_curve(parameters[n])}
        return self.bind(**curves) if curves else None


def path_of(first: Any) -> PathGraph:
    """Return the path of one element, such as a chain begins with."""
    if isinstance(first, PathGraph):
        return first
    path = PathGraph()
    if isinstance(first, NamedElement):
        path.add(first.name, first.element)
    elif isinstance(first, Element):
        path.add(editing.name_by_kind(first), first)
    else:
        cure = f"write path.add(name, element) >> path['{first.name}']"
        raise PathError(f"{first} stands in a path already; add there what is before, and {cure}")
    return path
