"""The last realisations of a sample's surfaces, as compiled code takes them."""

from __future__ import annotations

from threading import Lock
from typing import TYPE_CHECKING

from optipath.surfaces.walk.packed_meshes import packed_meshes

if TYPE_CHECKING:
    from optipath.surfaces.samples.sample import Sample
    from optipath.surfaces.walk.packed_meshes import PackedMeshes

_MORE = 8
"""How many are kept besides those in turn, for blocks that are walked a little earlier or later."""


class KeptMeshes:
    """Packs what a sample draws, once for all threads, and drops what was packed first.

    Parameters
    ----------
    sample : Sample
        Whose surfaces they are.
    """

    def __init__(self, sample: Sample) -> None:
        self._sample = sample
        self._known: dict[int, PackedMeshes] = {}
        self._lock = Lock()

    def of(self, surface: int) -> PackedMeshes:
        """Return a realisation.

        Parameters
        ----------
        surface : int
            Which.

        Returns
        -------
        PackedMeshes
        """
        with self._lock:
            if surface not in self._known:
                if len(self._known) >= self._sample.surfaces + _MORE:
                    self._known.pop(next(iter(self._known)))
                self._known[surface] = packed_meshes(self._sample.fields(surface))
            return self._known[surface]


def kept_meshes(sample: Sample) -> KeptMeshes:
    """Return those that are kept with a sample.

    Parameters
    ----------
    sample : Sample
        Whose.

    Returns
    -------
    KeptMeshes
    """
    found: KeptMeshes = vars(sample).setdefault("_packed", KeptMeshes(sample))
    return found
