"""Detector and Dump: where light ends."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from optipath.elements.element import Element
from optipath.values.domains.quantities import Reads

if TYPE_CHECKING:
    from optipath.elements.coupling import Coupling


class Terminal(Element):
    """Where light ends; several links may arrive, and their light adds incoherently."""

    outputs: ClassVar[tuple[str, ...]] = ()
    natural: ClassVar[str] = ""
    merges: ClassVar[bool] = True

    def couplings(self) -> tuple[Coupling, ...]:
        """Return no way out."""
        return ()


class Detector(Terminal, kind="detector"):
    """Reads the light that arrives, in the frame it arrives in.

    Parameters
    ----------
    reads : {"stokes", "linear", "intensity"}, optional
        All four components, S0 to S2, or S0 alone. What is not read is NaN.

    Examples
    --------
    >>> Detector().reads
    'stokes'
    """

    detects: ClassVar[bool] = True

    reads: Reads = "stokes"


class Dump(Terminal, kind="dump"):
    """Takes light out of the path on purpose, and counts it.

    Parameters
    ----------
    reads : {"stokes", "linear", "intensity"}, optional
        As `Detector` takes it.

    Examples
    --------
    >>> Dump().reads
    'stokes'
    """

    reads: Reads = "stokes"
