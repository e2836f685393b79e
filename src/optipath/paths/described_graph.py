"""DescribedGraph: a graph of elements with what is told of it, and what can be made of it."""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Never

from optipath.elements.chaining import NamedElement, begun
from optipath.elements.terminal import Detector
from optipath.errors import ParameterError, PathError, shown
from optipath.paths.binding import bind
from optipath.paths.bound_materials import cases_left
from optipath.paths.element_graph import ElementGraph
from optipath.paths.joining import join
from optipath.paths.place_choice import PlaceChoice, choice_faults, put_in_place
from optipath.paths.reversed_graph import reversed_graph
from optipath.values.by_name import check_named
from optipath.values.cases import Case
from optipath.values.open_materials import is_by_wavelength

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from typing import Self

    import networkx as nx

    from optipath.elements.element import Element
    from optipath.elements.source import Source


class DescribedGraph(ElementGraph):
    """A graph of elements with a description and cases, of which others are made."""

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
        super().__init__(declared, loops)

    def __contains__(self, name: object) -> bool:
        return name in self._graph

    def __iter__(self) -> Iterator[str]:
        """Go through the names of the nodes, in the order in which they were added."""
        return iter(self._graph)

    def __len__(self) -> int:
        return len(self._graph)

    def __copy__(self) -> Self:
        return self._with(self._graph.copy())

    def _with(self, graph: nx.MultiDiGraph) -> Self:
        path = type(self)(self.description, self.cases)
        path._graph = graph  # noqa: SLF001 - its own
        return path

    def __rshift__(self, behind: Element | NamedElement | Self) -> Self:
        """Return the path in which light goes on from here to what stands behind.

        From the only natural way out that is open, to the only natural way in. Neither side
        is changed.
        """
        others: Self = begun(behind)
        if not self._graph or not others._graph:
            return copy(self if self._graph else others)
        if twice := sorted(self.cases.keys() & others.cases.keys()):
            raise PathError(f"case '{twice[0]}' stands on both sides of >>; take one of them out")
        path = copy(self)
        names = join(path._graph, others._graph)
        path.description = self.description or others.description
        for name, case in others.cases.items():
            published = {names.get(end, end): light for end, light in case.published.items()}
            path.cases[name] = replace(case, published=published)
        return path

    def bind(self, /, *unnamed: Never, **values: Any) -> Self:
        """Return a copy of the path in which parameters have these values for good.

        Parameters
        ----------
        *unnamed
            None: values are given by name.
        **values : float, str, array_like, Material or curve
            In radians and metres, or texts with units. A `Material` for the n of an index gives
            its k as well. What depends on the wavelength, as `op.tabulated(...)` and a `Spectrum`
            do, stands wherever the parameter stood, and leaves the path the parameter wavelength.

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
        path = self._with(self._given(values, for_good=True))
        if any(map(is_by_wavelength, values.values())):
            path.cases = cases_left(self.cases, {*path.parameters, *self.choices})
        return path

    def with_defaults(self, /, **values: Any) -> Self:
        """Return a copy of the path in which parameters have these values by default.

        They stay open: whoever traces the path may give others. None takes a default away.

        Raises
        ------
        ParameterError
            With every unknown parameter and every value that is not allowed.

        Examples
        --------
        >>> import optipath as op
        >>> crossed = op.load_preset("malus").with_defaults(angle="90 deg")
        >>> crossed.trace().intensity, crossed.trace(angle=0.0).intensity
        (array(0.), array(0.5))
        """
        return self._with(self._given(values, for_good=False))

    def _given(self, values: dict[str, Any], *, for_good: bool) -> nx.MultiDiGraph:
        """Return a copy of the graph with nodes in the places chosen, and other values given."""
        graph = self._graph.copy()
        faults: list[str] = []
        for name in [name for name in self.choices if name in values]:
            try:
                put_in_place(graph, name, values.pop(name))
            except PathError as fault:
                faults += fault.faults
        try:
            graph = bind(graph, values, for_good=for_good)
        except ParameterError as fault:
            faults += fault.faults
        if faults:
            raise ParameterError(*faults)
        return graph

    def reading(self, reads: str) -> Self:
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
        beside a place. ``path.reversed().mueller()`` is ``path.mueller().reversed()``, unless
        there is a magnetic field (Sekera, J. Opt. Soc. Am. 56, 1732 (1966)).

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

        Raises
        ------
        PathError
            If an element has no kind, or a value has no form in TOML.
        """
        from optipath.paths.format.writer import to_toml  # noqa: PLC0415 - not for every import

        return to_toml(self._graph, self.description, self.cases)

    def remove(self, name: str) -> None:
        """Take a node out, close the gap, and offer no places for it; see `ElementGraph.remove`."""
        super().remove(name)
        if self.choices:
            left = {word: choice for word, choice in self.choices.items() if choice.node != name}
            self._graph.graph["choices"] = left

    @property
    def choices(self) -> dict[str, PlaceChoice]:
        """What is chosen by word before the path is composed, as `bind` takes it, by name."""
        return dict(self._graph.graph.get("choices", {}))

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
        if name in self.choices:
            raise PathError(f"choice '{name}' is there already; use another name")
        choice = PlaceChoice(node, behind, help)
        if faults := choice_faults(self._graph, choice):
            raise PathError(*faults)
        self._graph.graph["choices"] = self.choices | {name: choice}
        self._plans.clear()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, DescribedGraph):
            return NotImplemented
        mine, theirs = ((path.description, path.cases, path.choices) for path in (self, other))
        return mine == theirs and super().__eq__(other)

    __hash__ = None
