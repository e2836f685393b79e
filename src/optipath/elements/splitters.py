"""Beam splitters, polarizing or not, and combiners."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from optipath.elements.boundary import FourPort
from optipath.elements.coupling import Coupling
from optipath.elements.element import Element
from optipath.elements.frame_checks import same_frame, x_faults
from optipath.kernels.catalog import (
    COMPLEMENT,
    MIRROR,
    POLARIZING_REFLECTION,
    POLARIZING_TRANSMISSION,
)
from optipath.kernels.filters import INFINITE
from optipath.materials.quantities import Angle, ExtinctionRatio, Fraction
from optipath.values.arrays import read_only
from optipath.values.operands import Operation

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.light.frame import Frame


class Combiner(Element, kind="combiner"):
    """Adds up all the light that arrives, incoherently, and sends it on.

    Examples
    --------
    >>> Combiner().merges
    True
    """

    merges: ClassVar[bool] = True

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the way straight through."""
        return (Coupling("in", "out", ()),)


_THROUGH = {"in": "transmitted", "transmitted": "in", "back": "reflected", "reflected": "back"}


class Splitter(FourPort):
    """An element with two sides, all of whose ports have x = s, and no natural way out."""

    natural: ClassVar[str] = ""

    def frame_of(self, port: str, frames: Mapping[str, Frame]) -> Frame | None:
        return frames.get(port) or frames.get(_THROUGH[port])

    def frame_faults(self, owner: str, frames: Mapping[str, Frame]) -> list[str]:
        results = []
        for enters, passes in (("in", "transmitted"), ("back", "reflected")):
            if {enters, passes} <= frames.keys() and not same_frame(frames[enters], frames[passes]):
                results.append(
                    f"'{owner}' lets transmitted light go straight through; give "
                    f"'{owner}.{enters}' and '{owner}.{passes}' one frame"
                )
        return results or x_faults(owner, frames)


class BeamSplitter(Splitter, kind="beam-splitter"):
    """A lossless beam splitter that does not polarise.

    Light that enters at ``in`` leaves in part at ``reflected``, as from an ideal
    mirror (r_p = -r_s), and in part at ``transmitted``, unchanged. Light that enters from
    the other side, at ``back``, is reflected to ``transmitted`` and passes to ``reflected``.

    Parameters
    ----------
    reflectance : float, array_like or Parameter, optional
        The fraction reflected, 0 to 1; the rest is transmitted.
    azimuth : float, array_like or Parameter, optional
        The turn of the frame of ``in``, x = s, against the frame of the port before it; for
        ``back``, a link may say it.

    Examples
    --------
    >>> BeamSplitter(reflectance=0.3)
    BeamSplitter(reflectance=0.3, azimuth=0.0)
    """

    mirrored: ClassVar[tuple[str, ...]] = ()

    reflectance: Fraction = 0.5
    azimuth: Angle = 0.0

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the mirror and what passes it, from either side."""
        mirror = Operation(MIRROR, (self.reflectance,))
        both = mirror, Operation(COMPLEMENT, (self.reflectance,))
        return self._ways(both, both)


class PolarizingBeamSplitter(Splitter, kind="polarizing-beam-splitter"):
    """A lossless beam splitter that transmits p, along y, and reflects s, along x.

    Its ports are those of a `BeamSplitter`. What is reflected has the phases of an ideal mirror
    (r_p = -r_s), and what is transmitted is not retarded. With the extinction ratios
    Tp / Ts = t and Rs / Rp = r, and nothing lost (Ts + Rs = Tp + Rp = 1),
    Tp = (1 - 1 / r) / (1 - 1 / (r t)) and Rs = (1 - 1 / t) / (1 - 1 / (r t)).

    Parameters
    ----------
    extinction_transmitted, extinction_reflected : float, array_like, text or Parameter, optional
        Tp / Ts of what is transmitted and Rs / Rp of what is reflected, 1.000001 or more,
        infinite by default, which 1e30 is, too (a Parameter takes finite ones); ``"1000:1"`` is
        1000. At 1 all would go one way, whatever its polarisation, or any share.
    azimuth : float, array_like or Parameter, optional
        As `BeamSplitter` takes it.

    Examples
    --------
    >>> cube = PolarizingBeamSplitter("1000:1", 20.0)
    >>> for port in cube.outputs:
    ...     print(cube.mueller("in", port).matrix[0, :2].round(6))
    [0.524501 0.474549]
    [ 0.475499 -0.474549]
    """

    mirrored: ClassVar[tuple[str, ...]] = ()

    extinction_transmitted: ExtinctionRatio = math.inf
    extinction_reflected: ExtinctionRatio = math.inf
    azimuth: Angle = 0.0

    def couplings(self) -> tuple[Coupling, ...]:
        """Return what is reflected and what passes, the same from either side."""
        ratios = _finite(self.extinction_transmitted), _finite(self.extinction_reflected)
        reflecting = Operation(POLARIZING_REFLECTION, ratios)
        both = reflecting, Operation(POLARIZING_TRANSMISSION, ratios)
        return self._ways(both, both)


def _finite(ratio: Any) -> Any:
    """Return a ratio that is known as numbers that can be computed with in any precision."""
    known = isinstance(ratio, (int, float, np.ndarray))
    return read_only(np.minimum(ratio, INFINITE)) if known else ratio
