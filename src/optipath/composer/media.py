"""Media: what boundaries take over from others (`FOLLOWS`), and what must agree between them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.meetings import TURNED, Meetings, SameTurn, keys_of, turn_text, way_text
from optipath.composer.path_values import FOLLOWING
from optipath.composer.placement import along_legs
from optipath.composer.wiring import Wiring
from optipath.elements.boundary import BoundaryElement, world_angles
from optipath.elements.boundary_media import MediaOfBoundary, arriving_waves
from optipath.elements.element import Element
from optipath.faults import Cure, Fault
from optipath.kernels.fresnel.boundary import phase_index
from optipath.kernels.primitives import of_module
from optipath.materials.index_domains import FOLLOWS
from optipath.materials.material import Material
from optipath.values.agreement import Agreement, first_faults, is_single, text_of
from optipath.values.arrays import read_only
from optipath.values.operands import Operand
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Iterator

    import networkx as nx

    from optipath.composer.meetings import Meeting
    from optipath.composer.wiring import Port
    from optipath.elements.boundary import WorldAngle


_HAS_PLANE = math.pi / 2
"""An incidence at which light has a plane, so that turns are compared."""


class Media:
    """The media and the angles at both ends of every way from boundary to boundary."""

    def __init__(self, wiring: Wiring) -> None:
        self.elements: dict[str, Any] = {**wiring.elements}
        self.following = wiring.graph.graph.get(FOLLOWING, {})
        self.meetings = Meetings(wiring)

    @cached_property
    def open(self) -> tuple[Agreement, ...]:
        """What is looked at when the path runs, since a value is given only then."""
        legs = along_legs(self.meetings.wiring)
        return tuple(a for a in (*self._all, *self._in_space, *legs) if a.is_open)

    def faults(self) -> list[str]:
        """Return what does not fit of the values that are known, a sentence each."""
        faults = first_faults([agreement for agreement in self._all if not agreement.is_open])
        for meeting in () if self.meetings.in_one_medium else self.meetings.wedges:
            (name, _), (own, _) = meeting.leaves, meeting.enters
            says = (
                f"'{own}', which says parallel=False, though light comes back at another incidence"
            )
            cure = "leave that out, or add elements of their own for the light that comes back"
            faults.append(f"light goes to and fro between '{name}' and {says}; {cure}")
        return faults

    @cached_property
    def _all(self) -> tuple[Agreement, ...]:
        met = () if self.meetings.in_one_medium else (*self._media, *self._between_layers)
        return *met, *self._arriving, *self._within

    @property
    def _media(self) -> list[Agreement]:
        results: dict[Any, SameMedium | None] = {}
        for meeting in self.meetings.all:
            if meeting.sides in results:
                continue
            (start, leaves), (end, enters) = meeting.leaves, meeting.enters
            element = self.elements[end]
            first, second = self.elements[start].medium_at(leaves), element.medium_at(enters)
            if type(first) is type(second) is float and first == second:
                continue
            in_front, results[meeting.sides] = enters == "in", None
            absorbs = _absorptions(first, second, element)
            if absorbs or not are_same(first, second):
                results[meeting.sides] = SameMedium(
                    (index_of(first), index_of(second), *absorbs),
                    f"{start}.{leaves}",
                    f"{end}.{enters}",
                    element.media_fields[not in_front],
                    measures=in_front and self._measures_in_front(meeting.enters),
                    follows=in_front and self._follows(end, "outside"),
                )
        return list(filter(None, results.values()))

    @property
    def _between_layers(self) -> Iterator[Agreement]:
        """What must fit of turns and angles between parallel faces, and on the way to a mirror."""
        planes: dict[Any, SameTurn] = {}
        laws: dict[Any, SnellsLaw] = {}
        rounds: dict[Any, Meeting] = {}
        ways = []
        for meeting in self.meetings.in_layers:
            leaves, enters = meeting.leaves, meeting.enters
            first, second = self.elements[leaves[0]], self.elements[enters[0]]
            ends, turns = (".".join(leaves), ".".join(enters)), meeting.turns
            follows = self._follows(enters[0], "incidence")
            both_ways = meeting.sides in self.meetings.to_and_fro
            if turns and (follows or both_ways):
                operands = tuple(map(Operand, (first.incidence, *turns)))
                names, way = (leaves[0], enters[0]), way_text(meeting)
                plane = SameTurn(operands, names, way, len(turns), follows=follows)
                planes.setdefault((leaves, enters, keys_of(turns)), plane)
            if both_ways:
                ways.append((rounds.setdefault(meeting.sides, meeting), meeting))
                turns = ()
            (angle, n), (own_angle, own_n) = first.measured, second.measured
            if not (are_same(angle, own_angle) and are_same(n, own_n)):
                pairs = Operand(angle), *parts_of(n), Operand(own_angle), *parts_of(own_n)
                shown, refracts = self.meetings.may_be_shown(meeting), self._ends(meeting)
                law = SnellsLaw((*pairs, *map(Operand, turns)), *ends, refracts, shown, follows)
                laws.setdefault((meeting.sides, keys_of(turns)), law)
        for agreement in (*planes.values(), *laws.values()):
            if not any(operand.value is FOLLOWS for operand in agreement.operands):
                yield agreement
        for one, other in (*ways, *self.meetings.mirrored):
            if keys_of(one.turns) != keys_of(other.turns):
                operands = tuple(map(Operand, (_HAS_PLANE, *one.turns, *other.turns)))
                names, count = (one.leaves[0], one.enters[0]), len(one.turns)
                yield SameTurn(operands, names, way_text(one), count, way_text(other))

    @property
    def _in_space(self) -> Iterator[WorldAngle]:
        """What frames in the world say of angles; what is known of it is told with the frames."""
        for name, frames in self.meetings.wiring.graph.nodes(data="frames"):
            if frames and isinstance(element := self.elements[name], BoundaryElement):
                yield from world_angles(name, element, frames)

    @property
    def _within(self) -> Iterator[Agreement]:
        """What must fit of the values of one element."""
        alike = self.meetings.wiring.alike
        for name in alike.where(lambda e: type(e).agreements is not Element.agreements):
            yield from self.elements[name].agreements(name)

    @property
    def _arriving(self) -> Iterator[Agreement]:
        """What must hold of light that comes out of media that absorb."""
        wiring = self.meetings.wiring
        for name in sorted(wiring.alike.where(_may_absorb)):
            element = self.elements[name]
            for port in sorted(element.inputs):
                if type(element.medium_at(port)) is not float and wiring.is_lit(name, port):
                    yield from arriving_waves(name, element, port)

    def _ends(self, meeting: Meeting) -> tuple[bool, bool]:
        """Tell of both ends whether an incidence of 90 deg means that no light is between."""
        first, second = meeting.leaves, meeting.enters
        refracts = first[1] == "transmitted" and self._measures_in_front(first)
        return refracts, second[1] == "in" and self._measures_in_front(second)

    def _follows(self, name: str, field: str) -> bool:
        return field in self.following.get(name, ())

    def _measures_in_front(self, port: Port) -> bool:
        """Tell whether a boundary has its incidence in the medium in front."""
        face = self.elements[port[0]]
        # A boundary in space has its angle by its points.
        has_one = isinstance(self.elements[port[0]], BoundaryElement)
        return has_one and face.measured[1] is face.outside


def _may_absorb(element: Element) -> bool:
    """Tell whether light may come to a boundary out of a medium that absorbs."""
    if not isinstance(element, BoundaryElement):
        return False
    return not {type(element.medium_at(port)) for port in element.inputs} <= {float}


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
    if first is second or first is FOLLOWS or second is FOLLOWS:
        return ()
    before, behind = absorption_of(first), absorption_of(second)
    if before is behind is None or (isinstance(first, Parameter) and first == second):
        return ()
    if not element.lit_from_absorbing:
        return () if before is None else (before,)
    return before or Operand(0.0), behind or Operand(0.0)


def are_same(first: Any, second: Any) -> bool:
    """Tell whether two values are one by their structure; what is taken over is."""
    if first is second or first is FOLLOWS or second is FOLLOWS:
        return True
    if type(first) is type(second) is float:
        return first == second
    keys, others = ([part.key() for part in parts_of(index)] for index in (first, second))
    return None not in keys and keys == others


_CLEAR = "an index without k there, and link a Medium between, which absorbs on the way"
_OWN_FACE = "give each light a face of its own"

_OF_INDEX, _OF_SINGLE_INDEX = 1e-9, 2.0**-23
"""How far apart two indices may be, as a share of them."""


@dataclass(frozen=True, eq=False)
class SameMedium(Agreement):
    """The indices of refraction of two boundaries that face each other are the same.

    The operands are n on both sides, and k on both where either may absorb; or k of the first
    alone, where the medium in front of the second must not absorb.
    """

    leaves: str
    enters: str
    field: str
    measures: bool = False
    follows: bool = False

    @property
    def spoils(self) -> tuple[str, ...]:
        """The incidence that is measured in a medium that is wrong says nothing."""
        return (self.enters, self.enters.rpartition(".")[0]) if self.measures else ()

    def fits(self, xp: Any, *numbers: Any) -> Any:
        n1, n2, *k = numbers
        rounding = xp.where(is_single(xp, n1) | is_single(xp, n2), _OF_SINGLE_INDEX, _OF_INDEX)
        differs = abs(n1 - n2) > rounding * xp.maximum(n1, n2)
        if len(k) == 1:
            return ~(differs | (k[0] != 0.0))
        if k:
            differs = differs | (abs(k[0] - k[1]) > rounding * xp.maximum(k[0], k[1]))
        return ~differs

    def sentence(self, *numbers: float) -> str:
        before, behind, *k = (text_of(o, n) for o, n in zip(self.operands, numbers, strict=True))
        name, _, port = self.leaves.rpartition(".")
        side = "behind" if port == "transmitted" else "in front of"
        where = f"{side} '{name}' (by '{self.leaves}')"
        if len(k) == 1 and numbers[2]:
            absorbs = f"is lit from a medium that absorbs, with k = {k[0]} {where}"
            return f"'{self.enters}' {absorbs}; give '{name}' {_CLEAR}"
        before = _called(before)
        if any(numbers[2:]):
            before, behind = f"{before} and k = {k[0]}", f"{behind} with k = {k[1]}"
        is_lit = f"'{self.enters}' is lit from {before} {where}"
        if self.follows:
            taken = f"has taken its {self.field} over (FOLLOWS) from other light"
            return f"{is_lit}, but {taken}, in {_called(behind)}; {_OWN_FACE}"
        # A number is a sure cure where both are known, and the first is one for all paths.
        n, own = [operand.value for operand in self.operands[:2]]
        is_open = isinstance(n, Parameter) or isinstance(own, Parameter) or np.ndim(n)
        cures = [] if is_open or any(numbers[2:3]) else [f"{self.field} = {numbers[0]:.12g}"]
        if self.enters.endswith(".back"):
            ways = [f"give {[*cures, f'the same for {self.field} as there'][0]}"]
        else:
            follows = ("op.FOLLOWS", FOLLOWS.in_file)
            ways = [f"give {', or '.join([*cures, way])} for {self.field}" for way in follows]
        return Fault(f"{is_lit}, but its {self.field} is {behind}", Cure(*ways))


def _called(number: str) -> str:
    """Return how an index is called; a multiple of a parameter says it."""
    return number if "=" in number else f"n = {number}"


_ROUNDING, _SINGLE_ROUNDING = 3e-8, 2.0**-22
"""How far apart two angles may be, in radians."""

_LAST_DIGITS, _LAST_SINGLE_DIGITS = 2.0**-50, 2.0**-22
"""How far apart two values of sin(incidence) may be, where the sine hardly changes."""


@dataclass(frozen=True, eq=False)
class SnellsLaw(Agreement):
    """An incidence at one boundary, and the medium where it is measured; the same at another.

    The operands are angle, n and k of both, and the turns between the two planes of incidence.
    """

    leaves: str
    enters: str
    ends: tuple[bool, bool] = (False, False)
    may_be_shown: bool = True
    follows: bool = False

    @property
    def rests_on(self) -> tuple[str, ...]:
        """The incidence at the first, and the medium at the second."""
        return self.leaves.rpartition(".")[0], self.enters

    @property
    def spoils(self) -> tuple[str, ...]:
        """The incidence at the second."""
        return (self.enters.rpartition(".")[0],)

    def fits(self, xp: Any, *numbers: Any) -> Any:
        angle1, n1, k1, angle2, n2, k2, *turns = numbers
        n1, n2 = _index(xp, angle1, n1, k1), _index(xp, angle2, n2, k2)
        single = is_single(xp, angle1) | is_single(xp, angle2)
        rounding = xp.where(single, _SINGLE_ROUNDING, _ROUNDING)
        single = single | is_single(xp, n1) | is_single(xp, n2)
        last = xp.where(single, _LAST_SINGLE_DIGITS, _LAST_DIGITS)
        normal = xp.minimum(abs(n1 * xp.cos(angle1)), abs(n2 * xp.cos(angle2)))
        here, there = n1 * xp.sin(angle1), n2 * xp.sin(angle2)
        differs = abs(here - there) > rounding * normal + last * xp.maximum(n1, n2)
        if turns:
            differs = differs & ~(abs(xp.sin(sum(turns))) > TURNED)
        # Where all is reflected, the angle behind is a right one, and no light gets there.
        first, second = self.ends
        if first:
            differs = differs & ~((abs(xp.cos(angle1)) <= rounding) & (here < there))
        if second:
            differs = differs & ~((abs(xp.cos(angle2)) <= rounding) & (there < here))
        return ~differs

    def sentence(self, *numbers: float) -> str:
        angle1, n1, k1, angle2, n2, k2, *turns = numbers
        (name, _, _), (own, _, _) = self.leaves.rpartition("."), self.enters.rpartition(".")
        pairs = ((angle1, n1, k1), (angle2, n2, k2))
        here, there = (float(_index(np, a, n, k)) * math.sin(a) for a, n, k in pairs)
        digits = 10 if f"{here:.10g}" != f"{there:.10g}" else 17
        sines = f"{here:.{digits}g} at '{name}' and {there:.{digits}g} at '{own}'"
        argument = text_of(self.operands[3], math.degrees(angle2), " deg")
        argument += f" in n = {text_of(self.operands[4], n2)}"
        if k2:
            argument += f" and k = {text_of(self.operands[5], k2)}"
        if turns:
            turned = turn_text(self.operands[6:], turns)
            argument += f"; their planes of incidence are one where azimuths come to {turned}"
        enters = f"light of '{self.leaves}' enters '{self.enters}', but"
        differ = f"n sin(incidence) is {sines} ({argument})"
        if self.follows:
            taken = f"'{own}' has taken its incidence over (FOLLOWS) from other light"
            return f"{enters} {taken}: {differ}; {_OWN_FACE}"
        cures = []
        for follows, no in (("op.FOLLOWS", "=False"), (FOLLOWS.in_file, " = false")):
            why = "light goes to and fro between them, so they are parallel"
            if self.may_be_shown:
                why = f"faces behind one that refracts are parallel, unless they say parallel{no}"
            cures.append(f"give '{own}' an incidence of {follows} ({why})")
        return Fault(f"{enters} {differ}", Cure(*cures))


def _index(xp: Any, angle: Any, n: Any, k: Any) -> Any:
    """Return the index by which Snell's law holds for a real angle in a medium."""
    with np.errstate(all="ignore"):
        (index,) = phase_index(of_module(xp))(n, k, xp.cos(angle), xp.sin(angle))
    return xp.where(k > 0.0, index, n)


