"""The ends of a path run the other way: light begins where it ended, and ends where it began."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from optipath.elements.element import Element
from optipath.elements.known_sizes import vanishes
from optipath.elements.source import Source
from optipath.elements.terminal import Detector, Dump
from optipath.errors import did_you_mean, shown, there_are

if TYPE_CHECKING:
    from collections.abc import Collection


def reversed_end(element: Element, source: Element | None = None) -> Element:
    """Return what stands on the way back where light began or ended.

    Examples
    --------
    >>> reversed_end(Source(100.0)), reversed_end(Dump()).intensity
    (Detector(reads='stokes', response=None), 0.0)
    """
    if not element.inputs:
        return Dump() if vanishes(getattr(element, "intensity", 1.0)) else Detector()
    return source or Source(1.0 if element.detects else 0.0)


def sources_by_name(
    given: Any, elements: Mapping[str, Element]
) -> tuple[dict[str, Element], list[str]]:
    """Return the light that begins at each node, and what is wrong with it, a sentence each."""
    ends = [name for name, element in elements.items() if not element.outputs]
    if given is None:
        return {}, []
    if not isinstance(given, Mapping):
        detectors = [name for name in ends if elements[name].detects]
        if len(detectors) == 1:
            given = {detectors[0]: given}
        else:
            which = f", source={{'{detectors[0]}': ...}}" if detectors else ""
            fault = (
                f"source is the light that begins at the only detector, and there are "
                f"{len(detectors)}; give it by name{which}{there_are(ends)}"
            )
            return {}, [fault]
    strange = [name for name in given if name not in ends]
    faults = [f"source['{name}']: no light ends there{_near(name, ends)}" for name in strange]
    wrong = {name: one for name, one in given.items() if not _emits(one)}
    faults += [
        f"source['{name}'] must be a Source, not {shown(one)}" for name, one in wrong.items()
    ]
    return {name: one for name, one in given.items() if name not in wrong}, faults


def _emits(one: Any) -> bool:
    return isinstance(one, Element) and not one.inputs and len(one.outputs) == 1


def _near(name: Any, ends: Collection[str]) -> str:
    return did_you_mean(name, ends) if isinstance(name, str) else there_are([*ends])
