"""Splitter: a beam splitter's ports and frames; what passes goes straight through."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from optipath.elements.four_port import FourPort
from optipath.elements.frame_checks import same_frame, share_x

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.light.frames import Frame

_THROUGH = {"in": "transmitted", "transmitted": "in", "back": "reflected", "reflected": "back"}


class Splitter(FourPort):
    """An element with two sides, all of whose ports have x = s, and no natural way out."""

    natural: ClassVar[str] = ""

    def frame_of(self, port: str, frames: Mapping[str, Frame]) -> Frame | None:
        return frames.get(port) or frames.get(_THROUGH[port])

    def frame_faults(self, owner: str, frames: Mapping[str, Frame]) -> list[str]:
        found = []
        for enters, passes, turns in (
            ("in", "transmitted", "reflected"),
            ("back", "reflected", "transmitted"),
        ):
            entry = frames.get(enters)
            if entry is None:
                continue
            if not same_frame(frames.get(passes, entry), entry):
                found.append(
                    f"'{owner}' lets transmitted light go straight through; give "
                    f"'{owner}.{enters}' and '{owner}.{passes}' one frame"
                )
            if not share_x(frames.get(turns, entry), entry):
                found.append(
                    f"the frames of '{owner}.{enters}' and '{owner}.{turns}' must share one x"
                )
        return found
