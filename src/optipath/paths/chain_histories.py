"""Histories of chains: events and media at each vertex, by palettes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault, collecting
from optipath.kernels.vertex_chain import Event
from optipath.materials.index_domains import INDEX
from optipath.materials.material import Material
from optipath.paths.chain_events import (
    REFLECTS,
    REFRACTS,
    event_faults,
    events_of,
    lengths_passed,
    letters_of,
    number_of,
    whole_numbers,
)
from optipath.values.arrays import broadcast_fault, first_place, locked
from optipath.values.jax_values import is_traced
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Histories:
    """Events (..., m) and ends (..., m) of the chains of a batch, besides their points."""

    materials: tuple[Any, ...]
    events: str | Floats | None = None
    ended: npt.NDArray[np.bool_] | None = None

    @property
    def count(self) -> int:
        """The most vertices that a chain has."""
        return len(self.materials)


def histories(
    materials: Sequence[Any], events: Any, ids: Any, lengths: Any, batch: tuple[int, ...]
) -> tuple[Histories, list[str]]:
    """Return what is told of chains, and what is wrong with it.

    >>> told, faults = histories((1.5, 1.0), ["TT", "R"], None, None, (2,))
    >>> told.events.tolist(), faults
    ([[1.0, 1.0], [0.0, 2.0]], [])
    """
    faults: list[str] = []

    def attempt(read: Any, *argument: Any) -> Any:
        with collecting(faults):
            return read(*argument)

    chosen = None if ids is None else attempt(rows_of_ids, ids)
    count = len(materials) if chosen is None else chosen.shape[-1]
    message = None if lengths is None else attempt(lengths_passed, lengths, count)
    letters = None
    of_text = event_faults(events, count) if isinstance(events, str) and lengths is None else []
    faults += of_text
    # Without materials nothing is known of how many there should be.
    if count and not of_text and not (events is None and lengths is None):
        letters = attempt(letters_of, REFLECTS * count if events is None else events, count)
    batches = {"vertices": batch, "ids": None if chosen is None else chosen.shape[:-1]}
    batches |= {"lengths": getattr(message, "shape", None)}
    batches |= {"events": None if letters is None else letters.shape[:-1]}
    faults += broadcast_fault({name: shape for name, shape in batches.items() if shape})
    result = Histories((*materials, *[*materials[-1:]] * count)[:count])
    if faults or not materials:
        return result, list(dict.fromkeys(faults))
    codes = None if letters is None else attempt(events_of, letters, message)
    ended = None if codes is None else codes == Event.BEHIND
    if chosen is not None:
        media = attempt(media_by_ids, materials, attempt(ids_within, chosen, len(materials), ended))
        result = result if media is None else replace(result, materials=media)
    if faults or codes is None:
        return result, faults
    return _simplest(replace(result, events=codes, ended=ended), message=events is not None), faults


def _simplest(chains: Histories, *, message: bool) -> Histories:
    """Return histories by letters, where all chains have the same."""
    codes: Any = chains.events
    if np.any(chains.ended):
        return chains
    chains = replace(chains, ended=None)
    rows = codes.reshape(-1, codes.shape[-1])
    if len(rows) and np.all(rows == rows[0]):
        text = "".join(REFRACTS if code == Event.REFRACTS else REFLECTS for code in rows[0])
        return replace(chains, events=text if message else None)
    return chains


def masked(chains: Histories, bad: npt.NDArray[np.bool_]) -> Histories:
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
    return events_of(letters_of(chains.events or REFLECTS * chains.count, chains.count), None)


def apart_where_absorbed(chains: Histories) -> Histories:
    """Return histories whose chains are told apart, where light would go on in what absorbs."""
    events = chains.events
    if not isinstance(events, str):
        return chains
    for event, material in zip(events, chains.materials, strict=True):
        try:
            _, k = index_parts("", material, "")
        except ValueFault:
            continue  # A fault of its own, or not known.
        if event == REFRACTS and np.any(k):
            return replace(chains, events=numbers_of_events(chains))
    return chains


def rows_of_ids(ids: Any) -> npt.NDArray[Any]:
    """Return ids as an array of real numbers, shape (..., m)."""
    numbers = whole_numbers("ids", ids)
    if not numbers.ndim or not numbers.shape[-1]:
        raise ValueFault(f"ids must have shape (..., m), one for each vertex, not {numbers.shape}")
    return numbers


def ids_within(numbers: npt.NDArray[Any], media: int, ended: Any) -> npt.NDArray[Any]:
    """Return which medium is behind each vertex (..., m) of each chain.

    >>> ended = np.array([[False, False], [False, True]])
    >>> ids_within(np.array([[0, 1], [1, -1]]), 2, ended).tolist()
    [[0, 1], [1, 0]]
    """
    bad = (numbers < 0) | (numbers >= media)
    if numbers.dtype.kind == "f":
        bad |= numbers != np.rint(numbers)
    there = True if ended is None else ~ended
    bad = bad & there
    if np.any(bad):
        every = np.broadcast_to(numbers, bad.shape)
        raise ValueFault(
            f"ids is {number_of(every, bad)}{first_place(bad)}; give the place of one of the "
            f"materials, 0 .. {media - 1}"
        )
    with np.errstate(invalid="ignore"):  # Behind the end of a chain.
        few = numbers.astype(np.min_scalar_type(media - 1))
    return few * there


def media_by_ids(materials: Sequence[Any], ids: npt.NDArray[Any] | None) -> tuple[Any, ...] | None:
    """Return the medium behind each vertex by ids (..., m), an array over chains each.

    >>> media_by_ids([1.5, 1.0], np.array([[0, 1], [1, 1]]))
    (array([1.5, 1. ]), array([1., 1.]))
    """
    faults: list[str] = []
    n, k = np.ones(len(materials)), np.zeros(len(materials))
    for place, material in enumerate(materials):
        name = f"materials[{place}]"
        with collecting(faults, ValueFault):
            one_n, one_k = index_parts(name, material, "ids choose from numbers")
            if one_n.ndim or one_k.ndim:
                faults.append(f"{name} is an array, and ids choose from numbers; give one number")
            else:
                n[place], k[place] = one_n, one_k
    if faults:
        raise ValueFault(*faults)
    if ids is None:
        return None
    # Row by row, which is read faster than with a stride.
    rows = np.ascontiguousarray(np.moveaxis(ids, -1, 0))
    each = ((locked(n.take(row)), locked(k.take(row)) if np.any(k) else k[:1]) for row in rows)
    return tuple(Material(*parts) if np.any(parts[1]) else parts[0] for parts in each)


def index_parts(name: str, medium: Any, why: str) -> tuple[Floats, Floats]:
    """Return n and k of a medium as numbers.

    >>> index_parts("gold", 0.2 + 3j, "")
    (array(0.2), array(3.))
    """
    parts = (medium.n, medium.k) if isinstance(medium, Material) else (medium,)
    if any(isinstance(part, Parameter) or is_traced(part) for part in parts):
        raise ValueFault(
            f"{name} is given when the path runs, but {why}; give a number here, and make a path "
            f"for each value"
        )
    if isinstance(medium, Material):
        n, k = (domain.check(part, value) for part, value, domain in INDEX.parts(name, medium))
    else:
        index = INDEX.check(name, medium)
        n, k = index.real, index.imag if index.dtype.kind == "c" else np.zeros(())
    return locked(np.asarray(n)), locked(np.asarray(k))
