"""The events of a photon as a table to be read."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from optipath.surfaces.replay.photon import Photon
    from optipath.surfaces.replay.photon_event import PhotonEvent

_HEADS = ("", "layer", "", "media", "incidence", "turn", "probability", "x", "y", "z")


def photon_table(photon: Photon) -> str:
    """Return what happens to a photon, a line for each event.

    Parameters
    ----------
    photon : Photon
        Which photon.

    Returns
    -------
    str
        Angles are in degrees; x, y and z are the point on the mesh of the layer.
    """
    rows = [_HEADS, *(_row(*each) for each in enumerate(photon.events, 1))]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [
        "  ".join(text.rjust(width) for text, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
    stokes = np.array2string(photon.stokes, precision=6)
    return "\n".join([f"{repr(photon)[1:-1]}, with Stokes vector", stokes, *lines])


def _row(number: int, event: PhotonEvent) -> tuple[str, ...]:
    what = "reflected" if event.reflected else "refracted"
    angles = (f"{degrees(angle):.3f}" for angle in (event.incidence, event.turn))
    media = f"{_index(event.n1)} | {_index(event.n2)}"
    where = (f"{number:.3f}" for number in event.on_mesh)
    share = f"{event.probability:.6f}"
    return (str(number), str(event.layer), what, media, *angles, share, *where)


def _index(index: Any) -> str:
    if np.ndim(index):
        return "n + ik"
    return f"{index.real:g}+{index.imag:g}j" if np.iscomplexobj(index) else f"{index:g}"
