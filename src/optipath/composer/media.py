"""Media: what must fit where light goes from boundary to boundary, by structure or by value."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.meetings import Meetings, keys_of
from optipath.composer.one_plane import OnePlane
from optipath.composer.same_medium import SameMedium
from optipath.composer.same_turn import SameTurn
from optipath.composer.snells_law import SnellsLaw
from optipath.elements.arriving_wave import arriving_waves
from optipath.elements.boundary_frames import BoundaryElement
from optipath.elements.world_angle import world_angles
from optipath.values.agreement import first_faults
from optipath.values.follows import FOLLOWS
from optipath.values.materials import Material
from optipath.values.operands import Operand
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from optipath.composer.meetings import Meeting
    from optipath.composer.travel import Port
    from optipath.composer.wiring import Wiring
    from optipath.elements.world_angle import WorldAngle
    from optipath.values.agreement import Agreement

FOLLOWING = "following"
"""By what a graph knows the boundaries that have taken something over, and of which fields."""


class Media:
    """The media and the angles at both ends of every way from boundary to boundary.

    What is the same by its structure, such as one parameter, needs no look at its values.
    """

    def __init__(self, wiring: Wiring) -> None:
        self.elements = wiring.elements
        self.following = wiring.graph.graph.get(FOLLOWING, {})
        self.meetings = Meetings(wiring)

    @cached_property
    def open(self) -> tuple[Agreement, ...]:
        """What is looked at when the path runs, since a value is given only then."""
        return tuple(a for a in (*self._all, *self._in_space) if a.is_open)

    def faults(self) -> list[str]:
        """Return what does not fit of the values that are known, a sentence each."""
        known = [agreement for agreement in self._all if not agreement.is_open]
        return [*first_faults(known), *map(_wedge_fault, self.meetings.wedges)]

    @property
    def _all(self) -> tuple[Agreement, ...]:
        between = *self._media, *self._planes, *self._angles, *self._rounds, *self._arriving
        return *between, *self._within

    @cached_property
    def _media(self) -> tuple[SameMedium, ...]:
        found = []
        for meeting in _once(self.meetings.all):
            leaves, enters = meeting.leaves, meeting.enters
            first, second = self._medium(leaves), self._medium(enters)
            element: Any = self.elements[enters[0]]
            absorbs = () if _are_one(first, second) else _absorptions(first, second, element)
            if absorbs or not are_same(first, second):
                front, behind = element.media_fields
                field = behind if enters[1] == "back" else front
                operands = index_of(first), index_of(second), *absorbs
                measures = enters[1] == "in" and self._measures_in_front(enters)
                ports = ".".join(leaves), ".".join(enters)
                follows = enters[1] == "in" and self._follows(enters[0], "outside")
                found.append(SameMedium(operands, *ports, field, measures, follows))
        return tuple(found)

    @cached_property
    def _angles(self) -> tuple[SnellsLaw, ...]:
        found: dict[Any, SnellsLaw] = {}
        for meeting in self.meetings.in_layers:
            leaves, enters = meeting.leaves, meeting.enters
            turns = () if meeting.sides in self.meetings.to_and_fro else meeting.turns
            faces: Any = self.elements[leaves[0]], self.elements[enters[0]]
            (angle, n), (own_angle, own_n) = (face.measured for face in faces)
            if not (are_same(angle, own_angle) and are_same(n, own_n)):
                pairs = Operand(angle), *parts_of(n), Operand(own_angle), *parts_of(own_n)
                operands = (*pairs, *map(Operand, turns))
                if not any(operand.value is FOLLOWS for operand in operands):
                    law = SnellsLaw(
                        operands,
                        ".".join(leaves),
                        ".".join(enters),
                        ends=self._ends(meeting),
                        may_be_told=self.meetings.may_be_told(meeting),
                        follows=self._follows(enters[0], "incidence"),
                    )
                    found.setdefault((meeting.sides, keys_of(turns)), law)
        return tuple(found.values())

    @cached_property
    def _planes(self) -> tuple[OnePlane, ...]:
        found: dict[Any, OnePlane] = {}
        for meeting in self.meetings.in_layers:
            leaves, enters = meeting.leaves, meeting.enters
            follows = self._follows(enters[0], "incidence")
            if meeting.turns and (follows or meeting.sides in self.meetings.to_and_fro):
                first: Any = self.elements[leaves[0]]
                operands = tuple(map(Operand, (first.incidence, *meeting.turns)))
                if not any(operand.value is FOLLOWS for operand in operands):
                    plane = OnePlane(operands, ".".join(leaves), ".".join(enters), follows)
                    found.setdefault((leaves, enters, keys_of(meeting.turns)), plane)
        return tuple(found.values())

    @cached_property
    def _rounds(self) -> tuple[SameTurn, ...]:
        first: dict[Any, Meeting] = {}
        both = self.meetings.to_and_fro
        between = [meeting for meeting in self.meetings.in_layers if meeting.sides in both]
        ways = [(first.setdefault(meeting.sides, meeting), meeting) for meeting in between]
        found = []
        for one, other in (*ways, *self.meetings.mirrored):
            if keys_of(one.turns) != keys_of(other.turns):
                operands = tuple(map(Operand, (*one.turns, *other.turns)))
                ends = [(".".join(m.leaves), ".".join(m.enters)) for m in (one, other)]
                found.append(SameTurn(operands, len(one.turns), *ends))
        return tuple(found)

    @property
    def _in_space(self) -> Iterator[WorldAngle]:
        """What frames in the world say of angles; what is known of it is told with the frames."""
        for name, element in self.elements.items():
            if isinstance(element, BoundaryElement):
                yield from world_angles(
                    name, element, self.meetings.wiring.graph.nodes[name]["frames"]
                )

    @property
    def _within(self) -> Iterator[Agreement]:
        """What must fit of the values of one element."""
        for name, element in self.elements.items():
            yield from element.agreements(name)

    @property
    def _arriving(self) -> Iterator[Agreement]:
        """What must hold of light that comes out of media that absorb."""
        for name, port in sorted(self.meetings.wiring.lit):
            if isinstance(element := self.elements[name], BoundaryElement):
                yield from arriving_waves(name, element, port)

    def _ends(self, meeting: Meeting) -> tuple[bool, bool]:
        """Tell of both ends whether an incidence of 90 deg means that no light is between."""
        first, second = meeting.leaves, meeting.enters
        refracts = first[1] == "transmitted" and self._measures_in_front(first)
        return refracts, second[1] == "in" and self._measures_in_front(second)

    def _follows(self, name: str, field: str) -> bool:
        return field in self.following.get(name, ())

    def _medium(self, port: Port) -> Any:
        element: Any = self.elements[port[0]]
        return element.medium_at(port[1])

    def _measures_in_front(self, port: Port) -> bool:
        """Tell whether a boundary has its incidence in the medium in front."""
        face: Any = self.elements[port[0]]
        # A boundary in space has its angle by its points.
        has_one = isinstance(self.elements[port[0]], BoundaryElement)
        return has_one and face.measured[1] is face.outside


def _wedge_fault(meeting: Meeting) -> str:
    (name, _), (own, _) = meeting.leaves, meeting.enters
    return (
        f"light goes to and fro between '{name}' and '{own}', which says parallel=False: what "
        f"comes back has another incidence than the element has; leave parallel=False out, or add "
        f"elements of their own for the light that comes back"
    )


def _once(meetings: Iterable[Meeting]) -> Iterator[Meeting]:
    """Yield the first meeting of each two sides."""
    seen = set()
    for meeting in meetings:
        if meeting.sides not in seen:
            seen.add(meeting.sides)
            yield meeting


def index_of(value: Any) -> Operand:
    """Return n of a medium as an operand."""
    return Operand(value.n if isinstance(value, Material) else value, "real")


def absorption_of(value: Any) -> Operand | None:
    """Return k of a medium as an operand; None where it has none."""
    if isinstance(value, Material):
        return None if type(value.k) is float and value.k == 0.0 else Operand(value.k)
    if isinstance(value, (int, float)) or (
        isinstance(value, np.ndarray) and value.dtype.kind != "c"
    ):
        return None
    return Operand(value, "imag")


def parts_of(index: Any) -> tuple[Operand, Operand]:
    """Return n and k of a medium as operands."""
    return index_of(index), absorption_of(index) or Operand(0.0)


def _absorptions(first: Any, second: Any, element: Any) -> tuple[Operand, ...]:
    """Return what is looked at of k: that before, or of both sides where light may come from it."""
    before, behind = absorption_of(first), absorption_of(second)
    if not element.lit_from_absorbing:
        return () if before is None else (before,)
    if before is None and behind is None:
        return ()
    return before or Operand(0.0), behind or Operand(0.0)


def _are_one(first: Any, second: Any) -> bool:
    """Tell whether two media are one value, with all that is asked of either."""
    if first is second or first is FOLLOWS or second is FOLLOWS:
        return True
    return isinstance(first, Parameter) and first == second


def are_same(first: Any, second: Any) -> bool:
    """Tell whether two values are one by their structure; what is taken over is."""
    if first is second or first is FOLLOWS or second is FOLLOWS:
        return True
    if type(first) is type(second) is float:
        return first == second
    keys, others = ([part.key() for part in parts_of(index)] for index in (first, second))
    return None not in keys and keys == others
