"""What boundaries take over from those before them: a graph with `FOLLOWS` becomes one without."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.media import SameMedium, absorption_of, are_same, parts_of
from optipath.composer.meetings import Meetings
from optipath.composer.path_values import FOLLOWING
from optipath.composer.wiring import Wiring
from optipath.elements.boundary_media import MediaOfBoundary
from optipath.materials.index_domains import FOLLOWS
from optipath.materials.material import Material
from optipath.values.arrays import read_only

if TYPE_CHECKING:
    from collections.abc import Iterator

    import networkx as nx

    from optipath.composer.meetings import Meeting


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
    following = {name: elements[name].followed() for name in names}
    # An incidence comes with the medium in which it is measured.
    result.graph[FOLLOWING] = {
        name: (*fields, "incidence_in") if "incidence" in fields else fields
        for name, fields in following.items()
    }
    for name in names:
        if not faults.get(name):
            result.nodes[name]["element"] = taking.elements[name]
    messages = [fault for several in faults.values() for fault in several]
    going_round = [name for name in faults if not messages and taking.elements[name].followed()]
    messages += [
        f"'{name}' takes over (FOLLOWS) what the boundaries before it take over, too; give it at "
        f"one of them"
        for name in going_round
    ]
    return result, messages


class _Taking:
    """Gives values on from boundary to boundary, as soon as they are there."""

    def __init__(self, elements: dict[str, Any], names: list[str], meetings: Meetings) -> None:
        self.given, self.elements = elements, dict(elements)
        self.fronts = _by_end(m for m in meetings.all if m.enters[1] == "in")
        self.layers = _by_end(meetings.in_layers)
        self.in_space = _by_end(meetings.in_space)
        behind: dict[str, set[str]] = {}
        for into in (self.fronts, self.layers):
            for name, several in into.items():
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
            elif _may_measure(element) and (pairs := self._angles(name)):
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
        if "outside" in missing and not self.fronts.get(name):
            yield (
                f"'{name}' takes its {field} over (FOLLOWS), but no boundary before it sends light "
                f"to {port}; give the index of the medium in front"
            )
        took = "outside" in self.given[name].followed() and "outside" not in missing
        if took and not element.lit_from_absorbing and _absorbs(element.medium_at("in")):
            yield (
                f"'{name}' takes its {field} over (FOLLOWS), but the medium before {port} absorbs; "
                f"give that an index without k, and link a Medium between, which absorbs on the way"
            )
        elif took and any(_differ(index, element.medium_at("in")) for index in self._media(name)):
            yield (
                f"'{name}' takes its {field} over (FOLLOWS), but light of several media comes to "
                f"{port}; give each light a face of its own"
            )
        if "incidence" in missing and not (_may_measure(element) and self.layers.get(name)):
            why = "no parallel boundary before it sends it light that it has refracted"
            cure = "give the angle"
            if not _may_measure(element):
                why = "has an incidence_in of its own, which comes with it"
                cure = "leave that out"
            elif name in self.in_space:
                why = "its world frames say how it stands to what is before it"
            yield f"'{name}' takes its incidence over (FOLLOWS), but {why}; {cure}"


def _by_end(meetings: Any) -> dict[str, list[Meeting]]:
    results: dict[str, list[Meeting]] = {}
    for meeting in meetings:
        results.setdefault(meeting.enters[0], []).append(meeting)
    return results


def _may_measure(element: Any) -> bool:
    return element.incidence_in is None


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


def _absorbs(index: Any) -> bool:
    """Tell whether an index is known to have an absorption."""
    k = absorption_of(index)
    return k is not None and k.known and not k.traced and bool(np.any(k.numbers()))


def _differ(first: Any, second: Any) -> bool:
    """Tell whether two indices are known to be of different media."""
    (n1, k1), (n2, k2) = parts_of(first), parts_of(second)
    laws = [SameMedium(operands, "", "", "") for operands in ((n1, n2), (n1, n2, k1, k2))]
    return not are_same(first, second) and any(law.fault() for law in laws if not law.is_open)
