"""What a hemisphere is asked of files: to be written into one."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from os import PathLike

    import numpy.typing as npt


class Saving:
    """A hemisphere that is written into files."""

    def save(
        self,
        path: str | PathLike[str],
        *,
        source: npt.ArrayLike | None = None,
        side: str | None = None,
    ) -> None:
        """Write the hemisphere into a file, whose ending says the form.

        ``.zarr`` and ``.nc`` (NetCDF) hold the `dataset`, which xarray opens, and the sums over
        photons, so that `load_hemisphere` gives back all that was measured, bit for bit. ``.exr``
        is a picture of the light of one source in single precision: radiances in W / (m^2 sr) for
        an irradiance of the sample of 1 W / m^2, in channels ``S0.550,000000nm`` by wavelength (A.
        Fichet, R. Pacanowski and A. Wilkie, An OpenEXR Layout for Spectral Images, JCGT 10(3),
        2021) or ``S0.Y`` where there is none, and ``Y``, the mean of S0.

        Parameters
        ----------
        path : str or PathLike
            A name that ends in .zarr, .nc or .exr. It is there whole or not at all: what was there
            stays until then. A folder that is no hemisphere is not replaced.
        source : array_like, shape (4,), optional
            For a picture, the Stokes vector of the light that comes in, as `stokes` takes it, whose
            S0 counts as 1; unpolarised by default.
        side : {"reflected", "transmitted"}, optional
            For a picture, of which hemisphere; needed where there are two.

        Raises
        ------
        SurfaceError
            If the name has another ending, or it cannot be written there; with all faults of what
            is asked for.
        MissingExtraError
            If Zarr, h5netcdf or OpenEXR is not installed.

        Examples
        --------
        >>> from pathlib import Path
        >>> from tempfile import TemporaryDirectory
        >>> import optipath as op
        >>> found = op.measure(op.Sample([(1j, 0.3)]), "40 deg", photons=16_384, sensor=16)
        >>> with TemporaryDirectory() as folder:
        ...     found.save(Path(folder, "mirror.nc"))
        ...     again = op.load_hemisphere(Path(folder, "mirror.nc"))
        >>> bool((again.mueller[1] == found.mueller[1]).all()), again.seen.beam.sample
        (True, Sample([(1j, 0.3)]))
        """
        # By name, since what writes a hemisphere knows what one is.
        written: Any = import_module("optipath.surfaces.files.saved_hemisphere")
        written.save_hemisphere(self, path, source, side)
