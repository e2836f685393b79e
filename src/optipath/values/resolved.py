"""Resolved: what was given for a parameter, as numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

THERE = np.ones((), dtype=bool)
"""For a parameter that is there, on every path."""
THERE.flags.writeable = False


class Resolved(NamedTuple):
    """Numbers for a parameter, and where an optional one is there at all."""

    value: npt.NDArray[Any]
    present: npt.NDArray[np.bool_]
