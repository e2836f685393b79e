"""Hemisphere files: saved, loaded, and as Stokes pictures."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, SurfaceError, needing
from optipath.surfaces.walk.beam import UNPOLARISED, state_argument
from optipath.values.files import drafted, input_file, message_of

if TYPE_CHECKING:
    from collections.abc import Mapping
    from os import PathLike
    from pathlib import Path

    import numpy.typing as npt

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
    optipath.errors.SurfaceError: 'sun.exr' is a picture, which does not hold all of a hemisphere; \
save it with a name that ends in .zarr or .nc, and load that
    """
    place = input_file(path, SurfaceError)
    if place.suffix not in _PACKAGES:
        what = "a picture, which does not hold all of" if place.suffix == ".exr" else "no file of"
        raise SurfaceError(
            f"'{place}' is {what} a hemisphere; save it with a name that ends in .zarr or .nc, and "
            f"load that"
        )
    if not (place.is_file() or place.is_dir()):  # A pipe would be waited for.
        raise SurfaceError(f"there is no '{place}'; save a hemisphere of that name first")
    with needing("files of hemispheres"):
        import_module(_PACKAGES[place.suffix])
        from optipath.surfaces.formats.datasets import (  # noqa: PLC0415 - an extra  # noqa: PLC0415 - an extra
            hemisphere_of,
            read_dataset,
        )
    try:
        result = hemisphere_of(read_dataset(place), sample)
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
        picture = StokesPicture.of(hemisphere, source, side)
        with message_of(place, SurfaceError):
            picture.write(place)
    elif place.suffix in _PACKAGES:
        if argument := [
            n for n, each in {"source": source, "side": side}.items() if each is not None
        ]:
            raise SurfaceError(
                f"'{place}' is to hold the light of every source on all sides; leave "
                f"{'= and '.join(argument)}= out, or give a name that ends in .exr for a picture"
            )
        write = _writer(hemisphere, place.suffix)
        with message_of(place, SurfaceError):
            write(place)
    else:
        raise SurfaceError(
            f"'{place}' has no ending of a hemisphere; give .zarr or .nc for all that was "
            f"measured, .exr for a picture of Stokes vectors, such as '{place.stem or 'a'}.zarr'"
        )


def _writer(hemisphere: Hemisphere, ending: str) -> Any:
    with needing("files of hemispheres"):
        import_module(_PACKAGES[ending])
        from optipath.surfaces.formats.datasets import (  # noqa: PLC0415 - an extra  # noqa: PLC0415 - an extra
            stored_hemisphere,
            write_netcdf,
            write_zarr,
        )
    write = {".zarr": write_zarr, ".nc": write_netcdf}[ending]
    return lambda place: write(stored_hemisphere(hemisphere), place)


_NANOMETRE = 1e-9
_HANDEDNESS = (
    "S3 > 0 is a field that turns in time as the fingers of a right hand whose thumb points along "
    "the light, counter-clockwise to who looks at the source: right-handed to IEEE and IAU"
)
_UNIT = "W.m^-2.sr^-1"


@dataclass(frozen=True)
class StokesPicture:
    """The light of one source by direction; channels (pixels, pixels)."""

    channels: Mapping[str, npt.NDArray[np.float32]]
    attributes: Mapping[str, str]

    @classmethod
    def of(cls, hemisphere: Hemisphere, source: Any = None, side: Any = None) -> StokesPicture:
        """Return the picture of a hemisphere."""
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
        seen = np.where(np.isnan(light), np.float32(0.0), light)[::-1]
        return cls(
            _channels(seen, hemisphere.wavelengths),
            _attributes(hemisphere, sides[place], state),
        )

    def write(self, file: Path) -> None:
        """Write the picture."""
        with needing("pictures of Stokes vectors"):
            import OpenEXR  # noqa: PLC0415 - an extra
        header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
        with drafted(file) as draft:
            draft.touch()  # What is wrong with the place is told by the system, not by OpenEXR.
            OpenEXR.File(header | dict(self.attributes), dict(self.channels)).write(str(draft))


def _channels(
    light: npt.NDArray[np.float32], wavelengths: npt.NDArray[np.float64]
) -> dict[str, npt.NDArray[np.float32]]:
    """Return channels by their names: a layer for each Stokes component."""
    results = {"Y": light[..., 0].mean(axis=-1)}
    for place, wavelength in enumerate(wavelengths):
        name = "Y" if np.isnan(wavelength) else _name(wavelength)
        results |= {f"S{each}.{name}": light[:, :, place, each] for each in range(4)}
    return {name: np.ascontiguousarray(each) for name, each in results.items()}


def _name(wavelength: float) -> str:
    """Return the name of a channel: the wavelength with a comma, which splits no layers.

    >>> _name(550.25e-9)
    '550,250000nm'
    """
    return f"{wavelength / _NANOMETRE:.6f}nm".replace(".", ",")


def _attributes(
    hemisphere: Hemisphere, side: str, state: npt.NDArray[np.float64]
) -> dict[str, str]:
    messages = {name: str(each) for name, each in hemisphere.dataset.attrs.items()}
    written = f"optipath {version('optipath')}"
    layout = {
        "spectralLayoutVersion": "1.0",
        "emissiveUnits": _UNIT,
        "polarisationHandedness": "right",
    }
    return (
        messages
        | layout
        | {
            "software": written,
            "side": side,
            "source": " ".join(map(str, (state / state[0]).tolist())),
            "handedness": _HANDEDNESS,
            "comments": f"radiance of a sample that gets 1 W/m^2, in {_UNIT}, over directions",
        }
    )
