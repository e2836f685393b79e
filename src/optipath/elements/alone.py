"""An element by itself: its Mueller matrix and its action on light, without a path."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.boundary_media import MediaOfBoundary, arriving_waves
from optipath.elements.frame_checks import azimuth_at
from optipath.elements.own_element import couplings_of, own_ways
from optipath.errors import PathError
from optipath.faults import shown
from optipath.kernels.catalog import REFLECTION
from optipath.light.frame import Frame
from optipath.light.mueller import Mueller
from optipath.values.agreement import first_faults
from optipath.values.arrays import broadcast_fault, enough_for, joint_shape
from optipath.values.curve_value import CurveValue
from optipath.values.operands import Operand
from optipath.values.use import faults_of, known_among

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.elements.coupling import Coupling
    from optipath.values.use import Use


NO_FRAMES: Mapping[str, Frame] = MappingProxyType({})
"""Of an element that does not stand in the world."""

_TWO_MATRICES = 256
"""How many bytes a matrix and what it is made of have."""


def mueller_alone(
    element: Any,
    enters: str = "in",
    leaves: str = "",
    method: str = "stable",
    placed: tuple[Frame | None, Frame | None] = (None, None),
    before: Frame | None = None,
) -> Mueller:
    """Return the Mueller matrix of an element."""
    REFLECTION.by_method(method)
    owner = element.kind or type(element).__name__
    for port in (enters, leaves):
        if not isinstance(port, str):
            raise PathError(f"a port of {owner} must be a text, not {shown(port)}")
    for argument in placed:
        if argument is not None and not isinstance(argument, Frame):
            raise PathError(f"a frame of {owner} must be a Frame, not {shown(argument)}")
    leaves, ports = leaves or element.natural, {*element.inputs, *element.outputs}
    pairs = zip((enters, leaves), placed, strict=True)
    frames = {port: frame for port, frame in pairs if frame is not None and port in ports}
    batch = checked_alone(element, enters, frames)
    couplings = couplings_of(element)
    entering = [coupling for coupling in couplings if coupling.enters == enters]
    wanted = next((coupling for coupling in entering if coupling.leaves == leaves), None)
    if wanted is None:
        raise PathError(_no_way(owner, enters, leaves, couplings))
    with enough_for(batch, _TWO_MATRICES, error=PathError):
        for way in own_ways(owner, element, entering, method):
            if way.are_known():
                PathError.raise_for(text for _, text in way.faults(Operand.numbers))
        matrix = wanted.matrix(method)
    arriving = _frame_at(element, enters, frames) or turned_alone(element, enters, before)
    leaving = _frame_at(element, leaves, frames or {enters: arriving}) or Frame()
    # An azimuth is in the frames alone.
    return Mueller.of(
        np.broadcast_to(matrix, (*batch, 4, 4)) if batch else matrix, arriving, leaving
    )


def checked_alone(element: Any, enters: str, frames: Mapping[str, Frame] = NO_FRAMES) -> Any:
    """Return the shape of the batch of an element, all of whose values are known and allowed."""
    owner = element.kind or type(element).__name__
    if followed := element.followed() if isinstance(element, MediaOfBoundary) else ():
        raise PathError(
            f"{owner} takes its {' and '.join(followed)} over from a boundary before it (FOLLOWS), "
            f"and alone it has none; give numbers"
        )
    uses = element.uses(owner) + element.uses_entered(owner, enters)
    open_ones = [_open(owner, use) for use in uses if use.is_open]
    shapes = {use.owner: use.batch_shape(numbers) for use, numbers in known_among(uses)}
    faults = list(dict.fromkeys(faults_of(uses) + open_ones))
    faults = faults or broadcast_fault(shapes) or element.frame_faults(owner, frames)
    faults = faults or first_faults(
        [*arriving_waves(owner, element, enters), *element.agreements(owner)]
    )
    is_placed = not faults and element.frame_of(enters, frames) is not None
    if is_placed and np.any(Operand(azimuth_at(element, enters)).numbers()):
        faults = [f"{owner} is turned by its world frames and by an azimuth; give one of them"]
    PathError.raise_for(faults)
    return joint_shape(*shapes.values())


def _no_way(owner: str, enters: str, leaves: str, couplings: tuple[Coupling, ...]) -> str:
    """Say that there is no such way, and which there are."""
    ways = [(c.enters, c.leaves) for c in couplings if c.enters]
    if not ways:
        return f"{owner} lets no light through; ask an element between source and detector"
    known = ", ".join(f"{begin} -> {end}" for begin, end in ways)
    return (
        f"{owner} has no way '{enters} -> {leaves or '...'}'; say the ports, such as "
        f'element.mueller("{ways[0][0]}", "{ways[0][1]}"); there are: {known}'
    )


def _open(owner: str, use: Use) -> str:
    """Say that a value is not known yet."""
    by_wavelength = isinstance(use.value, CurveValue)
    cure = ", as it depends on the wavelength; give what stands there .at('550 nm')" * by_wavelength
    return f"{use.value.called} of {owner} has no value yet{cure}"


def _frame_at(element: Any, port: str, frames: dict[str, Frame]) -> Frame | None:
    """Return the frame of a port: given, or that which the element has by its values."""
    own = element.own_frame(port)
    return element.frame_of(port, frames) if own is None else own.frame({})  # type: ignore[no-any-return]


def turned_alone(element: Any, enters: str, before: Frame | None = None) -> Frame:
    """Return the frame that light arrives in, turned by the azimuth of an element."""
    frame, azimuth = before or Frame(), Operand(azimuth_at(element, enters)).numbers()
    return frame.turned_by(azimuth) if np.any(azimuth) else frame
