"""Depolarizer: takes polarisation away, all states alike."""

from __future__ import annotations

from typing import ClassVar

from optipath.elements.coupling import Coupling
from optipath.elements.element import Element
from optipath.kernels.catalogue import DEPOLARIZER
from optipath.values.domains.quantities import Fraction
from optipath.values.operation import Operation


class Depolarizer(Element, kind="depolarizer"):
    """An ideal depolariser, diag(1, 1-d, 1-d, 1-d): no light is lost, only its polarisation.

    It has no Jones matrix, and is refused where Jones columns are composed. Chipman, Lam &
    Young, Polarized Light and Optical Systems (2018).

    Parameters
    ----------
    depolarization : float, array_like or Parameter, optional
        The share d of the polarisation that is taken away, 0 to 1.

    Examples
    --------
    >>> Depolarizer(0.25).mueller().matrix.diagonal()
    array([1.  , 0.75, 0.75, 0.75])
    """

    mirrored: ClassVar[tuple[str, ...]] = ()

    depolarization: Fraction = 1.0

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the depolariser."""
        return (Coupling("in", "out", (Operation(DEPOLARIZER, (self.depolarization,)),)),)
