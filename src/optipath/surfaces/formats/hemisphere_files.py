"""Hemisphere files: saved, loaded, and as Stokes pictures."""

from __future__ import annotations

from importlib import import_module
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, SurfaceError, needing
from optipath.surfaces.walk.beam import UNPOLARISED, state_argument
from optipath.values.files import drafted, input_file, message_of

if TYPE_CHECKING:
    from os import PathLike
    from pathlib import Path

    from optipath.surfaces.hemisphere.hemisphere import Hemisphere
    from optipath.surfaces.sample import Sample


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
    datasets = _datasets(place.suffix)
    try:
        result: Hemisphere = datasets.hemisphere_of(datasets.read_dataset(place), sample)
    except OptipathError as fault:
        raise SurfaceError(*fault.faults, about=f"'{place}'") from None
    except Exception:  # noqa: BLE001 - damaged files make their readers raise anything
        raise SurfaceError(
            f"'{place}' is no hemisphere, or a damaged one; load what Hemisphere.save has written"
        ) from None
    return result


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
        datasets = _datasets(place.suffix)
        dataset = datasets.stored_hemisphere(hemisphere)
        write = datasets.write_zarr if place.suffix == ".zarr" else datasets.write_netcdf
        with message_of(place, SurfaceError):
            write(dataset, place)
    else:
        raise SurfaceError(
            f"'{place}' has no ending of a hemisphere; give .zarr or .nc for all that was "
            f"measured, .exr for a picture of Stokes vectors, such as '{place.stem or 'a'}.zarr'"
        )


def _datasets(ending: str) -> Any:
    """Return the module that writes and reads files of an ending."""
    with needing("files of hemispheres"):
        import_module(_PACKAGES[ending])
        from optipath.surfaces.formats import datasets  # noqa: PLC0415 - an extra
    return datasets


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
