"""The sample of a hemisphere in its file: what is kept of it, and how it is known again."""

from __future__ import annotations

from dataclasses import asdict, replace
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

from optipath.errors import OptipathError, SurfaceError, shown
from optipath.surfaces.fields.height_field import HeightField
from optipath.surfaces.files.unknown_sample import UnknownSample
from optipath.surfaces.samples.sample import Sample
from optipath.surfaces.samples.sample_tables import sample_of_text

if TYPE_CHECKING:
    from collections.abc import Mapping


def kept_sample(sample: Sample | UnknownSample) -> dict[str, Any]:
    """Return what a file keeps of a sample besides its text.

    Examples
    --------
    >>> found = kept_sample(Sample([(1.5, 0.1)]))
    >>> found["why"], sample_of(found)
    ('', Sample([(1.5, 0.1)]))
    """
    if isinstance(sample, UnknownSample):
        return asdict(sample)
    text, why = None, "its heights are not in this file" if _heights(sample) else ""
    try:
        text = sample.to_toml()
    except SurfaceError as fault:
        why = str(fault)
    return asdict(UnknownSample(why, bool(sample.isotropic), _digest(sample), text))


def sample_of(kept: Mapping[str, Any], given: Any = None) -> Sample | UnknownSample:
    """Return the sample of a file."""
    if given is not None:
        return _known_again(given, kept)
    unknown = UnknownSample(**kept)
    if unknown.why:
        return unknown
    try:
        found = sample_of_text(unknown.to_toml(), Path("the sample of a hemisphere"))
    except OptipathError as fault:
        return replace(unknown, why=str(fault))
    if _digest(found) == unknown.digest:
        return found
    return replace(
        unknown, why="this optipath reads its text in another way than the one that wrote it"
    )


def _known_again(given: Any, kept: Mapping[str, Any]) -> Sample:
    if not isinstance(given, Sample):
        raise SurfaceError(f"sample is {shown(given)}; give the op.Sample that was measured")
    if _digest(given) != kept["digest"]:
        raise SurfaceError(f"sample is {given}, which is not the one that was measured")
    return given


def _heights(sample: Sample) -> list[HeightField]:
    """Return the heights that are given; flat interfaces have none."""
    rough = [layer.roughness for layer in sample.layers]
    return [each for each in rough if isinstance(each, HeightField) and not each.is_flat]


def _digest(sample: Sample) -> str:
    """Return what tells a sample from others, whatever it is called."""
    plain = replace(sample, description="")
    try:
        text = plain.to_toml()
    except SurfaceError:
        text = repr(plain)
    found = sha256(text.encode())
    for field in _heights(sample):
        found.update(repr((field.size, field.periodic)).encode() + field.heights.tobytes())
    return found.hexdigest()
