"""Reciprocity: what a system does to light that goes through it the other way."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self

import numpy as np

from optipath.light.mueller.matrix_noise import KnownNoise
from optipath.values.arrays.jax_values import known

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.light.frames import Frame

_MIRRORED = np.array([1, 1, -1, 1], np.int8)
_SIGNS = np.outer(_MIRRORED, _MIRRORED)
"""Those of Q M Q, entry by entry, for Q = diag(1, 1, -1, 1)."""


def reciprocal(matrix: Any) -> Any:
    """Return Q M^T Q, Q = diag(1, 1, -1, 1): M backwards, between mirrored frames (x, -y, -z).

    De Hoop, Appl. Sci. Res. B 8, 135 (1960); Sekera, J. Opt. Soc. Am. 56, 1732 (1966).

    Shapes: matrix (..., 4, 4); returns (..., 4, 4).

    Examples
    --------
    >>> matrix = np.arange(16.0).reshape(4, 4)
    >>> print(reciprocal(matrix)[2])
    [ -2.  -6.  10. -14.]
    >>> bool(np.all(reciprocal(reciprocal(matrix)) == matrix))
    True
    """
    # Adding 0 turns -0 into 0.
    return known(matrix).swapaxes(-1, -2) * _SIGNS + 0


class HasReciprocal(KnownNoise):
    """What a matrix between two frames is to light that goes the other way."""

    def reversed(self) -> Self:
        """Return what the same system does to light that goes back through it.

        It is that of whatever is reciprocal: light that goes back along a frame (x, y, z) has
        (x, -y, -z), and between these frames it meets Q M^T Q, Q = diag(1, 1, -1, 1) (Sekera,
        J. Opt. Soc. Am. 56, 1732 (1966)). What stands in a magnetic field is not, nor is the power
        that passes into a medium that absorbs, and a matrix does not know: reverse the element,
        or the path.

        Returns
        -------
        Mueller
            From the mirrored `frame_out` to the mirrored `frame_in`.

        Examples
        --------
        >>> from optipath import Retarder
        >>> back = Retarder(1.0, 0.3).mueller().reversed()
        >>> bool(np.allclose(back.matrix, Retarder(1.0, -0.3).mueller().matrix))
        True
        >>> print(back.frame_in.z)
        [ 0.  0. -1.]
        """
        frames = self._mirrored("frame_out"), self._mirrored("frame_in")
        back: Self = self.of(reciprocal(self.matrix), *frames)
        return back.with_noise(lambda _: self.noise, given=self.is_given)

    def _mirrored(self, name: str) -> Callable[[], Frame]:
        """Return what makes the mirrored frame when somebody asks, since most nobody looks."""
        return lambda: getattr(self, name).reversed()
