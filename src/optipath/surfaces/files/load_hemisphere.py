"""A hemisphere read back from its file."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from optipath.errors import OptipathError, SurfaceError
from optipath.extras import needing
from optipath.values.given_files import given_file

if TYPE_CHECKING:
    from os import PathLike

    from optipath.surfaces.hemispheres.hemisphere import Hemisphere
    from optipath.surfaces.samples.sample import Sample

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
    place = given_file(path, SurfaceError)
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
        from optipath.surfaces.files.hemisphere_forms import (  # noqa: PLC0415 - an extra
            read_dataset,
        )
        from optipath.surfaces.files.kept_hemisphere import (  # noqa: PLC0415 - an extra
            hemisphere_of,
        )
    try:
        found = hemisphere_of(read_dataset(place), sample)
    except OptipathError as fault:
        raise SurfaceError(*fault.faults, about=f"'{place}'") from None
    except Exception:  # noqa: BLE001 - damaged files make their readers raise anything
        raise SurfaceError(
            f"'{place}' is no hemisphere, or a damaged one; load what Hemisphere.save has written"
        ) from None
    return found
