"""What tells one measurement from all others, so that chunks of it can be kept and found again."""

from __future__ import annotations

from functools import cache
from hashlib import sha256
from importlib.metadata import version
from typing import TYPE_CHECKING

from optipath.surfaces.fields.height_field import HeightField
from optipath.surfaces.walk.walk_code import digest_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy as np
    import numpy.typing as npt

    from optipath.surfaces.hemispheres.sensed_beam import SensedBeam
    from optipath.surfaces.hemispheres.sensor import Sensor
    from optipath.surfaces.samples.sample import Sample
    from optipath.surfaces.samples.sample_layer import Roughness

LAYOUT = 1
"""The version of what a store of a measurement has in it."""

_SOURCES = "kernels", "engines/formulas", "surfaces"
"""What the bits follow from."""


@cache
def measuring_code() -> str:
    """Return a hash of all that the bits of a measurement follow from but for what is measured."""
    return f"{version('optipath')}, {digest_of(_SOURCES)[:16]}"


def chunk_identity(
    seen: SensedBeam, wavelengths: npt.NDArray[np.float64], photons: int, code: str
) -> str:
    """Return all of what is measured, a line each, so that the first other one can be told.

    Units: wavelengths in metres.
    """
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
        yield f"layers[{place}]: {_told(layer.roughness)}"
    if any(layer.is_random for layer in sample.layers):
        yield f"cells: {sample.cells!r}"
        yield f"periodic: {sample.periodic}"
        yield f"surfaces: {sample.surfaces}, of seed {sample.seed}"


def _sensor(sensor: Sensor) -> str:
    side = int(sensor.pixels)
    return f"{side} x {side} pixels, {sensor.projection}, {int(sensor.parts)} parts"


def _told(roughness: Roughness) -> str:
    if not isinstance(roughness, HeightField):
        return f"alpha {roughness!r}"
    heights = sha256(roughness.heights.tobytes()).hexdigest()[:16]
    return f"heights {heights} of size {roughness.size!r}, {roughness!r}"
