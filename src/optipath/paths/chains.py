"""Chains of vertices: reflection or refraction at each, the media along them, and their normals."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.ends import Detector, Source
from optipath.elements.vertex_chain import of_chain, pieces_of
from optipath.elements.vertex_place import deviation, off_normals
from optipath.elements.vertices import RefractingVertex, SpecularVertex, Vertex
from optipath.errors import ValueFault
from optipath.faults import shown
from optipath.kernels.catalog import REFRACTION
from optipath.kernels.primitives import NUMPY
from optipath.kernels.vertex_chain import Event
from optipath.materials.index_domains import INDEX
from optipath.materials.material import Material
from optipath.paths.path_graph import PathGraph
from optipath.values.arrays import (
    as_argument,
    broadcast_fault,
    check_broadcast,
    first_place,
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
    from collections.abc import Iterator

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


def histories(
    materials: Sequence[Any], events: Any, ids: Any, lengths: Any, batch: tuple[int, ...]
) -> Histories:
    """Return the histories of chains whose points have a batch of this shape."""
    chosen = known_lengths = None
    if ids is not None:
        chosen = _real_numbers("ids", ids)
        if not chosen.ndim or not chosen.shape[-1]:
            shape = f"(..., m), one for each vertex, not {chosen.shape}"
            raise ValueFault(f"ids must have shape {shape}")
    count = len(materials) if chosen is None else chosen.shape[-1]
    if lengths is not None:
        known_lengths = _real_numbers("lengths", lengths)
        bad = ~((known_lengths >= 1) & (known_lengths <= count))
        _refuse("lengths", known_lengths, bad, f"how many vertices each chain has, 1 .. {count}")
    letters = letters_of(REFLECTS * count if events is None else events, count)
    batches = {
        "vertices": batch,
        "ids": () if chosen is None else chosen.shape[:-1],
        "lengths": () if known_lengths is None else known_lengths.shape,
        "events": letters.shape[:-1],
    }
    ValueFault.raise_for(broadcast_fault({name: shape for name, shape in batches.items() if shape}))
    codes = events_of(letters, known_lengths)
    ended = codes == Event.BEHIND
    media = tuple(materials)
    if chosen is not None:
        media = media_by_ids(materials, ids_within(chosen, len(materials), ended))
    if np.any(ended):
        return Histories(media, codes, ended)
    rows = codes.reshape(-1, count)
    if len(rows) and np.all(rows == rows[0]):
        text = "".join(REFRACTS if code == Event.REFRACTS else REFLECTS for code in rows[0])
        return Histories(media, text)
    return Histories(media, codes)


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
    else:
        # Of several texts, all behind the last letter is none.
        ended = np.logical_and.accumulate(letters[..., ::-1] == 0, axis=-1)[..., ::-1]
        ended[..., 0] = False
        ended &= letters.ndim > 1
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


def _real_numbers(what: str, argument: Any) -> npt.NDArray[Any]:
    numbers = as_argument(what, argument)
    if numbers.dtype.kind not in "iuf":
        raise ValueFault(f"{what} must be whole numbers, not {shown(argument)}")
    return numbers


def _refuse(what: str, numbers: npt.NDArray[Any], bad: Bools, cure: str) -> None:
    """Raise where numbers are bad, or not whole."""
    bad = bad | (numbers != np.rint(numbers))
    if np.any(bad):
        first = f"{np.broadcast_to(numbers, bad.shape)[bad].ravel()[0]:.12g}{first_place(bad)}"
        raise ValueFault(f"{what} is {first}; give {cure}")


def ids_within(numbers: npt.NDArray[Any], media: int, ended: Bools) -> npt.NDArray[Any]:
    """Return which medium is behind each vertex (..., m) of each chain."""
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
    each = ((locked(n.take(row)), locked(k.take(row)) if np.any(k) else k[:1]) for row in rows)
    return tuple(Material(*parts) if np.any(parts[1]) else parts[0] for parts in each)


def index_parts(name: str, medium: Any) -> tuple[Floats, Floats]:
    """Return n and k of a medium as numbers."""
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


def path_of_chains(
    points: Any, chains: Histories, intensity: Any, outside: Any, bad: IfBad
) -> PathGraph:
    """Return the path of light from point to point."""
    path = PathGraph()
    node = path.add("light", Source(intensity))
    for place, vertex in enumerate(_vertices(points, chains, outside, bad), 1):
        node = node >> path.add(f"vertex{place}", vertex)
    node >> path.add("eye", Detector())
    return path


def _vertices(points: Any, chains: Histories, outside: Any, bad: IfBad) -> Iterator[ChainVertex]:
    front = outside
    if isinstance(chains.events, str):
        for place, (event, medium) in enumerate(
            zip(chains.events, chains.materials, strict=True), 1
        ):
            kind = SpecularVertex if event == REFLECTS else RefractingVertex
            yield kind(medium, points, place, front, chains.count, bad)
            front = medium if event == REFRACTS else front
        return
    events: Any = locked(chains.events)
    front, _ = index_parts("outside", outside)
    for place, material in enumerate(chains.materials, 1):
        n, k = index_parts(f"materials[{place - 1}]", material)
        behind = Material(_unboxed(n), _unboxed(k)) if np.any(k) else _unboxed(n)
        yield Vertex(behind, points, place, _unboxed(front), events=events, bad=bad)
        front = locked(np.where(events[..., place - 1] == Event.REFRACTS, n, front))


def _unboxed(numbers: Floats) -> Any:
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
        around = _around(points, front, behind, place, there)
        if around is None or not _may_refract(*around):
            events += REFLECTS
            continue
        events += REFRACTS
        readings = readings or (
            f"light is turned by {deviation(around[0][0]):.6g} deg at vertex {place + 1}"
            f"{of_chain(0, points.shape[:-2])}, which a reflection does, and a refraction from "
            f"n = {around[1][0]:.6g} into n = {around[2][0]:.6g}"
        )
        front = behind
    if readings:
        one = f"events='{REFLECTS * len(events)}' where it is reflected"
        raise ValueFault(f"{readings}; say which, {one}, events='{events}' where it goes through")


def _around(
    points: Any, front: Any, behind: Any, place: int, there: Any
) -> tuple[Floats, Floats, Floats] | None:
    """Return the points (n, 9) around a vertex and n on both sides, of all chains that have it.

    None where light cannot go on behind it, or there is no such chain.
    """
    if behind is None or any(np.any(k) or np.any(n <= 0.0) for n, k in (front, behind)):
        return None
    try:
        sides = [points[..., place, 0], front[0], behind[0]]
        batch = np.broadcast_shapes(*(each.shape for each in sides))
        has = np.broadcast_to(True if there is None else there[..., place], batch)
    except ValueError:
        return None  # A fault of its own.
    around = np.broadcast_to(points[..., place : place + 3, :], (*batch, 3, 3)).reshape(*batch, 9)
    n1, n2 = (np.broadcast_to(n, batch)[has] for n in (front[0], behind[0]))
    return (np.asarray(around[has], np.float64), n1, n2) if np.any(has) else None


def _may_refract(points: Floats, front: Floats, behind: Floats) -> bool:
    """Tell whether all chains may refract at a vertex."""
    for piece in pieces_of(len(points)):
        with np.errstate(all="ignore"):
            *_, cos, sin = REFRACTION.made_for(NUMPY)(front[piece], behind[piece], *points[piece].T)
            if not np.all((cos >= 0.0) & (sin > _TURNED)):
                return False
    return True
