"""Composer: turns a path into a plan."""

from __future__ import annotations

import gc
from contextlib import contextmanager
from dataclasses import dataclass
from numbers import Real
from typing import TYPE_CHECKING, Any, Protocol

import networkx as nx

from optipath.composer.followed_values import with_followed
from optipath.composer.lower import lower, refuse_no_jones
from optipath.composer.media import Media
from optipath.composer.path_values import Values
from optipath.composer.reduce import by_name, reduced, tolerated
from optipath.composer.validate import refuse_faults
from optipath.composer.wiring import KEEPABLE, LOOPS, Wiring, link_text
from optipath.engines.choice import ENGINES, REGISTRY, is_installed
from optipath.engines.program import MODELS
from optipath.errors import ComposerError, collecting, shown, unknown
from optipath.kernels.catalog import METHODS
from optipath.plan.plan import Plan
from optipath.values.precision import precision_name, whole_number

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.engines.program import Program, Reduction, Tolerance


CHOICES = {
    "method": METHODS,
    "model": ("auto", *MODELS),
    "engine": ENGINES,
    "composing": ("stokes", "jones"),
    "loops": LOOPS,
    "keep": KEEPABLE,
}


class Path(Protocol):
    """Anything that has a graph of elements."""

    @property
    def graph(self) -> nx.MultiDiGraph:
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

    method: str = "stable"
    model: str = "auto"
    engine: str = "auto"
    dtype: Any = "float64"
    composing: str = "stokes"
    tolerance: float | None = None
    threads: int = 1
    loops: str | None = None
    keep: str = "ends"

    def __post_init__(self) -> None:
        faults: list[str] = []
        for option, choices in CHOICES.items():
            value = getattr(self, option)
            if value is not None or option != "loops":
                faults += unknown(option, value, choices)
        with collecting(faults, ComposerError):
            object.__setattr__(self, "dtype", precision_name(self.dtype))
        if faults:
            raise ComposerError(*faults)
        if not is_installed(self.engine):
            faults += REGISTRY[self.engine].missing.faults
        if (self.engine, self.dtype) == ("jax", "longdouble"):
            faults.append("engine 'jax' has no longdouble; use engine 'numpy'")
        faults += whole_number("threads", self.threads)
        faults += self._tolerance_faults()
        if self.composing == "jones" and self.model in MODELS[:-1]:
            faults.append(
                f"model '{self.model}' is not for composing='jones', which carries columns whole; "
                f"use model 'auto' or composing='stokes'"
            )
        if faults:
            raise ComposerError(*faults)

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

    def compose(self, path: Path | nx.MultiDiGraph) -> Plan:
        """Return the plan of a path.

        Parameters
        ----------
        path : PathGraph or networkx.MultiDiGraph
            The elements and links.

        Raises
        ------
        PathError
            With every fault of the path.
        ComposerError
            If an element may depolarise, and Jones columns are composed, or if the model is
            not exact for the path.
        """
        graph = path if isinstance(path, nx.MultiDiGraph) else getattr(path, "graph", None)
        if not isinstance(graph, nx.MultiDiGraph):
            raise ComposerError(f"a path or a networkx.MultiDiGraph is composed, not {shown(path)}")
        with put_off():
            return self._plan(path if isinstance(path, Values) else Values(graph))

    def _plan(self, values: Values) -> Plan:
        graph, unfollowed = with_followed(values.graph)
        values = values if graph is values.graph else Values(graph)
        wiring = Wiring(graph, self.loops, self.keep)
        media = Media(wiring)
        refuse_faults(values, wiring, media, unfollowed)
        whole = lower(wiring, self.method)
        if self.composing == "jones":
            refuse_no_jones(whole)
        reduction, instead = self._reduced(whole)
        return Plan(
            whole=whole,
            reduction=reduction,
            instead=instead,
            tolerance=self.tolerance,
            inputs=values.inputs(media.open),
            own_ways=tuple([w for w in wiring.own_ways(self.method) if not w.are_known()]),
            outlets=wiring.outlets,
            taps=tuple(map(link_text, wiring.taps)),
            method=self.method,
            composing=self.composing,
            dtype=self.dtype,
            chosen=self.engine,
            threads=self.threads,
        )

    def _reduced(self, whole: Program) -> tuple[Reduction, Tolerance | None]:
        """Return what is run, and what may be taken in its place."""
        exact = reduced(whole, self.model, self.composing, self.dtype)
        if self.tolerance is not None:
            instead = tolerated(exact, self.model, self.tolerance)
            if instead is not None:
                return exact, instead
        unchanged = self.model == "auto" or exact.unreduced
        return exact if unchanged else by_name(exact, self.model), None


@contextmanager
def put_off() -> Iterator[None]:
    """Collect no garbage for a while: each time, all elements of a long path are looked at.

    >>> import gc
    >>> with put_off():
    ...     print(gc.isenabled())
    False
    """
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()
