"""Meetings: where light leaving one boundary enters another, and parallel boundaries."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.composer.placement import azimuth_of, is_zero
from optipath.elements.boundary import BoundaryElement, FourPort
from optipath.elements.boundary_media import MediaOfBoundary
from optipath.values.agreement import Agreement, text_of
from optipath.values.operands import Operand

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.composer.wiring import Link, Port, Wiring


_MOST_ROUTES = 64
"""How many routes to one port are told apart, lest turned elements in a ring give no end."""


class Meeting(NamedTuple):
    """Light leaves a boundary and enters another, or the same again."""

    leaves: Port
    enters: Port
    straight: bool
    turns: tuple[Any, ...]
    sides: frozenset[Port]


class Meetings:
    """The meetings of a path."""

    def __init__(self, wiring: Wiring) -> None:
        self.wiring = wiring

    @cached_property
    def all(self) -> tuple[Meeting, ...]:
        """Every meeting, those by a front first: these have a medium to be given."""
        results = [meeting for meeting in self._arrivals if meeting.enters[0] in self._boundaries]
        return tuple(sorted(results, key=lambda meeting: meeting.enters[1] == "back"))

    @cached_property
    def _arrivals(self) -> list[Meeting]:
        """Where light of boundaries gets to in one medium: other boundaries, and mirrors."""
        elements = self.wiring.elements
        starts = [(name, port) for name in self._boundaries for port in elements[name].outputs]
        return [way for start in starts if start in self._links_from for way in self._of(start)]

    @cached_property
    def _boundaries(self) -> dict[str, None]:
        elements = self.wiring.elements.items()
        return dict.fromkeys([name for name, e in elements if isinstance(e, MediaOfBoundary)])

    @cached_property
    def in_one_medium(self) -> bool:
        """Whether boundaries only reflect, each in front, in one medium, and no light comes back.

        There is nothing to compare then, and long paths of mirrors are mostly so.
        """
        boundaries, media = self._boundaries, set[float]()
        for start, end, (leaves, enters) in self.wiring.links:
            if (start in boundaries and leaves != "reflected") or (
                end in boundaries and enters != "in"
            ):
                return False
        for element in self.wiring.alike.distinct.values():
            if isinstance(element, MediaOfBoundary):
                medium = element.medium_at("in")
                if type(medium) is not float:
                    return False
                media.add(medium)
        return len(media) < 2 and not self.wiring.cycles

    @cached_property
    def faces(self) -> set[str]:
        """The nodes of boundaries that refract, vertices aside."""
        elements = self.wiring.elements
        return {name for name in self._boundaries if isinstance(elements[name], BoundaryElement)}

    @cached_property
    def _links_from(self) -> dict[Port, list[Link]]:
        """The links of each out-port, those that only read its light included."""
        wiring = self.wiring
        if not wiring.taps:
            return wiring.links_from
        results = {port: [*links] for port, links in wiring.links_from.items()}
        for tap in wiring.taps:
            results.setdefault((tap[0], tap[2][0]), []).append(tap)
        return results

    @property
    def mirrored(self) -> Iterator[tuple[Meeting, Meeting]]:
        """The ways from a boundary straight to a mirror, each with one straight back to its side.

        All in one plane: neither between two mirrors nor by way of a beam splitter.
        """
        for there in self._arrivals:
            mirror, enters = there.enters
            element = self.wiring.elements[mirror]
            if not there.straight or isinstance(element, (MediaOfBoundary, FourPort)):
                continue
            for way in self.wiring.couplings[mirror]:
                if way.enters == enters and way.reflects:
                    for back in self._of((mirror, way.leaves)):
                        if back.straight and back.enters == _side(there.leaves):
                            yield there, back

    def _of(self, start: Port) -> Iterator[Meeting]:
        """Yield where light goes in one medium, also by mirrors."""
        wiring, links_from = self.wiring, self._links_from
        waiting: list[tuple[Port, bool, tuple[Any, ...]]] = [(start, True, ())]
        seen: dict[Port, set[Any]] = {}
        while waiting:
            port, straight, before = waiting.pop()
            for link in links_from.get(port, ()):
                name, enters, turns = link[1], (link[1], link[2][1]), before
                if wiring.may_turn(link):
                    azimuth = azimuth_of(wiring, link)
                    turns = before if is_zero(azimuth) else (*before, azimuth)
                routes = seen.setdefault(enters, set())
                route = straight, keys_of(turns) if turns else ()
                if route in routes or len(routes) == _MOST_ROUTES:
                    continue
                routes.add(route)
                if name in self._boundaries:
                    yield Meeting(start, enters, straight, turns, _sides(start, enters))
                    continue
                element = wiring.elements[name]
                for way in wiring.couplings[name]:
                    if way.enters != enters[1]:
                        continue
                    # A beam splitter lets light through as it is.
                    passes = isinstance(element, FourPort) and not way.reflects
                    goes_on = element.straight or passes
                    if goes_on or way.reflects:
                        waiting.append(((name, way.leaves), straight and goes_on, turns))
                        if not goes_on:
                            yield Meeting(start, enters, straight, turns, _sides(start, enters))

    @cached_property
    def in_layers(self) -> tuple[Meeting, ...]:
        """The meetings of light between parallel faces: one of them has refracted it.

        Those whose plane of incidence is turned are among them, since their angles may be 0.
        """
        leaving: dict[Port, list[Meeting]] = {}
        explained = {meeting.sides for meeting in self._straight if self._is_shown(meeting)}
        facing = [m for m in self._straight if m.sides not in explained]
        for meeting in facing:
            leaving.setdefault(meeting.leaves, []).append(meeting)
        both = self.to_and_fro
        waiting = [m for m in facing if m.sides in both or self._refracted(m.leaves)]
        results = {_way(meeting) for meeting in waiting}
        while waiting:
            last = waiting.pop()
            # What stands at an angle sends light where no other is known to be parallel.
            if last.sides not in both and _are_turned(last.turns):
                continue
            name, port = last.enters
            reflected = name, "reflected" if port == "in" else "transmitted"
            for meeting in leaving.get(reflected, ()):
                if _way(meeting) not in results:
                    results.add(_way(meeting))
                    waiting.append(meeting)
        return tuple(m for m in facing if _way(m) in results)

    @cached_property
    def to_and_fro(self) -> frozenset[frozenset[Port]]:
        """The sides of faces between which light goes both ways."""
        ways = Counter(sides for sides, *_ in {(m.sides, *_way(m)) for m in self._straight})
        return frozenset(sides for sides, count in ways.items() if count > 1)

    @property
    def wedges(self) -> list[Meeting]:
        """The meetings of faces that are told not to be parallel, but get their light back."""
        return [m for m in self._straight if m.sides in self.to_and_fro and self._is_shown(m)]

    @cached_property
    def _straight(self) -> list[Meeting]:
        """The meetings of two faces whose directions no frames in the world give."""
        return [m for m in self.all if self._of_faces(m) and not self._is_in_space(m)]

    def _is_shown(self, meeting: Meeting) -> bool:
        """Tell whether a face says that it is not parallel to the one before."""
        face: Any = self.wiring.elements[meeting.enters[0]]
        return face.parallel is False and self._comes_before(meeting)

    def may_be_shown(self, meeting: Meeting) -> bool:
        """Tell whether the face that light enters might say ``parallel=False``."""
        return self._comes_before(meeting) and meeting.sides not in self.to_and_fro

    def _comes_before(self, meeting: Meeting) -> bool:
        name, port = meeting.enters
        if port == "in" or not self.wiring.is_lit(name, "in"):
            return True
        in_front = any(m.enters == (name, "in") for m in self._straight)
        return not in_front and meeting.sides not in self.to_and_fro

    def _of_faces(self, meeting: Meeting) -> bool:
        first, second = meeting.leaves[0], meeting.enters[0]
        faces = self.faces
        return meeting.straight and first != second and first in faces and second in faces

    def _refracted(self, port: Port) -> bool:
        """Tell whether light at a port has been refracted there, and not reflected as well."""
        name, leaves = port
        is_lit = self.wiring.is_lit
        if leaves == "transmitted":
            return is_lit(name, "in")
        return is_lit(name, "back") and not is_lit(name, "in")

    def _is_in_space(self, meeting: Meeting) -> bool:
        framed = self.wiring.framed
        names = meeting.leaves[0], meeting.enters[0]
        return bool(framed) and all(len(framed.get(name, ())) > 1 for name in names)


def _sides(start: Port, enters: Port) -> frozenset[Port]:
    return frozenset([_side(start), enters])


def _side(port: Port) -> Port:
    """Return the in-port on the same side of a boundary as an out-port."""
    return port[0], "in" if port[1] == "reflected" else "back"


def _way(meeting: Meeting) -> tuple[Port, Port]:
    return meeting.leaves, meeting.enters


def keys_of(turns: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return what the same turns share."""
    return tuple(Operand(turn).key() or id(turn) for turn in turns)


