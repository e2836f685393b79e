"""Several measured samples, seen from one side in one picture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import SurfaceError
from optipath.paths.format.faults import Faults, joined
from optipath.plots.hemispheres.seen_side import SeenSide
from optipath.surfaces.hemispheres.hemisphere import Hemisphere

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence


def seen_sides(
    several: Mapping[str, Any],
    side: Any,
    wavelength: Any,
    source: Any,
    *,
    beside: Sequence[str] = (),
) -> dict[str, SeenSide]:
    """Return the sides that a picture of several samples is asked for.

    The wavelength is for those that were measured at several; where none was, for those at one.
    """
    most = max(map(_choices, several.values()))
    faults = Faults(beside)
    found = {
        name: faults.attempt(
            name,
            SeenSide.of,
            each,
            side,
            wavelength if _choices(each) == most else None,
            source,
        )
        for name, each in several.items()
    }
    if faults:
        raise SurfaceError(*joined(faults))
    return {name: seen for name, seen in found.items() if seen}


def titled(what: str, several: Collection[SeenSide]) -> str:
    """Return the title of a picture of several samples, of what is the same of all."""
    first = next(iter(several))
    parts = [what, first.side, "in the plane of incidence"]
    colours = {each.colour for each in several} - {""}
    parts += colours if len(colours) == 1 else []
    return ", ".join(parts) + first.source_line


def labels(several: Mapping[str, SeenSide]) -> dict[str, str]:
    """Return what curves are called: their names, with wavelengths where these differ."""
    differ = len({each.colour for each in several.values()} - {""}) > 1
    return {
        name: f"{name}, {seen.colour}" if differ and seen.colour else name
        for name, seen in several.items()
    }


def _choices(measured: Any) -> int:
    """Return whether something was measured at no wavelength, at one, or at several, 2."""
    if not isinstance(measured, Hemisphere):
        return 0
    return min(int(np.isfinite(measured.wavelengths).sum()), 2)
