"""Arguments of measurements: directions, estimates and stores, checked."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, SurfaceError, listed, shown
from optipath.materials.quantities import ANGLE
from optipath.paths.files.schema import Faults
from optipath.surfaces.facet_model import frame_along
from optipath.values.files import input_file
from optipath.values.parameters import Parameter
from optipath.values.units import format_quantity
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.light.frame import Frame
    from optipath.values.precision import Numbers


_SAME = 1e-9
"""By how much of itself a wavelength may differ from the one that is meant."""


def direction_of(argument: Any, azimuth: float, *, up: bool) -> Frame:
    """Return the frame of light toward a direction, or several (..., 3).

    >>> print(direction_of(["30 deg", "-30 deg"], 0.0, up=True).z.round(6))
    [[ 0.5       0.        0.866025]
     [-0.5       0.        0.866025]]
    """
    if isinstance(argument, Parameter):
        raise SurfaceError(
            f"direction is {argument.called}; give a direction, and make an element for each"
        )
    try:
        if _is_angle(argument):
            argument = _in_plane(ANGLE.check("direction", argument), azimuth, up=up)
        frame = frame_along("direction", argument, up=up)
    except SurfaceError:
        raise
    except OptipathError as fault:
        raise SurfaceError(*fault.faults) from None
    if not frame.z.size:
        raise SurfaceError(f"direction has the shape {frame.z.shape}; give one direction or more")
    return frame


def wavelength_place(known: Numbers, argument: Any) -> int:
    """Return the place of a wavelength among measured ones, in metres.

    >>> wavelength_place(np.array([4e-7, 5e-7]), "500 nm")
    1
    """
    if argument is None:
        if len(known) > 1:
            raise SurfaceError(
                f"{len(known)} wavelengths have been measured; give one of them, "
                f"{_wavelengths_text(known)}"
            )
        return 0
    if np.isnan(known[0]):
        raise SurfaceError(
            f"wavelength is {shown(argument)}, but nothing of the sample depends on it; leave "
            "it out"
        )
    try:
        wanted = np.asarray(Wavelength().resolve(argument).value)
    except OptipathError as fault:
        raise SurfaceError(*fault.faults) from None
    if wanted.ndim:
        raise SurfaceError(
            f"wavelength has the shape {wanted.shape}; give one, {_wavelengths_text(known)}"
        )
    nearest = int(np.argmin(np.abs(known - wanted)))
    if abs(known[nearest] - wanted) > _SAME * wanted:
        raise SurfaceError(
            f"wavelength {format_quantity(float(wanted), 'nm')} has not been measured; give "
            f"{_wavelengths_text(known)}"
        )
    return nearest


def _is_angle(argument: Any) -> bool:
    """Tell whether it is an angle, or several as texts: numbers in a row are a vector."""
    array = np.asarray(argument, dtype=object)
    return array.ndim == 0 or isinstance(array.ravel()[0] if array.size else None, str)


def _in_plane(angle: Numbers, azimuth: float, *, up: bool) -> Any:
    if np.any(beyond := np.abs(angle) >= np.pi / 2.0):
        worst = float(angle[beyond].flat[0])
        raise SurfaceError(
            f"direction is {worst:.6g} rad ({np.degrees(worst):.6g} deg) from the normal; give an "
            f"angle in the plane of incidence below 90 deg, such as '45 deg'"
        )
    sin, cos = np.sin(angle), np.cos(angle)
    height = cos if up else -cos
    # Adding 0 turns -0 into 0.
    return np.stack([sin * np.cos(azimuth), sin * np.sin(azimuth), height], axis=-1) + 0.0


def _wavelengths_text(known: Numbers) -> str:
    named = [format_quantity(float(each), "nm") for each in known[:6]]
    more = ["..."] if len(known) > 6 else []
    return listed([*named, *more]) if more else " or ".join(named)


def following(result: Callable[[Numbers], Any]) -> Callable[[Numbers], Numbers]:
    """Return a function that returns arrays, or refuses what is returned.

    >>> following(lambda light: None)(np.eye(4))
    Traceback (most recent call last):
    optipath.errors.SurfaceError: what is estimated is None; let the function return real numbers
    """
    if not callable(result):
        raise SurfaceError(
            f"found is {shown(result)}; give a function of the light that returns real numbers"
        )

    def numbers(light: Numbers) -> Numbers:
        value = result(light)
        try:
            array = np.asarray(value)
        except (TypeError, ValueError):  # rows of several lengths
            array = np.empty(0, object)
        if array.dtype.kind not in "iuf":
            raise SurfaceError(
                f"what is estimated is {shown(value)}; let the function return real numbers"
            )
        return array

    return numbers


_ENDING = ".zarr"


def store_argument(store: Any, scheduler: Any) -> str | None:
    """Return where a measurement is to be kept; None where it is not.

    >>> store_argument("hemisphere.nc", None)
    Traceback (most recent call last):
    optipath.errors.SurfaceError: store 'hemisphere.nc' is no Zarr store; give a name that ends \
in .zarr, such as 'hemisphere.zarr'
    """
    faults = Faults()
    if scheduler is not None:
        faults.attempt("", _check_scheduler, scheduler)
    if store is None:
        if scheduler is not None:
            faults.append(
                "scheduler= is for a measurement that is kept; give store= besides, such as "
                "store='hemisphere.zarr', or threads= for those of this process"
            )
        place = None
    else:
        place = faults.attempt("", input_file, store, SurfaceError)
    if place is not None and place.suffix != _ENDING:
        stem = "hemisphere" if place.stem in ("", _ENDING) else place.stem
        faults.append(
            f"store {shown(str(place))} is no Zarr store; give a name that ends in {_ENDING}, such "
            f"as '{stem}{_ENDING}'"
        )
    if faults:
        raise SurfaceError(*faults)
    return None if place is None else os.fspath(store)  # A URL is no path.


def _check_scheduler(scheduler: Any) -> None:
    try:
        from optipath.sweeps.blocks import check_scheduler  # noqa: PLC0415 - an extra
    except ImportError:
        return  # What is not installed is told by who needs it.
    check_scheduler(scheduler)
