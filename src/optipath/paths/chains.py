"""Chains of vertices: reflection or refraction at each, the media along them, and their normals."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.elements.ends import Detector, Source
from optipath.elements.vertex_chain import of_chain, pieces_of
from optipath.elements.vertex_place import deviation, goes_along, off_normals
from optipath.elements.vertices import RefractingVertex, SpecularVertex, Vertex
from optipath.errors import OptipathError, ShapeError, ValueFault
from optipath.faults import shown
from optipath.kernels.catalog import REFRACTION
from optipath.kernels.primitives import NUMPY
from optipath.kernels.vertex_chain import Event
from optipath.materials.index_domains import INDEX
from optipath.materials.material import Material
from optipath.paths.path_graph import PathGraph
from optipath.plan.batches import holds_for_all
from optipath.values.arrays import (
    as_argument,
    broadcast_fault,
    check_broadcast,
    first_place,
    joint_shape,
    locked,
)
from optipath.values.jax_values import is_traced
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from optipath.elements.vertex_chain import IfBad

    Floats = npt.NDArray[np.float64]
    Letters = npt.NDArray[np.uint32]
    Bools = npt.NDArray[np.bool_]
    from collections.abc import Iterable, Iterator

    from optipath.elements.vertices import ChainVertex


REFLECTS, REFRACTS = "R", "T"
_CURE = "give R for each vertex that reflects and T for each that refracts"


@dataclass(frozen=True, eq=False)
class Histories:
    """The chains of a batch, besides their points.

    Events are letters where all chains have the same, else `Event` numbers (..., m).
    """

    materials: tuple[Any, ...]
    events: str | Floats
    ended: Bools | None = None

    @property
    def count(self) -> int:
        """The most vertices that a chain has."""
        return len(self.materials)


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
    materials: Sequence[Any], events: Any, ids: Any, lengths: Any, batch: tuple[int, ...]
) -> Histories:
    """Return the histories of chains whose points have a batch of this shape."""
    chosen = None if ids is None else read_part("ids", ids, 0)
    count = len(materials) if chosen is None else chosen.shape[-1]
    known = None if lengths is None else read_part("lengths", lengths, count)
    letters = letters_of(REFLECTS * count if events is None else events, count)
    batches = {
        "vertices": batch,
        "ids": () if chosen is None else chosen.shape[:-1],
        "lengths": () if known is None else known.shape,
        "events": letters.shape[:-1],
    }
    ValueFault.raise_for(broadcast_fault({name: shape for name, shape in batches.items() if shape}))
    chains = history_of(materials, Said(letters, chosen, known))
    codes = numbers_of_events(chains)
    rows = codes.reshape(-1, count)
    alike = chains.ended is None and len(rows) and np.all(rows[:64] == rows[0])
    if alike and np.all(rows == rows[0]):
        text = "".join(REFRACTS if code == Event.REFRACTS else REFLECTS for code in rows[0])
        return replace(chains, events=text)
    return chains


def history_of(materials: Sequence[Any], said: Said) -> Histories:
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
    return Histories(media, codes, ended if np.any(ended) else None)


def masked(chains: Histories, bad: Bools) -> Histories:
    """Return histories in which some chains cannot be. Shape: bad (...)."""
    codes = numbers_of_events(chains)
    return replace(chains, events=np.where(bad[..., np.newaxis], Event.CANNOT, codes))


def numbers_of_events(chains: Histories) -> Floats:
    """Return the events of histories by numbers, shape (..., m)."""
    if isinstance(chains.events, np.ndarray):
        return chains.events
    return events_of(letters_of(chains.events, chains.count), None)


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


def index_parts(name: str, medium: Any) -> tuple[Floats, Floats]:
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
    return locked(np.asarray(n)), locked(np.asarray(k))


def path_along(vertices: Iterable[ChainVertex], intensity: Any) -> PathGraph:
    """Return the path of light from vertex to vertex."""
    path = PathGraph()
    node = path.add("light", Source(intensity))
    for place, vertex in enumerate(vertices, 1):
        node = node >> path.add(f"vertex{place}", vertex)
    node >> path.add("eye", Detector())
    return path


def vertices_of(points: Any, chains: Histories, outside: Any, bad: IfBad) -> list[ChainVertex]:
    """Return the vertices of chains that are known."""
    vertices = [*_vertices(points, chains, outside, bad)]
    if bad == "refuse" and _goes_along(points, chains, outside):
        for vertex in vertices:  # What is known of them is sound, and is not looked at again.
            vars(vertex).update(_is_sound=True, _goes=True)
    return vertices


_MANY = 1 << 20
"""The coordinates of points for which a pass is compiled."""


def _goes_along(points: Any, chains: Histories, outside: Any) -> bool:
    """Tell, in one pass, whether light can go along many chains."""
    if not isinstance(points, np.ndarray) or points.size < _MANY:
        return False  # Of few, each vertex is asked sooner.
    events = numbers_of_events(chains)
    try:
        numbers: list[Any] = [index_parts("outside", outside)[0]]
        for place, material in enumerate(chains.materials):
            numbers += [events[..., place], *index_parts("", material)]
    except OptipathError:
        return False  # They are parameters.
    numbers += [points[..., place, axis] for place in range(points.shape[-2]) for axis in range(3)]
    shapes = [number.shape for number in numbers]
    try:
        batch = joint_shape(*shapes)
    except ShapeError:
        return False  # A fault of its own.
    known = [number.item() if number.size == 1 else number for number in numbers]
    return holds_for_all(goes_along, known, batch)


def _vertices(points: Any, chains: Histories, outside: Any, bad: IfBad) -> Iterator[ChainVertex]:
    front = outside
    if isinstance(chains.events, str):
        for place, (event, medium) in enumerate(
            zip(chains.events, chains.materials, strict=True), 1
        ):
            kind = SpecularVertex if event == REFLECTS else RefractingVertex
            index = index_of(*medium) if type(medium) is KnownIndex else medium
            yield kind(index, points, place, front, chains.count, bad)
            front = index if event == REFRACTS else front
        return
    events: Any = locked(chains.events)
    front, _ = index_parts("outside", outside)
    for place, material in enumerate(chains.materials, 1):
        n, k = index_parts(f"materials[{place - 1}]", material)
        vertex = Vertex(index_of(n, k), points, place, unboxed(front), events=events, bad=bad)
        if place < chains.count:
            front = locked(np.where(events[..., place - 1] == Event.REFRACTS, n, front))
            # The very array that the next one has in front, so that nobody compares them.
            vars(vertex)["_behind"] = vertex.index, vertex.outside, unboxed(front)
        yield vertex


def index_of(n: Any, k: Any) -> Any:
    """Return what stands for n and k of a medium, numbers or arrays."""
    return Material(unboxed(n), unboxed(k)) if np.any(k) else unboxed(n)


def unboxed(numbers: Floats) -> Any:
    """Return an array, or one number as it is."""
    return numbers if numbers.ndim else float(numbers)


def apart_where_absorbed(chains: Histories) -> Histories:
    """Return histories whose chains are told apart, where light would go on in what absorbs."""
    if isinstance(chains.events, str):
        for event, medium in zip(chains.events, chains.materials, strict=True):
            index = known_index(medium)
            if event == REFRACTS and index is not None and np.any(index[1]):
                return replace(chains, events=numbers_of_events(chains))
    return chains


def known(value: Any) -> Any:
    """Return what is known of a value, be it by default; None if nothing is."""
    value = value.default if isinstance(value, Parameter) else value
    return None if value is None or is_traced(value) else value


def known_index(medium: Any) -> tuple[Floats, Floats] | None:
    """Return n and k of a medium; None where they are not known."""
    if type(medium) is KnownIndex:
        return medium
    if isinstance(medium, Material):
        n, k = known(medium.n), known(medium.k)
        medium = None if n is None or k is None else Material(n, k)
    medium = known(medium)
    return None if medium is None else index_parts("index", medium)


def normals_checked(
    points: Floats, normals: Any, chains: Histories, outside: Any, bad: IfBad
) -> Histories:
    """Return the chains of points (..., m + 2, 3) whose normals (..., m, 3) are theirs."""
    sides = _sides(chains, outside)
    if sides is None:
        raise ValueFault("normals that refract need media that are known; leave them out")
    normals = as_argument("the array of normals", normals)
    check_broadcast({"vertices": points.shape[:-2], "normals": normals.shape[:-2]})
    ended = chains.ended
    if ended is not None and normals.shape[-2:] == (chains.count, 3):
        points = _turned_back(points, ended)
        normals = np.where(ended[..., np.newaxis], 1.0, normals)
    off, sentence = off_normals(points, normals, sides)
    if sentence and bad == "refuse":
        raise ValueFault(sentence)
    return masked(chains, off) if sentence else chains


def _sides(chains: Histories, outside: Any) -> Floats | None:
    """Return the indices (..., m, 2) in front of and behind the vertices, as normals need them.

    They are over the larger one; None where they are not known.
    """
    events = numbers_of_events(chains)
    front, results = known_index(outside), []
    for place, material in enumerate(chains.materials):
        refracts = events[..., place] == Event.REFRACTS
        n1 = n2 = np.ones(())
        if np.any(refracts):
            behind = known_index(material)
            if front is None or behind is None:
                return None
            n1, n2 = front[0], behind[0]
            front = np.where(refracts, n2, n1), front[1]
        larger = np.where(n1 == n2, np.inf, np.maximum(n1, n2))
        otherwise = np.where(events[..., place] == Event.BEHIND, 0.0, 1.0)
        results += [np.where(refracts, n / larger, otherwise) for n in (n1, n2)]
    together = np.broadcast_arrays(*results)
    return np.stack(together, axis=-1).reshape(*together[0].shape, chains.count, 2)


def _turned_back(points: Floats, ended: npt.NDArray[np.bool_]) -> Floats:
    """Return points that go to and fro behind the end of a chain, where nobody says any."""
    batch = np.broadcast_shapes(points.shape[:-2], ended.shape[:-1])
    result = np.array(np.broadcast_to(points, (*batch, *points.shape[-2:])))
    for place in range(ended.shape[-1]):
        where = ended[..., place, np.newaxis]
        np.copyto(result[..., place + 2, :], result[..., place, :], where=where)
    return result


_TURNED = 2.0**-50
"""The deviation below which light goes straight on, which changes nothing."""


def refuse_doubtful(chains: Histories, vertices: Any, outside: Any, there: Any) -> None:
    """Raise where each chain may as well refract at a vertex (..., m) as reflect."""
    points, front = known(vertices), known_index(outside)
    if points is None or front is None:
        return
    events, readings = "", ""
    for place, material in enumerate(chains.materials):
        behind = known_index(material)
        first = _may_refract(points, front, behind, place, there)
        if first is None:
            events += REFLECTS
            continue
        events += REFRACTS
        readings = readings or (
            f"light is turned by {deviation(first[2:]):.6g} deg at vertex {place + 1}"
            f"{of_chain(0, points.shape[:-2])}, which a reflection does, and a refraction from "
            f"n = {first[0]:.6g} into n = {first[1]:.6g}"
        )
        front = behind
    if readings:
        one = f"events='{REFLECTS * len(events)}' where it is reflected"
        raise ValueFault(f"{readings}; say which, {one}, events='{events}' where it goes through")


def _may_refract(points: Any, front: Any, behind: Any, place: int, there: Any) -> Any:
    """Return n on both sides of a vertex and the points around it, of the first chain, or None.

    None unless all chains that have it may refract there.
    """
    if behind is None or any(np.any(k) or np.any(n <= 0.0) for n, k in (front, behind)):
        return None
    around = [points[..., at, axis] for at in range(place, place + 3) for axis in range(3)]
    arrays, has, first = [front[0], behind[0], *around], np.ones(1, bool), None
    try:
        has, *_ = np.broadcast_arrays(has if there is None else there[..., place], has, *arrays)
    except ValueError:
        return None  # A fault of its own.
    for piece in pieces_of(has.size):
        where = np.unravel_index(np.arange(piece.start, piece.stop), has.shape)
        some = has[where]
        numbers = [np.broadcast_to(each, has.shape)[where][some] for each in arrays]
        with np.errstate(all="ignore"):
            *_, cos, sin = REFRACTION.made_for(NUMPY)(*numbers)
            if not np.all((cos >= 0.0) & (sin > _TURNED)):
                return None
        if first is None and np.any(some):
            first = [float(each[0]) for each in numbers]
    return first
