"""The world frames of a boundary's four ports: one x, and directions by reflection and Snell."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from optipath.elements.four_port import FourPort
from optipath.elements.frame_checks import angle_between, incidence_between, share_x
from optipath.elements.fresnel import refraction_angle
from optipath.elements.media_of_boundary import MediaOfBoundary
from optipath.light.frames import Frame
from optipath.values.arrays.shapes import broadcast_fault
from optipath.values.domains.indices import LIT_BEHIND
from optipath.values.follows import FOLLOWS
from optipath.values.materials import Material
from optipath.values.operands import Operand

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from optipath.values.domains.domain import Domain


_TOLERANCE = 1e-7


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
        return [*_meeting_faults(owner, self, frames), *_passing_faults(owner, self, frames)]


def _refracted_frame(element: Any, port: str, frames: Mapping[str, Frame]) -> Frame | None:
    """Return the frame of refracted light, of that of the other; None where it is not known."""
    if port != "transmitted" or not {"in", "reflected"} <= frames.keys():
        return None
    angles = _angles("", element)
    if not angles:
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


def _meeting_faults(owner: str, element: Any, frames: Mapping[str, Frame]) -> Iterator[str]:
    if not {"in", "reflected"} <= frames.keys():
        return
    arriving, reflected = frames["in"], frames["reflected"]
    found = incidence_between(arriving, reflected)
    problem = f"the frames of '{owner}' meet at an incidence of {_degrees(found)}"
    if element.incidence is FOLLOWS:
        return  # What it takes over is looked at.
    if not Operand(element.incidence).known:
        name = element.incidence.name
        yield f"{problem}; give that, not the parameter '{name}'"
    angles = _angles(owner, element)
    if angles and not _agree(found, angles[0], arriving.rounding_to(reflected)):
        yield f"{problem}, but its incidence is {_degrees(angles[0])}; make them agree"


def _passing_faults(owner: str, element: Any, frames: Mapping[str, Frame]) -> Iterator[str]:
    angles = _angles(owner, element) if len(frames) > 1 else None
    if not angles:
        return
    front, behind = angles
    if {"back", "transmitted"} <= frames.keys():
        arriving, reflected = frames["back"], frames["transmitted"]
        found = incidence_between(arriving, reflected)
        if not _agree(found, behind, arriving.rounding_to(reflected)):
            yield (
                f"the frames of '{owner}.back' and '{owner}.transmitted' meet at an incidence of "
                f"{_degrees(found)}, but behind '{owner}' it is {_degrees(behind)}; make them agree"
            )
    for enters, leaves in (("in", "transmitted"), ("back", "reflected")):
        if {enters, leaves} <= frames.keys():
            found = angle_between(frames[enters], frames[leaves])
            rounding = frames[enters].rounding_to(frames[leaves])
            if not _agree(found, np.abs(front - behind), rounding):
                yield (
                    f"light from '{owner}.{enters}' to '{owner}.{leaves}' is turned by "
                    f"{_degrees(found)} in the world, but by {_degrees(np.abs(front - behind))} "
                    f"by Snell's law; make them agree"
                )


def _angles(owner: str, element: Any) -> tuple[Any, Any] | None:
    """Return the angles in front and behind, if they are known and allowed."""
    before = getattr(element, "incidence_in", None)
    values = [element.incidence, element.index, element.outside, before]
    if any(value is FOLLOWS for value in values):
        return None
    parts: list[Any] = [
        p for v in values for p in ((v.n, v.k) if isinstance(v, Material) else (v,))
    ]
    operands = [Operand(part) for part in parts]
    if not all(v.known and not v.traced for v in operands) or element.faults(owner):
        return None
    shapes = {str(place): np.shape(part) for place, part in enumerate(parts) if part is not None}
    if broadcast_fault(shapes):
        return None  # Named with all other shapes.
    incidence, outside = Operand(element.incidence).numbers({}), _complex(element.outside).real
    if before is not None:
        incidence = refraction_angle(outside, incidence, _complex(before).real)
    return incidence, refraction_angle(_complex(element.index), incidence, outside)


def _complex(index: Any) -> Any:
    if isinstance(index, Material):
        return Operand(index.n).numbers({}) + 1j * Operand(index.k).numbers({})
    return Operand(index).numbers({})


def _agree(found: Any, given: Any, rounding: float) -> bool:
    if broadcast_fault({"found": np.shape(found), "given": np.shape(given)}):
        return True  # Named with all other shapes.
    return bool(np.all(np.abs(found - given) <= max(_TOLERANCE, rounding)))


def _degrees(angle: Any) -> str:
    return f"{np.degrees(np.ravel(angle)[0]):.9g} deg"
