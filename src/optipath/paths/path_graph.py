"""PathGraph: a graph of elements that can be asked for its light, the face that users touch."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal, overload

from optipath.composer.composer import Composer
from optipath.composer.wiring import KEPT
from optipath.elements.terminal import Detector
from optipath.errors import ParameterError, PathError, shown, unknown
from optipath.paths.binding import bind
from optipath.paths.element_graph import ElementGraph
from optipath.values.cases import Case

if TYPE_CHECKING:
    from collections.abc import Sequence

    import networkx as nx

    from optipath.light.light import Light
    from optipath.light.mueller.matrix import Mueller
    from optipath.plan.light_paths.light_path import LightPath
    from optipath.plan.plan import Plan


class PathGraph(ElementGraph):
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

    _plans: dict[str, Plan]

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

    def __copy__(self) -> PathGraph:
        return self._with(self._graph.copy())

    def _with(self, graph: nx.MultiDiGraph) -> PathGraph:
        path = PathGraph(self.description, self.cases)
        path._graph = graph
        return path

    def compose(self) -> Plan:
        """Return the plan of a default `Composer`, composed once and kept."""
        if "ends" not in self._plans:
            self._plans["ends"] = Composer().compose(self._graph)
        return self._plans["ends"]

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

        Returns
        -------
        Light or dict of str to Light
            The light at the detector; with ``"all"``, each light by name.

        Raises
        ------
        ParameterError
            With every unknown, missing or unsuitable parameter.
        """
        plan = self.compose()
        if isinstance(keep, str) and keep == KEPT[0]:
            return plan.run(**parameters)
        if "keep" in plan.inputs.open:
            return plan.run(keep=keep, **parameters)
        if faults := unknown("keep", keep, KEPT):
            raise ParameterError(*faults)
        if keep not in self._plans:
            self._plans[keep] = Composer(keep=keep).compose(self._graph)
        return self._plans[keep].run_all(**parameters)

    def paths(
        self, /, limit: int | None = None, bounces: int | None = None, **parameters: Any
    ) -> list[LightPath]:
        """Return the ways of light one by one, the brightest first; see `Plan.paths`.

        Parameters
        ----------
        limit, bounces : int, optional
            How many ways at most, and how often light may be reflected on each.
        **parameters : float or array_like
            As in `trace`.

        Returns
        -------
        list of LightPath
        """
        return self.compose().paths(limit, bounces, **parameters)

    def trace_all(self, /, **parameters: Any) -> dict[str, Light]:
        """Return the light at every detector and dump by name; see `Plan.run_all`."""
        return self.compose().run_all(**parameters)

    def mueller(
        self, source: str | None = None, detector: str | None = None, /, **parameters: Any
    ) -> Mueller:
        """Return the Mueller matrix from a source to a detector; see `Plan.mueller`.

        Parameters
        ----------
        source, detector : str, optional
            Their names; needed only where there are several.
        **parameters : float or array_like
            As in `trace`.

        Returns
        -------
        Mueller
        """
        return self.compose().mueller(source, detector, **parameters)

    def bind(self, /, **values: Any) -> PathGraph:
        """Return a copy of the path in which parameters have these values for good.

        Raises
        ------
        ParameterError
            With every unknown parameter and every value that is not allowed.
        """
        return self._with(bind(self._graph, values))

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
        graph = self._graph.copy()
        for node in graph.nodes.values():
            if hasattr(node["element"], "reads"):
                node["element"] = replace(node["element"], reads=reads)
        return self._with(graph)

    def to_toml(self) -> str:
        """Return the path as the text of a preset file; loading it gives the path back.

        Raises
        ------
        PathError
            If an element has no kind, or a value has no form in TOML.
        """
        from optipath.paths.format.writer import to_toml  # noqa: PLC0415 - not for every import

        return to_toml(self._graph, self.description, self.cases)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, PathGraph):
            return NotImplemented
        told = self.description == other.description and self.cases == other.cases
        return told and super().__eq__(other)

    __hash__ = None
