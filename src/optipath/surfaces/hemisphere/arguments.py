"""Arguments of measurements: directions, wavelengths and stores, checked."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, SurfaceError, shown
from optipath.materials.quantities import ANGLE
from optipath.surfaces.facet_model import frame_along
from optipath.values.files import input_file
from optipath.values.units import format_quantity
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
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
    try:
        entries = np.asarray(argument, dtype=object)
        # An angle, or several as texts; numbers in a row are a vector.
        if entries.ndim == 0 or isinstance(next(entries.flat, None), str):
            angle = np.asarray(ANGLE.check("direction", argument))
            # From 3 quarter turns on, a vector would point to the right side again.
            if np.any(beyond := np.abs(angle) >= np.pi / 2.0):
                worst = float(angle[beyond].flat[0])
                raise SurfaceError(
                    f"direction is {worst:.6g} rad ({np.degrees(worst):.6g} deg) from the normal; "
                    f"give an angle in the plane of incidence below 90 deg, such as '45 deg'"
                )
            sin, height = np.sin(angle), np.cos(angle) if up else -np.cos(angle)
            # Adding 0 turns -0 into 0.
            parts = [sin * np.cos(azimuth), sin * np.sin(azimuth), height]
            argument = np.stack(parts, axis=-1) + 0.0
        return frame_along("direction", argument, up=up)
    except OptipathError as fault:
        raise SurfaceError(*fault.faults) from None


def wavelength_place(known: Numbers, argument: Any) -> int:
    """Return the place of a wavelength among measured ones, in metres.

    >>> wavelength_place(np.array([4e-7, 5e-7]), "500 nm")
    1
    """
    if argument is None and len(known) == 1:
        return 0
    try:
        wanted = np.ravel(np.nan if argument is None else Wavelength().resolve(argument).value)
    except OptipathError as fault:
        raise SurfaceError(*fault.faults) from None
    nearest = int(np.argmin(np.abs(known - wanted[0]))) if wanted.size == 1 else 0
    if wanted.size != 1 or not abs(known[nearest] - wanted[0]) <= _SAME * wanted[0]:
        several = " or ".join(format_quantity(float(each), "nm") for each in known)
        which = "none, since nothing of the sample depends on it" if np.isnan(known[0]) else several
        raise SurfaceError(f"wavelength is {shown(argument)}, and measured is {which}; give that")
    return nearest


def store_argument(store: Any, scheduler: Any) -> str | None:
    """Return where a measurement is to be kept; None where it is not.

    >>> store_argument("hemisphere.nc", None)
    Traceback (most recent call last):
    optipath.errors.SurfaceError: store 'hemisphere.nc' is no Zarr store; give a name that ends \
in .zarr, such as 'hemisphere.zarr'
    """
    if store is None:
        if scheduler is not None:
            raise SurfaceError(
                "scheduler= is for a measurement that is kept; give store= besides, such as "
                "store='hemisphere.zarr', or threads= for those of this process"
            )
        return None
    if input_file(store, SurfaceError).suffix != ".zarr":
        raise SurfaceError(
            f"store {shown(str(store))} is no Zarr store; give a name that ends in .zarr, such as "
            f"'hemisphere.zarr'"
        )
    place: str = os.fspath(store)
    return place
