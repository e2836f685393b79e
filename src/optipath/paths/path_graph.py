"""PathGraph: a graph of elements that can be asked for its light, the face that users touch."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, Never, overload

from optipath.composer.composer import Composer
from optipath.composer.wiring import KEPT
from optipath.elements.chaining import NamedElement, chains_begin_with
from optipath.elements.element import Element
from optipath.errors import ComposerError, ParameterError, PathError, shown, unknown
from optipath.paths.described_graph import DescribedGraph
from optipath.paths.joining import name_by_kind
from optipath.paths.sweeping import Sweeping
from optipath.values.by_name import check_named
from optipath.values.open_materials import is_curve

if TYPE_CHECKING:
    from optipath.light.light import Light
    from optipath.light.mueller.matrix import Mueller
    from optipath.plan.light_paths.light_path import LightPath
    from optipath.plan.plan import Plan


class PathGraph(Sweeping, DescribedGraph):
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

    _plans: dict[str | Composer, Plan]

    def compose(self) -> Plan:
        """Return the plan of a default `Composer`, composed once and kept."""
        # By a word, which costs each run less to look up than a composer.
        if "usual" not in self._plans:
            self._plans["usual"] = Composer().compose(self._graph)
        return self._plans["usual"]

    def plan_by(self, composer: Composer) -> Plan:
        """Return the plan that a composer makes of the path, composed once and kept.

        Raises
        ------
        ComposerError
            If it is none.
        """
        if not isinstance(composer, Composer):
            given, example = shown(composer), "op.Composer(engine='numpy')"
            raise ComposerError(f"a plan is made by a Composer, not {given}; write {example}")
        if composer not in self._plans:
            self._plans[composer] = composer.compose(self._graph)
        return self._plans[composer]

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
        *unnamed
            None: values are given by name.
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
            With every unknown, missing or unsuitable parameter, or if there are several
            detectors.
        """
        plan = self.compose()
        if unnamed:
            _check_named(unnamed, plan)
        ends = isinstance(keep, str) and keep == KEPT[0]
        if not ends and "keep" not in plan.inputs.open:
            if path := self._with_curves(parameters):
                return path.trace(keep="all", **parameters)
            return self._keeping(keep).run_all(**parameters)
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

    def _keeping(self, keep: str) -> Plan:
        """Return the plan that keeps so much light."""
        if faults := unknown("keep", keep, KEPT):
            raise ParameterError(*faults)
        return self.plan_by(Composer(keep=keep))

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
        *unnamed
            None: values are given by name.
        **parameters : float or array_like
            As in `trace`.

        Returns
        -------
        list of LightPath
        """
        return self.compose().paths(limit, bounces, *unnamed, **parameters)

    def trace_all(self, /, *unnamed: Never, **parameters: Any) -> dict[str, Light]:
        """Return the light at every detector and dump by name; see `Plan.run_all`.

        Parameters
        ----------
        *unnamed
            None: values are given by name.
        **parameters : float or array_like
            As in `trace`.

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

    def _with_curves(self, parameters: dict[str, Any]) -> PathGraph | None:
        """Return the path bound to what depends on the wavelength, which is taken out; or none."""
        curves = {n: parameters.pop(n) for n in [*parameters] if is_curve(parameters[n])}
        return self.bind(**curves) if curves else None

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
        *unnamed
            None: values are given by name.
        **parameters : float or array_like
            As in `trace`.

        Returns
        -------
        Mueller
        """
        return self.compose().mueller(source, detector, *unnamed, **parameters)


def _beginning(first: Any) -> PathGraph:
    if isinstance(first, PathGraph):
        return first
    path = PathGraph()
    if isinstance(first, NamedElement):
        path.add(first.name, first.element)
    elif isinstance(first, Element):
        path.add(name_by_kind(first), first)
    else:
        raise PathError(
            f"{first} stands in a path already; add there what light passes before, and write "
            f"path.add(name, element) >> path['{first.name}']"
        )
    return path


chains_begin_with(_beginning)


def _check_named(unnamed: tuple[Any, ...], plan: Plan) -> None:
    """Refuse values that `PathGraph.trace` is given without a name, and what is to be kept."""
    if isinstance(unnamed[0], str) and unnamed[0] in KEPT:
        raise ParameterError(f"what is kept is given by name: trace(keep={shown(unnamed[0])})")
    check_named("trace", unnamed, plan.inputs.open)
