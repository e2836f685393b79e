"""Histories of chains: reflection or refraction, and the medium, at each vertex."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.vertex_chain import of_chain
from optipath.errors import ValueFault, shown
from optipath.kernels.vertex_chain import Event
from optipath.materials.index_domains import INDEX
from optipath.materials.material import Material
from optipath.values.arrays import as_argument, broadcast_fault, first_place, locked
from optipath.values.jax_values import is_traced
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

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
    events: str | Floats
    ended: Bools | None = None

    @property
    def count(self) -> int:
        """The most vertices that a chain has."""
        return len(self.materials)


def histories(
    materials: Sequence[Any], events: Any, ids: Any, lengths: Any, batch: tuple[int, ...]
) -> Histories:
    """Return the histories of chains whose points have a batch of this shape.

    >>> histories((1.5, 1.0), ["TT", "R"], None, None, (2,)).events.tolist()
    [[1.0, 1.0], [0.0, 2.0]]
    """
    chosen = None if ids is None else _rows_of_ids(ids)
    count = len(materials) if chosen is None else chosen.shape[-1]
    known_lengths = None if lengths is None else _checked_lengths(lengths, count)
    letters = letters_of(REFLECTS * count if events is None else events, count)
    batches = {
        "vertices": batch,
        "ids": () if chosen is None else chosen.shape[:-1],
        "lengths": () if known_lengths is None else known_lengths.shape,
        "events": letters.shape[:-1],
    }
    if faults := broadcast_fault({name: shape for name, shape in batches.items() if shape}):
        raise ValueFault(*faults)
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
    """Return the events of histories by numbers, shape (..., m).

    >>> numbers_of_events(Histories((1.5, 1.0), "RT"))
    array([0., 1.])
    """
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
    letters = np.ascontiguousarray(texts).view(np.uint32).reshape(*texts.shape, width)
    if texts.ndim < 2:
        if width > count:
            raise ValueFault(
                f"events has {width} letters for a chain of {count} vertices at most; {_CURE}"
            )
        room = np.zeros((*texts.shape, count - width), np.uint32)
        return np.concatenate([letters, room], axis=-1)
    if texts.shape[-1] != count or width > 1:
        raise ValueFault(
            f"events is an array of {texts.shape} texts of up to {width} letters; give a text for "
            f"each chain, in one row, or an array of shape (..., {count}) of single letters"
        )
    return letters[..., 0]


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


def _checked_lengths(lengths: Any, count: int) -> npt.NDArray[np.int64]:
    """Return how many vertices each chain has."""
    numbers = _real_numbers("lengths", lengths)
    bad = ~((numbers >= 1) & (numbers <= count) & (numbers == np.rint(numbers)))
    if np.any(bad):
        raise ValueFault(
            f"lengths is {_first(numbers, bad)}; give how many vertices each chain has, "
            f"1 .. {count}"
        )
    return numbers.astype(np.int64)


def _rows_of_ids(ids: Any) -> npt.NDArray[Any]:
    """Return ids as an array of real numbers, shape (..., m)."""
    numbers = _real_numbers("ids", ids)
    if not numbers.ndim or not numbers.shape[-1]:
        raise ValueFault(f"ids must have shape (..., m), one for each vertex, not {numbers.shape}")
    return numbers


def _real_numbers(what: str, argument: Any) -> npt.NDArray[Any]:
    numbers = as_argument(what, argument)
    if numbers.dtype.kind not in "iuf":
        raise ValueFault(f"{what} must be whole numbers, not {shown(argument)}")
    return numbers


def _first(numbers: npt.NDArray[Any], bad: Bools) -> str:
    """Return the first number that is bad, and its place."""
    return f"{numbers[bad].ravel()[0]:.12g}{first_place(bad)}"


def ids_within(numbers: npt.NDArray[Any], media: int, ended: Bools) -> npt.NDArray[Any]:
    """Return which medium is behind each vertex (..., m) of each chain.

    >>> ended = np.array([[False, False], [False, True]])
    >>> ids_within(np.array([[0, 1], [1, -1]]), 2, ended).tolist()
    [[0, 1], [1, 0]]
    """
    bad = ((numbers < 0) | (numbers >= media) | (numbers != np.rint(numbers))) & ~ended
    if np.any(bad):
        raise ValueFault(
            f"ids is {_first(np.broadcast_to(numbers, bad.shape), bad)}; give the place of one of "
            f"the materials, 0 .. {media - 1}"
        )
    with np.errstate(invalid="ignore"):  # Behind the end of a chain.
        few = numbers.astype(np.min_scalar_type(media - 1))
    return few * ~ended


def media_by_ids(materials: Sequence[Any], ids: npt.NDArray[Any]) -> tuple[Any, ...]:
    """Return the medium behind each vertex by ids (..., m), an array over chains each.

    >>> media_by_ids([1.5, 1.0], np.array([[0, 1], [1, 1]]))
    (array([1.5, 1. ]), array([1., 1.]))
    """
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
    """Return n and k of a medium as numbers.

    >>> index_parts("gold", 0.2 + 3j)
    (array(0.2), array(3.))
    """
    parts = (medium.n, medium.k) if isinstance(medium, Material) else (medium,)
    if any(isinstance(part, Parameter) or is_traced(part) for part in parts):
        raise ValueFault(
            f"{name} is given when the path runs, but chains that differ need numbers; give a "
            f"number here, and make a path for each value"
        )
    if isinstance(medium, Material):
        n, k = (domain.check(part, value) for part, value, domain in INDEX.parts(name, medium))
    else:
        index = INDEX.check(name, medium)
        n, k = index.real, index.imag if index.dtype.kind == "c" else np.zeros(())
    return locked(np.asarray(n)), locked(np.asarray(k))
