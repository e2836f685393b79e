"""Chains of vertices that light goes along: as points, or by angles."""

from optipath.elements.vertices.by_angles import VerticesByAngles, counted, vertices_from_angles
from optipath.elements.vertices.coordinates import Coordinates, coordinates
from optipath.elements.vertices.frame import VertexFrame
from optipath.elements.vertices.normals import normal_faults
from optipath.elements.vertices.place import PlaceInChain
from optipath.elements.vertices.vertex_domain import VERTICES, Vertices, VerticesDomain

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
    "normal_faults",
    "vertices_from_angles",
]
