"""Composer: checks a path, and turns it into a plan."""

from __future__ import annotations

import gc
from contextlib import contextmanager
from dataclasses import dataclass
from numbers import Real
from typing import TYPE_CHECKING, Any, Literal, Protocol, TypeAlias, get_args

import networkx as nx

from optipath.composer.lower import lower, refuse_no_jones
from optipath.composer.media import Media, with_followed
from optipath.composer.path_values import Values
from optipath.composer.placement import placement_faults
from optipath.composer.plain_graph import completed
from optipath.composer.reduce import by_name, reduced, tolerated
from optipath.composer.wiring import (
    KEEPABLE,
    LOOPS,
    among,
    link_text,
    sharing_faults,
    tap_faults,
    where_several,
)
from optipath.elements.element import Chainable
from optipath.engines.choice import ENGINES, REGISTRY, is_installed
from optipath.engines.program import MODELS
from optipath.errors import ComposerError, PathError
from optipath.faults import Cure, Fault, shown, unknown
from optipath.kernels.catalog import METHODS
from optipath.plan.plan import Plan
from optipath.values.operands import Operand
from optipath.values.precision import precision_name, whole_number

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.composer.wiring import Keep, Loops, Wiring
    from optipath.engines.choice import EngineName
    from optipath.engines.draft import Draft
    from optipath.engines.program import Model, Reduction, Tolerance
    from optipath.kernels.catalog import Method
    from optipath.values.precision import Precision


def checked(
    values: Values, loops: str | None = None, keep: str = KEEPABLE[0]
) -> tuple[Values, Wiring, Media]:
    """Return the values, wiring and media of a path, or raise with all that is wrong with it."""
    graph, faults = with_followed(values.graph) if values.has_followers else (values.graph, [])
    values = values if graph is values.graph else Values(graph)
    wiring = values.wiring.changed(loops, keep)
    media = Media(wiring)
    # In a cycle by mistake, light meets media and misses ends in consequence.
    cyclic = [] if wiring.loops == LOOPS[1] else list(_loop_faults(wiring))
    faults += [*values.faults, *placement_faults(wiring), *([] if cyclic else media.faults())]
    faults += [*_feeding_faults(wiring), *sharing_faults(wiring), *tap_faults(wiring)]
    faults += [*_dark_link_faults(wiring), *cyclic, *_missing_end_faults(wiring)]
    faults += [] if faults else _own_faults(wiring)
    if wiring.starts and wiring.ends and not cyclic:
        faults += _reach_faults(wiring)
    PathError.raise_for(faults)
    for element in wiring.elements.values():
        vars(element)["_is_sound"] = True
    return values, wiring, media


def _own_faults(wiring: Wiring) -> Iterator[str]:
    for each in wiring.own_ways():
        if each.are_known():
            yield from (fault for _, fault in each.faults(Operand.numbers))


def _missing_end_faults(wiring: Wiring) -> Iterator[str]:
    detects = any(element.detects for element in wiring.elements.values())
    for kind, is_there in (("source", bool(wiring.starts)), ("detector", detects)):
        if not is_there:
            table = f'[elements.{kind}] with kind = "{kind}"'
            cure = Cure.of("add one, such as {}".format, f"{kind.title()}()", table)
            yield Fault(f"the path has no {kind}", cure)


def _dark_link_faults(wiring: Wiring) -> Iterator[str]:
    for link in wiring.dark_links:
        element = wiring.elements[link[0]]
        kind = element.kind or type(element).__name__
        yield f"link '{link_text(link)}' carries no light: {kind} gives none there; remove the link"


def _feeding_faults(wiring: Wiring) -> Iterator[str]:
    for (name, port), links in where_several(wiring.links_to):
        element = wiring.elements[name]
        if not element.merges:
            feeders = " and ".join(f"'{start}.{leaves}'" for start, _, (leaves, _) in links)
            merges = f"{element.kind or type(element).__name__} does not merge light"
            yield f"port '{name}.{port}' is fed by {feeders}, but {merges}; put a Combiner there"


