"""An element that acts on light by itself: ``element @ light``."""

from __future__ import annotations

from typing import overload

from optipath.elements.alone import mueller_alone
from optipath.errors import LightError
from optipath.light.light import Light
from optipath.light.mueller.matrix import Mueller
from optipath.light.refused_products import why_refused


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
        arriving = mueller_alone(other) if isinstance(other, ActsOnLight) else other
        if not isinstance(arriving, (Light, Mueller)):
            raise LightError(why_refused(arriving))
        frame = arriving.frame if isinstance(arriving, Light) else arriving.frame_out
        return mueller_alone(self, before=frame) @ arriving

    def __rmatmul__(self, other: object) -> Mueller:
        """Return the Mueller matrix of the element and of what stands behind it."""
        if not isinstance(other, Mueller):
            raise LightError(why_refused(other))
        return other @ mueller_alone(self)
