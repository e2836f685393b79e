"""How far plans are from the reference for a whole path, region by region."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import ParameterError
from optipath.lab.accuracy.error_measures import Errors, errors
from optipath.lab.accuracy.many_digits import exactly, mpmath
from optipath.lab.accuracy.path_reference import exact_batch
from optipath.lab.accuracy.region_path import in_region, interfaces

if TYPE_CHECKING:
    from collections.abc import Iterator

    import networkx as nx

    from optipath.composer.composer import Composer
    from optipath.lab.accuracy.path_reference import ExactLight
    from optipath.lab.accuracy.regions import Region
    from optipath.paths.path_graph import PathGraph

AS_GIVEN = "as given"


class Trial(NamedTuple):
    """A path in one region, and what exactly comes of it."""

    region: str
    graph: nx.MultiDiGraph
    lights: tuple[dict[str, ExactLight], ...]


def trials(
    path: PathGraph,
    regions: tuple[Region, ...],
    dtype: str,
    count: int,
) -> Iterator[Trial]:
    """Yield the path as given, and in every region if it has interfaces."""
    given = path.graph.copy()
    yield Trial(AS_GIVEN, given, tuple(exact_batch(given)))
    for region in regions if interfaces(path) else ():
        yield trial(path, region, dtype, count)


def trial(path: PathGraph, region: Region, dtype: str, count: int) -> Trial:
    """Return the path with its interfaces in one region."""
    graph = in_region(path, region, count, dtype)
    return Trial(region.name, graph, tuple(exact_batch(graph)))


def path_errors(composer: Composer, of: Trial, dtype: str) -> Errors:
    """Return the errors of a composer's plan, at all ends together."""
    ends = list(of.lights[0])
    exact = [lights[end] for end in ends for lights in of.lights]
    try:
        lights = composer.compose(of.graph).run_all()
    except ParameterError:
        shape = (len(exact), 4)
        return Errors(np.full(shape, np.inf), np.full(len(exact), np.inf))
    found = np.concatenate([lights[end].mantissa.reshape(-1, 4) for end in ends])
    powers = np.concatenate([lights[end].exponent.ravel() for end in ends])
    unread = np.isnan(found)
    found = np.where(unread, 0, found)
    exact = [
        _comparable(*each) for each in zip(exact, powers.tolist(), (~unread).tolist(), strict=True)
    ]
    off = errors(found, exact, dtype, against_first=True)
    # Light that a precision cannot hold is lost, however small the step of its last place.
    least = exactly(np.finfo(dtype).tiny)
    lost = [
        not row[0] and 0 < light.stokes[0] < least for row, light in zip(found, exact, strict=True)
    ]
    off.componentwise[lost] = off.normwise[lost] = np.inf
    return off


def _comparable(light: ExactLight, power: int, read: list[bool]) -> ExactLight:
    """Return a light without two to a power: what is too faint for floats is compared so.

    A component that a detector does not read is 0, and has no error.
    """
    parts = zip(light.stokes, read, strict=True)
    # A product would be rounded to the digits that mpmath works with outside of references.
    scaled = (mpmath.ldexp(part, -power) if seen else mpmath.mpf(0) for part, seen in parts)
    return light._replace(stokes=tuple(scaled))


def worst_and_median(numbers: Any) -> dict[str, float]:
    """Return the largest and the middle of errors, the largest of each row first."""
    rows = np.sort(numbers.reshape(len(numbers), -1).max(axis=1))
    return {"worst": float(rows[-1]), "median": float(rows[len(rows) // 2])}
