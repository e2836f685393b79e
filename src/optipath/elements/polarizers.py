"""Polarizers, diattenuators, attenuators and depolarizers."""

from __future__ import annotations

import math
from typing import ClassVar

from optipath.elements.coupling import Coupling, turned
from optipath.elements.element import Element
from optipath.kernels.catalog import ATTENUATOR, DEPOLARIZER, POLARIZER, RETARDER
from optipath.materials.quantities import Angle, Axis, Fraction, Handedness
from optipath.values.operands import Operation


class Polarizer(Element, kind="polarizer"):
    """A linear polariser, ideal unless told otherwise.

    Parameters
    ----------
    angle, azimuth : float, array_like or Parameter, optional
        The transmission axis, in radians from x towards y of the polariser's frame, and the turn
        of this frame against the frame of the port before it.
    transmittance, leakage : float, array_like or Parameter, optional
        The principal transmittances along and across the axis, 0 to 1.

    Examples
    --------
    >>> Polarizer(angle=0.5).leakage
    0.0
    """

    mirrored: ClassVar[tuple[str, ...]] = ("angle",)

    angle: Axis = 0.0
    azimuth: Angle = 0.0
    transmittance: Fraction = 1.0
    leakage: Fraction = 0.0

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the diattenuator, its axes turned by the angle."""
        filtering = Operation(POLARIZER, (self.transmittance, self.leakage))
        return (Coupling("in", "out", turned(self.angle, filtering)),)


class Diattenuator(Element, kind="diattenuator"):
    """A linear partial polariser; ideal, with its axis along x, unless told otherwise.

    Its diattenuation is (maximum - minimum) / (maximum + minimum); Chipman, Lam & Young,
    Polarized Light and Optical Systems (2018).

    Parameters
    ----------
    maximum, minimum : float, array_like or Parameter, optional
        The principal transmittances of the intensity along and across the axis, 0 to 1. The
        axis is that of `maximum`, even where that is the lesser of the two: the diattenuation is
        negative there, and a parameter may run from one side to the other.
    angle, azimuth : float, array_like or Parameter, optional
        The axis, and the turn of the diattenuator's frame, as `Polarizer` takes them.

    Examples
    --------
    >>> Diattenuator(maximum=0.75, minimum=0.25).mueller().matrix[0]
    array([0.5 , 0.25, 0.  , 0.  ])
    """

    mirrored: ClassVar[tuple[str, ...]] = ("angle",)

    maximum: Fraction = 1.0
    minimum: Fraction = 0.0
    angle: Axis = 0.0
    azimuth: Angle = 0.0

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the diattenuator, its axes turned by the angle."""
        filtering = Operation(POLARIZER, (self.maximum, self.minimum))
        return (Coupling("in", "out", turned(self.angle, filtering)),)


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


class CircularDiattenuator(Element, kind="circular-diattenuator"):
    """A circular dichroic filter; lets all right-handed light through unless told otherwise.

    Right-handed is light of S3 > 0, as IEEE and `Light.handedness` have it; to Hecht and to
    chemists it is left-handed. What is circular leaves it circular, of the same hand. The linear
    dichroic filter is `Diattenuator`. Chipman, Lam & Young, Polarized Light and Optical Systems
    (2018).

    Parameters
    ----------
    right, left : float, array_like or Parameter, optional
        The transmittances of the intensity for light of S3 > 0 and of S3 < 0, 0 to 1.

    Examples
    --------
    >>> CircularDiattenuator(right=0.75, left=0.25).mueller().matrix[0]
    array([0.5 , 0.  , 0.  , 0.25])
    """

    mirrored: ClassVar[tuple[str, ...]] = ()

    right: Fraction = 1.0
    left: Fraction = 0.0

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the diattenuator, its axes circular."""
        filtering = Operation(POLARIZER, (self.right, self.left))
        return (Coupling("in", "out", along_circular_axes(filtering)),)


_QUARTER, _DIAGONAL = math.pi / 2, math.pi / 4


def along_circular_axes(*operations: Operation) -> tuple[Operation, ...]:
    """Return operations between quarter-wave plates: S3 > 0 becomes x, S3 < 0 y, to all digits."""
    there, back = Operation(RETARDER, (_QUARTER,)), Operation(RETARDER, (-_QUARTER,))
    # The plate makes light at -45 degrees of S3 > 0.
    return (there, *turned(-_DIAGONAL, *operations), back)


class Attenuator(Element, kind="attenuator"):
    """A filter that dims light and leaves its polarisation as it is.

    Parameters
    ----------
    transmittance : float, array_like or Parameter
        The fraction of light let through, 0 to 1.

    Examples
    --------
    >>> Attenuator(transmittance=0.25)
    Attenuator(transmittance=0.25)
    """

    mirrored: ClassVar[tuple[str, ...]] = ()

    transmittance: Fraction

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the attenuation."""
        return (Coupling("in", "out", (Operation(ATTENUATOR, (self.transmittance,)),)),)


class Depolarizer(Element, kind="depolarizer"):
    """An ideal depolariser, diag(1, 1-d, 1-d, 1-d): no light is lost, only its polarisation.

    It has no Jones matrix, and is refused where Jones columns are composed. Chipman, Lam &
    Young, Polarized Light and Optical Systems (2018).

    Parameters
    ----------
    depolarization : float, array_like or Parameter, optional
        The share d of the polarisation that is taken away, 0 to 1.

    Examples
    --------
    >>> Depolarizer(0.25).mueller().matrix.diagonal()
    array([1.  , 0.75, 0.75, 0.75])
    """

    mirrored: ClassVar[tuple[str, ...]] = ()

    depolarization: Fraction = 1.0

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the depolariser."""
        return (Coupling("in", "out", (Operation(DEPOLARIZER, (self.depolarization,)),)),)
