"""Histories of chains that are given when a path runs: events, ids and lengths as parameters."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property
from hashlib import blake2b
from itertools import chain
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.vertices import Vertex
from optipath.kernels.vertex_chain import Event
from optipath.materials.material import Material
from optipath.paths.chains import (
    REFLECTS,
    KnownIndex,
    Said,
    history_of,
    index_of,
    index_parts,
    letters_of,
    media_by_ids,
    numbers_of_events,
    read_part,
)
from optipath.values.arrays import broadcast_fault, locked, read_only
from optipath.values.curve_value import CurveValue
from optipath.values.domains import Domain
from optipath.values.parameters import THERE, Parameter, Resolved
from optipath.values.precision import ENDLESS

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.elements.vertex_chain import IfBad
    from optipath.elements.vertices import ChainVertex


class HistoryDomain(Domain):
    """Events, ids or lengths of chains, which are checked where all of them are known."""

    def quickly_allows(self, value: Any) -> bool:
        return True

    def described(self) -> str:
        return f"{self.name} of chains"


@dataclass(frozen=True, eq=False)
class HistoryParameter(Parameter):
    """Events, ids or lengths that are given when the path runs."""

    what: str = ""
    count: int = 0

    def resolve(self, raw: Any, limits: tuple[float, float] | None = None) -> Resolved:
        numbers = read_part(self.what, raw, self.count)
        if self.what != "events" and (self.minimum, self.maximum) != ENDLESS:
            self._check_range(numbers)
        return Resolved(numbers, THERE)

    def _read_default(self) -> None:
        default = None if self.default is None else read_only(self.default)
        vars(self).update(default=default, is_material=False)

    @property
    def domain(self) -> Domain:
        """What it may be."""
        return HistoryDomain(self.what, tail=(self.count,) if self.what != "lengths" else ())


class HistoryValue(CurveValue):
    """A number of each chain that follows from its history: an event, or n or k of a medium."""

    def argument_places(self, owner: str) -> list[tuple[str, Any, Domain]]:
        node = owner.partition(".")[0]
        return [(f"{node}.{one.what}", one, one.domain) for one in self.depends_on]

    def follows(self, arguments: Mapping[str, Resolved]) -> bool:
        return all(one.name in arguments for one in self.depends_on) and not broadcast_fault(
            self.shapes(arguments)
        )

    def shapes(self, arguments: Mapping[str, Resolved]) -> dict[str, tuple[int, ...]]:
        given = [(one, arguments[one.name].value.shape) for one in self.depends_on]
        return {one.name: shape[: len(shape) - len(one.domain.tail)] for one, shape in given}

    def parts(self, arguments: Mapping[str, Resolved]) -> tuple[Any, ...]:
        given = {one.what: arguments[one.name].value for one in self.depends_on}
        numbers: tuple[Any, ...] = self.curve.numbers(given)
        return numbers

    def bound_to(self, values: Mapping[str, Any]) -> Any:
        if not any(one.name in values for one in self.depends_on):
            return self
        return self.curve.given_by([values.get(one.name, one) for one in self.depends_on])[
            self.place
        ]

    @property
    def is_nowhere_0(self) -> bool:
        return False

    @property
    def shape(self) -> tuple[int, ...]:
        """The axes of its numbers besides the batch: events are of all vertices of a chain."""
        return (self.curve.count,) if self.place == 0 else ()


@dataclass(frozen=True, eq=False)
class OpenHistories:
    """The histories of a batch of chains, of which something is given when the path runs.

    Media are the palette, or one for each vertex; `front` is the index that light starts in.
    """

    materials: tuple[KnownIndex, ...]
    front: Any
    count: int
    known: Said
    given: tuple[HistoryParameter, ...]

    label, span, unit, is_checked = "the chains", (0.0, np.inf), "", True
    events = None

    @property
    def parts(self) -> tuple[str, ...]:
        """What it comes to."""
        return ("events", *("n", "k", "n in front") * self.count)

    @cached_property
    def values(self) -> list[HistoryValue]:
        """What stands for each part in a path: all events; for each vertex n, k, n in front."""
        arrays = [*map(np.asarray, (self.front, *chain(*self.materials))), *self.known]
        about = [a if a is None else (a.dtype.str, a.shape, a.tobytes()) for a in arrays]
        named = repr((about, [(one.what, one.name) for one in self.given]))
        mark = blake2b(named.encode(), digest_size=8).hexdigest()
        return [
            HistoryValue(f"{part} [{mark} {at}]", curve=self, place=at, depends_on=self.given)
            for at, part in enumerate(self.parts)
        ]

    def given_by(self, parameters: Sequence[HistoryParameter]) -> Sequence[Any]:
        """Return what stands for each part where parameters have other defaults, or are bound."""
        known = {one.what: one.resolve(one.default).value for one in parameters if one.bound}
        left = tuple([one for one in parameters if not one.bound])
        if not left:
            return [locked(numbers) for numbers in self.numbers(known)]
        return OpenHistories(
            self.materials, self.front, self.count, self.known._replace(**known), left
        ).values

    def numbers(self, given: Mapping[str, Any]) -> tuple[Any, ...]:
        """Return the numbers of all parts."""
        chains = history_of(self.materials, self.known._replace(**given))
        codes, front = numbers_of_events(chains), self.front
        results: list[Any] = [codes]
        for place, (n, k) in enumerate(chains.materials):
            results += [n, k, front]
            front = np.where(codes[..., place] == Event.REFRACTS, n, front)
        return tuple(results)

    def vertices(self, points: Any, bad: IfBad) -> list[ChainVertex]:
        """Return the vertices of a path."""
        events, *others = self.values
        absorbs = any(np.any(medium.k) for medium in self.materials)
        picks = self.known.ids is not None or "ids" in [one.what for one in self.given]
        results: list[ChainVertex] = []
        for at in range(self.count):
            n, k, front = others[3 * at : 3 * at + 3]
            index: Any = Material(n, k) if absorbs else n
            if not picks:
                index = index_of(*self.materials[at])
            outside = front if at else self.front
            results.append(Vertex(index, points, at + 1, outside, events=events, bad=bad))
        return results


def open_histories(
    materials: Sequence[Any], front: Any, count: int, parts: Mapping[str, Any]
) -> OpenHistories:
    """Return the histories of chains of events, ids and lengths, some of them parameters."""
    parts = {"events": REFLECTS * count} | {w: v for w, v in parts.items() if v is not None}
    opened = {what: value for what, value in parts.items() if isinstance(value, Parameter)}
    known = {w: read_part(w, value, count) for w, value in parts.items() if w not in opened}
    own = [f.name for f in fields(Parameter) if f.init]
    given = [
        HistoryParameter(**{name: getattr(one, name) for name in own}, what=what, count=count)
        for what, one in opened.items()
    ]
    known = {"events": letters_of(REFLECTS * count, count)} | known
    if "ids" in parts:
        media_by_ids(materials, np.zeros((0, count), int))  # Looks at them.
    media = [KnownIndex(*index_parts(f"materials[{at}]", one)) for at, one in enumerate(materials)]
    return OpenHistories(tuple(media), front, count, Said(**known), tuple(given))
