"""The JAX engine: a program traced, so that it can be differentiated and run on a GPU."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from optipath.engines.engine import Engine

if TYPE_CHECKING:
    import numpy as np

    from optipath.engines.jax_path import JaxPath
    from optipath.engines.program import Program
    from optipath.kernels.carriers.carrier import Carrier


class CarriedProgram(NamedTuple):
    """What stands behind a formula."""

    program: Program
    carrier: type[Carrier]
    dtype: np.dtype[np.floating]


class JaxEngine(Engine[CarriedProgram, "JaxPath"]):
    """Traces the steps of a program; it compiles each batch when it is run."""

    name = extra = "jax"

    def compiled(self, formula: CarriedProgram) -> JaxPath:
        """Return the program for JAX."""
        if not self.is_installed:
            raise self.missing
        from optipath.engines.jax_path import JaxPath  # noqa: PLC0415 - an extra

        return JaxPath(*formula)
