"""CircularDiattenuator: a circular dichroic filter, by its two transmittances."""

from __future__ import annotations

from typing import ClassVar

from optipath.elements.circular_axes import along_circular_axes
from optipath.elements.coupling import Coupling
from optipath.elements.element import Element
from optipath.kernels.catalogue import POLARIZER
from optipath.values.domains.quantities import Fraction
from optipath.values.operation import Operation


class CircularDiattenuator(Element, kind="circular-diattenuator"):
    """A circular dichroic filter; lets all right-handed light through unless told otherwise.

    Right-handed is light of S3 > 0, as IEEE and `Light.handedness` have it; to Hecht and to
    chemists it is left-handed. What is circular leaves it circular, of the same hand. The linear
    dichroic filter is `Diattenuator`. Chipman, Lam & Young, Polarized Light and Optical Systems
    (2018).

    Parameters
    ----------
    right, left : float, array_like or Parameter, optional
        The transmittances of the intensity for light of S3 > 0 and of S3 < 0, 0 to 1.

    Examples
    --------
    >>> CircularDiattenuator(right=0.75, left=0.25).mueller().matrix[0]
    array([0.5 , 0.  , 0.  , 0.25])
    """

    mirrored: ClassVar[tuple[str, ...]] = ()

    right: Fraction = 1.0
    left: Fraction = 0.0

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the diattenuator, its axes circular."""
        filtering = Operation(POLARIZER, (self.right, self.left))
        return (Coupling("in", "out", along_circular_axes(filtering)),)
