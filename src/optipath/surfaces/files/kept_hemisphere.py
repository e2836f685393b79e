"""A hemisphere as the Dataset of its file, and back."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import SurfaceError
from optipath.surfaces.files.kept_sample import kept_sample, sample_of
from optipath.surfaces.hemispheres.hemisphere import Hemisphere
from optipath.surfaces.hemispheres.part_sums import PartSums
from optipath.surfaces.hemispheres.pixel_array import PIXELS
from optipath.surfaces.hemispheres.sensed_beam import STATES, SensedBeam
from optipath.surfaces.hemispheres.sensor import Sensor
from optipath.surfaces.samples.sample_indices import SampleIndices
from optipath.surfaces.walk.given_beam import UNPOLARISED
from optipath.surfaces.walk.photon_beam import PhotonBeam

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr

MEASUREMENT = "measurement"
"""The attribute that a file is known by: in JSON, what it is read back by."""

LAYOUT = 1
"""The version of what is in such a file."""

_SUMS = ("part", *PIXELS, "number")
_LARGEST = 2**63


def kept_hemisphere(hemisphere: Hemisphere) -> xr.Dataset:
    """Return the Dataset of a file, of which `hemisphere_of` makes the hemisphere again."""
    parts, indices = hemisphere.parts, hemisphere.seen.beam.indices
    names = [f"M{row}{column}" for row in range(4) for column in range(4)]
    numbers = {"scalar": ["scalar"], "polarized": names, "both": [*names, "scalar"]}
    what = "sum over the photons of a part, as counted: of Mueller matrices and the scalar"
    found: xr.Dataset = hemisphere.dataset.assign(
        sums=(_SUMS, parts.sums, {"long_name": what, "units": "1"}),
        part_photons=("part", parts.photons, {"long_name": "photons of a part", "units": "1"}),
        index_n=("wavelength", indices.n.ravel(), {"long_name": "n of the last medium"}),
        index_k=("wavelength", indices.k.ravel(), {"long_name": "k of the last medium"}),
    )
    found = found.assign_coords(number=numbers[hemisphere.seen.polarized])
    attributes = {name: _plain(each) for name, each in hemisphere.dataset.attrs.items()}
    found.attrs = attributes | {MEASUREMENT: json.dumps(_measurement(hemisphere))}
    # Words of a fixed length are in the specifications of all forms.
    texts = {name: each.astype(str) for name, each in found.coords.items() if each.dtype == object}
    return found.assign_coords(texts)


def hemisphere_of(dataset: xr.Dataset, sample: Any = None) -> Hemisphere:
    """Return the hemisphere that is in a file."""
    told = json.loads(dataset.attrs[MEASUREMENT])
    if told["layout"] != LAYOUT:
        raise SurfaceError(
            f"it has layout {told['layout']}, but this version reads layout {LAYOUT}; load it by "
            f"optipath {dataset.attrs['optipath_version']}"
        )
    found = sample_of(told["sample"], sample)
    seen = SensedBeam(
        _beam(dataset, told, found),
        Sensor(told["pixels"], told["projection"], told["parts"]),
        told["polarized"],
        told["events"],
    )
    read = {name: dataset[name].to_numpy() for name in ("sums", "count", "part_photons")}
    sums = PartSums(*read.values())
    if (sums.sums.shape, sums.counts.shape) != (seen.shape, seen.shape[1:4]):
        raise ValueError(sums.sums.shape)
    return Hemisphere(seen, sums, dataset.wavelength.to_numpy(), told["symmetric"])


def _measurement(hemisphere: Hemisphere) -> dict[str, Any]:
    """Return all of what a hemisphere is that is no array; JSON keeps every bit of a float."""
    seen = hemisphere.seen
    beam, sensor = seen.beam, seen.sensor
    return {
        "layout": LAYOUT,
        "sample": kept_sample(beam.sample),
        "cos": beam.cos,
        "sin": beam.sin,
        "azimuth": beam.azimuth,
        "outside": beam.indices.outside,
        "inner": beam.indices.inner,
        "wavelengths": beam.indices.n.shape,
        "seed": beam.seed,
        "most_events": beam.most_events,
        "pixels": int(sensor.pixels),
        "projection": sensor.projection,
        "parts": int(sensor.parts),
        "polarized": seen.polarized,
        "events": None if seen.events is None else int(seen.events),
        "symmetric": bool(hemisphere.symmetric),
    }


def _beam(dataset: xr.Dataset, told: Mapping[str, Any], sample: Any) -> PhotonBeam:
    n, k = [
        dataset[name].to_numpy().reshape(told["wavelengths"]) for name in ("index_n", "index_k")
    ]
    return PhotonBeam(
        sample,
        told["cos"],
        told["sin"],
        told["azimuth"],
        SampleIndices(told["outside"], tuple(told["inner"]), n, k),
        (UNPOLARISED,) if told["polarized"] == "scalar" else STATES,
        told["seed"],
        told["most_events"],
    )


def _plain(value: Any) -> Any:
    """Return an attribute as files take it: whole numbers of more than 64 bits as texts."""
    is_long = isinstance(value, int | np.integer) and abs(int(value)) >= _LARGEST
    return str(value) if is_long else value
