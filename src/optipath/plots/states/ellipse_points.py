"""The ellipse that the electric field of light runs through."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.light.light import Light


def ellipse_points(light: Light, count: int = 73) -> npt.NDArray[np.float64]:
    """Return points of the ellipse of the polarised part of light, in the order of time.

    Shapes: light (...); returns (..., count, 2).

    Examples
    --------
    >>> import optipath as op
    >>> ellipse_points(op.Light([1.0, 0.0, 0.0, 1.0]), 5).round(4) + 0.0
    array([[ 0.7071,  0.    ],
           [ 0.    ,  0.7071],
           [-0.7071,  0.    ],
           [ 0.    , -0.7071],
           [ 0.7071,  0.    ]])
    """
    time = np.linspace(0.0, 2.0 * np.pi, count)
    open_angle = np.asarray(light.ellipticity_angle, float)[..., np.newaxis]
    # Circular light has no axis; any will do.
    angle = np.nan_to_num(np.asarray(light.aop, float))[..., np.newaxis]
    along, across = np.cos(open_angle) * np.cos(time), np.sin(open_angle) * np.sin(time)
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.stack([along * cosine - across * sine, along * sine + across * cosine], axis=-1)
