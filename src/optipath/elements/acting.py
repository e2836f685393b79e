"""An element that acts on light by itself: ``element @ light``."""

from __future__ import annotations

from typing import Any, overload

import numpy as np

from optipath.elements.alone import mueller_alone
from optipath.errors import LightError
from optipath.light.frames import Frame
from optipath.light.light import Light
from optipath.light.mueller.matrix import Mueller
from optipath.light.refused_products import why_refused
from optipath.values.operands import Operand
from optipath.values.written_units import units_are_written


class ActsOnLight:
    """What stands before light, and before a matrix of what light has met already."""

    __array_ufunc__ = None  # NumPy's arrays leave products to it.

    @overload
    def __matmul__(self, other: Mueller | ActsOnLight) -> Mueller: ...
    @overload
    def __matmul__(self, other: Light) -> Light: ...
    def __matmul__(self, other: Mueller | ActsOnLight | Light) -> Mueller | Light:
        """Return the light behind the element, which stands in the frame that light arrives in.

        Behind another element, or a matrix, it is the Mueller matrix of both.

        Examples
        --------
        >>> from optipath import Light, Polarizer
        >>> Polarizer(0.0) @ Light([1.0, 0.0, 0.0, 0.0])
        Light([0.5, 0.5, 0. , 0. ])
        >>> print((Polarizer(0.0) @ Polarizer("60 deg")).matrix[0, 0].round(12))
        0.125
        """
        arriving = _standing_in(other, Frame()) if isinstance(other, ActsOnLight) else other
        if not isinstance(arriving, (Light, Mueller)):
            raise LightError(why_refused(arriving))
        frame = arriving.frame if isinstance(arriving, Light) else arriving.frame_out
        return _standing_in(self, frame) @ arriving

    def __rmatmul__(self, other: object) -> Mueller:
        """Return the Mueller matrix of the element and of what stands behind it.

        Raises
        ------
        LightError
            If that is no `Mueller`.
        """
        if not isinstance(other, Mueller):
            raise LightError(why_refused(other))
        return other @ _standing_in(self, Frame())


def _standing_in(element: Any, frame: Frame) -> Mueller:
    """Return the Mueller matrix of an element that stands in the frame in which light arrives.

    Its azimuth turns it against that frame. One that stands in space by its own values keeps
    its place, and one that lets light go another way a frame of its own behind it, as in a path.
    """
    alone = mueller_alone(element, "in", "", "stable", (None, None))
    if element.own_frame("in") is not None:
        return alone
    azimuth = Operand(getattr(element, "azimuth", 0.0)).numbers()
    with units_are_written():  # The angle was looked at when the element was made.
        frame = frame.turned(azimuth) if np.any(azimuth) else frame
    return Mueller.of(alone.matrix, frame, frame if element.straight else alone.frame_out)
