"""The last realisations of a sample's surfaces, as compiled code takes them."""

from __future__ import annotations

from threading import Lock
from typing import TYPE_CHECKING, NamedTuple
from weakref import proxy

from optipath.engines.array_address import address
from optipath.surfaces.fields.height_field import HeightField
from optipath.surfaces.walk.packed_meshes import PackedMeshes, packed_meshes

if TYPE_CHECKING:
    from optipath.surfaces.samples.sample import Sample

_MORE = 8
"""How many are kept besides those in turn, for blocks that are walked a little earlier or later."""


class PlacedMeshes(NamedTuple):
    """Meshes, and where they are in memory."""

    meshes: PackedMeshes
    addresses: tuple[int, ...]


class KeptMeshes:
    """Packs what a sample draws, once for all threads, and drops what was packed first."""

    def __init__(self, sample: Sample) -> None:
        # It keeps these meshes itself, and both are to go as soon as nobody needs it.
        self._sample: Sample = proxy(sample)
        self._known: dict[int, PlacedMeshes] = {}
        self._lock = Lock()

    def of(self, surface: int) -> PlacedMeshes:
        """Return a realisation."""
        with self._lock:
            if surface not in self._known:
                if len(self._known) >= self._sample.surfaces + _MORE:
                    self._known.pop(next(iter(self._known)))
                given = [isinstance(each.roughness, HeightField) for each in self._sample.layers]
                meshes = packed_meshes(self._sample.fields(surface), given)
                self._known[surface] = PlacedMeshes(meshes, tuple(map(address, meshes)))
            return self._known[surface]


def kept_meshes(sample: Sample) -> KeptMeshes:
    """Return those that are kept with a sample."""
    found: KeptMeshes = vars(sample).setdefault("_packed", KeptMeshes(sample))
    return found
