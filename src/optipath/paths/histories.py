"""Histories of chains: what happens at each vertex, and in which media; known, or parameters."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from functools import cached_property
from hashlib import blake2b
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple, Self

import numpy as np

from optipath.elements.vertex_chain import of_chain
from optipath.elements.vertex_place import goes_along
from optipath.elements.vertices import RefractingVertex, SpecularVertex, Vertex
from optipath.errors import OptipathError, ValueFault
from optipath.faults import shown
from optipath.kernels.vertex_chain import Event
from optipath.materials.index_domains import INDEX
from optipath.materials.material import Material
from optipath.plan.batches import holds_for_all
from optipath.values.arrays import (
    as_argument,
    broadcast_fault,
    first_place,
    joint_shape,
    locked,
    read_only,
)
from optipath.values.curve_value import CurveValue
from optipath.values.domains import Domain
from optipath.values.jax_values import is_traced
from optipath.values.parameters import THERE, Parameter, Resolved
from optipath.values.precision import ENDLESS

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    import numpy.typing as npt

    from optipath.elements.vertex_chain import IfBad
    from optipath.elements.vertices import ChainVertex

    Floats = npt.NDArray[np.float64]
    Letters = npt.NDArray[np.uint32]
    Bools = npt.NDArray[np.bool_]


REFLECTS, REFRACTS = "R", "T"
_CURE = "give R for each vertex that reflects and T for each that refracts"


@dataclass(frozen=True, eq=False)
class Histories:
    """The chains of a batch, besides their points.

    Events are letters where all chains have the same, else `Event` numbers (..., m).
    """

    materials: tuple[Any, ...]
    outside: Any
    events: str | Floats
    ended: Bools | None = None

    @property
    def count(self) -> int:
        """The most vertices that a chain has."""
        return len(self.materials)

    @property
    def codes(self) -> Floats:
        """The events by numbers, shape (..., m)."""
        if isinstance(self.events, np.ndarray):
            return self.events
        return events_of(letters_of(self.events, self.count), None)

    def media(self) -> Iterator[tuple[Floats, Floats, Floats]]:
        """Yield n and k of the medium behind each vertex, and n in front of it."""
        codes, n = self.codes, index_parts("outside", self.outside).n
        front = n
        for place, material in enumerate(self.materials):
            if place:
                shapes = {"events": codes.shape[:-1], f"materials[{place - 1}]": n.shape}
                ValueFault.raise_for(broadcast_fault(shapes | {"the medium before": front.shape}))
                front = locked(np.where(codes[..., place - 1] == Event.REFRACTS, n, front))
            n, k = index_parts(f"materials[{place}]", material)
            yield n, k, front

    def vertices(self, points: Any, bad: IfBad) -> list[ChainVertex]:
        """Return the vertices of a path."""
        if not isinstance(self.events, str):
            results = self._vertices_by_numbers(points, bad)
        else:
            pairs = [*zip(self.events, self.materials, strict=True)]
            behind = (known_index(medium) for event, medium in pairs if event == REFRACTS)
            if bad == "mask" and any(index is not None and np.any(index.k) for index in behind):
                # Light would go on in what absorbs, which is told chain by chain alone.
                return replace(self, events=self.codes).vertices(points, bad)
            results = []
            front = self.outside
            for place, (event, medium) in enumerate(pairs, 1):
                kind = SpecularVertex if event == REFLECTS else RefractingVertex
                index = index_of(*medium) if type(medium) is KnownIndex else medium
                results.append(kind(index, points, place, front, self.count, bad))
                front = index if event == REFRACTS else front
        if bad == "refuse" and self._goes_along(points):
            for vertex in results:  # What is known of them is sound, and is not looked at again.
                vars(vertex).update(_is_sound=True, _goes=True)
        return results

    def _vertices_by_numbers(self, points: Any, bad: IfBad) -> list[ChainVertex]:
        events: Any = locked(self.codes)
        results: list[ChainVertex] = []
        for place, (n, k, front) in enumerate(self.media(), 1):
            vertex = Vertex(index_of(n, k), points, place, unboxed(front), events=events, bad=bad)
            for before in results[-1:]:  # The very array, so that nobody compares them.
                vars(before)["_behind"] = before.index, before.outside, vertex.outside
            results.append(vertex)
        return results

    def _goes_along(self, points: Any) -> bool:
        """Tell, in one pass, whether light can go along many chains."""
        if not isinstance(points, np.ndarray) or points.size < _MANY:
            return False  # Of few, each vertex is asked sooner.
        events = self.codes
        try:
            numbers: list[Any] = [index_parts("outside", self.outside).n]
            for place, material in enumerate(self.materials):
                numbers += [events[..., place], *index_parts("", material)]
            numbers += [
                points[..., at, axis] for at in range(points.shape[-2]) for axis in range(3)
            ]
            batch = joint_shape(*[number.shape for number in numbers])
        except OptipathError:
            return False  # They are parameters, or there is a fault of its own.
        known = [number.item() if number.size == 1 else number for number in numbers]
        return holds_for_all(goes_along, known, batch)


_MANY = 1 << 20
"""The coordinates of points for which a pass is compiled."""


class Said(NamedTuple):
    """What is said of histories: letters (..., m), ids (..., m) and lengths (...), as read."""

    events: Letters
    ids: npt.NDArray[Any] | None = None
    lengths: npt.NDArray[Any] | None = None


def read_part(what: str, value: Any, count: int) -> npt.NDArray[Any]:
    """Return events, ids or lengths as `Said` has them; a count of 0 is any."""
    if what == "events":
        return letters_of(value, count)
    numbers = as_argument(what, value)
    if numbers.dtype.kind not in "iuf":
        raise ValueFault(f"{what} must be whole numbers, not {shown(value)}")
    width = numbers.shape[-1] if numbers.ndim else 0
    if what == "ids" and (not width or width != (count or width)):
        shape = f"(..., {count or 'm'}), one for each vertex, not {numbers.shape}"
        raise ValueFault(f"ids must have shape {shape}")
    return numbers


def histories(
    materials: Sequence[Any],
    outside: Any,
    parts: Mapping[str, Any],
    count: int,
    batch: tuple[int, ...],
) -> Histories | OpenHistories:
    """Return the histories of chains whose points have a batch of this shape.

    They are open where some of the parts, events, ids and lengths, are parameters.
    """
    given = [HistoryParameter.of(a, w, count) for w, a in parts.items() if isinstance(a, Parameter)]
    front = index_parts("outside", outside).n if given else outside
    said = {"events": REFLECTS * count} | {w: one for w, one in parts.items() if one is not None}
    known = {w: read_part(w, a, count) for w, a in said.items() if not isinstance(a, Parameter)}
    if given:
        if "ids" in said:
            media_by_ids(materials, np.zeros((0, count), int))  # Looks at them.
        media = [index_parts(f"materials[{at}]", one) for at, one in enumerate(materials)]
        known = {"events": letters_of(REFLECTS * count, count)} | known
        return OpenHistories(tuple(media), front, count, Said(**known), tuple(given))
    shapes = {what: known[what].shape for what in ("ids", "lengths", "events") if what in known}
    shapes = {what: shape if what == "lengths" else shape[:-1] for what, shape in shapes.items()}
    shapes = {what: shape for what, shape in ({"vertices": batch} | shapes).items() if shape}
    ValueFault.raise_for(broadcast_fault(shapes))
    chains = history_of(materials, front, Said(**known))
    rows = chains.codes.reshape(-1, count)
    alike = chains.ended is None and len(rows) and np.all(rows[:64] == rows[0])
    if alike and np.all(rows == rows[0]):
        text = "".join(REFRACTS if code == Event.REFRACTS else REFLECTS for code in rows[0])
        return replace(chains, events=text)
    return chains


def history_of(materials: Sequence[Any], outside: Any, said: Said) -> Histories:
    """Return the histories of chains, their events by numbers."""
    letters, ids, lengths = said
    count = letters.shape[-1]
    if lengths is not None:
        bad = ~((lengths >= 1) & (lengths <= count))
        _refuse("lengths", lengths, bad, f"how many vertices each chain has, 1 .. {count}")
    codes = events_of(letters, lengths)
    ended = codes == Event.BEHIND
    media = tuple(materials)
    if ids is not None:
        media = media_by_ids(materials, ids_within(ids, len(materials), ended))
    return Histories(media, outside, codes, ended if np.any(ended) else None)


def letters_of(events: Any, count: int) -> Letters:
    """Return the letters (..., count) of the vertices of chains, in Unicode; 0 for none.

    >>> letters_of(["RT", "T"], 2).tolist()
    [[82, 84], [84, 0]]
    """
    if type(events) is np.ndarray and events.dtype.kind == "U":
        texts = events.astype(events.dtype.newbyteorder("="), copy=False)
    else:
        texts = as_argument("events", events)
    if texts.dtype.kind == "O" and all(isinstance(text, str) for text in texts.ravel()):
        texts = texts.astype(str)
    if texts.dtype.kind != "U":
        raise ValueFault(f"events is {shown(events)}; {_CURE}, such as 'RT'")
    width = max(texts.dtype.itemsize // 4, 1)
    if texts.ndim < 2:
        if width > count:
            many = f"{width} letters for a chain of {count} vertices at most"
            raise ValueFault(f"events has {many}; {_CURE}")
        padded = np.ascontiguousarray(texts.astype(f"U{count}"))
        return padded.view(np.uint32).reshape(*texts.shape, count)
    if texts.shape[-1] != count or width > 1:
        cure = f"a text for each chain, in one row, or single letters of shape (..., {count})"
        raise ValueFault(f"events has shape {texts.shape}, of up to {width} letters; give {cure}")
    return np.ascontiguousarray(texts).view(np.uint32)


def events_of(letters: Letters, lengths: npt.NDArray[np.int64] | None) -> Floats:
    """Return the `Event` numbers (..., count) of the vertices of chains.

    >>> events_of(letters_of(["RTR", "T"], 3), None)
    array([[0., 1., 0.],
           [1., 2., 2.]])
    """
    count = letters.shape[-1]
    if lengths is not None:
        ended = np.arange(count) >= lengths[..., np.newaxis]
    elif letters.ndim < 2 or np.all(letters):
        ended = np.zeros(letters.shape, bool)
    else:
        # Of several texts, all behind the last letter is none.
        ended = np.logical_and.accumulate(letters[..., ::-1] == 0, axis=-1)[..., ::-1]
        ended[..., 0] = False
    refracts = letters == ord(REFRACTS)
    known = refracts | (letters == ord(REFLECTS)) | ended
    codes = np.empty(known.shape)
    codes[...] = refracts  # By their numbers, 0 and 1.
    np.copyto(codes, Event.BEHIND, where=ended)
    if not np.all(known):
        chain, place = (int(index[0]) for index in np.nonzero(~known.reshape(-1, count)))
        letter = np.broadcast_to(letters, codes.shape).reshape(-1, count)[chain, place]
        what = f"is {shown(chr(letter))}" if letter else "is missing"
        where = of_chain(chain, codes.shape[:-1])
        raise ValueFault(f"events: letter {place + 1}{where} {what}; {_CURE}")
    return codes


def _refuse(what: str, numbers: npt.NDArray[Any], bad: Bools, cure: str) -> None:
    """Raise where numbers are bad, or not whole."""
    if numbers.dtype.kind == "f":
        bad = bad | (numbers != np.rint(numbers))
    if np.any(bad):
        first = f"{np.broadcast_to(numbers, bad.shape)[bad].ravel()[0]:.12g}{first_place(bad)}"
        raise ValueFault(f"{what} is {first}; give {cure}")


def ids_within(numbers: npt.NDArray[Any], media: int, ended: Bools) -> npt.NDArray[Any]:
    """Return which medium is behind each vertex (..., m) of each chain."""
    whole = numbers
    if ended.any():
        with np.errstate(invalid="ignore"):
            whole = np.where(ended, 0, numbers)
    bad = (whole < 0) | (whole >= media)
    _refuse("ids", whole, bad, f"the place of one of the materials, 0 .. {media - 1}")
    few: npt.NDArray[Any] = whole.astype(np.min_scalar_type(media - 1))
    return few


def media_by_ids(materials: Sequence[Any], ids: npt.NDArray[Any]) -> tuple[Any, ...]:
    """Return the medium behind each vertex by ids (..., m), an array over chains each."""
    n, k = np.ones(len(materials)), np.zeros(len(materials))
    for place, material in enumerate(materials):
        name = f"materials[{place}]"
        one_n, one_k = index_parts(name, material)
        if one_n.ndim or one_k.ndim:
            raise ValueFault(f"{name} is an array, and ids choose from numbers; give one number")
        n[place], k[place] = one_n, one_k
    # Row by row, which is read faster than with a stride.
    rows = np.ascontiguousarray(np.moveaxis(ids, -1, 0))
    clear = locked(np.zeros(()))
    return tuple(
        KnownIndex(locked(n.take(row)), locked(k.take(row)) if np.any(k) else clear) for row in rows
    )


class KnownIndex(NamedTuple):
    """The numbers n and k of a medium, over chains; they have been checked."""

    n: Floats
    k: Floats


def index_parts(name: str, medium: Any) -> KnownIndex:
    """Return n and k of a medium as numbers."""
    if type(medium) is KnownIndex:
        return medium
    parts = (medium.n, medium.k) if isinstance(medium, Material) else (medium,)
    if any(isinstance(part, Parameter) or is_traced(part) for part in parts):
        cure = "chains that differ need numbers; give one here, and make a path for each value"
        raise ValueFault(f"{name} is given when the path runs, but {cure}")
    if isinstance(medium, Material):
        n, k = (domain.check(part, value) for part, value, domain in INDEX.parts(name, medium))
    else:
        index = INDEX.check(name, medium)
        n, k = index.real, index.imag if index.dtype.kind == "c" else np.zeros(())
    return KnownIndex(locked(np.asarray(n)), locked(np.asarray(k)))


def known(value: Any) -> Any:
    """Return what is known of a value, be it by default; None if nothing is."""
    value = value.default if isinstance(value, Parameter) else value
    return None if value is None or is_traced(value) else value


def known_index(medium: Any) -> KnownIndex | None:
    """Return n and k of a medium; None where they are not known."""
    if type(medium) is KnownIndex:
        return medium
    if isinstance(medium, Material):
        n, k = known(medium.n), known(medium.k)
        medium = None if n is None or k is None else Material(n, k)
    medium = known(medium)
    return None if medium is None else index_parts("index", medium)


def index_of(n: Any, k: Any) -> Any:
    """Return what stands for n and k of a medium, numbers or arrays."""
    return Material(unboxed(n), unboxed(k)) if np.any(k) else unboxed(n)


def unboxed(numbers: Floats) -> Any:
    """Return an array, or one number as it is."""
    return numbers if numbers.ndim else float(numbers)


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

    @classmethod
    def of(cls, parameter: Parameter, what: str, count: int) -> Self:
        """Return it for a parameter."""
        own = {f.name: getattr(parameter, f.name) for f in fields(Parameter) if f.init}
        return cls(**own, what=what, count=count)

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
        return replace(self, known=self.known._replace(**known), given=left).values

    def numbers(self, given: Mapping[str, Any]) -> tuple[Any, ...]:
        """Return the numbers of all parts."""
        chains = history_of(self.materials, self.front, self.known._replace(**given))
        return (chains.codes, *chain(*chains.media()))

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
