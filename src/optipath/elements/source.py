"""Source: where light begins."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np

from optipath.elements.coupling import Coupling, Operation, numbers_of
from optipath.elements.element import Element
from optipath.kernels.catalogue import POLARIZED, UNPOLARIZED
from optipath.values.domains.quantities import NonNegative, StokesState, YesOrNo
from optipath.values.made import refuse

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
    physical : bool, optional
        Whether a state that is polarised by more than 100 % is refused; False for what has been
        measured with noise.

    Examples
    --------
    >>> Source(intensity=100.0)
    Source(intensity=100.0, stokes=None, physical=True)
    """

    inputs: ClassVar[tuple[str, ...]] = ()
    outputs: ClassVar[tuple[str, ...]] = ("out",)

    intensity: NonNegative = 1.0
    stokes: StokesState | None = None
    physical: YesOrNo = True  # type: ignore[misc] # each source says it for itself

    def __post_init__(self) -> None:
        """Ask besides whether four numbers are a state."""
        given = self.intensity
        super().__post_init__()
        if self.stokes is None and isinstance(given, (list, tuple)) and _is_a_state(self.intensity):
            refuse(
                [
                    (
                        f"Source intensity is {given}, which may be a state, or the intensities of "
                        f"four paths; give stokes={given} for the one, np.array for the other"
                    )
                ]
            )

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the emission into ``out``."""
        arguments: tuple[Any, ...] = (self.intensity,)
        kernel = UNPOLARIZED
        if self.stokes is not None:
            kernel = POLARIZED
            arguments += numbers_of(self.stokes, self.domains()["stokes"])
        return (Coupling(None, "out", (Operation(kernel, arguments),)),)


def _is_a_state(numbers: Any) -> bool:
    """Tell whether four numbers are those of light that is polarised by 100 % at most."""
    if (
        not isinstance(numbers, np.ndarray)
        or numbers.shape != (4,)
        or numbers.dtype.kind not in "iuf"
    ):
        return False
    return bool(np.linalg.norm(numbers[1:]) <= numbers[0])
