"""How programs are run."""

from __future__ import annotations

from typing import NamedTuple

from optipath.kernels.numbers.trigonometry import DIGITS


class RunOptions(NamedTuple):
    """How programs are run, as `Composer` takes it.

    Attributes
    ----------
    method : str
        How Fresnel's equations are computed.
    composing : str
        Whether light is carried as Stokes or as Jones vectors.
    dtype : str
        The precision.
    engine : str
        What is asked for, ``"auto"`` or the name of an engine.
    threads : int
        How many share a large batch.
    """

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
