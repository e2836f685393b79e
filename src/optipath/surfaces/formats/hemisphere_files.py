"""Hemisphere files: all that was measured as Zarr or NetCDF, and pictures of Stokes vectors."""

from __future__ import annotations

import json
import os
import shutil
from dataclasses import asdict, dataclass, replace
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn

import numpy as np

from optipath.errors import OptipathError, SurfaceError
from optipath.extras import need, needing
from optipath.faults import shown
from optipath.surfaces.height_field import HeightField
from optipath.surfaces.hemisphere.beam import (
    NUMBERS,
    OF_BEAM,
    PIXELS,
    STATES,
    PartSums,
    SensedBeam,
)
from optipath.surfaces.hemisphere.hemisphere import Hemisphere
from optipath.surfaces.hemisphere.sensor import Sensor
from optipath.surfaces.sample import Sample, SampleIndices
from optipath.surfaces.sample_files import sample_of_text
from optipath.surfaces.walk.beam import UNPOLARISED, PhotonBeam, state_argument
from optipath.values.files import drafted, input_file, message_of

if TYPE_CHECKING:
    from collections.abc import Mapping
    from os import PathLike

    import xarray as xr


_PACKAGES = {".zarr": "zarr", ".nc": "h5netcdf"}


def load_hemisphere(path: str | PathLike[str], sample: Sample | None = None) -> Hemisphere:
    """Return what `Hemisphere.save` has written as Zarr or NetCDF, with every bit.

    Parameters
    ----------
    path : str or PathLike
        A name that ends in .zarr or .nc.
    sample : Sample, optional
        The sample that was measured, where it has no form in files: heights that are given stand
        in no hemisphere. Without it all but the sample itself is there, and what asks for that is
        refused.

    Returns
    -------
    Hemisphere

    Raises
    ------
    SurfaceError
        If there is no such file, or it is something else, or another sample was measured.
    MissingExtraError
        If xarray, Zarr or h5netcdf is not installed.

    Examples
    --------
    >>> load_hemisphere("sun.exr")
    Traceback (most recent call last):
    optipath.errors.SurfaceError: 'sun.exr' does not hold all of a hemisphere; save it with a \
name that ends in .zarr or .nc, and load that
    """
    place = input_file(path, SurfaceError)
    if place.suffix not in _PACKAGES:
        raise SurfaceError(
            f"'{place}' does not hold all of a hemisphere; save it with a name that ends in .zarr "
            f"or .nc, and load that"
        )
    if not (place.is_file() or place.is_dir()):
        raise SurfaceError(f"there is no '{place}'; save a hemisphere of that name first")
    need("files of hemispheres", _PACKAGES[place.suffix], "xarray")
    try:
        return hemisphere_of(read_dataset(place), sample)
    except OptipathError as fault:
        raise SurfaceError(*fault.faults, about=f"'{place}'") from None
    except Exception:  # noqa: BLE001 - damaged files make their readers raise anything
        raise SurfaceError(
            f"'{place}' is no hemisphere, or a damaged one; load what Hemisphere.save has written"
        ) from None


def save_hemisphere(hemisphere: Hemisphere, path: Any, source: Any, side: Any) -> None:
    """Write a hemisphere."""
    place = input_file(path, SurfaceError)
    if place.suffix == ".exr":
        write_picture(hemisphere, place, source, side)
    elif place.suffix in _PACKAGES:
        if source is not None or side is not None:
            raise SurfaceError(
                f"'{place}' is to hold the light of every source on all sides; leave source= and "
                f"side= out, or give a name that ends in .exr for a picture"
            )
        need("files of hemispheres", _PACKAGES[place.suffix], "xarray")
        dataset = stored_hemisphere(hemisphere)
        write = write_zarr if place.suffix == ".zarr" else write_netcdf
        with message_of(place, SurfaceError):
            write(dataset, place)
    else:
        raise SurfaceError(
            f"'{place}' has no ending of a hemisphere; give .zarr or .nc for all that was "
            f"measured, .exr for a picture of Stokes vectors, such as '{place.stem or 'a'}.zarr'"
        )


_HANDEDNESS = (
    "S3 > 0 is a field that turns in time as the fingers of a right hand whose thumb points along "
    "the light, counter-clockwise to who looks at the source: right-handed to IEEE and IAU"
)
_UNIT = "W.m^-2.sr^-1"


