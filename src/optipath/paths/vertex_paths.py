"""Paths out of the points that light passes: a reflection or refraction at each but the ends."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.vertex_chain import (
    BAD,
    VERTICES,
    VerticesByAngles,
    counted,
    legs_fit,
    viewed,
)
from optipath.errors import PathError, ValueFault
from optipath.faults import shown, unknown
from optipath.materials.index_domains import OUTSIDE
from optipath.paths.chains import (
    apart_where_absorbed,
    histories,
    index_parts,
    known,
    normals_checked,
    path_along,
    refuse_doubtful,
    vertices_of,
)
from optipath.paths.open_histories import OpenHistories, open_histories
from optipath.values.arrays import as_argument, entries_of
from optipath.values.jax_values import is_traced
from optipath.values.parameters import Parameter
from optipath.values.precision import is_whole
from optipath.values.use import Use, checked_later, faults_of, stored_value

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import numpy.typing as npt

    from optipath.elements.vertex_chain import IfBad
    from optipath.paths.path_graph import PathGraph


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
        parts = {"events": events, "ids": ids, "lengths": lengths}
        is_open = any(isinstance(part, Parameter) for part in parts.values())
        most = _count(count, media, vertices, parts) if is_open or count is not None else 0
        chains: Any
        if is_open:
            chains = open_histories(media, index_parts("outside", start)[0], most, parts)
        else:
            chains = histories(media, events, ids, lengths, batch)
        points = _points(vertices, chains)
        if bad == "mask" and not is_open:
            chains = apart_where_absorbed(chains)
        path = _checked(points, chains, intensity, start, bad)
        if normals is not None:
            if is_open or not isinstance(points, np.ndarray):
                raise ValueFault("normals need points that are known; leave them out")
            checked = normals_checked(points, normals, chains, start, bad)
            if checked is not chains:
                path = _checked(points, checked, intensity, start, bad)
        elif events is None and not (is_open or isinstance(points, VerticesByAngles)):
            # Light may not arrive everywhere.
            there = None if chains.ended is None else ~chains.ended
            if bad == "mask" and isinstance(points, np.ndarray):
                there = legs_fit(points)[..., 1:] & (True if there is None else there)
            refuse_doubtful(chains, points, start, there)
    return path


def _count(told: Any, media: Sequence[Any], vertices: Any, parts: Mapping[str, Any]) -> int:
    """Return how many vertices chains have at most, by the first that says so."""
    if told is not None and not is_whole(told, most=_MOST):
        raise ValueFault(f"count must be a whole number above 0, not {shown(told)}")
    ids, points = (np.shape(known(value)) for value in (parts["ids"], vertices))
    own = (len(media),) if parts["ids"] is None else ids[-1:]
    if not own:  # Of letters for each vertex, or one text for all chains.
        text = parts["events"]
        own = (len(text),) if isinstance(text, str) else np.shape(text)[1:][-1:]
    if not own and len(points) > 1:
        own = (points[-2] - 2,)
    if not own and told is None:
        raise ValueFault("ids is a parameter; say how many vertices chains have, count=...")
    if told is not None and own and told != own[0]:
        by = "materials" if parts["ids"] is None else "ids" if ids else "events or vertices"
        raise ValueFault(f"count is {told}, but {by} say {own[0]}; leave it out")
    return int(told or own[0])


def _checked(points: Any, chains: Any, intensity: Any, start: Any, bad: IfBad) -> PathGraph:
    with checked_later():  # The path names the vertices, and looks at their array once.
        if isinstance(chains, OpenHistories):
            vertices = chains.vertices(points, bad)
        else:
            vertices = vertices_of(points, chains, start, bad)
        path = path_along(vertices, intensity)
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
