"""Source: where light begins."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from optipath.elements.coupling import Coupling, Operation, numbers_of
from optipath.elements.element import Element
from optipath.kernels.catalogue import POLARIZED, UNPOLARIZED
from optipath.values.domains.quantities import NonNegative, StokesState

if TYPE_CHECKING:
    from typing import Any


class Source(Element, kind="source"):
    """A source of light of any intensity and any state of polarisation.

    Parameters
    ----------
    intensity : float, array_like or Parameter, optional
        What the state is multiplied by; not negative.
    stokes : array_like, shape (..., 4), or Parameter, optional
        The state; unpolarised light ``(1, 0, 0, 0)`` by default. The light that
        leaves is ``intensity * stokes``.

    Examples
    --------
    >>> Source(intensity=100.0)
    Source(intensity=100.0, stokes=None)
    """

    inputs: ClassVar[tuple[str, ...]] = ()
    outputs: ClassVar[tuple[str, ...]] = ("out",)

    intensity: NonNegative = 1.0
    stokes: StokesState | None = None

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the emission into ``out``."""
        arguments: tuple[Any, ...] = (self.intensity,)
        kernel = UNPOLARIZED
        if self.stokes is not None:
            kernel = POLARIZED
            arguments += numbers_of(self.stokes, self.domains()["stokes"])
        return (Coupling(None, "out", (Operation(kernel, arguments),)),)
