"""Detector and Dump: where light ends."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from optipath.elements.element import Element
from optipath.materials.quantities import Reads, Spectral
from optipath.materials.spectrum import check_response

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
    response : Spectrum, float or array_like, optional
        What it reads of the light that arrives, at each wavelength of a run; not negative, and of
        any unit, so that it may be above 1. All of the light, without one.

    Examples
    --------
    >>> Detector().reads
    'stokes'
    """

    detects: ClassVar[bool] = True

    reads: Reads = "stokes"
    response: Spectral = None

    def __post_init__(self) -> None:
        """Refuse besides a spectrum that is power in bins or lines, and no response."""
        super().__post_init__()
        check_response("Detector response", self.response)


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
