"""The angles that a surface of a chain is given, where the chain is given by angles."""

from __future__ import annotations

from typing import Any

from optipath.elements.chain_vertex import ChainVertex
from optipath.elements.vertices.by_angles import VerticesByAngles


def angles_in_chain(element: Any) -> tuple[Any, Any]:
    """Return the incidence at a surface, and the turn of its plane against that of the one before.

    Units: incidence, turn in radians.

    Examples
    --------
    >>> import optipath as op
    >>> path = op.load_preset("npgr026-3d")
    >>> [angle.name for angle in angles_in_chain(path.element("X1"))]
    ['delta', 'rho']
    """
    if not isinstance(element, ChainVertex):
        return None, None
    chain, place = element.vertices, int(element.place)
    if not isinstance(chain, VerticesByAngles):
        return None, None
    way = -1 if chain.backwards else 1
    turn = chain.turns[::way][place - 2] if place > 1 else None
    return chain.incidences[::way][place - 1], turn
