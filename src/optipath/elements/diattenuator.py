"""Diattenuator: a partial polariser, by its two principal transmittances."""

from __future__ import annotations

from typing import ClassVar

from optipath.elements.coupling import Coupling, turned
from optipath.elements.element import Element
from optipath.kernels.catalogue import POLARIZER
from optipath.values.domains.quantities import Angle, Axis, Fraction
from optipath.values.operation import Operation


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
    angle : float, array_like or Parameter, optional
        The axis, in radians from x towards y of the diattenuator's frame.
    azimuth : float, array_like or Parameter, optional
        The turn of its frame against the frame of the port before it, in radians.

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
