"""Media and normals along chains, and vertices that may reflect or refract."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.ends import Detector, Source
from optipath.elements.vertex_chain import of_chain, pieces_of
from optipath.elements.vertex_place import are_off, deviation, normal_faults
from optipath.elements.vertices import RefractingVertex, SpecularVertex, Vertex
from optipath.errors import ValueFault
from optipath.kernels.catalog import REFRACTION
from optipath.kernels.primitives import NUMPY
from optipath.kernels.vertex_chain import Event
from optipath.materials.material import Material
from optipath.paths.chain_histories import (
    REFLECTS,
    REFRACTS,
    Histories,
    index_parts,
    masked,
    numbers_of_events,
)
from optipath.paths.path_graph import PathGraph
from optipath.values.arrays import as_argument, check_broadcast, locked
from optipath.values.jax_values import is_traced
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy.typing as npt

    from optipath.elements.vertices import ChainVertex

    Floats = npt.NDArray[np.float64]


def path_of_chains(
    points: Any, chains: Histories, intensity: Any, outside: Any, bad: str
) -> PathGraph:
    """Return the path of light from point to point."""
    path = PathGraph()
    node = path.add("light", Source(intensity))
    for place, vertex in enumerate(_vertices(points, chains, outside, bad), 1):
        node = node >> path.add(f"vertex{place}", vertex)
    node >> path.add("eye", Detector())
    return path


def _vertices(points: Any, chains: Histories, outside: Any, bad: str) -> Iterator[ChainVertex]:
    if not isinstance(chains.events, str):
        events: Any = locked(chains.events)
        for place, (front, behind) in enumerate(_media_along(chains, outside), 1):
            yield Vertex(behind, points, place, front, events=events, bad=bad)
        return
    front = outside
    for place, (event, medium) in enumerate(zip(chains.events, chains.materials, strict=True), 1):
        kind = SpecularVertex if event == REFLECTS else RefractingVertex
        yield kind(medium, points, place, front, chains.count, bad)
        front = medium if event == REFRACTS else front


def _media_along(chains: Histories, outside: Any) -> Iterator[tuple[Any, Any]]:
    """Yield the media in front of each vertex and behind it, where events differ."""
    events = numbers_of_events(chains)
    front, _ = index_parts("outside", outside)
    for place, material in enumerate(chains.materials):
        n, k = index_parts(f"materials[{place}]", material)
        yield _unboxed(front), Material(_unboxed(n), _unboxed(k)) if np.any(k) else _unboxed(n)
        front = locked(np.where(events[..., place] == Event.REFRACTS, n, front))


def _unboxed(numbers: Floats) -> Any:
    """Return an array, or one number as it is."""
    return numbers if numbers.ndim else float(numbers)


def apart_where_absorbed(chains: Histories) -> Histories:
    """Return histories whose chains are told apart, where light would go on in what absorbs."""
    if isinstance(chains.events, str):
        for event, medium in zip(chains.events, chains.materials, strict=True):
            index = known_index(medium)
            if event == REFRACTS and index is not None and np.any(index[1]):
                return replace(chains, events=numbers_of_events(chains))
    return chains


def known(value: Any) -> Any:
    """Return what is known of a value, be it by default; None if nothing is."""
    value = value.default if isinstance(value, Parameter) else value
    return None if value is None or is_traced(value) else value


def known_index(medium: Any) -> tuple[Floats, Floats] | None:
    """Return n and k of a medium; None where they are not known.

    >>> known_index(1.5 + 2j), known_index(Parameter("n"))
    ((array(1.5), array(2.)), None)
    """
    if isinstance(medium, Material):
        n, k = known(medium.n), known(medium.k)
        medium = None if n is None or k is None else Material(n, k)
    medium = known(medium)
    return None if medium is None else index_parts("index", medium)


def normals_checked(
    points: Floats, normals: Any, chains: Histories, outside: Any, bad: str
) -> Histories:
    """Return the chains of points (..., m + 2, 3) whose normals (..., m, 3) are theirs."""
    sides = _sides(chains, outside)
    if sides is None:
        raise ValueFault(
            "normals that refract are checked against media that are known; leave them out"
        )
    normals = as_argument("the array of normals", normals)
    check_broadcast({"vertices": points.shape[:-2], "normals": normals.shape[:-2]})
    ended = chains.ended
    if ended is not None and normals.shape[-2:] == (chains.count, 3):
        points = _turned_back(points, ended)
        normals = np.where(ended[..., np.newaxis], 1.0, normals)
    if faults := normal_faults(points if bad == "refuse" else None, normals, chains.count, sides):
        raise ValueFault(*faults)
    if bad == "mask" and np.any(off := are_off(points, normals, sides)):
        return masked(chains, off)
    return chains


def _sides(chains: Histories, outside: Any) -> Floats | None:
    """Return the indices (..., m, 2) in front of and behind the vertices, as normals need them.

    They are over the larger one; None where they are not known.
    """
    events = numbers_of_events(chains)
    front, results = known_index(outside), []
    for place, material in enumerate(chains.materials):
        refracts = events[..., place] == Event.REFRACTS
        n1 = n2 = np.ones(())
        if np.any(refracts):
            behind = known_index(material)
            if front is None or behind is None:
                return None
            n1, n2 = front[0], behind[0]
            front = np.where(refracts, n2, n1), front[1]
        larger = np.where(n1 == n2, np.inf, np.maximum(n1, n2))
        otherwise = np.where(events[..., place] == Event.BEHIND, 0.0, 1.0)
        results += [np.where(refracts, n / larger, otherwise) for n in (n1, n2)]
    together = np.broadcast_arrays(*results)
    return np.stack(together, axis=-1).reshape(*together[0].shape, chains.count, 2)


def _turned_back(points: Floats, ended: npt.NDArray[np.bool_]) -> Floats:
    """Return points that go to and fro behind the end of a chain, where nobody says any."""
    batch = np.broadcast_shapes(points.shape[:-2], ended.shape[:-1])
    result = np.array(np.broadcast_to(points, (*batch, *points.shape[-2:])))
    for place in range(ended.shape[-1]):
        np.copyto(
            result[..., place + 2, :], result[..., place, :], where=ended[..., place, np.newaxis]
        )
    return result


_TURNED = 2.0**-50
"""The deviation below which light goes straight on, which changes nothing."""


def refuse_doubtful(chains: Histories, vertices: Any, outside: Any, there: Any) -> None:
    """Raise where each chain may as well refract at a vertex (..., m) as reflect."""
    points, front = known(vertices), known_index(outside)
    if points is None or front is None:
        return
    events, readings = "", ""
    for place, material in enumerate(chains.materials):
        behind = known_index(material)
        around = _around(points, front, behind, place, there)
        if around is None or not all(
            _refracts(*(each[piece] for each in around)) for piece in pieces_of(len(around[0]))
        ):
            events += REFLECTS
            continue
        events += REFRACTS
        readings = readings or (
            f"light is turned by {deviation(around[0][0]):.6g} deg at vertex {place + 1}"
            f"{of_chain(0, points.shape[:-2])}, which a reflection does, and a refraction from "
            f"n = {around[1][0]:.6g} into n = {around[2][0]:.6g}"
        )
        front = behind
    if readings:
        raise ValueFault(
            f"{readings}; say which, events='{REFLECTS * len(events)}' where it is reflected, "
            f"events='{events}' where it goes through"
        )


def _around(
    points: Any, front: Any, behind: Any, place: int, there: Any
) -> tuple[Floats, Floats, Floats] | None:
    """Return the points (n, 9) around a vertex and n on both sides, of all chains that have it.

    None where light cannot go on behind it, or there is no such chain.
    """
    if behind is None or any(np.any(k) or np.any(n <= 0.0) for n, k in (front, behind)):
        return None
    try:
        sides = [points[..., place, 0], front[0], behind[0]]
        batch = np.broadcast_shapes(*(each.shape for each in sides))
        has = np.broadcast_to(True if there is None else there[..., place], batch)
    except ValueError:
        return None  # A fault of its own.
    around = np.broadcast_to(points[..., place : place + 3, :], (*batch, 3, 3)).reshape(*batch, 9)
    n1, n2 = (np.broadcast_to(n, batch)[has] for n in (front[0], behind[0]))
    return (np.asarray(around[has], np.float64), n1, n2) if np.any(has) else None


def _refracts(points: Floats, front: Floats, behind: Floats) -> bool:
    with np.errstate(all="ignore"):
        _, _, cos, sin = REFRACTION.made_for(NUMPY)(front, behind, *points.T)
        return bool(np.all((cos >= 0.0) & (sin > _TURNED)))
