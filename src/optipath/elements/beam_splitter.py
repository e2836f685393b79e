"""BeamSplitter: parts one beam into two."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from optipath.elements.splitter import Splitter
from optipath.kernels.catalogue import COMPLEMENT, MIRROR
from optipath.values.domains.quantities import Angle, Fraction
from optipath.values.operation import Operation

if TYPE_CHECKING:
    from optipath.elements.coupling import Coupling


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
        passing = Operation(COMPLEMENT, (self.reflectance,))
        both = mirror, passing
        return self._ways(both, both)
