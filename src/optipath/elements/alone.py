"""What an element does to light by itself, without a path around it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.elements.media_of_boundary import MediaOfBoundary
from optipath.elements.own_couplings import couplings_of
from optipath.elements.own_ways import own_ways
from optipath.errors import PathError, shown
from optipath.kernels.catalogue import REFLECTION
from optipath.light.frames import Frame
from optipath.light.mueller.matrix import Mueller
from optipath.values.arrays.memory import enough_for
from optipath.values.arrays.shapes import broadcast_fault, joint_shape
from optipath.values.made import faults_of
from optipath.values.operands import Operand

if TYPE_CHECKING:
    from optipath.elements.coupling import Coupling
    from optipath.elements.own_ways import OwnWays

_TWO_MATRICES = 256
"""How many bytes a matrix and what it is made of have."""


def mueller_alone(
    element: Any, enters: str, leaves: str, method: str, placed: tuple[Frame | None, Frame | None]
) -> Mueller:
    """Return the Mueller matrix of an element.

    Parameters
    ----------
    element : Element
        The element, all of whose values are known.
    enters, leaves : str
        The ports; an empty out-port is the natural one.
    method : str
        How Fresnel's equations are computed.
    placed : tuple of Frame or None
        The world frames of the two ports, where they are given.

    Returns
    -------
    Mueller
        Between the two frames, or those that the element has by its values.

    Raises
    ------
    PathError
        With all faults at once, among them what no light can do, of an element of one's own.
    """
    REFLECTION.by_method(method)
    owner, (frame_in, frame_out) = element.kind or type(element).__name__, placed
    for port in (enters, leaves):
        if not isinstance(port, str):
            raise PathError(f"a port of {owner} must be a text, not {shown(port)}")
    leaves = leaves or element.natural
    followed = element.followed() if isinstance(element, MediaOfBoundary) else ()
    if followed:
        raise PathError(
            f"{owner} takes its {' and '.join(followed)} over from a boundary before it (FOLLOWS), "
            f"and alone it has none; give numbers"
        )
    uses = element.uses(owner) + element.uses_entered(owner, enters)
    open_ones = [
        f"parameter '{use.value.name}' of {owner} has no value yet" for use in uses if use.is_open
    ]
    shapes = {use.owner: use.known_shape() for use in uses if not use.is_open}
    for given in placed:
        if given is not None and not isinstance(given, Frame):
            raise PathError(f"a frame of {owner} must be a Frame, not {shown(given)}")
    if frame_in is not None and element.straight:
        frame_out = frame_out or frame_in
    pairs = ((enters, frame_in), (leaves, frame_out))
    frames = {port: frame for port, frame in pairs if frame is not None}
    faults = list(dict.fromkeys(faults_of(uses) + open_ones))
    faults = faults or broadcast_fault(shapes) or element.frame_faults(owner, frames)
    if faults:
        raise PathError(*faults)
    batch = joint_shape(*shapes.values())
    couplings = couplings_of(element)
    entering = [coupling for coupling in couplings if coupling.enters == enters]
    for coupling in entering:
        if coupling.leaves == leaves:
            with enough_for(batch, _TWO_MATRICES, error=PathError):
                _refuse_unphysical(own_ways(owner, element, entering, method))
                matrix = coupling.matrix(method)
            frame_in = frame_in or _own_frame(element, enters)
            return Mueller.of(matrix, frame_in, frame_out or _own_frame(element, leaves))
    raise PathError(_no_way(owner, enters, leaves, couplings))


def _no_way(owner: str, enters: str, leaves: str, couplings: tuple[Coupling, ...]) -> str:
    """Say that there is no such way, and which there are."""
    ways = [(c.enters, c.leaves) for c in couplings if c.enters]
    if not ways:
        where = "begins" if couplings else "ends"
        return f"{owner} lets no light through, which {where} there; ask an element between"
    known = ", ".join(f"{begin} -> {end}" for begin, end in ways)
    begin, end = next((way for way in ways if way[0] == enters), ways[0])
    return (
        f"{owner} has no way '{enters} -> {leaves or '...'}'; say the ports, such as "
        f'element.mueller("{begin}", "{end}") @ light; there are: {known}'
    )


def _refuse_unphysical(ways: list[OwnWays]) -> None:
    """Refuse what no light can do, as paths do."""
    known = [each for each in ways if each.are_known()]
    if faults := [text for each in known for _, text in each.faults(Operand.numbers)]:
        raise PathError(*faults)


def _own_frame(element: Any, port: str) -> Frame:
    own = element.own_frame(port)
    return own.frame({}) if own is not None else Frame()
