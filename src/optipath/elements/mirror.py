"""Mirror: a reflection by given amplitude coefficients."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from optipath.elements.coupling import Coupling, numbers_of
from optipath.elements.element import Element
from optipath.elements.frame_checks import share_x
from optipath.kernels.catalogue import GIVEN_AMPLITUDES
from optipath.values.arrays.read_only import read_only
from optipath.values.domains.quantities import AMPLITUDE, Amplitude, Angle
from optipath.values.operation import Operation

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.light.frames import Frame

_IDEAL = {"r_s": -1.0, "r_p": 1.0}


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
        What the field is multiplied by along s and along p; of a size of 1 or less. Where one
        alone is given, r_p = -r_s, as at normal incidence; -1 and 1 where none is.
    azimuth : float, array_like or Parameter, optional
        The turn of the frame of ``in`` against the frame of the port before it, in radians.

    Examples
    --------
    >>> aluminium = Mirror(r_s=-0.97 + 0.12j, r_p=0.92 - 0.26j)
    >>> (aluminium.mueller().matrix[0] * 2).round(4)
    array([1.8693, 0.0413, 0.    , 0.    ])
    >>> Mirror(r_s=-0.9)
    Mirror(r_s=-0.9, r_p=0.9, azimuth=0.0)
    """

    outputs: ClassVar[tuple[str, ...]] = ("reflected",)
    natural: ClassVar[str] = "reflected"
    straight: ClassVar[bool] = False
    mirrored: ClassVar[tuple[str, ...]] = ()

    r_s: Amplitude | None = None
    r_p: Amplitude | None = None
    azimuth: Angle = 0.0

    def __post_init__(self) -> None:
        """Let one amplitude follow from the other where that alone is given."""
        missing = [name for name in _IDEAL if getattr(self, name) is None]
        for name in missing:
            object.__setattr__(self, name, _IDEAL[name])
        super().__post_init__()
        # What is wrong with the one that is given is told of that alone.
        if len(missing) == 1 and not self.faults(""):
            (given,) = _IDEAL.keys() - missing
            object.__setattr__(self, missing[0], read_only(-getattr(self, given)))

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
