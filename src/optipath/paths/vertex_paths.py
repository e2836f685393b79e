"""Paths out of the points that light passes: a reflection or refraction at each but the ends."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.vertex_chain import BAD, VERTICES, VerticesByAngles, counted, legs_fit
from optipath.errors import OptipathError, PathError, ValueFault, shown, unknown
from optipath.materials.index_domains import OUTSIDE
from optipath.paths.chain_events import medium_faults, passable
from optipath.paths.chain_histories import Histories, apart_where_absorbed, histories
from optipath.paths.chain_media import doubtful_vertex, normals_checked, path_of_chains
from optipath.paths.path_graph import PathGraph
from optipath.values.arrays import as_argument, entries_of
from optipath.values.jax_values import is_traced
from optipath.values.parameters import Parameter
from optipath.values.use import checked_later, stored_value

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt


def path_from_vertices(
    vertices: Any,
    materials: Sequence[Any],
    normals: npt.ArrayLike | None = None,
    intensity: Any = 1.0,
    *,
    events: Any = None,
    outside: Any = 1.0,
    ids: npt.ArrayLike | None = None,
    lengths: npt.ArrayLike | None = None,
    bad: str = "refuse",
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
        1e70. A parameter is given arrays of this shape when the path runs.
    materials : sequence of m float, complex, array_like, Material or Parameter
        The index of refraction on the other side of each surface, in order from the light. Light
        that is reflected stays in its medium; light that is refracted goes on in this one, which
        must not absorb. With `ids`, a palette of numbers.
    normals : array_like, shape (..., m, 3), optional
        The normals of the surfaces, of any length and to either side, to be checked: each is to
        be along that of the vertex to within 1e-6 rad, or the rounding of half precision.
    intensity : float, array_like or Parameter, optional
        Of the unpolarised light.
    events : str, sequence of str, or array_like of str, shape (..., m), optional
        A letter for each vertex, in order from the light: R where it is reflected, T where it is
        refracted (let through). One text is for all chains, several are one for each, whose
        letters say how long it is; an array has a single letter for each vertex. Without it every
        vertex reflects, and normals say so, or points that are known: where they may as well be
        those of a refraction, `events` is asked for.
    outside : float, array_like, Material or Parameter, optional
        The index of the medium that the light starts in, without absorption.
    ids : array_like of int, shape (..., m), optional
        Which of the materials, counted from 0, is on the other side of each surface of each chain.
    lengths : array_like of int, shape (...), optional
        How many vertices each chain has, 1 to m. What stands behind its last point is not read;
        its light and its frame are those of its own last leg.
    bad : {"refuse", "mask"}, optional
        Whether chains that cannot be are refused, or their light is NaN.

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
    several, not_several = _several(materials)
    chains, faults = histories(several, events, ids, lengths, _batch_of(vertices))
    points, not_points = _chain(vertices, chains.count)
    of_start = medium_faults("outside", outside, OUTSIDE)
    start = 1.0 if of_start else stored_value("outside", outside, OUTSIDE)
    of_bad = unknown("bad", bad, BAD)
    bad = BAD[0] if of_bad else bad
    faults += [*not_points, *of_start, *of_bad]
    if isinstance(points, VerticesByAngles) and isinstance(chains.events, np.ndarray):
        faults.append("vertices by angles have one length and reflect; give the points")
    if not several:
        raise PathError(*faults, *not_several)
    if bad != "mask" and isinstance(chains.events, str):
        media, of_media = passable(chains.events, chains.materials)
        chains, faults = replace(chains, materials=tuple(media)), faults + of_media
    is_sound = not faults
    if bad == "mask" and is_sound:
        chains = apart_where_absorbed(chains)
    path, more, is_sound = _composed(points, chains, intensity, start, bad, is_sound=is_sound)
    faults += more
    known = isinstance(points, np.ndarray)
    if normals is not None and is_sound and not known:
        faults.append("normals are checked against points that are known; leave them out")
    elif normals is not None:
        of_points = points if is_sound else None
        masked, more = normals_checked(of_points, normals, chains, start, bad)
        faults += more
        if masked is not chains and not faults:
            path, *_ = _composed(points, masked, intensity, start, bad, is_sound=True)
    elif events is None and not faults and not isinstance(points, VerticesByAngles):
        doubt = doubtful_vertex(points, chains.materials, start, _there(points, chains, bad))
        faults += [doubt] * bool(doubt)
    if faults:
        raise PathError(*faults)
    return path


def _composed(
    points: Any, chains: Histories, intensity: Any, start: Any, bad: str, *, is_sound: bool
) -> tuple[PathGraph, list[str], bool]:
    """Return the path, what is wrong with it, and whether points and histories are not."""
    with checked_later():  # Composing names the vertices, and looks at their array once.
        if not is_sound:  # With others in their place, so that the rest is checked too.
            points, chains, bad = _any_chain(chains.count), Histories(chains.materials), BAD[0]
        try:
            path = path_of_chains(points, chains, intensity, start, bad)
        except ValueFault as fault:
            return PathGraph(), list(fault.faults), False
    try:
        path.compose()
    except PathError as error:
        return path, list(error.faults), is_sound and _is_sound(points, chains, bad)
    return path, [], is_sound


def _is_sound(points: Any, chains: Histories, bad: str) -> bool:
    masks = bad == "mask" or isinstance(chains.events, np.ndarray)
    try:
        replace(VERTICES, tail=(chains.count + 2, 3), masks=masks).check("vertices", points)
    except ValueFault:
        return not isinstance(points, np.ndarray)
    return True


def _there(points: Any, chains: Histories, bad: str) -> Any:
    """Return at which vertices of which chains light arrives, where that is not all of them."""
    if chains.ended is None and (bad != "mask" or not isinstance(points, np.ndarray)):
        return None
    there = np.ones(chains.count, bool) if chains.ended is None else ~chains.ended
    if bad == "mask" and isinstance(points, np.ndarray):
        there = there & legs_fit(points)[..., 1:]
    return there


def _batch_of(vertices: Any) -> tuple[int, ...]:
    """Return the shape of a batch of points, as far as it is known."""
    if isinstance(vertices, (Parameter, VerticesByAngles)):
        return ()
    try:
        shape: tuple[int, ...] = np.shape(as_argument("the array of vertices", vertices))
    except (TypeError, ValueError, OptipathError):
        return ()  # A fault of its own.
    return shape[:-2]


def _any_chain(count: int) -> VerticesByAngles:
    return VerticesByAngles((0.5,) * count, (0.0,) * (count - 1))


def _several(materials: Any) -> tuple[Sequence[Any], list[str]]:
    """Return the materials one by one, or what is wrong with them."""
    try:
        several = entries_of("materials", "one for each vertex", materials)
    except ValueFault as fault:
        return (), list(fault.faults)
    several = tuple(_real_again(medium) for medium in several)
    none = "materials must be a sequence of one for each vertex, and there is none"
    return several, [none] * (not several)


def _real_again(medium: Any) -> Any:
    """Return a medium that an array with others has made complex as the real one that it is."""
    of_numpy = isinstance(medium, (np.ndarray, np.generic)) and medium.dtype.kind == "c"
    is_complex = isinstance(medium, complex) or of_numpy
    return medium.real if is_complex and not np.any(medium.imag) else medium


def _chain(vertices: Any, count: int) -> tuple[Any, list[str]]:
    """Return vertices that nobody can change, and what is wrong with their shape."""
    if isinstance(vertices, Parameter):
        return vertices, []
    if isinstance(vertices, VerticesByAngles):
        result = len(vertices.incidences)
        fault = f"vertices have {counted(result, 'incidence')}{_for(count)}"
        return vertices, [fault] * (result != count)
    try:
        traced = is_traced(vertices)
        chain = (
            vertices if traced else VERTICES.kept(as_argument("the array of vertices", vertices))
        )
    except ValueFault as fault:
        return None, list(fault.faults)
    shape = np.shape(chain)
    if shape[-2:] == (count + 2, 3) or (not count and len(shape) > 1 and shape[-1] == 3):
        return chain, []
    argument = shape or shown(vertices)
    return chain, [f"vertices must have shape (..., m + 2, 3){_for(count)}, not {argument}"]


def _for(count: int) -> str:
    return f", m = {count} for {counted(count, 'material')}" if count else ""
