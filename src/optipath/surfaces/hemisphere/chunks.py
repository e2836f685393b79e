"""A measurement as a job of chunks that are kept, each walked by itself."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass, field, replace
from functools import cache, partial
from hashlib import sha256
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import SurfaceError
from optipath.surfaces.height_field import HeightField
from optipath.surfaces.hemisphere.beam import CHUNK, PartSums, SensedBeam
from optipath.surfaces.walk.code import digest_of
from optipath.sweeps.jobs import StoredArray, WholeArray

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy.typing as npt

    from optipath.surfaces.hemisphere.sensor import Sensor
    from optipath.surfaces.sample import Sample
    from optipath.surfaces.sample_layers import Roughness


LAYOUT = 1
"""The version of what a store of a measurement has in it."""

_SOURCES = "kernels", "engines", "surfaces"
"""What the bits follow from."""


@cache
def measuring_code() -> str:
    """Return a hash of all that the bits of a measurement follow from but for what is measured."""
    return f"{version('optipath')}, {digest_of(_SOURCES)[:16]}"


def chunk_identity(
    seen: SensedBeam, wavelengths: npt.NDArray[np.float64], photons: int, code: str
) -> str:
    """Return all of what is measured, a line each; wavelengths in metres."""
    beam = seen.beam
    lines = [
        f"a measurement by optipath {code}, layout {LAYOUT}",
        *_sample_lines(beam.sample),
        f"index outside: {beam.indices.outside!r}",
        f"indices between: {beam.indices.inner!r}",
        f"base n: {beam.indices.n.ravel().tolist()}",
        f"base k: {beam.indices.k.ravel().tolist()}",
        f"wavelengths in m: {wavelengths.tolist()}",
        f"incidence, cosine and sine: {beam.cos!r}, {beam.sin!r}",
        f"azimuth: {beam.azimuth!r}",
        f"states: {beam.states!r}",
        f"sensor: {_sensor(seen.sensor)}",
        f"polarized: {seen.polarized}",
        f"events: {seen.events}",
        f"most_events: {beam.most_events}",
        f"seed: {beam.seed}",
        f"photons: {photons}",
    ]
    return "\n".join(lines)


def _sample_lines(sample: Sample) -> Iterator[str]:
    for place, layer in enumerate(sample.layers):
        yield f"layers[{place}]: {_roughness_text(layer.roughness)}"
    if any(layer.is_random for layer in sample.layers):
        yield f"cells: {sample.cells!r}"
        yield f"periodic: {sample.periodic}"
        yield f"surfaces: {sample.surfaces}, of seed {sample.seed}"


def _sensor(sensor: Sensor) -> str:
    side = int(sensor.pixels)
    return f"{side} x {side} pixels, {sensor.projection}, {int(sensor.parts)} parts"


def _roughness_text(roughness: Roughness) -> str:
    if not isinstance(roughness, HeightField):
        return f"alpha {roughness!r}"
    heights = sha256(roughness.heights.tobytes()).hexdigest()[:16]
    return f"heights {heights} of size {roughness.size!r}, {roughness!r}"


_PIXELS = ("side", "y", "x")
_MATRIX = [f"m{row}{column}" for row in range(4) for column in range(4)]
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
        return chunk_identity(self.seen, self.wavelengths, self.photons, self.code)

    @property
    def blocks(self) -> int:
        """How many chunks there are."""
        return -(-self.photons // CHUNK)

    @property
    def arrays(self) -> dict[str, StoredArray]:
        """The fields of `PartSums`, with the chunks before all other dimensions."""
        parts, *pixels, wavelengths, numbers = self.seen.shape
        shapes: dict[str, tuple[tuple[str, ...], tuple[int, ...], str]] = {
            "sums": (("part", *_PIXELS, "wavelength", "number"), self.seen.shape, "float64"),
            "counts": (_PIXELS, tuple(pixels), "int64"),
            "photons": (("part",), (parts,), "int64"),
        }
        # Codecs take no more than 2 GiB at a time.
        files = {"sums": (1, *pixels, wavelengths, numbers)}
        messages = {"sums": _SUMS, "counts": "photons of a pixel", "photons": "photons of a part"}
        return {
            name: StoredArray(
                ("chunk", *dims),
                (self.blocks, *shape),
                (1, *files.get(name, shape)),
                dtype,
                {"long_name": messages[name], "units": "1"},
            )
            for name, (dims, shape, dtype) in shapes.items()
        }

    @property
    def coords(self) -> dict[str, WholeArray]:
        """Where pixels are, and what is summed up."""
        place = self.seen.sensor.coordinates
        matrix = [] if self.seen.polarized == "scalar" else _MATRIX
        scalar = [] if self.seen.polarized == "polarized" else ["scalar"]
        return {
            "side": WholeArray(("side",), np.array(self.seen.sides)),
            "y": WholeArray(("y",), place, {"units": "1"}),
            "x": WholeArray(("x",), place, {"units": "1"}),
            "wavelength": WholeArray(("wavelength",), self.wavelengths, {"units": "m"}),
            "number": WholeArray(("number",), np.array([*matrix, *scalar])),
        }

    @property
    def attrs(self) -> dict[str, Any]:
        """What the store is."""
        return {"title": "chunks of photons of a measurement; optipath.measure adds them up"}

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