def write_picture(hemisphere: Hemisphere, file: Path, source: Any, side: Any) -> None:
    """Write the light of one source by direction: a channel for each component and wavelength."""
    sides = hemisphere.seen.sides
    if side is None and len(sides) > 1:
        raise SurfaceError(
            "a picture is of one hemisphere, and the sample lets light through; give "
            "side='reflected' or side='transmitted'"
        )
    place = hemisphere.side(sides[0] if side is None else side)
    state = np.array(state_argument("source", UNPOLARISED if source is None else source))
    with np.errstate(over="ignore"):
        brdf = hemisphere.brdf().to_numpy()[place]
        light = np.asarray(brdf @ (state / state[0]), np.float32)
    light = np.where(np.isnan(light), np.float32(0.0), light)[::-1]
    channels = {"Y": light[..., 0].mean(axis=-1)}
    for at, wavelength in enumerate(hemisphere.wavelengths):
        # With a comma, since points split layers.
        name = "Y" if np.isnan(wavelength) else f"{wavelength / 1e-9:.6f}nm".replace(".", ",")
        channels |= {f"S{each}.{name}": light[:, :, at, each] for each in range(4)}
    attributes = {name: str(each) for name, each in hemisphere.dataset.attrs.items()} | {
        "spectralLayoutVersion": "1.0",
        "emissiveUnits": _UNIT,
        "polarisationHandedness": "right",
        "software": f"optipath {version('optipath')}",
        "side": sides[place],
        "source": " ".join(map(str, (state / state[0]).tolist())),
        "handedness": _HANDEDNESS,
        "comments": f"radiance of a sample that gets 1 W/m^2, in {_UNIT}, over directions",
    }
    with needing("pictures of Stokes vectors"):
        import OpenEXR  # noqa: PLC0415 - an extra
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage, **attributes}
    channels = {name: np.ascontiguousarray(each) for name, each in channels.items()}
    with message_of(file, SurfaceError), drafted(file) as draft:
        draft.touch()  # What is wrong with the place is told by the system, not by OpenEXR.
        OpenEXR.File(header, channels).write(str(draft))


MEASUREMENT = "measurement"
"""The attribute that a file is known by: in JSON, what it is read back by."""

LAYOUT = 1
"""The version of what is in such a file."""

_SUMS = ("part", *PIXELS, "number")


def stored_hemisphere(hemisphere: Hemisphere) -> xr.Dataset:
    """Return the Dataset of a file, of which `hemisphere_of` makes the hemisphere again."""
    parts, indices = hemisphere.parts, hemisphere.seen.beam.indices
    what = "sum over the photons of a part, as counted: of Mueller matrices and the scalar"
    result: xr.Dataset = hemisphere.dataset.assign(
        sums=(_SUMS, parts.sums, {"long_name": what, "units": "1"}),
        part_photons=("part", parts.photons, {"long_name": "photons of a part", "units": "1"}),
        index_n=("wavelength", indices.n.ravel(), {"long_name": "n of the last medium"}),
        index_k=("wavelength", indices.k.ravel(), {"long_name": "k of the last medium"}),
    )
    result = result.assign_coords(number=list(NUMBERS[hemisphere.seen.polarized]))
    measurement = {  # All of it that is no array; JSON keeps every bit of a float.
        "layout": LAYOUT,
        "sample": stored_sample(hemisphere.seen.beam.sample),
        "wavelengths": indices.n.shape,
        "symmetric": hemisphere.symmetric,
        **hemisphere.seen.facts,
    }
    result.attrs = result.attrs | {MEASUREMENT: json.dumps(measurement)}
    if result.attrs["seed"] >= 2**63:  # Files have whole numbers of up to 64 bits.
        result.attrs["seed"] = str(result.attrs["seed"])
    # Words of a fixed length are in the specifications of all forms.
    texts = {name: each.astype(str) for name, each in result.coords.items() if each.dtype == object}
    return result.assign_coords(texts)


def hemisphere_of(dataset: xr.Dataset, sample: Any = None) -> Hemisphere:
    """Return the hemisphere that is in a file."""
    message = json.loads(dataset.attrs[MEASUREMENT])
    if message["layout"] != LAYOUT:
        raise SurfaceError(
            f"it has layout {message['layout']}, but this version reads layout {LAYOUT}; load "
            f"it by optipath {dataset.attrs['optipath_version']}"
        )
    shape = message["wavelengths"]
    n, k = (dataset[name].to_numpy().reshape(shape) for name in ("index_n", "index_k"))
    beam = PhotonBeam(
        sample=sample_of(message["sample"], sample),  # type: ignore[arg-type]
        indices=SampleIndices(message["outside"], tuple(message["inner"]), n, k),
        states=(UNPOLARISED,) if message["polarized"] == "scalar" else STATES,
        **{name: message[name] for name in OF_BEAM},
    )
    sensor = Sensor(message["pixels"], message["projection"], message["parts"])
    seen = SensedBeam(beam, sensor, message["polarized"], message["events"])
    sums = PartSums(*(dataset[name].to_numpy() for name in ("sums", "count", "part_photons")))
    if (sums.sums.shape, sums.counts.shape) != (seen.shape, seen.shape[1:4]):
        raise ValueError(sums.sums.shape)
    return Hemisphere(seen, sums, dataset.wavelength.to_numpy(), message["symmetric"])


