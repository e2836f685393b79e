"""What happens at the vertices of chains that differ in it: out of letters, a number for each."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.vertices.naming import of_chain
from optipath.errors import ValueFault, shown
from optipath.kernels.geometry.events import Event
from optipath.paths.histories.chain_lengths import has_ended
from optipath.paths.histories.vertex_events import REFLECTS, REFRACTS
from optipath.values.arrays.array_likes import as_given

if TYPE_CHECKING:
    import numpy.typing as npt

    Floats = npt.NDArray[np.float64]
    Letters = npt.NDArray[np.uint32]

_CURE = "give R for each vertex that reflects and T for each that refracts"


def letters_given(events: Any, count: int) -> Letters:
    """Return the letter of each vertex of each chain, as its number in Unicode; 0 for none.

    Shapes: events (..., count); returns (..., count).

    Examples
    --------
    >>> letters_given(["RT", "T"], 2).tolist()
    [[82, 84], [84, 0]]
    """
    texts = _texts(events)
    width = max(texts.dtype.itemsize // 4, 1)
    letters = np.ascontiguousarray(texts).view(np.uint32).reshape(*texts.shape, width)
    if texts.ndim < 2:
        if width > count:
            raise ValueFault(_too_long(texts, count))
        room = np.zeros((*texts.shape, count - width), np.uint32)
        return np.concatenate([letters, room], axis=-1)
    if texts.shape[-1] != count or width > 1:
        raise ValueFault(
            f"events is an array of {texts.shape} texts of up to {width} letters; give a text for "
            f"each chain, in one row, or an array of shape (..., {count}) of single letters"
        )
    return letters[..., 0]


def events_of(letters: Letters, lengths: npt.NDArray[np.int64] | None) -> Floats:
    """Return what happens at each vertex of each chain, by numbers of `Event`.

    Shapes: letters (..., count); lengths (...); returns (..., count).

    Examples
    --------
    >>> events_of(letters_given(["RTR", "T"], 3), None)
    array([[0., 1., 0.],
           [1., 2., 2.]])
    """
    if lengths is None:
        # Of a text, all behind its last letter is none.
        ended = np.logical_and.accumulate(letters[..., ::-1] == 0, axis=-1)[..., ::-1]
        ended[..., 0] = False
    else:
        ended = has_ended(lengths, letters.shape[-1])
    refracts = letters == ord(REFRACTS)
    told = refracts | (letters == ord(REFLECTS)) | ended
    codes = np.empty(told.shape)
    codes[...] = refracts  # By their numbers, 0 and 1.
    np.copyto(codes, Event.BEHIND, where=ended)
    if not np.all(told):
        bad = ~told
        chain, place = (int(found[0]) for found in np.nonzero(bad.reshape(-1, bad.shape[-1])))
        letter = np.broadcast_to(letters, codes.shape).reshape(-1, bad.shape[-1])[chain, place]
        found = f"is {shown(chr(letter))}" if letter else "is missing"
        where = of_chain(chain, codes.shape[:-1])
        raise ValueFault(f"events: letter {place + 1}{where} {found}; {_CURE}")
    return codes


def _texts(events: Any) -> npt.NDArray[np.str_]:
    array = as_given("events", events)
    if array.dtype.kind == "O" and all(isinstance(text, str) for text in array.ravel()):
        array = array.astype(str)
    if array.dtype.kind != "U":
        raise ValueFault(
            f"events is {shown(events)}; {_CURE}, such as 'RT' for all chains, a text for each, or "
            f"an array of single letters"
        )
    return array


def _too_long(texts: npt.NDArray[np.str_], count: int) -> str:
    lengths = np.char.str_len(texts)
    chain = int(np.argmax((lengths > count).ravel()))
    most = f"{count} vert{'ices' if count != 1 else 'ex'}"
    return (
        f"events{of_chain(chain, texts.shape)} has {lengths.ravel()[chain]} letters for {most} at "
        f"most; give R or T for each vertex, in order"
    )
