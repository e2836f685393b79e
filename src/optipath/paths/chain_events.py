"""Events along chains of vertices: reflection or transmission, and lengths of chains."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.vertex_chain import of_chain
from optipath.errors import ValueFault, shown
from optipath.kernels.vertex_chain import Event
from optipath.materials.index_domains import CLEAR, INDEX
from optipath.values.arrays import as_argument, first_place
from optipath.values.use import Use, faults_of, stored_value

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from optipath.values.domains import Domain

    Floats = npt.NDArray[np.float64]
    Letters = npt.NDArray[np.uint32]
    Whole = npt.NDArray[np.int64]


REFLECTS, REFRACTS = "R", "T"


def event_faults(events: Any, count: int) -> list[str]:
    """Return what is wrong with the events of a chain, a sentence each.

    >>> event_faults("RTR", 3)
    []
    >>> event_faults("rt", 2)
    ["events is 'rt'; give R for each vertex that reflects and T for each that refracts: 'RT'"]
    """
    meant = _meant(events)
    if not isinstance(events, str) or not set(events) <= {REFLECTS, REFRACTS}:
        cure = "R for each vertex that reflects and T for each that refracts"
        example = f"'{meant}'" if meant else "such as 'RT'"
        return [f"events is {shown(events)}; give {cure}{':' if meant else ','} {example}"]
    if count and len(events) != count:
        letters = f"{len(events)} letter{'s' * (len(events) != 1)}"
        media = f"{count} material{'s' * (count != 1)}"
        return [f"events has {letters} for {media}; give R or T for each vertex, in order"]
    return []


def passable(events: str, materials: Sequence[Any]) -> tuple[list[Any], list[str]]:
    """Return the media of a chain, and why light cannot go on in some of those that it should.

    >>> passable("RT", (1.5 + 2j, 1.5))
    ([(1.5+2j), 1.5], [])
    """
    media, faults = list(materials), []
    for place, event in enumerate(events):
        if event == REFRACTS and (
            result := medium_faults(f"vertex{place + 1}.index", media[place])
        ):
            media[place] = 1.0
            faults += result
    return media, faults


def medium_faults(owner: str, medium: Any, domain: Domain = CLEAR) -> list[str]:
    """Return why a value is no medium that light may go on in, or come from."""
    if doubt := INDEX.doubt(owner, medium):
        return [doubt]
    try:
        stored = stored_value(owner, medium, domain)
    except ValueFault as fault:
        return list(fault.faults)
    return faults_of(Use(name, value, of) for name, value, of in domain.parts(owner, stored))


def media_in_front(events: str, materials: Sequence[Any], outside: Any) -> list[Any]:
    """Return the medium that light comes from at each vertex.

    >>> media_in_front("TRT", (1.5, 1.0, 1.0), 1.0)
    [1.0, 1.5, 1.5]
    """
    result, medium = [], outside
    for event, material in zip(events, materials, strict=True):
        result.append(medium)
        medium = material if event == REFRACTS else medium
    return result


def _meant(events: Any) -> str:
    """Return the text that was meant, if it is one of the two letters but for how it is written."""
    if not isinstance(events, str):
        parts = events if isinstance(events, (list, tuple)) else ()
        if not all(isinstance(part, str) for part in parts):
            return ""
        events = "".join(parts)
    bare = "".join(letter for letter in events.upper() if letter not in " ,;-\t\n")
    return bare if set(bare) <= {REFLECTS, REFRACTS} else ""


_CURE = "give R for each vertex that reflects and T for each that refracts"


def letters_of(events: Any, count: int) -> Letters:
    """Return the letters (..., count) of the vertices of chains, in Unicode; 0 for none.

    >>> letters_of(["RT", "T"], 2).tolist()
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
    """Return the `Event` numbers (..., count) of the vertices of chains.

    >>> events_of(letters_of(["RTR", "T"], 3), None)
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
    message = refracts | (letters == ord(REFLECTS)) | ended
    codes = np.empty(message.shape)
    codes[...] = refracts  # By their numbers, 0 and 1.
    np.copyto(codes, Event.BEHIND, where=ended)
    if not np.all(message):
        bad = ~message
        chain, place = (int(result[0]) for result in np.nonzero(bad.reshape(-1, bad.shape[-1])))
        letter = np.broadcast_to(letters, codes.shape).reshape(-1, bad.shape[-1])[chain, place]
        result = f"is {shown(chr(letter))}" if letter else "is missing"
        where = of_chain(chain, codes.shape[:-1])
        raise ValueFault(f"events: letter {place + 1}{where} {result}; {_CURE}")
    return codes


def _texts(events: Any) -> npt.NDArray[np.str_]:
    array = as_argument("events", events)
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


def lengths_passed(lengths: Any, count: int) -> Whole:
    """Return how many vertices each chain has.

    >>> lengths_passed([1, 3], 3)
    array([1, 3])
    """
    numbers = whole_numbers("lengths", lengths)
    bad = ~((numbers >= 1) & (numbers <= count) & (numbers == np.rint(numbers)))
    if np.any(bad):
        raise ValueFault(
            f"lengths is {number_of(numbers, bad)}{first_place(bad)}; give how many vertices each "
            f"chain has, 1 .. {count}"
        )
    return numbers.astype(np.int64)


def whole_numbers(what: str, argument: Any) -> npt.NDArray[Any]:
    """Return real numbers, which are to be whole ones."""
    numbers = as_argument(what, argument)
    if numbers.dtype.kind not in "iuf":
        raise ValueFault(f"{what} must be whole numbers, not {shown(argument)}")
    return numbers


def number_of(numbers: npt.NDArray[Any], bad: npt.NDArray[np.bool_]) -> str:
    """Return the first number that is bad, as sentences have it.

    >>> number_of(np.array([1.0, 2.5]), np.array([False, True]))
    '2.5'
    """
    return f"{numbers[bad].ravel()[0]:.12g}"


def has_ended(lengths: Whole, count: int) -> npt.NDArray[np.bool_]:
    """Return which vertices (..., count) are behind the end of their chain.

    >>> has_ended(np.array([1, 2]), 2).tolist()
    [[False, True], [False, False]]
    """
    result: npt.NDArray[np.bool_] = np.arange(count) >= lengths[..., np.newaxis]
    return result
