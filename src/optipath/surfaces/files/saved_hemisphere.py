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

_WRITERS = {".zarr": ("zarr", "write_zarr"), ".nc": ("h5netcdf", "write_netcdf")}
"""The package that each form needs, and what writes it."""


def save_hemisphere(hemisphere: Hemisphere, path: Any, source: Any, side: Any) -> None:
    """Write a hemisphere."""
    place = given_file(path, SurfaceError)
    if place.suffix == ".exr":
        picture = StokesPicture.of(hemisphere, source, side)
        with told_of(place):
            picture.write(place)
    elif place.suffix in _WRITERS:
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
    package, name = _WRITERS[ending]
    with needing("files of hemispheres"):
        import_module(package)
        kept: Any = import_module("optipath.surfaces.files.kept_hemisphere")
        forms = import_module("optipath.surfaces.files.hemisphere_forms")
    return lambda place: getattr(forms, name)(kept.kept_hemisphere(hemisphere), place)
