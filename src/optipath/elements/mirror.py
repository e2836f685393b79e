"""Mirror: a reflection by given amplitude coefficients."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from optipath.elements.coupling import Coupling, Operation, numbers_of
from optipath.elements.element import Element
from optipath.elements.frame_checks import share_x
from optipath.kernels.catalogue import GIVEN_AMPLITUDES
from optipath.values.domains.quantities import AMPLITUDE, Amplitude, Angle

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.light.frames import Frame


class Mirror(Element, kind="mirror"):
    """A mirror whose amplitude reflection coefficients are known; ideal unless told otherwise.

    Light that enters at ``in`` leaves at ``reflected``; both frames have x = s,
    perpendicular to the plane of incidence. The field is exp(-iwt), and y turns over with
    the light: r_p = -r_s at normal incidence. So what light meets again on its way back has its
    axes at the opposite angle. C + iS = r_s conj(r_p); Born & Wolf,
    Principles of Optics, sec. 1.5.2.

    Parameters
    ----------
    r_s, r_p : float, complex, array_like or Parameter, optional
        What the field is multiplied by along s and along p; of a size of 1 or less.
    azimuth : float, array_like or Parameter, optional
        The turn of the frame of ``in`` against the frame of the port before it, in radians.

    Examples
    --------
    >>> aluminium = Mirror(r_s=-0.97 + 0.12j, r_p=0.92 - 0.26j)
    >>> (aluminium.mueller().matrix[0] * 2).round(4)
    array([1.8693, 0.0413, 0.    , 0.    ])
    """

    outputs: ClassVar[tuple[str, ...]] = ("reflected",)
    natural: ClassVar[str] = "reflected"
    straight: ClassVar[bool] = False

    r_s: Amplitude = -1.0
    r_p: Amplitude = 1.0
    azimuth: Angle = 0.0

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the reflection from ``in`` to ``reflected``."""
        numbers = numbers_of(self.r_s, AMPLITUDE) + numbers_of(self.r_p, AMPLITUDE)
        reflecting = Operation(GIVEN_AMPLITUDES, numbers)
        return (Coupling("in", "reflected", (reflecting,), reflects=True),)

    def frame_faults(self, owner: str, frames: Mapping[str, Frame]) -> list[str]:
        if not {"in", "reflected"} <= frames.keys() or share_x(frames["in"], frames["reflected"]):
            return []
        problem = f"the frames of '{owner}.in' and '{owner}.reflected' must share one x"
        return [f"{problem}, perpendicular to the plane of incidence"]
