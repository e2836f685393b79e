"""What users let follow from the light of pixels: a function that returns real numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError, shown

if TYPE_CHECKING:
    from collections.abc import Callable

Numbers = npt.NDArray[np.float64]


def following(found: Callable[[Numbers], Any]) -> Callable[[Numbers], Numbers]:
    """Return a function that returns arrays, or refuses what is returned.

    Examples
    --------
    >>> following(lambda light: None)(np.eye(4))
    Traceback (most recent call last):
    optipath.errors.SurfaceError: what is estimated is None; let the function return real numbers
    """
    if not callable(found):
        raise SurfaceError(
            f"found is {shown(found)}; give a function of the light that returns real numbers"
        )

    def numbers(light: Numbers) -> Numbers:
        value = found(light)
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