def _are_turned(turns: tuple[Any, ...]) -> bool:
    """Tell whether turns are known to come to another plane of incidence, on every path."""
    operands = [Operand(turn) for turn in turns]
    if not turns or any(not operand.known or operand.traced for operand in operands):
        return False
    try:
        turn = sum(operand.numbers() for operand in operands)
        with np.errstate(invalid="ignore"):
            return bool(np.all(np.abs(np.sin(turn)) > TURNED))
    except (TypeError, ValueError):
        return False  # What is no angle is a fault of its own.


TURNED = 1e-3
"""From what sine on a turn makes another plane of incidence: less is none in a laboratory."""

_NORMAL = 1e-9
"""Up to what sine of an incidence light has no plane of incidence."""


@dataclass(frozen=True, eq=False)
class SameTurn(Agreement):
    """The turns on a way between two faces come to none, or to those on the way back.

    A turn counts about the direction of travel, so that a way back undoes it by as much again. The
    operands are the incidence at the first, which has no plane at 0, the turns, and those back.
    """

    names: tuple[str, str]
    way: str
    count: int
    back: str = ""
    follows: bool = False

    @property
    def rests_on(self) -> tuple[str, ...]:
        """That neither way turns the plane of incidence, where there is one."""
        return (self.way, self.back) if self.back else ()

    @property
    def spoils(self) -> tuple[str, ...]:
        """What else is said of the turns on this way."""
        return () if self.back else (self.way,)

    def fits(self, xp: Any, *numbers: Any) -> Any:
        angle, *turns = numbers
        turn = sum(turns[: self.count]) - sum(turns[self.count :])
        return ~((abs(xp.sin(turn)) > TURNED) & (abs(xp.sin(angle)) > _NORMAL))

    def sentence(self, *numbers: float) -> str:
        name, own = self.names
        parts = slice(1, 1 + self.count), slice(1 + self.count, None)
        turn, other = (turn_text(self.operands[part], numbers[part]) for part in parts)
        why = f"light goes to and fro between '{name}' and '{own}'"
        cure = "let the azimuths on the way add up to 0"
        if self.back:
            turn += f", and that from {self.back} by {other}"
            cure = "let the azimuths on either way add up to the same"
        elif self.follows:
            why = f"'{own}' takes its incidence over (FOLLOWS), as a face parallel to '{name}' does"
            cure += ", or give its incidence"
        else:
            why += ", which are parallel then"
        return (
            f"{why}, but the way from {self.way} turns the plane of incidence by {turn}; {cure} "
            f"(a polarizer or retarder is turned by its angle, which turns nothing behind it)"
        )


def turn_text(operands: Any, turns: Any) -> str:
    """Write what turns add up to, and whose values they are. Units: turns in radians."""
    each = [text_of(o, math.degrees(t), " deg") for o, t in zip(operands, turns, strict=True)]
    if len(each) == 1:
        return each[0]
    several = f" ({', '.join(each)})" if each else ""
    return f"{math.degrees(sum(turns)):.10g} deg{several}"


def way_text(meeting: Meeting) -> str:
    """Write where light leaves one boundary and enters another."""
    return f"'{'.'.join(meeting.leaves)}' to '{'.'.join(meeting.enters)}'"