def stored_sample(sample: Sample | UnknownSample) -> dict[str, Any]:
    """Return what a file keeps of a sample besides its text."""
    if isinstance(sample, UnknownSample):
        return asdict(sample)
    text, why = None, "its heights are not in this file" if _heights(sample) else ""
    try:
        text = sample.to_toml()
    except SurfaceError as fault:
        why = str(fault)
    return asdict(UnknownSample(why, bool(sample.isotropic), _digest(sample), text))


def sample_of(stored: Mapping[str, Any], argument: Any = None) -> Sample | UnknownSample:
    """Return the sample of a file, or the one that is given, if it is the one that was measured."""
    if argument is not None:
        if not isinstance(argument, Sample) or _digest(argument) != stored["digest"]:
            raise SurfaceError(f"sample is {shown(argument)}, which is not the one measured")
        return argument
    unknown = UnknownSample(**stored)
    if unknown.why:
        return unknown
    try:
        result = sample_of_text(unknown.to_toml(), Path("the sample of a hemisphere"))
    except OptipathError as fault:
        return replace(unknown, why=str(fault))
    if _digest(result) == unknown.digest:
        return result
    return replace(unknown, why="this optipath reads its text in another way than its writer did")


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
    result = sha256(text.encode())
    for field in _heights(sample):
        result.update(repr((field.size, field.periodic)).encode() + field.heights.tobytes())
    return result.hexdigest()


@dataclass(frozen=True, repr=False)
class UnknownSample:
    """What stands for a sample that is not known, and refuses to be asked for more than this."""

    why: str
    isotropic: bool
    digest: str
    text: str | None = None
    is_flat: ClassVar[bool] = False

    def to_toml(self) -> str:
        """Return the text of its file, as it has been read."""
        if self.text is None:
            raise SurfaceError(self.why)
        return self.text

    def __getattr__(self, name: str) -> NoReturn:
        if name.startswith("__"):
            raise AttributeError(name)  # Python itself asks for what need not be there.
        raise SurfaceError(
            f"the sample of this hemisphere is not known: {self.why}; give it, "
            f"op.load_hemisphere(path, sample=...)"
        )

    def __repr__(self) -> str:
        return "a sample that is not known"


def write_netcdf(dataset: xr.Dataset, file: Path) -> None:
    """Write a Dataset as a file of NetCDF 4, compressed part by part."""
    packed: dict[str, Any] = {"zlib": True, "complevel": 4, "shuffle": True}
    encoding = {name: packed for name in dataset.data_vars if dataset[name].ndim > 1}
    encoding["sums"] = packed | {"chunksizes": (1, *dataset["sums"].shape[1:])}
    with drafted(file) as draft:
        dataset.to_netcdf(draft, engine="h5netcdf", encoding=encoding)


def write_zarr(dataset: xr.Dataset, folder: Path) -> None:
    """Write a Dataset as a Zarr group, part by part, in place of a hemisphere that was there."""
    folder = Path(os.path.realpath(folder))
    if folder.exists() and not _is_hemisphere(folder):
        raise SurfaceError(
            f"'{folder}' is there already, and is no hemisphere; give another name, or move it away"
        )
    with TemporaryDirectory(prefix=".", dir=folder.parent, ignore_cleanup_errors=True) as place:
        draft, old = Path(place, "draft"), Path(f"{place}.old")
        # Version 2, whose words of a fixed length and joint metadata are in its specification.
        encoding = {"sums": {"chunks": (1, *dataset["sums"].shape[1:])}}
        dataset.to_zarr(draft, encoding=encoding, zarr_format=2, consolidated=True)
        try:
            if folder.exists():
                folder.rename(old)
            draft.rename(folder)
        finally:
            if old.exists() and not folder.exists():
                old.rename(folder)
        shutil.rmtree(old, ignore_errors=True)


def read_dataset(place: Path) -> xr.Dataset:
    """Return all of what a file or folder holds."""
    import xarray as xr  # noqa: PLC0415 - an extra

    is_netcdf = place.suffix == ".nc"
    engine: Any = {"engine": "h5netcdf"} if is_netcdf else {"engine": "zarr", "consolidated": True}
    with xr.open_dataset(place, chunks=None, **engine) as result:
        result.attrs[MEASUREMENT]  # Before any of its numbers is read.
        return result.load()


def _is_hemisphere(folder: Path) -> bool:
    try:
        return f'"{MEASUREMENT}"' in (folder / ".zattrs").read_text("utf-8")
    except (OSError, UnicodeDecodeError):
        return False
