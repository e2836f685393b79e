"""Paths out of the points that light passes: a specular reflection at each but the ends."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.source import Source
from optipath.elements.specular_vertex import SpecularVertex
from optipath.elements.terminal import Detector
from optipath.elements.vertices.by_angles import VerticesByAngles, counted
from optipath.elements.vertices.normals import normal_faults
from optipath.elements.vertices.vertex_domain import VERTICES
from optipath.errors import PathError, ValueFault, shown
from optipath.paths.path_graph import PathGraph
from optipath.values.arrays.array_likes import as_given, entries_of
from optipath.values.arrays.jax_values import is_traced
from optipath.values.made import checked_later
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt


def path_from_vertices(
    vertices: Any,
    materials: Sequence[Any],
    normals: npt.ArrayLike | None = None,
    intensity: Any = 1.0,
) -> PathGraph:
    """Return the path of light from point to point, reflected specularly at each but the ends.

    The surfaces tilt themselves: each is perpendicular to the bisector of its two legs. Angles
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
        The index of refraction behind each surface, in order from the light.
    normals : array_like, shape (..., m, 3), optional
        The normals of the surfaces, of any length and to either side, to be checked: each is to
        be along the bisector to within 1e-6 rad, or the rounding of half precision.
    intensity : float, array_like or Parameter, optional
        Of the unpolarised light.

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
    """
    several, not_several = _several(materials)
    chain, faults = _chain(vertices, len(several))
    if not several:
        raise PathError(*faults, *not_several)
    # With others in place of faulty vertices, so that the rest is checked too.
    with checked_later():  # Composing names the vertices, and looks at their array once.
        path = _path(_any_chain(len(several)) if faults else chain, several, intensity)
    is_sound = not faults
    try:
        path.compose()
    except PathError as error:
        faults += error.faults
        is_sound = is_sound and _is_sound(chain, len(several))
    if normals is not None and is_sound and not isinstance(chain, np.ndarray):
        faults.append("normals are checked against points that are known; leave them out")
    elif normals is not None:
        faults += normal_faults(chain if is_sound else None, normals, len(several))
    if faults:
        raise PathError(*faults)
    return path


def _is_sound(chain: Any, count: int) -> bool:
    try:
        replace(VERTICES, tail=(count + 2, 3)).check("vertices", chain)
    except ValueFault:
        return not isinstance(chain, np.ndarray)
    return True


def _path(chain: Any, materials: Sequence[Any], intensity: Any) -> PathGraph:
    path = PathGraph()
    node = path.add("light", Source(intensity))
    for place, material in enumerate(materials, 1):
        vertex = SpecularVertex(material, chain, place, reflections=len(materials))
        node = node >> path.add(f"vertex{place}", vertex)
    node >> path.add("eye", Detector())
    return path


def _any_chain(count: int) -> VerticesByAngles:
    return VerticesByAngles((0.5,) * count, (0.0,) * (count - 1))


def _several(materials: Any) -> tuple[tuple[Any, ...], list[str]]:
    """Return the materials one by one, or what is wrong with them."""
    try:
        several = entries_of("materials", "one for each reflection", materials)
    except ValueFault as fault:
        return (), list(fault.faults)
    none = "materials must be a sequence of one for each reflection, and there is none"
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