def with_followed(graph: nx.MultiDiGraph) -> tuple[nx.MultiDiGraph, list[str]]:
    """Return a graph of elements in which boundaries have what they take over from others.

    The medium in front is that of the boundary whose light enters at ``in``; the incidence is that
    of a parallel boundary before, measured in the same medium.
    """
    elements = dict(graph.nodes(data="element"))
    names = [
        name for name, e in elements.items() if isinstance(e, MediaOfBoundary) and e.followed()
    ]
    if not names:
        return graph, []
    taking = _Taking(elements, names, Meetings(Wiring(graph)))
    faults = {name: [*taking.faults(name)] for name in names}
    result = graph.copy()
    result.graph[FOLLOWING] = {}
    for name in names:
        fields = elements[name].followed()
        # An incidence comes with the medium in which it is measured.
        result.graph[FOLLOWING][name] = (*fields, *["incidence_in"] * ("incidence" in fields))
        if not faults[name]:
            dict.update(result.nodes[name], element=taking.elements[name])
    messages = [fault for several in faults.values() for fault in several]
    if not messages:
        takes = "takes over (FOLLOWS) what those before it take over; give it at one of them"
        messages = [f"'{name}' {takes}" for name in names if taking.elements[name].followed()]
    return result, messages


class _Taking:
    """Gives values on from boundary to boundary, as soon as they are there."""

    def __init__(self, elements: dict[str, Any], names: list[str], meetings: Meetings) -> None:
        self.given, self.elements = elements, dict(elements)
        self.fronts = _by_end(m for m in meetings.all if m.enters[1] == "in")
        self.layers = _by_end(meetings.in_layers)
        behind: dict[str, set[str]] = {}
        for name, several in [*self.fronts.items(), *self.layers.items()]:
            for meeting in several:
                behind.setdefault(meeting.leaves[0], set()).add(name)
        waiting = names[::-1]
        while waiting:
            name = waiting.pop()
            if self._take(name):
                waiting += sorted(behind.get(name, ()), reverse=True)

    def _take(self, name: str) -> bool:
        """Take over what is there for an element; tell whether anything was."""
        element = self.elements[name]
        taken: dict[str, Any] = {}
        for field in element.followed():
            if field == "outside":
                media = self._media(name)
                if not element.lit_from_absorbing:
                    media = list(map(_real, media))
                taken |= dict(zip(["outside"], media, strict=False))
            elif element.incidence_in is None and (pairs := self._angles(name)):
                taken |= dict(zip(["incidence", "incidence_in"], pairs[0], strict=True))
        if taken:
            self.elements[name] = element.taking_over(**taken)
        return bool(taken)

    def _media(self, name: str) -> list[Any]:
        """Return the media in which light comes to the front of an element."""
        ports = [meeting.leaves for meeting in self.fronts.get(name, ())]
        media = [self.elements[node].medium_at(port) for node, port in ports]
        return [_real_if_clear(index) for index in media if index is not FOLLOWS]

    def _angles(self, name: str) -> list[tuple[Any, Any]]:
        """Return the incidence at parallel boundaries before it, each with its medium."""
        pairs = [self.elements[m.leaves[0]].measured for m in self.layers.get(name, ())]
        return [(a, n) for a, n in pairs if a is not FOLLOWS and n is not FOLLOWS]

    def faults(self, name: str) -> Iterator[str]:
        """Yield what an element could not take over, a sentence each."""
        element = self.elements[name]
        missing = element.followed()
        port, field = f"'{name}.in'", element.media_fields[0]
        takes = f"'{name}' takes its {field} over (FOLLOWS), but"
        medium = element.medium_at("in")
        if "outside" in missing:
            if not self.fronts.get(name):
                yield f"{takes} no boundary before it sends light to {port}; give the index"
        elif "outside" in self.given[name].followed():
            k = None if element.lit_from_absorbing else absorption_of(medium)
            if k is not None and k.known and not k.traced and np.any(k.numbers()):
                yield f"{takes} the medium before {port} absorbs; give that {_CLEAR}"
            elif any(_differ(index, medium) for index in self._media(name)):
                yield f"{takes} light of several media comes to {port}; {_OWN_FACE}"
        if "incidence" not in missing:
            return
        why = "no parallel boundary before it, without world frames, refracts to it; give the angle"
        if element.incidence_in is not None:
            why = "has an incidence_in of its own, which comes with it; leave that out"
        elif self.layers.get(name):
            return
        yield f"'{name}' takes its incidence over (FOLLOWS), but {why}"


def _by_end(meetings: Any) -> dict[str, list[Meeting]]:
    results: dict[str, list[Meeting]] = {}
    for meeting in meetings:
        results.setdefault(meeting.enters[0], []).append(meeting)
    return results


def _real(index: Any) -> Any:
    """Return an index without absorption as a real number; open ones are compared later."""
    k = absorption_of(index) if isinstance(index, Material) else None
    if k is not None and (not k.known or k.traced):
        return Material(index.n)
    return index


def _real_if_clear(index: Any) -> Any:
    """Return an index of complex numbers without absorption as a real one; any other as it is."""
    if isinstance(index, complex) or (isinstance(index, np.ndarray) and index.dtype.kind == "c"):
        return index if np.any(index.imag) else read_only(index.real)
    return index


def _differ(first: Any, second: Any) -> bool:
    """Tell whether two indices are known to be of different media."""
    (n1, k1), (n2, k2) = parts_of(first), parts_of(second)
    laws = [SameMedium(operands, "", "", "") for operands in ((n1, n2), (n1, n2, k1, k2))]
    return not are_same(first, second) and any(law.fault() for law in laws if not law.is_open)
