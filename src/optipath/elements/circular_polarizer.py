"""CircularPolarizer: lets one of the two circular states through."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar

from optipath.elements.coupling import Coupling, Operation, turned
from optipath.elements.element import Element
from optipath.kernels.catalogue import POLARIZER, RETARDER
from optipath.values.domains.quantities import Fraction, Handedness

if TYPE_CHECKING:
    from typing import Any


class CircularPolarizer(Element, kind="circular-polarizer"):
    """A homogeneous circular polariser: its eigenstates are the two circular states.

    Whatever comes in, circular light of its handedness comes out, and light of that handedness
    passes as it is, from either side: it has no axis. A laminated sheet, a linear polariser with
    a quarter-wave plate behind it, is another thing: ``Polarizer(0) >> Retarder(pi/2, pi/4)``
    makes light of S3 < 0 of light from its front, and dims circular light by half, of either
    handedness. Chipman, Lam & Young, Polarized Light and Optical Systems (2018).

    Parameters
    ----------
    handedness : {"right", "left"}, optional
        Of the light that passes: "right" for S3 > 0, which IEEE, astronomy and
        `Light.handedness` call right-handed, and Hecht and Born & Wolf left-handed.
    transmittance, leakage : float, array_like or Parameter, optional
        The transmittances of light of that handedness and of the other one, 0 to 1.

    Examples
    --------
    >>> CircularPolarizer("left").mueller().matrix[[0, 3]]
    array([[ 0.5,  0. ,  0. , -0.5],
           [-0.5,  0. ,  0. ,  0.5]])
    """

    mirrored: ClassVar[tuple[str, ...]] = ()

    handedness: Handedness = "right"
    transmittance: Fraction = 1.0
    leakage: Fraction = 0.0

    def couplings(self) -> tuple[Coupling, ...]:
        """Return a linear polariser at 45 degrees between two crossed quarter-wave plates.

        It is the same, with the same digits, and no depolarisation in any step.
        """
        quarter = -math.pi / 2 if self.handedness == "right" else math.pi / 2
        filtering = Operation(POLARIZER, (self.transmittance, self.leakage))
        linear = turned(math.pi / 4, filtering)
        return (Coupling("in", "out", (_plate(quarter), *linear, _plate(-quarter))),)


def _plate(retardance: Any) -> Operation:
    return Operation(RETARDER, (retardance,))
