"""Paths out of the points that light passes: a reflection or refraction at each but the ends."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.refracting_vertex import RefractingVertex
from optipath.elements.source import Source
from optipath.elements.specular_vertex import SpecularVertex
from optipath.elements.terminal import Detector
from optipath.elements.vertices.by_angles import VerticesByAngles, counted
from optipath.elements.vertices.normals import normal_faults
from optipath.elements.vertices.vertex_domain import VERTICES
from optipath.errors import PathError, ValueFault, shown
from optipath.paths.grazing_or_through import doubtful_vertex
from optipath.paths.known_media import sides_of
from optipath.paths.path_graph import PathGraph
from optipath.paths.vertex_events import (
    REFLECTS,
    event_faults,
    media_in_front,
    medium_faults,
    passable,
)
from optipath.values.arrays.array_likes import as_given, entries_of
from optipath.values.arrays.jax_values import is_traced
from optipath.values.domains.indices import OUTSIDE
from optipath.values.made import checked_later, kept_value
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt


def path_from_vertices(
    vertices: Any,
    materials: Sequence[Any],
    normals: npt.ArrayLike | None = None,
    intensity: Any = 1.0,
    *,
    events: str | None = None,
    outside: Any = 1.0,
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
        must not absorb.
    normals : array_like, shape (..., m, 3), optional
        The normals of the surfaces, of any length and to either side, to be checked: each is to
        be along that of the vertex to within 1e-6 rad, or the rounding of half precision.
    intensity : float, array_like or Parameter, optional
        Of the unpolarised light.
    events : str, optional
        A letter for each vertex, in order from the light: R where it is reflected, T where it is
        refracted (let through). Without it every vertex reflects, and normals say so, or points
        that are known: where they may as well be those of a refraction, `events` is asked for.
    outside : float, array_like, Material or Parameter, optional
        The index of the medium that the light starts in, without absorption.

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
    """
    several, not_several = _several(materials)
    chain, faults = _chain(vertices, len(several))
    of_events = [] if events is None else event_faults(events, len(several))
    of_start = medium_faults("outside", outside, OUTSIDE)
    faults += [*of_events, *of_start]
    if not several:
        raise PathError(*faults, *not_several)
    happens = REFLECTS * len(several) if events is None or of_events else events
    several, of_media = passable(happens, several)
    faults += of_media
    # With others in place of what is faulty, so that the rest is checked too.
    start = 1.0 if of_start else kept_value("outside", outside, OUTSIDE)
    happens = REFLECTS * len(several) if faults else happens
    with checked_later():  # Composing names the vertices, and looks at their array once.
        given = _any_chain(len(several)) if faults else chain
        path = _path(given, several, intensity, happens, start)
    is_sound = not faults
    try:
        path.compose()
    except PathError as error:
        faults += error.faults
        is_sound = is_sound and _is_sound(chain, len(several))
    if normals is not None and is_sound and not isinstance(chain, np.ndarray):
        faults.append("normals are checked against points that are known; leave them out")
    elif normals is not None:
        faults += _normal_faults(chain if is_sound else None, normals, several, happens, start)
    elif events is None and not faults and not isinstance(chain, VerticesByAngles):
        doubt = doubtful_vertex(chain, several, start)
        faults += [doubt] * bool(doubt)
    if faults:
        raise PathError(*faults)
    return path


def _normal_faults(
    chain: Any, normals: Any, materials: Sequence[Any], events: str, outside: Any
) -> list[str]:
    sides = sides_of(events, materials, outside)
    if sides is None:
        return ["normals that refract are checked against media that are known; leave them out"]
    return normal_faults(chain, normals, len(materials), sides)


def _is_sound(chain: Any, count: int) -> bool:
    try:
        replace(VERTICES, tail=(count + 2, 3)).check("vertices", chain)
    except ValueFault:
        return not isinstance(chain, np.ndarray)
    return True


def _path(
    chain: Any, materials: Sequence[Any], intensity: Any, events: str, outside: Any
) -> PathGraph:
    path = PathGraph()
    node, count = path.add("light", Source(intensity)), len(materials)
    each = zip(events, materials, media_in_front(events, materials, outside), strict=True)
    for place, (event, material, front) in enumerate(each, 1):
        kind = SpecularVertex if event == REFLECTS else RefractingVertex
        vertex = kind(material, chain, place, front, count)
        node = node >> path.add(f"vertex{place}", vertex)
    node >> path.add("eye", Detector())
    return path


def _any_chain(count: int) -> VerticesByAngles:
    return VerticesByAngles((0.5,) * count, (0.0,) * (count - 1))


def _several(materials: Any) -> tuple[Sequence[Any], list[str]]:
    """Return the materials one by one, or what is wrong with them."""
    try:
        several = entries_of("materials", "one for each vertex", materials)
    except ValueFault as fault:
        return (), list(fault.faults)
    none = "materials must be a sequence of one for each vertex, and there is none"
    return several, [none] * (not several)


def _chain(vertices: Any, count: int) -> tuple[Any, list[str]]:
    """Return vertices that nobody can change, and what is wrong with their shape."""
    if isinstance(vertices, Parameter):
        return vertices, []
    if isinstance(vertices, VerticesByAngles):
        found = len(vertices.incidences)
        fault = f"vertices have {counted(found, 'incidence')}{_for(count)}"
        return vertices, [fault] * (found != count)
    try:
        traced = is_traced(vertices)
        chain = vertices if traced else VERTICES.kept(as_given("the array of vertices", vertices))
    except ValueFault as fault:
        return None, list(fault.faults)
    shape = np.shape(chain)
    if shape[-2:] == (count + 2, 3) or (not count and len(shape) > 1 and shape[-1] == 3):
        return chain, []
    given = shape or shown(vertices)
    return chain, [f"vertices must have shape (..., m + 2, 3){_for(count)}, not {given}"]


def _for(count: int) -> str:
    return f", m = {count} for {counted(count, 'material')}" if count else ""
