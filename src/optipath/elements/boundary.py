"""Boundaries in space: frames of the four ports, directions by reflection and Snell's law."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from optipath.elements.boundary_media import MediaOfBoundary
from optipath.elements.coupling import Coupling, numbers_of
from optipath.elements.element import Element
from optipath.elements.frame_checks import angle_between, incidence_between, x_faults
from optipath.kernels.fresnel.boundary import phase_index, refraction
from optipath.kernels.primitives import of_module
from optipath.light.frame import Frame
from optipath.materials.index_domains import FOLLOWS, INDEX, LIT_BEHIND
from optipath.values.agreement import Agreement, first_faults, is_single, text_of
from optipath.values.arrays import broadcast_fault
from optipath.values.operands import Operand, operand_of
from optipath.values.use import Use

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from optipath.values.operands import Operation


class FourPort(Element):
    """An element with two sides, and the ports of an `Interface`."""

    inputs: ClassVar[tuple[str, ...]] = ("in", "back")
    outputs: ClassVar[tuple[str, ...]] = ("reflected", "transmitted")
    natural: ClassVar[str] = "reflected"
    entry: ClassVar[str] = "in"
    straight: ClassVar[bool] = False
    _ports_back: ClassVar[dict[str, str]] = {
        "in": "reflected",
        "reflected": "in",
        "back": "transmitted",
        "transmitted": "back",
    }

    def _ways(
        self, front: Sequence[Operation], behind: Sequence[Operation]
    ) -> tuple[Coupling, ...]:
        """Return the couplings for what reflects, and what lets through, from either side."""
        return (
            Coupling("in", "reflected", (front[0],), reflects=True),
            Coupling("in", "transmitted", (front[1],)),
            Coupling("back", "transmitted", (behind[0],), reflects=True),
            Coupling("back", "reflected", (behind[1],)),
        )


class BoundaryElement(MediaOfBoundary, FourPort):
    """An element between the media in front, ``outside``, and behind, ``index``.

    All its ports share x = s; directions obey the laws of reflection and of Snell.
    """

    may_follow: ClassVar[tuple[str, ...]] = ("outside", "incidence")
    lit_behind: ClassVar[Any] = LIT_BEHIND

    @property
    def measured(self) -> tuple[Any, Any]:
        """The angle of incidence, and the index of the medium in which it is measured."""
        face: Any = self
        before = getattr(face, "incidence_in", None)
        return face.incidence, face.outside if before is None else before

    def uses_entered(self, owner: str, port: str) -> list[Use]:
        if port != "back":
            return []
        parts = self.lit_behind.parts(self.media_fields[1], self.medium_at("back"))
        return [Use(f"{owner}.{name}", value, domain) for name, value, domain in parts]

    def frame_of(self, port: str, frames: Mapping[str, Frame]) -> Frame | None:
        return frames.get(port) or _refracted_frame(self, port, frames)

    def frame_faults(self, owner: str, frames: Mapping[str, Frame]) -> list[str]:
        if (faults := x_faults(owner, frames)) or not frames:
            return faults
        face: Any = self
        if {"in", "reflected"} <= frames.keys() and not Operand(face.incidence).known:
            result = np.ravel(incidence_between(frames["in"], frames["reflected"]))[0]
            faults.append(
                f"the frames of '{owner}' meet at an incidence of {np.degrees(result):.9g} deg; "
                f"give that, not the parameter '{face.incidence.name}'"
            )
        laws = [law for law in world_angles(owner, self, frames) if not law.is_open]
        return faults + (first_faults(laws) if laws and not self.faults(owner) else [])


def _refracted_frame(element: Any, port: str, frames: Mapping[str, Frame]) -> Frame | None:
    """Return the frame of refracted light, of that of the other; None where it is not known."""
    if port != "transmitted" or not {"in", "reflected"} <= frames.keys():
        return None
    operands = operands_of(element)
    if any(o.value is FOLLOWS or not o.known or o.traced for o in operands) or element.faults(""):
        return None
    numbers = [operand.numbers() for operand in operands]
    if broadcast_fault({str(place): number.shape for place, number in enumerate(numbers)}):
        return None  # Named with all other shapes.
    arriving, reflected = frames["in"], frames["reflected"]
    front, behind = (np.asarray(angle)[..., np.newaxis] for angle in angles_of(np, *numbers))
    # Along the surface, and out of it.
    along, normal = _unit(arriving.z + reflected.z), _unit(reflected.z - arriving.z)
    z = np.where(front > 0.0, np.sin(behind) * along, 0.0) - np.cos(behind) * normal
    frame = Frame.from_direction(z, arriving.x)
    rounding = max(arriving.rounding, reflected.rounding)
    return Frame.trusted(frame.x, frame.y, frame.z, rounding)


def _unit(vector: Any) -> Any:
    length = np.linalg.norm(vector, axis=-1, keepdims=True)
    return vector / np.where(length > 0.0, length, 1.0)


_BOUNCES = ("in", "reflected"), ("back", "transmitted")
"""By which ports light goes that is turned back; it is let through by any others."""

_ROUNDING = 1e-7
"""How far apart two angles may be, in radians."""

_LAST_DIGITS, _LAST_SINGLE_DIGITS = 2.0**-50, 2.0**-22
"""How far apart two sines may be, of which one comes by Snell's law."""


