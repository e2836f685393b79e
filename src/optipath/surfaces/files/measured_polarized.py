"""A polarised BRDF as a table that Mitsuba 3 reads as a measured material."""

from __future__ import annotations

from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError, shown
from optipath.light.conventions import changed_matrix
from optipath.paths.format.faults import Faults
from optipath.surfaces.files.brdf_of_hemispheres import BrdfOfHemispheres
from optipath.surfaces.files.file_faults import told_of
from optipath.surfaces.files.given_brdf import GivenBrdf
from optipath.surfaces.files.half_angles import HalfAngles
from optipath.surfaces.files.tensor_file import Tensor, write_tensors
from optipath.values.given_files import given_file
from optipath.values.wavelength import Wavelength
from optipath.values.whole_numbers import is_whole
from optipath.values.written_files import written_whole

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from os import PathLike

    from optipath.surfaces.hemispheres.hemisphere import Hemisphere

_NANOMETRE = 1e-9
_MOST = 5
"""How many wavelengths the plugin has room for."""

_ANY = 550
"""The wavelength in nm that stands for all where nothing depends on it."""

_SHAPE = (73, 91, 91)
_LONGEST = 65535


def write_measured_polarized(
    path: str | PathLike[str],
    brdf: Callable[..., Any] | Sequence[Hemisphere],
    *,
    wavelengths: str | npt.ArrayLike | None = None,
    shape: tuple[int, int, int] = _SHAPE,
    description: str = "",
) -> None:
    """Write a polarised BRDF for the plugin ``measured_polarized`` of Mitsuba 3.

    A tensor file as that of S.-H. Baek et al., Image-Based Acquisition and Modeling of
    Polarimetric Reflectance, ACM Trans. Graphics 39(4), 2020: ``M`` (phi_d, theta_d, theta_h,
    wavelength, 4, 4) in 1 / sr, without the cosine, with Mitsuba's sign of S3, in frames with x
    across the directions of the light that comes and goes; ``phi_d``, ``theta_d`` and ``theta_h``
    (`HalfAngles`), ``wvls`` in nm, and ``description``. Of hemispheres there is ``M00_se``
    besides, no less than the standard error of M00 (NaN where it is not known), which the plugin
    does not read.

    Parameters
    ----------
    path : str or PathLike
        A name that ends in .pbsdf. The file is there whole or not at all.
    brdf : callable or sequence of Hemisphere
        A function of unit vectors, of the directions in which light comes and goes, such as
        ``functools.partial(single_scattering, 1.5, 0.3)``, that returns a `Mueller` in 1 / sr; or
        hemispheres of one isotropic sample for light from several incidences, between which, and
        between whose pixels, numbers are interpolated: see `BrdfOfHemispheres`.
    wavelengths : str or array_like, optional
        Up to five, in whole nanometres, which a function is given one at a time as
        ``wavelength=`` in metres; hemispheres have their own.
    shape : tuple of int, optional
        How many phi_d, theta_d and theta_h there are; each product takes 64 bytes a wavelength.
    description : str, optional
        What it is, as the file says; hemispheres are named by default.

    Raises
    ------
    SurfaceError
        With all faults at once; if hemispheres do not belong together, or it cannot be written.

    Examples
    --------
    >>> from functools import partial
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from optipath.surfaces import single_scattering
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder, "glass.pbsdf")
    ...     write_measured_polarized(file, partial(single_scattering, 1.5, 0.3), shape=(5, 4, 6))
    ...     file.read_bytes()[:11]
    b'tensor_file'
    """
    faults = Faults()
    place = faults.attempt("", _place, path)
    table = faults.attempt("", _table, brdf, wavelengths)
    faults += _shape_faults(shape)
    if not isinstance(description, str):
        faults.append(f"description must be a text, not {shown(description)}")
    if faults or place is None or table is None:
        raise SurfaceError(*faults)
    colours = faults.attempt("", _nanometres, table.wavelengths)
    if colours is None:
        raise SurfaceError(*faults)
    axes = HalfAngles.of(shape)
    with told_of(place), written_whole(place) as stream:
        write_tensors(stream, _tensors(axes, colours, table, description or _measured(brdf)))


