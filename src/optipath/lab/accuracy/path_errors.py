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
    from collections.abc import Callable

    import networkx as nx
    import numpy.typing as npt

    from optipath.composer import Composer
    from optipath.lab.accuracy.path_reference import ExactLight
    from optipath.lab.accuracy.regions import Region
    from optipath.paths.path_graph import PathGraph

AS_GIVEN = "as given"


class Trial(NamedTuple):
    """A path in one region, and what exactly comes of it.

    Attributes
    ----------
    region : str
        Its name; "as given" for the path with its own values.
    graph : networkx.MultiDiGraph
        The elements and links.
    lights : tuple of mapping
        The exact light at every end, for each of the batch.
    """

    region: str
    graph: nx.MultiDiGraph
    lights: tuple[dict[str, ExactLight], ...]


def trials(
    path: PathGraph,
    regions: tuple[Region, ...],
    dtype: str,
    count: int,
    tick: Callable[[], object] = lambda: None,
) -> list[Trial]:
    """Return the path as given, and in every region if it has interfaces."""
    graphs = [(AS_GIVEN, path.graph.copy())]
    if interfaces(path):
        graphs += [(region.name, in_region(path, region, count, dtype)) for region in regions]
    found = []
    for name, graph in graphs:
        found.append(Trial(name, graph, tuple(exact_batch(graph))))
        tick()
    return found


def path_errors(composer: Composer, trial: Trial, dtype: str) -> Errors:
    """Return the errors of a composer's plan, at all ends together, one row a sample and end.

    A plan that refuses, because a number is not finite, has infinite errors.
    """
    ends = list(trial.lights[0])
    exact = [lights[end] for end in ends for lights in trial.lights]
    try:
        lights = composer.compose(trial.graph).run_all()
    except ParameterError:
        shape = (len(exact), 4)
        return Errors(np.full(shape, np.inf), np.full(len(exact), np.inf))
    found = np.concatenate([lights[end].mantissa.reshape(-1, 4) for end in ends])
    powers = np.concatenate([lights[end].exponent.ravel() for end in ends])
    exact = [_over(light, int(power)) for light, power in zip(exact, powers, strict=True)]
    # A component that a detector does not read has no error.
    unread = np.isnan(found)
    found = np.where(unread, 0, found)
    exact = [_without(light, row) for light, row in zip(exact, unread, strict=True)]
    off = errors(found, exact, dtype, against_first=True)
    # Light that a precision cannot hold is lost, however small the step of its last place.
    least = exactly(np.finfo(dtype).tiny)
    lost = [
        not row[0] and 0 < light.stokes[0] < least for row, light in zip(found, exact, strict=True)
    ]
    off.componentwise[lost] = off.normwise[lost] = np.inf
    return off


def _without(light: ExactLight, unread: npt.NDArray[np.bool_]) -> ExactLight:
    kept = zip(light.stokes, unread.tolist(), strict=True)
    return light._replace(stokes=tuple(mpmath.mpf(0) if gone else part for part, gone in kept))


def _over(light: ExactLight, power: int) -> ExactLight:
    """Return a light without two to a power: what is too faint for floats is compared so."""
    return light._replace(stokes=tuple(mpmath.ldexp(part, -power) for part in light.stokes))


def worst_and_median(numbers: Any) -> dict[str, float]:
    """Return the largest and the middle of errors, the largest of each row first."""
    rows = np.sort(numbers.reshape(len(numbers), -1).max(axis=1))
    return {"worst": float(rows[-1]), "median": float(rows[len(rows) // 2])}
