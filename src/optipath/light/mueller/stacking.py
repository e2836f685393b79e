"""Rows of elementwise entries stacked up to Mueller matrices."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt


def stacked(rows: Any) -> npt.NDArray[np.float64]:
    """Return rows of elementwise entries as one array of shape (..., 4, 4)."""
    entries = np.broadcast_arrays(*(entry for row in rows for entry in row))
    flat = np.stack(entries, axis=-1)
    return flat.reshape(*flat.shape[:-1], 4, 4)
