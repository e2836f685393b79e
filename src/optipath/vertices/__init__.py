"""Chains of vertices that light goes along: as points, or by angles."""

from optipath.vertices.by_angles import VerticesByAngles, vertices_from_angles
from optipath.vertices.coordinates import Coordinates, coordinates
from optipath.vertices.domain import Vertices, VerticesDomain
from optipath.vertices.frame import VertexFrame
from optipath.vertices.normals import normal_faults

__all__ = [
    "Coordinates",
    "VertexFrame",
    "Vertices",
    "VerticesByAngles",
    "VerticesDomain",
    "coordinates",
    "normal_faults",
    "vertices_from_angles",
]
