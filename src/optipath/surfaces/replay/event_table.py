"""Events of a photon as a table to be read."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable

    from optipath.surfaces.replay.photon_event import PhotonEvent

_HEADS = ("", "layer", "", "media", "incidence", "turn", "probability", "x", "y", "z")


def event_table(events: Iterable[PhotonEvent]) -> str:
    """Return a line for each event of a photon."""
    rows = [_HEADS, *(_row(number, event) for number, event in enumerate(events, 1))]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return "\n".join(
        "  ".join(text.rjust(width) for text, width in zip(row, widths, strict=True))
        for row in rows
    )


def _row(number: int, event: PhotonEvent) -> tuple[str, ...]:
    what = "reflected" if event.reflected else "refracted"
    media = f"{_index(event.n1)} | {_index(event.n2)}"
    angles = [f"{_rounded(degrees(angle))} deg" for angle in (event.incidence, event.turn)]
    where = map(_rounded, event.on_mesh)
    return str(number), str(event.layer), what, media, *angles, f"{event.probability:.6f}", *where


def _rounded(number: float) -> str:
    # Adding 0 turns -0 into 0.
    return f"{round(number, 3) + 0.0:.3f}"


def _index(index: Any) -> str:
    if np.ndim(index):
        return "n + ik"
    return f"{index.real:g}+{index.imag:g}j" if np.iscomplexobj(index) else f"{index:g}"
