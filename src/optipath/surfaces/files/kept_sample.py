"""The sample of a hemisphere in its file: what is kept of it, and how it is known again."""

from __future__ import annotations

from dataclasses import replace
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

    Parameters
    ----------
    sample : Sample or UnknownSample
        What was measured.

    Returns
    -------
    dict
        ``digest``, by which it is known again; ``isotropic``; ``why`` it cannot be read back, ""
        where it can; and whether it ``has_text`` in TOML.

    Examples
    --------
    >>> kept_sample(Sample([(1.5, 0.1)]))["why"]
    ''
    >>> print(kept_sample(Sample([(1.5, HeightField.beckmann(0.3, cells=160))]))["why"][:42])
    layers[0]: its heights are in no file that
    """
    if isinstance(sample, UnknownSample):
        why, digest = sample.why, sample.digest
    else:
        why, digest = "its heights are not in this file" if _heights(sample) else "", _digest(sample)
    try:
        sample.to_toml()
    except SurfaceError as fault:
        return _kept(digest, sample, str(fault), has_text=False)
    return _kept(digest, sample, why, has_text=True)


def _kept(digest: str, sample: Sample | UnknownSample, why: str, *, has_text: bool) -> dict[str, Any]:
    isotropic = bool(sample.isotropic)
    return {"digest": digest, "isotropic": isotropic, "why": why, "has_text": has_text}


def sample_of(text: str, kept: Mapping[str, Any], given: Any = None) -> Sample | UnknownSample:
    """Return the sample of a file.

    Parameters
    ----------
    text : str
        What the file says of it, in TOML.
    kept : mapping of str to Any
        As `kept_sample` returns it.
    given : Sample, optional
        The sample that a user has.

    Returns
    -------
    Sample or UnknownSample
        The second if it cannot be read, or is another now.

    Raises
    ------
    SurfaceError
        If the sample that is given is another.
    """
    if given is not None:
        return _known_again(given, kept)
    try:
        found = None if kept["why"] else sample_of_text(text, Path("the sample of a hemisphere"))
        why = kept["why"] or "this optipath makes another of its text than the one that wrote it"
    except OptipathError as fault:
        found, why = None, str(fault)
    if found is not None and _digest(found) == kept["digest"]:
        return found
    own = text if kept["has_text"] else None
    return UnknownSample(why, kept["isotropic"], kept["digest"], own)


def _known_again(given: Any, kept: Mapping[str, Any]) -> Sample:
    if not isinstance(given, Sample):
        raise SurfaceError(f"sample is {shown(given)}; give the op.Sample that was measured")
    if _digest(given) != kept["digest"]:
        raise SurfaceError(f"sample is {given!r}, which is not the one that was measured")
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
