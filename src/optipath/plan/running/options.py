"""How programs are run."""

from __future__ import annotations

from typing import NamedTuple

from optipath.kernels.numbers.trigonometry import DIGITS


class RunOptions(NamedTuple):
    """How programs are run, as `Composer` takes it."""

    method: str
    composing: str
    dtype: str
    engine: str
    threads: int

    @property
    def reproducible(self) -> bool:
        """Whether a path comes to the same bits alone and in any batch, by every engine but JAX.

        Elementary functions are then those of `reproducible`, which there are of this precision.
        """
        return self.dtype in DIGITS
