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
    """Return a line for each event of a photon.

    Parameters
    ----------
    events : iterable of PhotonEvent
        In their order.

    Returns
    -------
    str
        x, y and z are the point on the mesh of the layer.
    """
    rows = [_HEADS, *(_row(number, event) for number, event in enumerate(events, 1))]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return "\n".join(
        "  ".join(text.rjust(width) for text, width in zip(row, widths, strict=True))
        for row in rows
    )


def _row(number: int, event: PhotonEvent) -> tuple[str, ...]:
    what = "reflected" if event.reflected else "refracted"
    media = f"{_index(event.n1)} | {_index(event.n2)}"
    angles = [f"{degrees(angle):.3f} deg" for angle in (event.incidence, event.turn)]
    where = [f"{length:.3f}" for length in event.on_mesh]
    return str(number), str(event.layer), what, media, *angles, f"{event.probability:.6f}", *where


def _index(index: Any) -> str:
    if np.ndim(index):
        return "n + ik"
    return f"{index.real:g}+{index.imag:g}j" if np.iscomplexobj(index) else f"{index:g}"
