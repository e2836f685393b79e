"""Media and normals along chains whose events differ."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.elements.ends import Detector, Source
from optipath.elements.vertex_chain import of_chain, pieces_of
from optipath.elements.vertex_place import are_off, deviation, normal_faults
from optipath.elements.vertices import RefractingVertex, SpecularVertex, Vertex
from optipath.errors import OptipathError, ValueFault
from optipath.kernels.catalog import REFRACTION
from optipath.kernels.primitives import NUMPY
from optipath.kernels.vertex_chain import Event
from optipath.materials.index_domains import INDEX
from optipath.materials.material import Material
from optipath.paths.chain_events import REFLECTS, REFRACTS, media_in_front
from optipath.paths.chain_histories import Histories, index_parts, masked
from optipath.paths.path_graph import PathGraph
from optipath.values.arrays import as_argument, locked
from optipath.values.jax_values import is_traced
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    import numpy.typing as npt

    from optipath.elements.vertices import ChainVertex

    Floats = npt.NDArray[np.float64]


def known(value: Any) -> Any:
    """Return what is known of a value, be it by default; None if nothing is."""
    value = value.default if isinstance(value, Parameter) else value
    return None if value is None or is_traced(value) else value


def known_index(medium: Any) -> Floats | None:
    """Return n of a medium; None where it is not known, or absorbs.

    >>> known_index(1.5), known_index(Parameter("n")), known_index(1.5 + 2j)
    (array(1.5), None, None)
    """
    parts = (medium.n, medium.k) if isinstance(medium, Material) else (medium,)
    several = [known(part) for part in parts]
    if any(part is None for part in several):
        return None
    try:
        n, *k = (INDEX.check("index", INDEX.read("index", part)) for part in several)
    except OptipathError:
        return None  # A fault of its own.
    clear = not (np.any(n.imag) or any(map(np.any, k)) or np.any(n.real <= 0.0))
    return np.asarray(n.real) if clear else None


def sides_of(events: str, materials: Sequence[Any], outside: Any) -> Floats | None:
    """Return the indices (..., m, 2) in front of and behind the vertices, for normals.

    >>> sides_of("RT", (1.5, 1.5), 3.0)
    array([[1. , 1. ],
           [1. , 0.5]])
    """
    results: list[Any] = []
    front = media_in_front(events, materials, outside)
    for event, before, behind in zip(events, front, materials, strict=True):
        n1, n2 = (np.ones(()),) * 2 if event == REFLECTS else map(known_index, (before, behind))
        if n1 is None or n2 is None:
            return None
        results.append(over_the_larger(n1, n2, event == REFRACTS))
    try:
        return in_order(results)
    except ValueError:
        return None


def over_the_larger(n1: Any, n2: Any, refracts: Any, otherwise: Any = 1.0) -> tuple[Any, Any]:
    """Return the indices on both sides of a vertex as normals need them.

    >>> [float(n) for n in over_the_larger(1.5, 3.0, True)]
    [0.5, 1.0]
    """
    larger = np.where(n1 == n2, np.inf, np.maximum(n1, n2))
    return np.where(refracts, n1 / larger, otherwise), np.where(refracts, n2 / larger, otherwise)


def in_order(sides: Sequence[tuple[Any, Any]]) -> Floats:
    """Return what stands on both sides of each vertex as one array, shape (..., m, 2)."""
    together = np.broadcast_arrays(*[side for both in sides for side in both])
    return np.stack(together, axis=-1).reshape(*together[0].shape, len(sides), 2)


_WHY = "which medium light is in differs from chain to chain"


class Sides(NamedTuple):
    """The media on both sides of a vertex, for each chain."""

    front: Any
    behind: Any


def media_along(events: Floats, materials: Sequence[Any], outside: Any) -> list[Sides]:
    """Return the media on both sides of each vertex of events (..., m).

    >>> events = np.array([[1.0, 1.0], [1.0, 0.0]])
    >>> media_along(events, (1.5, 1.2), 1.0)[1].front
    array([1.5, 1.5])
    """
    front, _ = index_parts("outside", outside, _WHY)
    results = []
    for place, material in enumerate(materials):
        n, k = index_parts(f"materials[{place}]", material, _WHY)
        behind = Material(_unboxed(n), _unboxed(k)) if np.any(k) else _unboxed(n)
        results.append(Sides(_unboxed(front), behind))
        front = locked(np.where(events[..., place] == Event.REFRACTS, n, front))
    return results


def _unboxed(numbers: Floats) -> Any:
    """Return an array, or one number as it is."""
    return numbers if numbers.ndim else float(numbers)


def normals_checked(
    points: Floats | None, normals: Any, chains: Histories, outside: Any, bad: str
) -> tuple[Histories, list[str]]:
    """Return the arguments of chains (..., m + 2, 3), and faults of normals (..., m, 3)."""
    sides = _sides(chains, outside)
    if sides is None:
        fault = "normals that refract are checked against media that are known; leave them out"
        return chains, [fault]
    argument = normals
    if chains.ended is not None and points is not None:
        points = _turned_back(points, chains.ended)
        argument = _any_behind_the_end(normals, chains)
    result = normal_faults(points if bad == "refuse" else None, argument, chains.count, sides)
    if bad == "refuse" or result or points is None:
        return chains, result
    off = are_off(points, np.asarray(argument), sides)
    return masked(chains, off) if np.any(off) else chains, []


def _sides(chains: Histories, outside: Any) -> Floats | None:
    """Return n1 and n2 at each vertex as `sides_of` does, whichever event each chain has."""
    events: Any = chains.events
    if not isinstance(events, np.ndarray):
        return sides_of(events or REFLECTS * chains.count, chains.materials, outside)
    results: list[Any] = []
    for place, (n1, behind) in enumerate(media_along(events, chains.materials, outside)):
        n2 = behind.n if isinstance(behind, Material) else behind
        here = events[..., place]
        otherwise = np.where(here == Event.BEHIND, 0.0, 1.0)
        results.append(over_the_larger(n1, n2, here == Event.REFRACTS, otherwise))
    return in_order(results)


def _turned_back(points: Floats, ended: npt.NDArray[np.bool_]) -> Floats:
    """Return points that go to and fro behind the end of a chain, where nobody says any."""
    batch = np.broadcast_shapes(points.shape[:-2], ended.shape[:-1])
    result = np.array(np.broadcast_to(points, (*batch, *points.shape[-2:])))
    for place in range(ended.shape[-1]):
        there = ended[..., place, np.newaxis]
        result[..., place + 2, :] = np.where(
            there, result[..., place, :], result[..., place + 2, :]
        )
    return result


def _any_behind_the_end(normals: Any, chains: Histories) -> Any:
    try:
        argument = as_argument("the array of normals", normals)
    except ValueFault:
        return normals
    ended: Any = chains.ended
    if argument.shape[-2:] != (chains.count, 3) or argument.dtype.kind not in "iuf":
        return normals
    try:
        return np.where(ended[..., np.newaxis], 1.0, argument)
    except ValueError:
        return normals


_TURNED = 2.0**-50
"""The deviation below which light goes straight on, which changes nothing."""


def doubtful_vertex(chains: Any, materials: Sequence[Any], outside: Any, there: Any = None) -> str:
    """Ask what is meant at a vertex (..., m) with reflection and refraction in each chain."""
    points, front = known(chains), known_index(outside)
    if points is None or front is None:
        return ""
    events, message = "", ""
    for place, material in enumerate(materials):
        behind = known_index(material)
        around = points[..., place : place + 3, :]
        if there is not None and behind is not None:
            around, behind = _of_those(there[..., place], around, behind)
        if behind is None or not _may_all_refract(around, front, behind):
            events += REFLECTS
            continue
        events += REFRACTS
        message = message or _readings(place + 1, around, front, behind)
        front = behind
    if not message:
        return ""
    return (
        f"{message}; say which, events='{REFLECTS * len(events)}' where it is reflected, "
        f"events='{events}' where it goes through"
    )


def _of_those(there: Any, around: Any, behind: Any) -> tuple[Any, Any]:
    """Return points and indices, those of chains that are not there replaced by one that is."""
    if np.all(there) or not np.any(there):
        return around, behind
    first = np.unravel_index(np.argmax(there), there.shape)
    if around.shape[:-2] == there.shape:
        around = np.where(there[..., np.newaxis, np.newaxis], around, around[first])
    if behind.shape == there.shape:
        behind = np.where(there, behind, behind[first])
    return around, behind


def _may_all_refract(around: Any, front: Any, behind: Any) -> bool:
    """Tell of points around a vertex whether each chain may be one that refracts."""
    try:
        batch = np.broadcast_shapes(around.shape[:-2], front.shape, behind.shape)
    except ValueError:
        return False  # A fault of its own.
    points = np.broadcast_to(around, (*batch, 3, 3)).reshape(-1, 9)
    media = [np.broadcast_to(n, batch).reshape(-1) for n in (front, behind)]
    # Mostly the first piece says that light is reflected.
    return len(points) > 0 and all(
        _refracts(points[piece].T, *(n[piece] for n in media)) for piece in pieces_of(len(points))
    )


def _refracts(coordinates: Any, front: Any, behind: Any) -> bool:
    with np.errstate(all="ignore"):
        _, _, cos, sin = REFRACTION.made_for(NUMPY)(
            front, behind, *np.asarray(coordinates, np.float64)
        )
        return bool(np.all((cos >= 0.0) & (sin > _TURNED)))


def _readings(vertex: int, around: Any, front: Any, behind: Any) -> str:
    """Return both readings of a vertex, for the first chain."""
    batch = around.shape[:-2]
    points = np.asarray(around, np.float64).reshape(-1, 9)[0]
    n1, n2 = (float(n.reshape(-1)[0]) for n in (front, behind))
    turned = deviation(points)
    _, _, cos, sin = REFRACTION.made_for(NUMPY)(n1, n2, *points)
    in_rarer = math.atan2(sin, cos)
    incidence = in_rarer if n1 <= n2 else math.asin(math.sin(in_rarer) * n2 / n1)
    return (
        f"light is turned by {turned:.6g} deg at vertex {vertex}{of_chain(0, batch)}, which is a "
        f"reflection at an incidence of {90.0 - 0.5 * turned:.6g} deg, or a refraction from "
        f"n = {n1:.6g} into n = {n2:.6g} at "
        f"{math.degrees(incidence):.6g} deg"
    )


def path_of_chains(
    points: Any, chains: Histories, intensity: Any, outside: Any, bad: str
) -> PathGraph:
    """Return the path of light from point to point."""
    path = PathGraph()
    node = path.add("light", Source(intensity))
    each = _alike if not isinstance(chains.events, np.ndarray) else _differing
    for place, vertex in enumerate(each(points, chains, outside, bad), 1):
        node = node >> path.add(f"vertex{place}", vertex)
    node >> path.add("eye", Detector())
    return path


def _alike(points: Any, chains: Histories, outside: Any, bad: str) -> Iterator[ChainVertex]:
    media, count = chains.materials, chains.count
    events: Any = chains.events or REFLECTS * count
    each = zip(events, media, media_in_front(events, media, outside), strict=True)
    for place, (event, material, front) in enumerate(each, 1):
        kind = SpecularVertex if event == REFLECTS else RefractingVertex
        yield kind(material, points, place, front, count, bad)


def _differing(points: Any, chains: Histories, outside: Any, bad: str) -> Iterator[ChainVertex]:
    events: Any = locked(chains.events)
    for place, sides in enumerate(media_along(events, chains.materials, outside), 1):
        yield Vertex(sides.behind, points, place, sides.front, events=events, bad=bad)