def _place(path: Any) -> Any:
    place = given_file(path, SurfaceError)
    if place.suffix != ".pbsdf":
        raise SurfaceError(f"'{place}' is to be a .pbsdf file; give '{place.stem or 'a'}.pbsdf'")
    return place


def _table(brdf: Any, wavelengths: Any) -> GivenBrdf | BrdfOfHemispheres:
    if isinstance(brdf, (list, tuple)):
        if wavelengths is not None:
            raise SurfaceError("hemispheres have wavelengths of their own; leave wavelengths= out")
        return BrdfOfHemispheres.of(brdf)
    if not callable(brdf):
        raise SurfaceError(
            f"brdf is {shown(brdf)}; give a function of the directions in which light comes and "
            f"goes, or a list of hemispheres"
        )
    when = [np.nan] if wavelengths is None else Wavelength().resolve(wavelengths).value
    return GivenBrdf(brdf, np.atleast_1d(np.ravel(when)))


def _shape_faults(shape: Any) -> list[str]:
    fits = isinstance(shape, tuple) and len(shape) == 3
    if fits and all(is_whole(each, 2, 10_000) for each in shape):
        return []
    return [f"shape is {shown(shape)}; give three whole numbers from 2 on, such as {_SHAPE}"]


def _nanometres(wavelengths: npt.NDArray[np.float64]) -> npt.NDArray[np.uint16]:
    """Return the wavelengths as the file has them."""
    if np.isnan(wavelengths).any():
        return np.array([_ANY], np.uint16)
    found = wavelengths / _NANOMETRE
    whole = np.round(found)
    if np.any(np.abs(found - whole) > 1e-6) or np.any(whole < 1) or np.any(whole > _LONGEST):
        raise SurfaceError(
            f"wavelengths are {found.tolist()} nm; the table has whole nanometres from 1 to "
            f"{_LONGEST}"
        )
    if whole.size > _MOST or np.any(np.diff(whole) <= 0.0):
        raise SurfaceError(
            f"wavelengths are {whole.tolist()} nm; the plugin reads up to {_MOST} that differ, the "
            f"shortest first"
        )
    return whole.astype(np.uint16)


def _tensors(
    axes: HalfAngles,
    colours: npt.NDArray[np.uint16],
    table: GivenBrdf | BrdfOfHemispheres,
    description: str,
) -> dict[str, Tensor]:
    """Return the arrays of the file; matrices are computed while they are written."""
    errors: list[npt.NDArray[np.float32]] = []
    shape = (*map(len, axes), len(colours))
    written = f"{description}\nwritten by optipath {version('optipath')}"
    text = np.frombuffer(written.encode(), np.uint8)
    found = {"description": Tensor.of(text), "wvls": Tensor.of(colours)}
    for name, each in axes._asdict().items():
        found[name] = Tensor.of(each.astype(np.float32)[np.newaxis])
    found["M"] = Tensor("float32", (*shape, 4, 4), _matrices(axes, table, errors))
    if isinstance(table, BrdfOfHemispheres):
        found["M00_se"] = Tensor("float32", shape, errors)
    return found


def _matrices(
    axes: HalfAngles,
    table: GivenBrdf | BrdfOfHemispheres,
    errors: list[npt.NDArray[np.float32]],
) -> Iterator[npt.NDArray[np.float32]]:
    """Yield the matrices of one phi_d after the other; their errors are kept."""
    for turn in range(len(axes.phi_d)):
        there, before, behind = axes.frames(turn)
        matrices, noise = table.at(before, behind)
        found = np.full((*there.shape, *matrices.shape[1:]), np.nan, np.float32)
        found[there] = changed_matrix("mitsuba", matrices)
        if noise is not None:
            spread = np.full(found.shape[:3], np.nan, np.float32)
            spread[there] = noise
            errors.append(spread)
        yield found


def _measured(brdf: Any) -> str:
    return "; ".join(map(repr, brdf)) if isinstance(brdf, (list, tuple)) else "a polarised BRDF"