def _reach_faults(wiring: Wiring) -> Iterator[str]:
    """Yield where a link is missing, and not what is cut off in consequence."""
    dark = wiring.elements.keys() - wiring.lit_nodes
    missing = wiring.elements.keys() - wiring.useful_nodes
    for name in _firsts(wiring.graph.subgraph(dark)) if dark else ():
        entries = ", ".join(f"'{name}.{port}'" for port in wiring.elements[name].inputs)
        yield f"node '{name}' is reached by no source; link one to {entries}"
    missing -= dark
    for name in _firsts(wiring.graph.subgraph(missing), backwards=True) if missing else ():
        exits = " or ".join(f"'{name}.{port}'" for port in wiring.elements[name].outputs)
        yield f"node '{name}' reaches no detector; link {exits} towards one, or to a Dump"


def _firsts(graph: nx.MultiDiGraph, *, backwards: bool = False) -> list[str]:
    """Return the nodes that no other leads to; of nodes in a circle, one."""
    parts = nx.condensation(graph.reverse() if backwards else graph)
    return [min(parts.nodes[n]["members"]) for n, degree in parts.in_degree if not degree]


def _loop_faults(wiring: Wiring) -> Iterator[str]:
    for together in wiring.cycles:
        start = min(together)
        inside = nx.DiGraph(among(wiring.untapped, together))
        back = min(inside.predecessors(start))
        route = [name for name, _ in nx.shortest_path(inside, start, back)]
        names = [name for i, name in enumerate(route) if i == 0 or route[i - 1] != name]
        closed = names if len(names) > 1 and names[0] == names[-1] else [*names, names[0]]
        yield Fault(
            f"light goes round in a cycle: {' -> '.join(closed)}",
            Cure.of(
                "open it by removing a link, or sum over all rounds with {}".format,
                "loops='sum'",
                'loops = "sum" above all tables',
            ),
        )


Composing: TypeAlias = Literal["stokes", "jones"]
CHOICES: dict[str, tuple[str, ...]] = {
    "method": METHODS,
    "model": ("auto", *MODELS),
    "engine": ENGINES,
    "composing": get_args(Composing),
    "loops": LOOPS,
    "keep": KEEPABLE,
}


class Path(Protocol):
    """Anything that has a graph of elements."""

    @property
    def graph(self) -> nx.MultiDiGraph[str]:
        """The graph: nodes with ``element`` and ``frames``, links with ``azimuth`` and ``tap``."""


