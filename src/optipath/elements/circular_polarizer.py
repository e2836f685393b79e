"""CircularPolarizer: lets one of the two circular states through."""

from __future__ import annotations

from typing import ClassVar

from optipath.elements.circular_axes import along_circular_axes
from optipath.elements.coupling import Coupling
from optipath.elements.element import Element
from optipath.kernels.catalogue import POLARIZER
from optipath.values.domains.quantities import Fraction, Handedness
from optipath.values.operation import Operation


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
        """Return the filter, its axes circular."""
        shares = self.transmittance, self.leakage
        along = shares if self.handedness == "right" else shares[::-1]
        return (Coupling("in", "out", along_circular_axes(Operation(POLARIZER, along))),)
