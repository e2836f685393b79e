"""Polarized BRDFs as tables that Mitsuba 3 reads as measured materials."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError
from optipath.faults import shown
from optipath.light.conventions import changed_matrix
from optipath.light.mueller import Mueller
from optipath.paths.files.schema import Faults
from optipath.surfaces.formats.brdf import BrdfOfHemispheres, HalfAngles, in_frames
from optipath.values.arrays import refuse_too_large
from optipath.values.files import input_file, message_of, written_whole
from optipath.values.precision import Numbers, is_whole
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from os import PathLike
    from typing import IO

    from optipath.light.frame import Frame
    from optipath.surfaces.hemisphere.hemisphere import Hemisphere


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
    faults, place = Faults(), input_file(path, SurfaceError)
    if place.suffix != ".pbsdf":
        faults.append(f"'{place}' is to be a .pbsdf file; give '{place.stem or 'a'}.pbsdf'")
    table = faults.attempt("", _table, brdf, wavelengths)
    if not (isinstance(shape, tuple) and len(shape) == 3 and all(is_whole(n, 2) for n in shape)):
        faults.append(f"shape is {shown(shape)}; give three whole numbers from 2 on, as {_SHAPE}")
    if faults or table is None:
        raise SurfaceError(*faults)
    colours, axes = _nanometres(table.wavelengths), HalfAngles.of(shape)
    if not description:
        several = table.hemispheres if isinstance(table, BrdfOfHemispheres) else ()
        description = "; ".join(map(repr, several)) or "a polarised BRDF"
    with message_of(place, SurfaceError), written_whole(place) as stream:
        write_tensors(stream, _tensors(axes, colours, table, description))


def _table(brdf: Any, wavelengths: Any) -> BrdfFunction | BrdfOfHemispheres:
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
    return BrdfFunction(brdf, np.atleast_1d(np.ravel(when)))


def _nanometres(wavelengths: Numbers) -> npt.NDArray[np.uint16]:
    """Return the wavelengths as the file has them."""
    if np.isnan(wavelengths).any():
        return np.array([_ANY], np.uint16)
    result = wavelengths / _NANOMETRE
    whole = np.round(result)
    fits = np.all(np.abs(result - whole) <= 1e-6) and whole.min() >= 1 and whole.max() <= _LONGEST
    if not fits or whole.size > _MOST or np.any(np.diff(whole) <= 0.0):
        raise SurfaceError(
            f"wavelengths are {result.tolist()} nm; the plugin reads up to {_MOST} whole "
            f"nanometres that differ, from 1 to {_LONGEST}, the shortest first"
        )
    return whole.astype(np.uint16)


def _tensors(
    axes: HalfAngles,
    colours: npt.NDArray[np.uint16],
    table: BrdfFunction | BrdfOfHemispheres,
    description: str,
) -> dict[str, npt.NDArray[Any]]:
    """Return the arrays of the file."""
    shape = (*map(len, axes), len(colours))
    refuse_too_large(shape, 68, "give a smaller shape", SurfaceError, "a table of {:.3g} matrices")
    matrices = np.full((*shape, 4, 4), np.nan, np.float32)
    errors = np.full(shape, np.nan, np.float32)
    for turn in range(len(axes.phi_d)):
        there, before, behind = axes.frames(turn)
        found, noise = table.at(before, behind)
        matrices[turn][there] = changed_matrix("mitsuba", found)
        if noise is not None:
            errors[turn][there] = noise
    written = f"{description}\nwritten by optipath {version('optipath')}"
    text = np.frombuffer(written.encode(), np.uint8)
    angles = {name: each.astype(np.float32)[np.newaxis] for name, each in axes._asdict().items()}
    measured = {"M00_se": errors} if isinstance(table, BrdfOfHemispheres) else {}
    return {"description": text, "wvls": colours, **angles, "M": matrices, **measured}


@dataclass(frozen=True)
class BrdfFunction:
    """A function of the directions in which light comes and goes. Units: wavelengths in metres."""

    function: Callable[..., Any]
    wavelengths: Numbers

    def at(self, before: Frame, behind: Frame) -> tuple[Numbers, None]:
        """Return the BRDF (n, wavelengths, 4, 4) for light that comes and goes in frames (n,)."""
        results = []
        for wavelength in self.wavelengths:
            at = {} if np.isnan(wavelength) else {"wavelength": float(wavelength)}
            brdf = self.function(before.z, behind.z, **at)
            if not isinstance(brdf, Mueller) or brdf.shape != before.x.shape[:-1]:
                raise SurfaceError(
                    f"brdf returns {shown(brdf)}; for {len(before.x)} directions it must return an "
                    f"op.Mueller of shape {before.x.shape[:-1]}"
                )
            results.append(in_frames(brdf, before, behind))
        return np.stack(results, axis=1), None


_HEAD = b"tensor_file\0" + bytes([1, 0])
_CODES = {"uint8": 1, "uint16": 3, "float32": 10}
_ALIGNED = 8


def write_tensors(stream: IO[bytes], tensors: Mapping[str, npt.NDArray[Any]]) -> None:
    """Write a tensor file, as ``mitsuba.python.tensor_io`` of Mitsuba 3.9 does.

    Little-endian: the word ``tensor_file``, the version 1.0, how many arrays; of each the length
    of its name (16 bits), its name, how many axes (16), its type (8), its place in the file (64)
    and its shape (64 each); then the arrays.

    >>> from io import BytesIO
    >>> write_tensors(stream := BytesIO(), {"a": np.array([1, 2], np.uint8)})
    >>> stream.getvalue()[:11], [*stream.getvalue()[-2:]]
    (b'tensor_file', [1, 2])
    """
    heads = sum(2 + len(name.encode()) + 11 + 8 * each.ndim for name, each in tensors.items())
    place = len(_HEAD) + 4 + heads
    stream.write(_HEAD + struct.pack("<I", len(tensors)))
    for name, each in tensors.items():
        place += -place % _ALIGNED
        stream.write(struct.pack("<H", len(name.encode())) + name.encode())
        stream.write(struct.pack("<HBQ", each.ndim, _CODES[each.dtype.name], place))
        stream.write(struct.pack(f"<{each.ndim}Q", *each.shape))
        place += each.nbytes
    place = len(_HEAD) + 4 + heads
    for each in tensors.values():
        stream.write(bytes(-place % _ALIGNED))
        stream.write(np.ascontiguousarray(each, each.dtype.newbyteorder("<")).data)
        place += -place % _ALIGNED + each.nbytes