@dataclass(frozen=True, eq=False)
class WorldAngle(Agreement):
    """The angle between the directions of two frames of a boundary, and that of its light.

    The operands are that of the frames, and what `angles_of` takes.
    """

    owner: str
    enters: str
    leaves: str
    rounding: float

    @property
    def rests_on(self) -> tuple[str, ...]:
        """The incidence, which may be wrong itself."""
        return (self.owner,)

    def fits(self, xp: Any, *numbers: Any) -> Any:
        result, *argument = numbers
        front, behind = angles_of(xp, *argument)
        single = [is_single(xp, number) for number in argument]
        last = xp.where(sum(single) > 0, _LAST_SINGLE_DIGITS, _LAST_DIGITS)
        # An angle next to grazing has fewer digits than its sine.
        cosine = xp.maximum(xp.minimum(xp.cos(front), xp.cos(behind)), xp.sqrt(last))
        allowed = max(_ROUNDING, self.rounding) + last / cosine
        differs = abs(result - self._expected(front, behind)) > allowed
        return ~differs | xp.isnan(sum(argument))

    def sentence(self, *numbers: float) -> str:
        result, incidence, *indices = numbers
        front, behind = angles_of(np, incidence, *indices)
        expected = _degrees(self._expected(front, behind))
        given = [
            f"{'k' if o.part == 'imag' else 'n'} = {text_of(o, number)}"
            for o, number in zip(self.operands[2:], indices, strict=True)
            if not o.known and (o.part != "imag" or number != 0.0)
        ]
        if not self.operands[1].known:
            given.insert(0, text_of(self.operands[1], math.degrees(incidence), " deg"))
        what, law = "meet at an incidence of", f"by the values of '{self.owner}' it is {expected}"
        if (self.enters, self.leaves) not in _BOUNCES:
            what, law = "turn light by", f"by {expected} by Snell's law"
        by = f" ({', '.join(given)})" if given else ""
        return (
            f"the frames of '{self.owner}.{self.enters}' and '{self.owner}.{self.leaves}' {what} "
            f"{_degrees(result)}, but {law}{by}; make them agree"
        )

    def _expected(self, front: Any, behind: Any) -> Any:
        if (self.enters, self.leaves) not in _BOUNCES:
            return abs(front - behind)
        return front if self.enters == "in" else behind


def world_angles(owner: str, element: Any, frames: Mapping[str, Frame]) -> Iterator[WorldAngle]:
    """Yield what must hold between the frames of a boundary and its values."""
    argument = operands_of(element)
    if any(operand.value is FOLLOWS for operand in argument):
        return  # What it takes over is looked at.
    for enters, leaves in product(element.inputs, element.outputs):
        if {enters, leaves} <= frames.keys():
            first, second = frames[enters], frames[leaves]
            bounces, needed = (enters, leaves) in _BOUNCES, argument
            angle = (incidence_between if bounces else angle_between)(first, second)
            if bounces and enters == "in":
                # What is behind is of no account in front, nor are both where one measures there.
                clear = [operand_of(number) for number in (1.0, 0.0)]
                front = argument[1:3] if len(argument) > 5 else clear
                needed = (argument[0], *front, *clear, *argument[5:])
            operands = (operand_of(angle), *needed)
            yield WorldAngle(operands, owner, enters, leaves, first.rounding_to(second))


def operands_of(element: Any) -> tuple[Operand, ...]:
    """Return what `angles_of` takes of a boundary."""
    before = getattr(element, "incidence_in", None)
    indices = numbers_of(element.index, INDEX)
    front = numbers_of(element.outside, INDEX)
    measured = () if before is None else numbers_of(before, INDEX)
    return tuple(map(operand_of, (element.incidence, *front, *indices, *measured)))


def angles_of(
    xp: Any, incidence: Any, n1: Any, k1: Any, n: Any, k: Any, *before: Any
) -> tuple[Any, Any]:
    """Return the angles of light in front of a boundary and behind it, in radians."""
    refract, phase = refraction(of_module(xp)), phase_index(of_module(xp))
    c, s = xp.cos(incidence), xp.sin(incidence)
    with np.errstate(all="ignore"):
        if before:
            c, s = refract(*phase(*before, c, s), n1, k1, c, s)
        behind, across = refract(*phase(n1, k1, c, s), n, k, c, s)
    return xp.arctan2(s, c), xp.arctan2(across, behind)


def _degrees(angle: Any) -> str:
    return f"{np.degrees(angle):.9g} deg"
