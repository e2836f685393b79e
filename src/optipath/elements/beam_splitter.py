"""BeamSplitter: parts one beam into two."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from optipath.elements.coupling import Operation
from optipath.elements.four_port import FourPort
from optipath.elements.frame_checks import same_frame, share_x
from optipath.kernels.catalogue import COMPLEMENT, MIRROR
from optipath.values.domains.quantities import Angle, Fraction

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.elements.coupling import Coupling
    from optipath.light.frames import Frame


_THROUGH = {"in": "transmitted", "transmitted": "in", "back": "reflected", "reflected": "back"}


class BeamSplitter(FourPort, kind="beam-splitter"):
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

    natural: ClassVar[str] = ""
    mirrored: ClassVar[tuple[str, ...]] = ()
    reflectance: Fraction = 0.5
    azimuth: Angle = 0.0

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the mirror and what passes it, from either side."""
        mirror = Operation(MIRROR, (self.reflectance,))
        passing = Operation(COMPLEMENT, (self.reflectance,))
        both = mirror, passing
        return self._ways(both, both)

    def frame_of(self, port: str, frames: Mapping[str, Frame]) -> Frame | None:
        return frames.get(port) or frames.get(_THROUGH[port])

    def frame_faults(self, owner: str, frames: Mapping[str, Frame]) -> list[str]:
        found = []
        for enters, passes, turns in (
            ("in", "transmitted", "reflected"),
            ("back", "reflected", "transmitted"),
        ):
            entry = frames.get(enters)
            if entry is None:
                continue
            if not same_frame(frames.get(passes, entry), entry):
                found.append(
                    f"'{owner}' lets transmitted light go straight through; give "
                    f"'{owner}.{enters}' and '{owner}.{passes}' one frame"
                )
            if not share_x(frames.get(turns, entry), entry):
                found.append(
                    f"the frames of '{owner}.{enters}' and '{owner}.{turns}' must share one x"
                )
        return found
