"""Ends of light: sources, detectors and dumps."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from optipath.elements.coupling import Coupling, numbers_of
from optipath.elements.element import Element
from optipath.kernels.catalog import POLARIZED, PRODUCT, UNPOLARIZED
from optipath.materials.quantities import (
    NonNegative,
    Reads,
    Spectral,
    StokesState,
    YesOrNo,
)
from optipath.materials.spectrum import check_response
from optipath.values.operands import Operation

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
    spectrum : Spectrum or array_like, optional
        What the light is multiplied by at each wavelength of a run: power per nanometre. A
        `Spectrum` takes the wavelength from the parameter ``wavelength``; without one, light is
        the same at each.

    Examples
    --------
    >>> Source(intensity=100.0)
    Source(intensity=100.0, stokes=None, physical=True, spectrum=None)
    """

    inputs: ClassVar[tuple[str, ...]] = ()
    outputs: ClassVar[tuple[str, ...]] = ("out",)

    intensity: NonNegative = 1.0
    stokes: StokesState | None = None
    physical: YesOrNo = True  # type: ignore[misc] # each source says it for itself
    spectrum: Spectral = None

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the emission into ``out``."""
        intensity: Any = self.intensity
        if self.spectrum is not None:
            (intensity,) = Operation(PRODUCT, (intensity, self.spectrum)).results(1)
        arguments: tuple[Any, ...] = (intensity,)
        kernel = UNPOLARIZED
        if self.stokes is not None:
            kernel = POLARIZED
            arguments += numbers_of(self.stokes, self.domains()["stokes"])
        return (Coupling(None, "out", (Operation(kernel, arguments),)),)


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
