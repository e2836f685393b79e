"""How the ports of an element stand to one another."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.elements.boundary_frames import BoundaryElement
from optipath.elements.chain_vertex import ChainVertex
from optipath.elements.faraday_rotator import FaradayRotator
from optipath.elements.medium import Medium
from optipath.elements.mirror import Mirror
from optipath.elements.rotator import Rotator
from optipath.elements.splitter import Splitter
from optipath.elements.terminal import Detector, Terminal
from optipath.elements.world_angle import angles_of, operands_of
from optipath.plots.space.told_values import number

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.elements.element import Element

    Array = npt.NDArray[np.float64]

_RIGHT = np.pi / 2.0
_SCHEMATIC = np.pi / 4.0


class Posture(NamedTuple):
    """The frames of the ports of an element, in a basis of its own.

    Shapes: axes (3, 3); normal, across (3,).
    """

    axes: dict[str, Array]
    normal: Array | None
    across: Array | None
    role: str
    told: bool = True


def turn_about_x(angle: float) -> Array:
    """Return the matrix of a turn about x by an angle in radians."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def turn_about_z(angle: float) -> Array:
    """Return the matrix of a turn about z by an angle in radians."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def posture_of(element: Element) -> Posture:
    """Return how the ports of an element stand to one another, by its values alone.

    Examples
    --------
    >>> import optipath as op
    >>> found = posture_of(op.Interface(1.5, "30 deg"))
    >>> print(found.axes["in"][:, 2].round(3), found.axes["reflected"][:, 2].round(3))
    [ 0.    -0.866  0.5  ] [0.    0.866 0.5  ]
    """
    ports = (*element.inputs, *element.outputs)
    if isinstance(element, BoundaryElement):
        return _surface(ports, *angles_at(element), "surface")
    if isinstance(element, ChainVertex):
        return Posture({}, None, None, "surface")
    if isinstance(element, Mirror):
        return _surface(ports, 0.0, 0.0, "mirror")
    if isinstance(element, Splitter):
        return _surface(ports, _SCHEMATIC, _SCHEMATIC, "surface")
    if element.straight:
        return _straight(element, ports)
    return _surface(ports, _SCHEMATIC, _SCHEMATIC, "surface")._replace(told=False)


def angles_at(element: Any) -> tuple[float, float]:
    """Return the angles of light in front of a boundary and behind it, in radians."""
    front, behind = angles_of(np, *(operand.numbers() for operand in operands_of(element)))
    return float(front), float(behind)


def has_axis(element: Any) -> bool:
    """Tell whether the angle of an element is that of an axis, and no turn of the light.

    Examples
    --------
    >>> import optipath as op
    >>> has_axis(op.Polarizer(0.3)), has_axis(op.Rotator(0.3)), has_axis(op.Medium(1.0))
    (True, False, False)
    """
    if getattr(element, "angle", None) is None or isinstance(element, Rotator | FaradayRotator):
        return False
    along = (element.retardance, element.dichroism) if isinstance(element, Medium) else (1.0,)
    return any(number(value) != 0.0 for value in along)


def _surface(ports: tuple[str, ...], front: float, behind: float, role: str) -> Posture:
    """Return ports about x = s, in the basis of x, the normal and along the surface.

    x is along k_out cross k_in (docs/conventions.md), which is the normal cross the light.
    """
    angles = {
        "in": _RIGHT - front,
        "reflected": front - _RIGHT,
        "transmitted": _RIGHT - behind,
        "back": behind - _RIGHT,
    }
    outward = angles["reflected"]
    axes = {port: turn_about_x(angles.get(port, outward)) for port in ports}
    x, normal, _ = np.eye(3)
    return Posture(axes, normal, x, role)


def _straight(element: Element, ports: tuple[str, ...]) -> Posture:
    axes = {port: np.eye(3) for port in ports}
    if isinstance(element, Terminal):
        return Posture(axes, None, None, "detector" if isinstance(element, Detector) else "dump")
    if not element.inputs:
        return Posture(axes, None, None, "source")
    if element.merges:
        return Posture(axes, None, None, "other")
    x, _, z = np.eye(3)
    return Posture(axes, -z, x, "plate")
