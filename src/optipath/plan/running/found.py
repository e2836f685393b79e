"""What has been found: the light at an end, and parts of a batch put together."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    Array = np.ndarray[Any, Any]


class Found(NamedTuple):
    """The light at an end: its Stokes vectors, times two to the power of an exponent.

    `stokes` is an array (..., 4), or a tuple of its four components.
    """

    stokes: Any
    exponent: Any

    def whole(self, batch: tuple[int, ...]) -> tuple[Array, Array]:
        """Return Stokes vectors (..., 4) and exponents (...) as arrays."""
        if not isinstance(self.stokes, tuple):
            return self.stokes, np.broadcast_to(self.exponent, batch)
        kind = np.result_type(self.stokes[0])
        parts = [np.broadcast_to(np.asarray(part, kind), batch) for part in self.stokes]
        return np.stack(parts, axis=-1), np.broadcast_to(self.exponent, batch)


def joined(parts: list[Array], batch: tuple[int, ...], tail: tuple[int, ...]) -> Array:
    """Return the parts of a batch as one array of its shape, with some axes behind it."""
    if len(parts) == 1:
        return parts[0]
    return np.concatenate([part.reshape(-1, *tail) for part in parts]).reshape(*batch, *tail)


def in_shape(part: Any, batch: tuple[int, ...]) -> Any:
    """Return a component as an array of the batch's shape, or the number that it is."""
    return part.reshape(batch) if isinstance(part, np.ndarray) else part
