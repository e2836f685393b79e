"""PathGraph: a graph of elements that can be asked for its light, the face that users touch."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Literal, Never, Self, overload

import networkx as nx

from optipath.composer.composer import Composer, checked, put_off
from optipath.composer.plain_graph import completed, whole
from optipath.composer.port_frames import PortFrames
from optipath.composer.wiring import KEEPABLE
from optipath.elements.element import Chainable, Element, NamedElement, begun
from optipath.elements.ends import Detector
from optipath.errors import ComposerError, ParameterError, PathError
from optipath.extras import needing
from optipath.faults import Fault, shown, unknown
from optipath.materials.named_materials import is_curve
from optipath.paths import editing
from optipath.paths.binding import PlaceChoice, cases_left, choice_faults, with_arguments
from optipath.paths.graph_face import LENDING, GraphFace, wiring_at_defaults
from optipath.paths.reversed import reversed_graph
from optipath.values.arrays import same
from optipath.values.parameters import check_named

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from os import PathLike

    import xarray as xr

    from optipath.composer.path_values import Values
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


class PathGraph(GraphFace):
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
        self._graph = nx.MultiDiGraph(**about)
        # What the graph has been composed to, until it changes.
        self._plans: dict[str | Composer, Plan] = {}
        self._gathered = None

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

        Returns
        -------
        PathGraph

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
            own = completed(graph)
        path = cls(own.graph.pop("description"), own.graph.pop("cases"))
        path._graph, own.graph["choices"] = own, dict(own.graph["choices"])
        PathError.raise_for(
            Fault.of(fault).under(f"choice '{name}'")
            for name, choice in path.choices.items()
            for fault in choice_faults(own, choice)
        )
        return path

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
        self._changed()
        return Node(self, name)

    def connect(self, leaves: str, enters: str, azimuth: Any = None, *, tap: bool = False) -> None:
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
            out-port feeds one link, and any number of taps, each of which leads to ends of
            its own.

        Raises
        ------
        PathError
            If a port does not exist or runs the other way, or the link is there already.
        """
        editing.connect(self._changing(), leaves, enters, azimuth, tap)
        self._changed()

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
        self._changed()

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
        frames : mapping of str to Frame, optional
            The world frame of each port, as `add` takes them: where its axes stand in space. By
            default that of the port that light comes from, if it has one.

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
        self._edit(editing.insert, name, element, behind, before, frames)
        return Node(self, name)

    def remove(self, name: str) -> None:
        """Take a node out, close the gap, and offer no places for it.

        What stood before it is linked with what stood behind it, where one link came to it,
        one left it, and light goes straight through. A node that no link comes to, or none
        leaves, goes with its links.

        Raises
        ------
        PathError
            If there is no such node, or the links in the way do not tell how to close the gap;
            the path is as it was then.
        """
        self._edit(editing.remove, name)
        if self.choices:
            left = {word: choice for word, choice in self.choices.items() if choice.node != name}
            self._changing().graph["choices"] = left

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

        Raises
        ------
        PathError
            If a port is missing, frames would not fit, its link says another azimuth, or it lacks
            that of one that light does not go straight through; the path is as it was then.
        """
        self._edit(editing.replace, name, element)
        return Node(self, name)

    def offer(self, name: str, node: str, behind: Mapping[str, str], help: str = "") -> None:  # noqa: A002 - as parameters have it
        """Offer a choice of places for a node, which `bind` and `load_preset` take by name.

        Parameters
        ----------
        name : str
            That of the choice, which no parameter has.
        node : str
            What is moved; it has one natural way through, and stands where it will if nothing
            is chosen.
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
        if not isinstance(name, str) or not name.isidentifier():
            raise PathError(f"choice name {shown(name)} must be letters, digits and underscores")
        if name in self.choices or name in self.parameters:
            raise PathError(f"choice or parameter '{name}' is there already; use another name")
        choice = PlaceChoice(node, behind, help)
        PathError.raise_for(choice_faults(self._graph, choice))
        self._changing().graph["choices"] = self.choices | {name: choice}
        self._plans.clear()

    def __rshift__(self, behind: Element | NamedElement | PathGraph) -> Self:
        """Return the path in which light goes on from here to what stands behind.

        From the only open natural way out to the only natural way in; neither side changes.
        """
        others = begun(behind)
        if twice := sorted(self.cases.keys() & others.cases.keys()):
            raise PathError(f"case '{twice[0]}' stands on both sides of >>; take one of them out")
        with LENDING:
            path, graph = self._lent_graph()
            names = editing.join(graph, others._graph, self._tip)
        tip = others._open_end
        path._tip = tip and (names[tip[0]], tip[1])
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
            gives its k as well. What depends on the wavelength, as `op.tabulated(...)` and a
            `Spectrum` do, stands wherever the parameter stood, and leaves the path the parameter
            wavelength.

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
        path = self._having(with_arguments(self._values, values, for_good=True))
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
        return self._having(with_arguments(self._values, values, for_good=False))

    def reading(self, reads: Reading) -> Self:
        """Return a copy of the path whose detectors and dumps read this, as `Detector` takes it.

        Examples
        --------
        >>> import optipath as op
        >>> op.load_preset("malus").reading("intensity").trace().stokes
        array([0.375,   nan,   nan,   nan])
        """
        PathError.raise_for(Detector(reads).faults("path.reading(...)"))
        graph = self._graph.copy()
        for node in graph.nodes.values():
            if hasattr(node["element"], "reads"):
                node["element"] = replace(node["element"], reads=reads)
        return self._with(graph)

    def reversed(self, source: Source | Mapping[str, Source] | None = None) -> Self:
        """Return the path in which light goes the other way, from the detector to the source.

        Each element is met from the other side, in mirrored frames (x, -y, -z); sources are
        detectors there, and detectors sources. What each link turns stays the same, and links say
        it, and not elements. Parameters, defaults and cases stay, but for what is published;
        values of the sources go with them, and what is chosen stays chosen where a turn stands
        beside a place. ``path.reversed().mueller()`` is ``path.mueller().reversed()``, unless there
        is a magnetic field (Sekera, J. Opt. Soc. Am. 56, 1732 (1966)).

        Parameters
        ----------
        source : Source or mapping of str to Source, optional
            The light that begins at the detector, or at several by name; by default unpolarised
            light of intensity 1, and none at a dump.

        Returns
        -------
        PathGraph

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
        path.cases = {}
        known = {*path.parameters, *path.choices}
        for name, case in self.cases.items():
            left = {n: value for n, value in case.values.items() if n in known}
            if not (self.choices.keys() - known).intersection(case.values):
                path.cases[name] = replace(case, values=left, published={})
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
            With ``"all"``, the light at every end, on every link, such as
            ``"lamp.out -> eye.in"``, and at every outlet, such as ``"glass.transmitted"``, by
            name, each in the frame in which it leaves its element. A path with an open
            parameter called ``keep`` takes it for that; compose it by ``Composer(keep="all")``.
        *unnamed, **parameters : float or array_like
            By name, the values of open parameters. Those that JAX traces cannot be refused: light
            is NaN where they are outside their domain.

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
            Axes besides: a CSV file with a column for each parameter, its unit in the heading; the
            coordinates of a Dataset; or a mapping from names to values.
        chunks : int, str or mapping of str to int, optional
            The variables are Dask arrays of so many values along each dimension; ``"auto"`` for
            blocks of about a million.
        store : str or PathLike, optional
            A Zarr store (``.zarr``) or a NetCDF file (``.nc``) that is written block by block; a
            Zarr store goes on where it stopped.
        scheduler : str or distributed.Client, optional
            What computes the blocks for a store: ``"threads"``, ``"processes"``, ``"synchronous"``,
            a client, or the address of a cluster.
        progress : bool or callable, optional
            Whether a bar shows how far it is; or what is told how many blocks are done, and of how
            many.
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
            Slopes by JAX where it is installed, traces the path and does not take long, else by
            differences; by JAX; by differences; or samples of normal distributions, which are cut
            off at the ends of ranges.
        samples, seed : int, optional
            Of ``"monte-carlo"``: 10,000, and what random numbers begin with, 0, by default.
        correlation : mapping of pairs of str to float, optional
            Coefficients of correlation, ``{("n1", "k1"): 0.3}``; 0 for other pairs.
        detector, composer : optional
            As `mueller` and `sweep` take them; slopes are in float64, and exact.
        *unnamed, **values : tuple of two, or array_like
            By name, a value and its standard uncertainty (one standard deviation), in radians,
            metres or texts with units, ``delta=("48 deg", "0.1 deg")``; they may be arrays that
            broadcast. What is no tuple is exact.

        Returns
        -------
        Propagation

        Raises
        ------
        ParameterError, MissingExtraError
            With everything that is wrong with values and options, or if JAX is asked for and
            not installed.

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

    def __copy__(self) -> Self:
        return self._with(self._graph.copy())

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, PathGraph):
            return NotImplemented
        message, also = ((path.description, path.cases, path.choices) for path in (self, other))
        mine, theirs = self._graph, other._graph
        return (
            message == also
            and self.loops == other.loops
            and same(dict(mine.nodes.items()), dict(theirs.nodes.items()))
            and same(dict(mine.edges.items()), dict(theirs.edges.items()))
        )

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        if chain := editing.as_chain(self._graph):
            return f"<{type(self).__name__}: {' >> '.join(chain)}>"
        nodes, links = self._graph.number_of_nodes(), self._graph.number_of_edges()
        return f"<{type(self).__name__} with {nodes} nodes and {links} links>"

    def _edit(self, change: Callable[..., None], *arguments: Any) -> None:
        editing.edit(self._changing(), change, *arguments)
        self._changed()

    def _append(self, port: str, others: PathGraph) -> str:
        """Add other elements behind a port, and return the name of the last of them."""
        last = editing.append(self._changing(), port, others._graph)
        self._changed()
        return last

    def _changed(self) -> None:
        self._plans.clear()
        self._gathered = None

    def _having(self, values: Values) -> Self:
        path = self._with(values.graph)
        path._gathered = values  # noqa: SLF001 - its own
        return path

    def _with(self, graph: nx.MultiDiGraph) -> Self:
        path = type(self)(self.description, self.cases)
        path._graph = graph  # noqa: SLF001 - its own
        return path

    def _with_curves(self, parameters: dict[str, Any]) -> PathGraph | None:
        """Return the path bound to what depends on the wavelength, which is taken out; or none."""
        curves = {n: parameters.pop(n) for n in [*parameters] if is_curve(parameters[n])}
        return self.bind(**curves) if curves else None


@dataclass(frozen=True)
class Node(Chainable):
    """A named element in its path; ``a >> b`` links the natural way out of a to b.

    An element or a chain in no path yet is added to the path of the first.
    """

    path: PathGraph
    name: str
    port: str = ""

    def __rshift__(self, behind: Chainable) -> Node:  # type: ignore[override] # it has a path
        if not isinstance(behind, Node):
            return Node(self.path, self.path._append(self._text, begun(behind)))
        if behind.path is not self.path:
            raise PathError(f"'{self.name}' and '{behind.name}' stand in different paths; use one")
        self.path.connect(self._text, behind._text)
        return Node(behind.path, behind.name)

    @property
    def frames(self) -> dict[str, Frame]:
        """The frame of each port, as `PathGraph.frames` has it, with parameters at their defaults.

        >>> import optipath as op
        >>> op.load_preset("npgr026-3d")["X2"].frames["in"].x.round(12) + 0.0
        array([1., 0., 0.])
        """
        return PortFrames(wiring_at_defaults(values_of(self.path), {})).of(self.name)

    @property
    def _text(self) -> str:
        return f"{self.name}.{self.port}" if self.port else self.name

    def __repr__(self) -> str:
        return f"Node '{self._text}'"


def values_of(path: PathGraph) -> Values:
    """Return the values of a path, gathered once until it changes."""
    return path._values  # noqa: SLF001 - its own


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
