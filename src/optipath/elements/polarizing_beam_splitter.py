"""PolarizingBeamSplitter: parts p from s."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from optipath.elements.splitter import Splitter
from optipath.kernels.catalogue import POLARIZING_REFLECTION, POLARIZING_TRANSMISSION
from optipath.kernels.filters.bench import INFINITE
from optipath.values.arrays.read_only import read_only
from optipath.values.domains.quantities import Angle, ExtinctionRatio
from optipath.values.operation import Operation

if TYPE_CHECKING:
    from optipath.elements.coupling import Coupling


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
        The turn of the frame of ``in``, x = s, against the frame of the port before it; for
        ``back``, a link may say it.

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
