"""Errors against references: in ulp and normwise, over the condition number."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import ParameterError
from optipath.kernels.carriers.structures import BLOCK
from optipath.kernels.catalog import REFLECTION, TRANSMISSION
from optipath.kernels.primitives import NUMPY
from optipath.lab import boundary_reference
from optipath.lab.many_digits import WORKING_DIGITS, exactly, mpmath
from optipath.lab.path_reference import exact_batch
from optipath.lab.regions import in_region

if TYPE_CHECKING:
    from collections.abc import Iterable

    import networkx as nx
    import numpy.typing as npt

    from optipath.composer.composer import Composer
    from optipath.kernels.kernel import Kernel
    from optipath.lab.path_reference import ExactLight
    from optipath.lab.regions import Region, Samples
    from optipath.paths.path_graph import PathGraph


LIMIT = 1000.0
"""A method fails where it is off by more than this: three digits lost that the problem has."""


class Errors(NamedTuple):
    """Componentwise (samples, 4) and normwise (samples,) errors of four numbers, in ulp."""

    componentwise: npt.NDArray[np.float64]
    normwise: npt.NDArray[np.float64]


def errors(
    result: npt.NDArray[Any], exact: Iterable[Any], dtype: str, *, against_first: bool = False
) -> Errors:
    """Return the errors, in ulp, of computed numbers (samples, 4).

    >>> off = errors(np.array([[1.0 + 2e-16, 0, 0, 0]]), [((1, 0, 0, 0), (0, 0, 0, 0))], "float64")
    >>> off.componentwise[0], off.normwise
    (array([1., 0., 0., 0.]), array([1.]))
    """
    componentwise, normwise = np.zeros(result.shape), np.zeros(len(result))
    with mpmath.workdps(WORKING_DIGITS):
        for row, (numbers, (values, conditions)) in enumerate(zip(result, exact, strict=True)):
            off = [_distance(x, value) for x, value in zip(numbers, values, strict=True)]
            size = abs(values[0])
            instead = size if against_first else 0
            componentwise[row] = [
                in_ulp(d, value or instead, dtype) / (1.0 + condition)
                for d, value, condition in zip(off, values, conditions, strict=True)
            ]
            shares = [abs(v) * c for v, c in zip(values, conditions, strict=True)]
            most = float(max(shares) / size) if size else 0.0
            normwise[row] = in_ulp(max(off), size, dtype) / (1.0 + most)
    return Errors(componentwise, normwise)


def _distance(number: Any, value: Any) -> Any:
    return abs(exactly(number) - value) if np.isfinite(number) else mpmath.inf


def in_ulp(distance: Any, value: Any, dtype: str) -> float:
    """Return a distance in units in the last place of a value."""
    if not distance:
        return 0.0
    kind = np.finfo(dtype)
    binade = int(mpmath.frexp(value)[1]) - 1 if value else kind.minexp
    return float(distance / mpmath.ldexp(1, max(binade, kind.minexp) - kind.nmant))


SAMPLES = 200
FAMILIES = {"reflection": REFLECTION, "transmission": TRANSMISSION}
REFERENCES = {what: getattr(boundary_reference, what) for what in FAMILIES}


def interface_errors(
    method: str,
    region: Region,
    dtype: str = "float64",
    count: int = SAMPLES,
    what: str = "reflection",
    *,
    against_first: bool = False,
) -> Errors:
    """Return the errors of (A, B, C, S) by a method in a region.

    >>> from optipath.lab.regions import REGIONS
    >>> off = interface_errors("stable", REGIONS[0], count=20)
    >>> bool(np.all(off.componentwise <= 10))
    True
    """
    result = matrix_numbers(FAMILIES[what].by_method(method), region.samples(count, dtype))
    exact = _references(region, dtype, count, what)
    return errors(result, exact, dtype, against_first=against_first)


def matrix_numbers(kernel: Kernel, samples: Samples) -> npt.NDArray[Any]:
    """Return (A, B, C, S) as a kernel computes them. Shape: returns (samples, 4)."""
    outside = np.ones((), samples.n.dtype)
    with np.errstate(all="ignore"):
        numbers = kernel.made_for(NUMPY)(outside, *samples)
        (A, B, _, _), _, (_, _, C, S), _ = BLOCK.rows(NUMPY, numbers)
    return np.stack(np.broadcast_arrays(A, B, C, S), axis=-1)


@lru_cache(maxsize=256)
def _references(
    region: Region, dtype: str, count: int, what: str
) -> tuple[boundary_reference.Exact, ...]:
    samples = zip(*region.samples(count, dtype), strict=True)
    with mpmath.workdps(WORKING_DIGITS):
        return tuple(REFERENCES[what](*map(exactly, sample)) for sample in samples)


AS_PASSED = "as given"


class Trial(NamedTuple):
    """A path in one region, and what exactly comes of it."""

    graph: nx.MultiDiGraph
    lights: tuple[dict[str, ExactLight], ...]


def trial(path: PathGraph, region: Region | None, dtype: str, count: int) -> Trial:
    """Return the path with its interfaces in one region, or as it is given."""
    graph = path.graph.copy() if region is None else in_region(path, region, count, dtype)
    return Trial(graph, tuple(exact_batch(graph)))


def path_errors(composer: Composer, of: Trial, dtype: str) -> Errors:
    """Return the errors of a composer's plan, at all ends together."""
    ends = list(of.lights[0])
    exact = [lights[end] for end in ends for lights in of.lights]
    try:
        lights = composer.compose(of.graph).run_all()
    except ParameterError:
        return Errors(np.full((len(exact), 4), np.inf), np.full(len(exact), np.inf))
    result = np.concatenate([lights[end].stokes.reshape(-1, 4) for end in ends])
    unread = np.isnan(result)
    result = np.where(unread, 0, result)
    exact = [_as_read(*each) for each in zip(exact, unread.tolist(), strict=True)]
    off = errors(result, exact, dtype, against_first=True)
    # Light that a precision cannot hold is lost, however small the step of its last place.
    least = exactly(np.finfo(dtype).tiny)
    missing = [
        not row[0] and 0 < light.stokes[0] < least for row, light in zip(result, exact, strict=True)
    ]
    off.componentwise[missing] = off.normwise[missing] = np.inf
    return off


def _as_read(light: ExactLight, unread: list[bool]) -> ExactLight:
    """Return a light that is 0 in components that a detector does not read."""
    parts = zip(light.stokes, unread, strict=True)
    return light._replace(stokes=tuple(mpmath.mpf(0) if not_read else x for x, not_read in parts))


def worst_and_median(numbers: Any) -> dict[str, float]:
    """Return the largest and the middle of errors, the largest of each row first."""
    rows = np.sort(numbers.reshape(len(numbers), -1).max(axis=1))
    return {"worst": float(rows[-1]), "median": float(rows[len(rows) // 2])}
