"""Paths out of the points that light passes: a reflection or refraction at each but the ends."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.ends import Detector, Source
from optipath.elements.vertex_chain import (
    BAD,
    VERTICES,
    VerticesByAngles,
    counted,
    legs_fit,
    of_chain,
    pieces_of,
    viewed,
)
from optipath.elements.vertex_place import deviation, off_normals
from optipath.errors import PathError, ValueFault
from optipath.faults import shown, unknown
from optipath.kernels.catalog import REFRACTION
from optipath.kernels.primitives import NUMPY
from optipath.kernels.vertex_chain import Event
from optipath.materials.index_domains import OUTSIDE
from optipath.paths.histories import (
    REFLECTS,
    REFRACTS,
    Histories,
    KnownIndex,
    histories,
    known,
    known_index,
    read_part,
)
from optipath.paths.path_graph import PathGraph
from optipath.values.arrays import as_argument, check_broadcast, entries_of
from optipath.values.jax_values import is_traced
from optipath.values.parameters import Parameter
from optipath.values.precision import is_whole
from optipath.values.use import Use, checked_later, faults_of, stored_value

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    import numpy.typing as npt

    from optipath.elements.vertex_chain import IfBad
    from optipath.elements.vertices import ChainVertex

    Floats = npt.NDArray[np.float64]


_MOST = (1 << 31) - 1


def path_from_vertices(
    vertices: Any,
    materials: Sequence[Any],
    normals: npt.ArrayLike | None = None,
    intensity: Any = 1.0,
    *,
    events: Any = None,
    outside: Any = 1.0,
    ids: npt.ArrayLike | Parameter | None = None,
    lengths: npt.ArrayLike | Parameter | None = None,
    bad: IfBad = "refuse",
    count: int | None = None,
) -> PathGraph:
    """Return the path of light from point to point, reflected or refracted at each but the ends.

    The surfaces tilt themselves: one that reflects is perpendicular to the bisector of its two
    legs, one that refracts stands by Snell's law. Angles
    of incidence and all frames come from the points; ``path.trace().frame`` is the world frame
    of the last leg, with x = k_out cross k_in at the last vertex. A vertex at which light comes
    back along its way, or goes straight on, has no plane of incidence of its own, and keeps the
    x that the light came with, or takes that which angles say.

    Parameters
    ----------
    vertices : array_like, shape (..., m + 2, 3), Parameter or VerticesByAngles
        The points from the light to the eye, in the unit of any length; legs within 1e-70 and
        1e70. A parameter is given arrays of this shape when the path runs. A large array of
        floats is used where it stands: leave it as it is while the path and its light are in use.
    materials : sequence of m float, complex, array_like, Material or Parameter
        The index of refraction on the other side of each surface, in order from the light. Light
        that is reflected stays in its medium; light that is refracted goes on in this one, which
        must not absorb. With `ids`, a palette of numbers.
    normals : array_like, shape (..., m, 3), optional
        The normals of the surfaces, of any length and to either side, to be checked: each is to
        be along that of the vertex to within 1e-6 rad, or the rounding of half precision.
    intensity : float, array_like or Parameter, optional
        Of the unpolarised light.
    events : str, sequence of str, array_like of str, shape (..., m), or Parameter, optional
        A letter for each vertex, in order from the light: R where it is reflected, T where it is
        refracted (let through). One text is for all chains, several are one for each, whose
        letters say how long it is; an array has a single letter for each vertex. Without it every
        vertex reflects, and normals say so, or points that are known: where they may as well be
        those of a refraction, `events` is asked for.
    outside : float, array_like, Material or Parameter, optional
        The index of the medium that the light starts in, without absorption.
    ids : array_like of int, shape (..., m), or Parameter, optional
        Which of the materials, counted from 0, is on the other side of each surface of each chain.
    lengths : array_like of int, shape (...), or Parameter, optional
        How many vertices each chain has, 1 to m. What stands behind its last point is not read;
        its light and its frame are those of its own last leg.
    bad : {"refuse", "mask"}, optional
        Whether chains that cannot be are refused, or their light is NaN.
    count : int, optional
        How many vertices a chain has at most, m; needed only where `ids` is a parameter, and
        neither the points nor `events` say it.

    Returns
    -------
    PathGraph
        ``light``, ``vertex1`` .. ``vertexm`` and ``eye``, one behind the other.

    Raises
    ------
    PathError
        With every fault of what is given.

    Examples
    --------
    Light falls straight down, is reflected to the side by glass, and is fully polarised across
    the plane of incidence at Brewster's angle; here it arrives at 45 degrees.

    >>> path = path_from_vertices([[0, 0, 3], [0, 0, 0], [0, 4, 0]], materials=[1.5])
    >>> light = path.trace()
    >>> print(light.stokes.round(4), light.frame.z)
    [0.0502 0.0418 0.     0.    ] [0. 1. 0.]

    Straight down through a pane, with an echo in it:

    >>> down = [[0, 0, 3], [0, 0, 2], [0, 0, 1], [0, 0, 2], [0, 0, 1], [0, 0, 0]]
    >>> pane = path_from_vertices(down, materials=[1.5, 1.0, 1.0, 1.0], events="TRRT")
    >>> float(pane.trace().intensity.round(9))
    0.00147456

    The same, beside light that the pane reflects at once:

    >>> up = [*down[:2], *[[0, 0, 3]] * 4]
    >>> both = path_from_vertices([down, up], [1.5, 1.0, 1.0, 1.0], events=["TRRT", "R"])
    >>> print(both.trace().intensity.round(9))
    [0.00147456 0.04      ]
    """
    PathError.raise_for(unknown("bad", bad, BAD))
    with PathError.wrapping():
        start = stored_value("outside", outside, OUTSIDE)
        ValueFault.raise_for(faults_of(Use(*part) for part in OUTSIDE.parts("outside", start)))
        media = entries_of("materials", "one for each vertex", materials)
        if not media:
            raise ValueFault("materials must be a sequence of one for each vertex; it is empty")
        batch: tuple[int, ...] = ()
        if not isinstance(vertices, (Parameter, VerticesByAngles)):
            batch = np.shape(as_argument("the array of vertices", vertices))[:-2]
        media = tuple(map(_real_again, media))
        if not (ids is None or isinstance(ids, Parameter)):
            ids = read_part("ids", ids, 0)
        parts = {"events": events, "ids": ids, "lengths": lengths}
        is_open = any(isinstance(part, Parameter) for part in parts.values())
        chains: Any = histories(media, start, parts, _count(count, media, vertices, parts), batch)
        points = _points(vertices, chains)
        path = _checked(points, chains, intensity, bad)
        if normals is not None:
            if is_open or not isinstance(points, np.ndarray):
                raise ValueFault("normals need points that are known; leave them out")
            checked = _normals_checked(points, normals, chains, bad)
            if checked is not chains:
                path = _checked(points, checked, intensity, bad)
        elif events is None and not (is_open or isinstance(points, VerticesByAngles)):
            # Light may not arrive everywhere.
            there = None if chains.ended is None else ~chains.ended
            if bad == "mask" and isinstance(points, np.ndarray):
                there = legs_fit(points)[..., 1:] & (True if there is None else there)
            _refuse_doubtful(chains, points, there)
    return path


def _count(told: Any, media: Sequence[Any], vertices: Any, parts: Mapping[str, Any]) -> int:
    """Return how many vertices chains have at most, by the first that says so."""
    if told is not None and not is_whole(told, most=_MOST):
        raise ValueFault(f"count must be a whole number above 0, not {shown(told)}")
    ids = np.shape(known(parts["ids"]))
    own = (len(media),) if parts["ids"] is None else ids[-1:]
    if not own:  # Of letters for each vertex, or one text for all chains.
        text = parts["events"]
        own = (len(text),) if isinstance(text, str) else np.shape(text)[1:][-1:]
    if not own and len(points := np.shape(known(vertices))) > 1:
        own = (points[-2] - 2,)
    if not own and told is None:
        raise ValueFault("ids is a parameter; say how many vertices chains have, count=...")
    if told is not None and own and told != own[0]:
        by = "materials" if parts["ids"] is None else "ids" if ids else "events or vertices"
        raise ValueFault(f"count is {told}, but {by} say {own[0]}; leave it out")
    return int(told or own[0])


def _checked(points: Any, chains: Any, intensity: Any, bad: IfBad) -> PathGraph:
    with checked_later():  # The path names the vertices, and looks at their array once.
        path = _path_along(chains.vertices(points, bad), intensity)
    path.check()
    return path


def _real_again(medium: Any) -> Any:
    """Return a medium that an array with others has made complex as the real one that it is."""
    is_complex = isinstance(medium, (complex, np.ndarray, np.generic)) and np.iscomplexobj(medium)
    return medium.real if is_complex and not np.any(np.imag(medium)) else medium


def _points(vertices: Any, chains: Any) -> Any:
    """Return vertices that nobody can change, as many as the chains have."""
    if isinstance(vertices, Parameter):
        return vertices
    count = chains.count
    media = f"m = {count} for {counted(count, 'material')}"
    if isinstance(vertices, VerticesByAngles):
        if not isinstance(chains.events, str):
            raise ValueFault("vertices by angles have one length and reflect; give the points")
        if len(vertices.incidences) != count:
            have = counted(len(vertices.incidences), "incidence")
            raise ValueFault(f"vertices have {have}, {media}")
        return vertices
    points = vertices
    if not is_traced(vertices):
        points = VERTICES.kept(viewed(as_argument("the array of vertices", vertices)))
    shape = np.shape(points)
    if shape[-2:] != (count + 2, 3):
        given = shape or shown(vertices)
        raise ValueFault(f"vertices must have shape (..., m + 2, 3), {media}, not {given}")
    return points


def _path_along(vertices: Iterable[ChainVertex], intensity: Any) -> PathGraph:
    """Return the path of light from vertex to vertex."""
    path = PathGraph()
    node = path.add("light", Source(intensity))
    for place, vertex in enumerate(vertices, 1):
        node = node >> path.add(f"vertex{place}", vertex)
    node >> path.add("eye", Detector())
    return path


def _normals_checked(points: Floats, normals: Any, chains: Histories, bad: IfBad) -> Histories:
    """Return the chains of points (..., m + 2, 3) whose normals (..., m, 3) are theirs."""
    sides = _sides(chains)
    if sides is None:
        raise ValueFault("normals that refract need media that are known; leave them out")
    normals = as_argument("the array of normals", normals)
    check_broadcast({"vertices": points.shape[:-2], "normals": normals.shape[:-2]})
    ended = chains.ended
    if ended is not None and normals.shape[-2:] == (chains.count, 3):
        points = _turned_back(points, ended)
        normals = np.where(ended[..., np.newaxis], 1.0, normals)
    off, sentence = off_normals(points, normals, sides)
    if sentence and bad == "refuse":
        raise ValueFault(sentence)
    if not sentence:
        return chains
    return replace(chains, events=np.where(off[..., np.newaxis], Event.CANNOT, chains.codes))


def _sides(chains: Histories) -> Floats | None:
    """Return the indices (..., m, 2) in front of and behind the vertices, as normals need them.

    They are over the larger one; None where they are not known.
    """
    events = chains.codes
    front, results = known_index(chains.outside), []
    for place, material in enumerate(chains.materials):
        refracts = events[..., place] == Event.REFRACTS
        n1 = n2 = np.ones(())
        if np.any(refracts):
            behind = known_index(material)
            if front is None or behind is None:
                return None
            n1, n2 = front[0], behind[0]
            front = KnownIndex(np.where(refracts, n2, n1), front.k)
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
        where = ended[..., place, np.newaxis]
        np.copyto(result[..., place + 2, :], result[..., place, :], where=where)
    return result


_TURNED = 2.0**-50
"""The deviation below which light goes straight on, which changes nothing."""


def _refuse_doubtful(chains: Histories, vertices: Any, there: Any) -> None:
    """Raise where each chain may as well refract at a vertex (..., m) as reflect."""
    points, front = known(vertices), known_index(chains.outside)
    if points is None or front is None:
        return
    events, readings = "", ""
    for place, material in enumerate(chains.materials):
        behind = known_index(material)
        first = _may_refract(points, front, behind, place, there)
        if first is None:
            events += REFLECTS
            continue
        events += REFRACTS
        readings = readings or (
            f"light is turned by {deviation(first[2:]):.6g} deg at vertex {place + 1}"
            f"{of_chain(0, points.shape[:-2])}, which a reflection does, and a refraction from "
            f"n = {first[0]:.6g} into n = {first[1]:.6g}"
        )
        front = behind
    if readings:
        one = f"events='{REFLECTS * len(events)}' where it is reflected"
        raise ValueFault(f"{readings}; say which, {one}, events='{events}' where it goes through")


def _may_refract(points: Any, front: Any, behind: Any, place: int, there: Any) -> Any:
    """Return n on both sides of a vertex and the points around it, of the first chain, or None.

    None unless all chains that have it may refract there.
    """
    if behind is None or any(np.any(k) or np.any(n <= 0.0) for n, k in (front, behind)):
        return None
    around = [points[..., at, axis] for at in range(place, place + 3) for axis in range(3)]
    arrays, has, first = [front[0], behind[0], *around], np.ones(1, bool), None
    try:
        has, *_ = np.broadcast_arrays(has if there is None else there[..., place], has, *arrays)
    except ValueError:
        return None  # A fault of its own.
    for piece in pieces_of(has.size):
        where = np.unravel_index(np.arange(piece.start, piece.stop), has.shape)
        some = has[where]
        numbers = [np.broadcast_to(each, has.shape)[where][some] for each in arrays]
        with np.errstate(all="ignore"):
            *_, cos, sin = REFRACTION.made_for(NUMPY)(*numbers)
            if not np.all((cos >= 0.0) & (sin > _TURNED)):
                return None
        if first is None and np.any(some):
            first = [float(each[0]) for each in numbers]
    return first