@dataclass(frozen=True)
class Composer:
    """How paths are turned into plans.

    Parameters
    ----------
    method : {"stable", "compensated", "amplitude", "textbook"}, optional
        How Fresnel's equations are computed.
    model : {"auto", "scalar", "sp", "linear", "full"}, optional
        What is carried along: S0 alone; S0 and S1, the intensities along s and p; S0, S1 and
        S2; or all four through every step as it stands, nothing folded. By default the
        smallest that is exact for what the detectors read, with all that is known done once.
    engine : {"auto", "numpy", "numba", "jax"}, optional
        What runs batches: by default what costs least, Numba only where its code is kept or
        compiling it pays; by name, Numba compiles at once.
    dtype : {"float64", "float32", "longdouble"}, optional
        The precision of the steps, to which all values are rounded (1e-60 is 0 in
        float32); longdouble where the platform has it. What NumPy takes for one of them
        will do, such as ``"f4"`` and ``np.float32``.
    composing : {"stokes", "jones"}, optional
        How light is carried along a path: as a Stokes vector, or as two Jones columns,
        which no element may depolarise and whose light is never polarised by more than
        100 %, however long the path.
    tolerance : float, optional
        How large the error of an intensity may be, as a share of it; 0.01 is 1 %. Where a
        certificate keeps the scalar model (or one asked for by name) within it, that is run,
        and the exact model elsewhere, path by path. A path with a Mueller matrix that is
        unphysical, which nothing bounds, is refused then. By default every plan is exact.
    loops : {"refuse", "sum"}, optional
        What becomes of light that goes round in a cycle: an error that names the cycle, or the
        sum of intensities over all rounds, found by solving for it. By default what the path
        says, which refuses unless it was built with ``loops="sum"``.
    keep : {"ends", "all"}, optional
        Which light a plan gives: that at detectors and dumps, or also that on every link,
        named like ``"lamp.out -> eye.in"``, and that which leaves the path by an outlet, named
        like ``"glass.transmitted"``, each in the frame in which it leaves its element.
    threads : int, optional
        How many threads share a batch of more than 65,536 paths; one by default, since
        threads that wait for a busy machine cost more than they bring.

    Raises
    ------
    ComposerError
        With every option that does not exist.

    Examples
    --------
    >>> import optipath as op
    >>> composer = op.Composer(method="textbook", engine="numpy")
    >>> plan = composer.compose(op.load_preset("malus"))
    >>> plan.method, plan.engine
    ('textbook', 'numpy')
    """

    method: Method = "stable"
    model: Literal["auto"] | Model = "auto"
    engine: EngineName = "auto"
    dtype: Precision = "float64"
    composing: Composing = "stokes"
    tolerance: float | None = None
    threads: int = 1
    loops: Loops | None = None
    keep: Keep = "ends"

    def __post_init__(self) -> None:
        faults: list[str] = []
        for option, choices in CHOICES.items():
            value = getattr(self, option)
            if value is not None or option != "loops":
                faults += unknown(option, value, choices)
        with ComposerError.collecting(faults):
            object.__setattr__(self, "dtype", precision_name(self.dtype))
        ComposerError.raise_for(faults)
        if not is_installed(self.engine):
            faults += REGISTRY[self.engine].missing.faults
        if (self.engine, self.dtype) == ("jax", "longdouble"):
            faults.append("engine 'jax' has no longdouble; use engine 'numpy'")
        faults += whole_number("threads", self.threads)
        faults += self._tolerance_faults()
        if self.composing == "jones" and self.model in MODELS[:-1]:
            cure = "use model 'auto' or composing='stokes'"
            faults.append(f"model '{self.model}' is not for composing='jones'; {cure}")
        ComposerError.raise_for(faults)

    def _tolerance_faults(self) -> list[str]:
        if self.tolerance is None:
            return []
        if not isinstance(self.tolerance, Real) or not 0.0 < self.tolerance < 1.0:
            allowed = "a number between 0 and 1, such as 0.01 for 1 %"
            return [f"tolerance must be {allowed}, not {shown(self.tolerance)}; leave it out"]
        if self.model == "full" or self.composing == "jones":
            what = "model 'full'" if self.model == "full" else "composing='jones'"
            return [f"{what} is exact and takes no tolerance; leave one of them out"]
        return []

    def compose(self, path: Path | nx.DiGraph[Any]) -> Plan:
        """Return the plan of a path.

        Parameters
        ----------
        path : PathGraph, networkx.MultiDiGraph or networkx.DiGraph
            The elements and links; `PathGraph.from_networkx` has the attributes of a graph.

        Raises
        ------
        PathError
            With every fault of the path.
        ComposerError
            If an element may depolarise, and Jones columns are composed, or if the model is
            not exact for the path.
        """
        graph = path if isinstance(path, nx.Graph) else getattr(path, "graph", None)
        if not isinstance(graph, nx.Graph):
            raise ComposerError(f"a path or a networkx.MultiDiGraph is composed, not {shown(path)}")
        with put_off():
            if not isinstance(path, Chainable | Values):  # Whose graphs are known to be right.
                graph = completed(graph)
            return self._plan(path if isinstance(path, Values) else Values(graph))

    def _plan(self, values: Values) -> Plan:
        values, wiring, media = checked(values, self.loops, self.keep)
        draft = lower(wiring, self.method)
        if self.composing == "jones":
            refuse_no_jones(draft)
        inputs, own_ways = values.inputs(media.open), wiring.own_ways(self.method)
        outlets, taps = wiring.outlets, tuple(map(link_text, wiring.taps))
        # Of a long path, they take as much memory as all that follows.
        del values, wiring, media
        reduction, instead = self._reduced(draft)
        return Plan(
            draft=draft,
            reduction=reduction,
            instead=instead,
            tolerance=self.tolerance,
            inputs=inputs,
            own_ways=tuple([way for way in own_ways if not way.are_known()]),
            outlets=outlets,
            taps=taps,
            method=self.method,
            composing=self.composing,
            dtype=str(self.dtype),
            chosen=self.engine,
            threads=self.threads,
        )

    def _reduced(self, draft: Draft) -> tuple[Reduction, Tolerance | None]:
        """Return what is run, and what may be taken in its place."""
        exact = reduced(draft, self.model, self.composing, str(self.dtype))
        most = self.tolerance
        if most is not None and (instead := tolerated(exact, self.model, most)):
            return exact, instead
        unchanged = self.model == "auto" or exact.unreduced
        return exact if unchanged else by_name(exact, self.model), None


@contextmanager
def put_off() -> Iterator[None]:
    """Collect no garbage for a while: each time, all elements of a long path are looked at."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()
