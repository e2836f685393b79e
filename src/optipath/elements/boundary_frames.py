"""The world frames of a boundary's four ports: one x, and directions by reflection and Snell."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from optipath.elements.four_port import FourPort
from optipath.elements.frame_checks import incidence_between, share_x
from optipath.elements.media_of_boundary import MediaOfBoundary
from optipath.elements.world_angle import angles_of, operands_of, world_angles
from optipath.light.frames import Frame
from optipath.values.agreement import first_faults
from optipath.values.arrays.shapes import broadcast_fault
from optipath.values.domains.indices import LIT_BEHIND
from optipath.values.follows import FOLLOWS
from optipath.values.operands import Operand

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from optipath.values.domains.domain import Domain


class BoundaryElement(MediaOfBoundary, FourPort):
    """An element between the media in front, ``outside``, and behind, ``index``.

    All its ports share x = s; directions obey the laws of reflection and of Snell.
    """

    may_follow: ClassVar[tuple[str, ...]] = ("outside", "incidence")

    @property
    def measured(self) -> tuple[Any, Any]:
        """The angle of incidence, and the index of the medium in which it is measured."""
        face: Any = self
        before = getattr(face, "incidence_in", None)
        return face.incidence, face.outside if before is None else before

    def domains_entered(self, port: str) -> Mapping[str, Domain]:
        """Return that the medium behind must not absorb where light comes from there."""
        return {"index": LIT_BEHIND} if port == "back" else {}

    def frame_of(self, port: str, frames: Mapping[str, Frame]) -> Frame | None:
        return frames.get(port) or _refracted_frame(self, port, frames)

    def frame_faults(self, owner: str, frames: Mapping[str, Frame]) -> list[str]:
        placed = list(frames.items())
        faulty = [port for port, frame in placed if not share_x(frame, placed[0][1])]
        if faulty:
            ports = " and ".join(f"'{owner}.{port}'" for port in (placed[0][0], *faulty))
            problem = f"the frames of {ports} must share one x"
            return [f"{problem}, perpendicular to the plane of incidence"]
        return [*_open_incidence_faults(owner, self, frames), *_angle_faults(owner, self, frames)]


def _refracted_frame(element: Any, port: str, frames: Mapping[str, Frame]) -> Frame | None:
    """Return the frame of refracted light, of that of the other; None where it is not known."""
    if port != "transmitted" or not {"in", "reflected"} <= frames.keys():
        return None
    angles = _known_angles(element)
    if angles is None:
        return None
    arriving, reflected = frames["in"], frames["reflected"]
    front, behind = (np.asarray(angle)[..., np.newaxis] for angle in angles)
    # Along the surface, and out of it.
    along, normal = arriving.z + reflected.z, reflected.z - arriving.z
    along, normal = (_unit(vector) for vector in (along, normal))
    z = np.where(front > 0.0, np.sin(behind) * along, 0.0) - np.cos(behind) * normal
    frame = Frame.from_direction(z, arriving.x)
    rounding = max(arriving.rounding, reflected.rounding)
    return Frame.trusted(frame.x, frame.y, frame.z, rounding)


def _unit(vector: Any) -> Any:
    length = np.linalg.norm(vector, axis=-1, keepdims=True)
    return vector / np.where(length > 0.0, length, 1.0)


def _open_incidence_faults(owner: str, element: Any, frames: Mapping[str, Frame]) -> Iterator[str]:
    incidence = element.incidence
    if {"in", "reflected"} <= frames.keys() and not Operand(incidence).known:
        found = incidence_between(frames["in"], frames["reflected"])
        yield (
            f"the frames of '{owner}' meet at an incidence of "
            f"{np.degrees(np.ravel(found)[0]):.9g} deg; give that, not the parameter "
            f"'{incidence.name}'"
        )


def _angle_faults(owner: str, element: Any, frames: Mapping[str, Frame]) -> list[str]:
    """Return where the angles between frames are not those of values that are known."""
    laws = [law for law in world_angles(owner, element, frames) if not law.is_open]
    return first_faults(laws) if laws and not element.faults(owner) else []


def _known_angles(element: Any) -> tuple[Any, Any] | None:
    """Return the angles in front and behind, if they are known and allowed."""
    operands = operands_of(element)
    if any(o.value is FOLLOWS or not o.known or o.traced for o in operands) or element.faults(""):
        return None
    numbers = [operand.numbers() for operand in operands]
    if broadcast_fault({str(place): number.shape for place, number in enumerate(numbers)}):
        return None  # Named with all other shapes.
    return angles_of(np, *numbers)
