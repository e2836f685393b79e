"""Histories: what happens along the chains of a batch, and behind which surfaces they meet what."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, ValueFault
from optipath.kernels.geometry.events import Event
from optipath.paths.histories.chain_lengths import lengths_given
from optipath.paths.histories.event_letters import events_of, letters_given
from optipath.paths.histories.palette import ids_within, index_parts, media_by_ids, rows_of_ids
from optipath.paths.histories.vertex_events import REFLECTS, REFRACTS, event_faults
from optipath.values.arrays.shapes import broadcast_fault

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Histories:
    """What is told of the chains of a batch, besides their points.

    Shapes: events (..., m); ended (..., m).
    """

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

    Examples
    --------
    >>> told, faults = histories((1.5, 1.0), ["TT", "R"], None, None, (2,))
    >>> told.events.tolist(), faults
    ([[1.0, 1.0], [0.0, 2.0]], [])
    """
    faults: list[str] = []

    def attempt(read: Any, *given: Any) -> Any:
        try:
            return read(*given)
        except OptipathError as fault:
            faults.extend(fault.faults)

    chosen = None if ids is None else attempt(rows_of_ids, ids)
    count = len(materials) if chosen is None else chosen.shape[-1]
    told = None if lengths is None else attempt(lengths_given, lengths, count)
    letters = None
    of_text = event_faults(events, count) if isinstance(events, str) and lengths is None else []
    faults += of_text
    # Without materials nothing is known of how many there should be.
    if count and not of_text and not (events is None and lengths is None):
        letters = attempt(letters_given, REFLECTS * count if events is None else events, count)
    batches = {"vertices": batch, "ids": None if chosen is None else chosen.shape[:-1]}
    batches |= {"lengths": getattr(told, "shape", None)}
    batches |= {"events": None if letters is None else letters.shape[:-1]}
    faults += broadcast_fault({name: shape for name, shape in batches.items() if shape})
    found = Histories((*materials, *[*materials[-1:]] * count)[:count])
    if faults or not materials:
        return found, list(dict.fromkeys(faults))
    codes = None if letters is None else attempt(events_of, letters, told)
    ended = None if codes is None else codes == Event.BEHIND
    if chosen is not None:
        media = attempt(media_by_ids, materials, attempt(ids_within, chosen, len(materials), ended))
        found = found if media is None else replace(found, materials=media)
    if faults or codes is None:
        return found, faults
    return _simplest(replace(found, events=codes, ended=ended), told=events is not None), faults


def _simplest(chains: Histories, *, told: bool) -> Histories:
    """Return histories by letters, where all chains have the same."""
    codes: Any = chains.events
    if np.any(chains.ended):
        return chains
    chains = replace(chains, ended=None)
    rows = codes.reshape(-1, codes.shape[-1])
    if len(rows) and np.all(rows == rows[0]):
        text = "".join(REFRACTS if code == Event.REFRACTS else REFLECTS for code in rows[0])
        return replace(chains, events=text if told else None)
    return chains


def masked(chains: Histories, bad: npt.NDArray[np.bool_]) -> Histories:
    """Return histories in which some chains cannot be.

    Shape: bad (...).
    """
    codes = numbers_of_events(chains)
    return replace(chains, events=np.where(bad[..., np.newaxis], Event.CANNOT, codes))


def numbers_of_events(chains: Histories) -> Floats:
    """Return the events of histories by numbers, shape (..., m).

    Examples
    --------
    >>> numbers_of_events(Histories((1.5, 1.0), "RT"))
    array([0., 1.])
    """
    if isinstance(chains.events, np.ndarray):
        return chains.events
    return events_of(letters_given(chains.events or REFLECTS * chains.count, chains.count), None)


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
