"""Interface: a smooth boundary between two media, reflecting by Fresnel's equations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from optipath.domains import Angle, Incidence, Index, OutsideIndex
from optipath.elements.coupling import Coupling, Operation, numbers_of
from optipath.elements.element import Element
from optipath.elements.frame_checks import incidence_between, share_x
from optipath.kernels import REFLECTION
from optipath.materials import Material
from optipath.shapes import broadcast_fault
from optipath.views import View

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.frames import Frame


class Interface(Element, kind="interface"):
    """A smooth boundary; its frames have x = s, perpendicular to the plane of incidence.

    Light that enters at ``in`` leaves at ``reflected``. The port ``transmitted`` is
    named already, but gives no light in this version.

    Parameters
    ----------
    index : float, complex, array_like, Material or Parameter
        The index of refraction n + ik of the medium behind the boundary.
    incidence : float, array_like or Parameter
        The angle of incidence in radians, 0 to pi/2.
    outside : float, array_like, Material or Parameter, optional
        The index of the medium that light comes from, without absorption.
    azimuth : float, array_like or Parameter, optional
        The angle by which the frame of ``in`` is turned about the direction of
        travel against the frame of the port before it.

    Examples
    --------
    >>> Interface(index=0.608 + 2.12j, incidence=0.349)
    Interface(index=(0.608+2.12j), incidence=0.349, outside=1.0, azimuth=0.0)
    """

    outputs: ClassVar[tuple[str, ...]] = ("reflected", "transmitted")
    natural: ClassVar[str] = "reflected"
    straight: ClassVar[bool] = False

    index: Index
    incidence: Incidence
    outside: OutsideIndex = 1.0
    azimuth: Angle = 0.0

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the reflection from ``in`` to ``reflected``."""
        outside = self.outside.n if isinstance(self.outside, Material) else self.outside
        n, k = numbers_of(self.index, self.domains()["index"])
        angle = (View(self.incidence, "cos"), View(self.incidence, "sin"))
        operation = Operation(REFLECTION, (outside, n, k, *angle))
        return (Coupling("in", "reflected", (operation,)),)

    def frame_faults(self, owner: str, frames: Mapping[str, Frame]) -> list[str]:
        """Check that x = s at both ports and that the directions meet at the incidence."""
        if not {"in", "reflected"} <= frames.keys():
            return []
        arriving, leaving = frames["in"], frames["reflected"]
        if not share_x(arriving, leaving):
            problem = f"the frames of '{owner}.in' and '{owner}.reflected' must share one x"
            return [f"{problem}, perpendicular to the plane of incidence"]
        found = incidence_between(arriving, leaving)
        problem = f"the frames of '{owner}' meet at an incidence of {_degrees(found)}"
        incidence = View(self.incidence)
        if not incidence.known:
            return [f"{problem}; give that, not the parameter '{self.incidence.name}'"]  # type: ignore[union-attr]
        if self.faults(owner):
            return []
        given = incidence.numbers({})
        if broadcast_fault({"frames": found.shape, "incidence": given.shape}):
            return []  # Named with all other shapes.
        if np.all(np.abs(found - given) <= 1e-7):
            return []
        return [f"{problem}, but its incidence is {_degrees(given)}; make them agree"]


def _degrees(angle: Any) -> str:
    return f"{np.degrees(np.ravel(angle)[0]):.9g} deg"
