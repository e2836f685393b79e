"""A measurement as a job of chunks, of which each is walked by itself and kept."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass, field, replace
from functools import cache, partial
from hashlib import sha256
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from optipath.errors import SurfaceError
from optipath.surfaces.energy_shares import processors
from optipath.surfaces.height_field import HeightField
from optipath.surfaces.hemisphere.beam import CHUNK, NUMBERS, PartSums, SensedBeam
from optipath.surfaces.walk.code import digest_of
from optipath.sweeps.blocks import active_client, keep_blocks

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    from optipath.surfaces.sample import Roughness


LAYOUT = 2
"""The version of what a store of a measurement has in it."""

_SOURCES = "kernels", "engines", "surfaces"
"""What the bits follow from."""


@cache
def measuring_code() -> str:
    """Return a hash of all that the bits of a measurement follow from but for what is measured."""
    return f"{version('optipath')}, {digest_of(_SOURCES)[:16]}"


def _roughness_text(roughness: Roughness) -> str:
    if not isinstance(roughness, HeightField):
        return f"alpha {roughness!r}"
    heights = sha256(roughness.heights.tobytes()).hexdigest()[:16]
    return f"heights {heights} of size {roughness.size!r}, {roughness!r}"


_PIXELS = ("side", "y", "x")
_DIMENSIONS = ("part", *_PIXELS, "wavelength", "number")
_SUMS = "sum over photons of the Mueller matrix, row by row, and of the light without polarisation"


@dataclass(frozen=True, eq=False)
class ChunkJob:
    """A measurement computed chunk by chunk, see `BlockJob`; wavelengths in metres."""

    seen: SensedBeam
    wavelengths: npt.NDArray[np.float64]
    photons: int
    threads: int = 1
    code: str = field(default_factory=measuring_code)

    @property
    def identity(self) -> str:
        """All of what is measured, a line each."""
        sample, indices = self.seen.beam.sample, self.seen.beam.indices
        known: dict[str, Any] = {
            f"layers[{place}]": _roughness_text(layer.roughness)
            for place, layer in enumerate(sample.layers)
        }
        if sample.is_random:
            known |= {name: getattr(sample, name) for name in ("cells", "periodic", "surfaces")}
            known["seed of the sample"] = sample.seed
        known |= {"base n": indices.n.ravel().tolist(), "base k": indices.k.ravel().tolist()}
        known |= {"wavelengths in m": self.wavelengths.tolist(), "photons": self.photons}
        known |= self.seen.facts
        lines = [f"{name}: {value}" for name, value in known.items()]
        return "\n".join([f"a measurement by optipath {self.code}, layout {LAYOUT}", *lines])

    @property
    def blocks(self) -> int:
        """How many chunks there are."""
        return -(-self.photons // CHUNK)

    @property
    def dataset(self) -> xr.Dataset:
        """The fields of `PartSums`, with the chunks before all other dimensions."""
        shape, place = self.seen.shape, self.seen.sensor.coordinates

        def stored(what: str, dims: tuple[str, ...], shape: Any, kind: str = "int64") -> Any:
            numbers = np.broadcast_to(np.zeros((), kind), (self.blocks, *shape))
            return ("chunk", *dims), numbers, {"long_name": what, "units": "1"}

        return xr.Dataset(
            {
                "sums": stored(_SUMS, _DIMENSIONS, shape, "float64"),
                "counts": stored("photons of a pixel", _PIXELS, shape[1:4]),
                "photons": stored("photons of a part", ("part",), shape[:1]),
            },
            {
                "side": ("side", np.array(self.seen.sides)),
                "y": ("y", place, {"units": "1"}),
                "x": ("x", place, {"units": "1"}),
                "wavelength": ("wavelength", self.wavelengths, {"units": "m"}),
                "number": ("number", np.array(NUMBERS[self.seen.polarized])),
            },
            {"title": "chunks of photons of a measurement; optipath.measure adds them up"},
        )

    @property
    def chunks(self) -> dict[str, tuple[int, ...]]:
        """The chunks of each: sums part by part, since codecs take no more than 2 GiB at a time."""
        shape = self.seen.shape
        return {
            "sums": (1, 1, *shape[1:]),
            "counts": (1, *shape[1:4]),
            "photons": (1, *shape[:1]),
        }

    def places(self, number: int) -> dict[str, tuple[slice, ...]]:
        """Return which part of each array a chunk is."""
        return dict.fromkeys(PartSums._fields, (slice(number, number + 1),))

    def task(self, number: int) -> partial[dict[str, npt.NDArray[Any]]]:
        """Return what computes a chunk."""
        return partial(self.compute, number)

    def compute(self, number: int) -> dict[str, npt.NDArray[Any]]:
        """Return the sums over the photons of a chunk."""
        if measuring_code() != self.code:
            raise SurfaceError(
                f"a worker has optipath {measuring_code()}, and the measurement was begun by "
                f"{self.code}; install one version everywhere, and start workers anew"
            )
        # Chunks that are walked at one time have other surfaces in turn, each set kept by a sample.
        own = replace(self.seen.beam, sample=copy(self.seen.beam.sample))
        result = replace(self.seen, beam=own).chunk(number, self.photons, self.threads)
        return {name: each[np.newaxis] for name, each in zip(PartSums._fields, result, strict=True)}


def kept_sums(
    job: ChunkJob,
    store: str,
    scheduler: Any,
    threads: Any,
    progress: Callable[[int, int], None] | None,
) -> PartSums:
    """Walk those chunks that a store does not hold, and add up all of them in their order."""
    if scheduler is None:
        scheduler = active_client() or "synchronous"
    if threads is None:
        threads = processors() if scheduler == "synchronous" else 1

    def tell(chunks: int, _: int) -> None:
        if progress is not None:
            progress(min(CHUNK * chunks, job.photons), job.photons)

    # Whoever asks is warned of coarse meshes, and not workers.
    job.seen.beam.sample.fields()
    stored = keep_blocks(replace(job, threads=int(threads)), store, scheduler, tell)
    there = [stored.arrays[name] for name in PartSums._fields]
    result = PartSums.none(job.seen.shape)
    for number in range(job.blocks):
        result.add(PartSums(*(each[number] for each in there)))
    return result
