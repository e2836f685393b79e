"""Chains of vertices that light goes along: as points, or by angles."""

from optipath.vertices.by_angles import VerticesByAngles, counted, vertices_from_angles
from optipath.vertices.coordinates import Coordinates, coordinates
from optipath.vertices.domain import VERTICES, Vertices, VerticesDomain
from optipath.vertices.frame import VertexFrame
from optipath.vertices.normals import normal_faults
from optipath.vertices.place import PlaceInChain, is_count

__all__ = [
    "VERTICES",
    "Coordinates",
    "PlaceInChain",
    "VertexFrame",
    "Vertices",
    "VerticesByAngles",
    "VerticesDomain",
    "coordinates",
    "counted",
    "is_count",
    "normal_faults",
    "vertices_from_angles",
]
