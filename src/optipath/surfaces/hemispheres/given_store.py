"""Where a measurement is to be kept, and who is to compute it, read and checked."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import SurfaceError, shown
from optipath.paths.format.faults import Faults
from optipath.values.given_files import given_file

if TYPE_CHECKING:
    from pathlib import Path

_ENDING = ".zarr"


def given_store(store: Any, scheduler: Any) -> Path | None:
    """Return where a measurement is to be kept; None where it is not.

    Examples
    --------
    >>> given_store("hemisphere.nc", None)
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
        place = faults.attempt("", given_file, store, SurfaceError)
    if place is not None and place.suffix != _ENDING:
        stem = "hemisphere" if place.stem in ("", _ENDING) else place.stem
        faults.append(
            f"store {shown(str(place))} is no Zarr store; give a name that ends in {_ENDING}, such "
            f"as '{stem}{_ENDING}'"
        )
    if faults:
        raise SurfaceError(*faults)
    return place


def _check_scheduler(scheduler: Any) -> None:
    try:
        from optipath.sweeps.blocks.workers import check_scheduler  # noqa: PLC0415 - an extra
    except ImportError:
        return  # What is not installed is told by who needs it.
    check_scheduler(scheduler)
