"""Composer: turns a path into a plan."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import networkx as nx

from optipath.composer.lower import lower
from optipath.composer.validate import refuse_faults
from optipath.composer.values import Values
from optipath.composer.wiring import Wiring
from optipath.errors import ComposerError, did_you_mean
from optipath.kernels import METHODS
from optipath.plan import Plan

_CHOICES = {
    "method": METHODS,
    "model": ("auto", "full"),
    "engine": ("auto", "numpy"),
    "dtype": ("float64", "float32"),
}


class Path(Protocol):
    """Anything that has a graph of elements."""

    @property
    def graph(self) -> nx.MultiDiGraph:
        """The graph: nodes with ``element`` and ``frames``, links with ``azimuth``."""


@dataclass(frozen=True)
class Composer:
    """How paths are turned into plans.

    Parameters
    ----------
    method : {"stable", "textbook"}, optional
        How Fresnel's equations are computed.
    model : {"auto", "full"}, optional
        What is carried along: all four Stokes components.
    engine : {"auto", "numpy"}, optional
        What runs the steps.
    dtype : {"float64", "float32"}, optional
        The precision.
    tolerance : None, optional
        Kept for approximations; only exact plans are made in this version.

    Raises
    ------
    ComposerError
        With every option that does not exist.

    Examples
    --------
    >>> import optipath as op
    >>> plan = op.Composer(method="textbook").compose(op.load_preset("malus"))
    >>> plan.method, plan.engine
    ('textbook', 'numpy')
    """

    method: str = "stable"
    model: str = "auto"
    engine: str = "auto"
    dtype: str = "float64"
    tolerance: None = None

    def __post_init__(self) -> None:
        faults = []
        for option, choices in _CHOICES.items():
            value = getattr(self, option)
            if value not in choices:
                faults.append(f"{option} {value!r} is unknown{did_you_mean(str(value), choices)}")
        if self.tolerance is not None:
            faults.append("tolerance is not available in this version; leave it None")
        if faults:
            raise ComposerError(*faults)

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
        """
        graph: Any = path if isinstance(path, nx.MultiDiGraph) else getattr(path, "graph", None)
        if not isinstance(graph, nx.MultiDiGraph):
            raise ComposerError(f"a path or a networkx.MultiDiGraph is composed, not {path!r}")
        values, wiring = Values(graph), Wiring(graph)
        refuse_faults(values, wiring)
        return Plan(
            program=lower(wiring, self.method),
            inputs=values.inputs(),
            outlets=wiring.outlets,
            copied=wiring.copied,
            method=self.method,
            model="full",
            engine="numpy",
            dtype=self.dtype,
        )
