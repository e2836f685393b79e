"""What light does at each vertex of a chain, R or T, and the media that it is in meanwhile."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import ValueFault, shown
from optipath.values.domains.indices import CLEAR, INDEX
from optipath.values.made import faults_of, kept_value
from optipath.values.use import Use

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.values.domains.domain import Domain

REFLECTS, REFRACTS = "R", "T"


def event_faults(events: Any, count: int) -> list[str]:
    """Return what is wrong with the events of a chain, a sentence each.

    Examples
    --------
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

    Examples
    --------
    >>> passable("RT", (1.5 + 2j, 1.5))
    ([(1.5+2j), 1.5], [])
    """
    media, faults = list(materials), []
    for place, event in enumerate(events):
        if event == REFRACTS and (found := medium_faults(f"vertex{place + 1}.index", media[place])):
            media[place] = 1.0
            faults += found
    return media, faults


def medium_faults(owner: str, medium: Any, domain: Domain = CLEAR) -> list[str]:
    """Return why a value is no medium that light may go on in, or come from."""
    if doubt := INDEX.doubt(owner, medium):
        return [doubt]
    try:
        kept = kept_value(owner, medium, domain)
    except ValueFault as fault:
        return list(fault.faults)
    return faults_of(Use(name, value, of) for name, value, of in domain.parts(owner, kept))


def media_in_front(events: str, materials: Sequence[Any], outside: Any) -> list[Any]:
    """Return the medium that light comes from at each vertex.

    Examples
    --------
    A pane with an echo in it:

    >>> media_in_front("TRT", (1.5, 1.0, 1.0), 1.0)
    [1.0, 1.5, 1.5]
    """
    found, medium = [], outside
    for event, material in zip(events, materials, strict=True):
        found.append(medium)
        medium = material if event == REFRACTS else medium
    return found


def _meant(events: Any) -> str:
    """Return the text that was meant, if it is one of the two letters but for how it is written."""
    if not isinstance(events, str):
        parts = events if isinstance(events, (list, tuple)) else ()
        if not all(isinstance(part, str) for part in parts):
            return ""
        events = "".join(parts)
    bare = "".join(letter for letter in events.upper() if letter not in " ,;-\t\n")
    return bare if set(bare) <= {REFLECTS, REFRACTS} else ""
