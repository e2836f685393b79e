"""A hemisphere written into a file of the form that its name ends in."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from optipath.errors import SurfaceError
from optipath.extras import needing
from optipath.surfaces.files.file_faults import told_of
from optipath.surfaces.files.stokes_picture import StokesPicture
from optipath.values.given_files import given_file

if TYPE_CHECKING:
    from optipath.surfaces.hemispheres.hemisphere import Hemisphere

_PACKAGES = {".zarr": "zarr", ".nc": "h5netcdf"}
"""The package that each form needs."""


def save_hemisphere(hemisphere: Hemisphere, path: Any, source: Any, side: Any) -> None:
    """Write a hemisphere."""
    place = given_file(path, SurfaceError)
    if place.suffix == ".exr":
        picture = StokesPicture.of(hemisphere, source, side)
        with told_of(place):
            picture.write(place)
    elif place.suffix in _PACKAGES:
        if given := [n for n, each in {"source": source, "side": side}.items() if each is not None]:
            raise SurfaceError(
                f"'{place}' is to hold the light of every source on all sides; leave "
                f"{'= and '.join(given)}= out, or give a name that ends in .exr for a picture"
            )
        write = _writer(hemisphere, place.suffix)
        with told_of(place):
            write(place)
    else:
        raise SurfaceError(
            f"'{place}' has no ending of a hemisphere; give .zarr or .nc for all that was "
            f"measured, .exr for a picture of Stokes vectors, such as '{place.stem or 'a'}.zarr'"
        )


def _writer(hemisphere: Hemisphere, ending: str) -> Any:
    with needing("files of hemispheres"):
        import_module(_PACKAGES[ending])
        from optipath.surfaces.files.hemisphere_forms import (  # noqa: PLC0415 - an extra
            write_netcdf,
            write_zarr,
        )
        from optipath.surfaces.files.kept_hemisphere import (  # noqa: PLC0415 - an extra
            kept_hemisphere,
        )
    write = {".zarr": write_zarr, ".nc": write_netcdf}[ending]
    return lambda place: write(kept_hemisphere(hemisphere), place)
