"""Chromatic adaptation: colours as they look to eyes that are used to another white."""

from __future__ import annotations

from typing import Any

import numpy as np

from optipath.light.colour.triples import times

BRADFORD = np.array(
    [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]
)
"""From X, Y, Z to responses of cones: the linear Bradford transform of ICC.1:2022, annex E."""

DISPLAY_WHITE = np.array([0.3127, 0.3290, 0.3583]) / 0.3290
"""X, Y, Z of the white of sRGB, which is D65, x = 0.3127 and y = 0.3290 (IEC 61966-2-1)."""


def adapted(xyz: Any, white: Any) -> Any:
    """Return X, Y, Z as they are under the white of a display.

    Shapes: xyz (..., 3); white (..., 3); returns (..., 3).

    Examples
    --------
    >>> adapted(np.array([0.5, 0.5, 0.5]), np.ones(3)).round(4)
    array([0.4752, 0.5   , 0.5445])
    """
    before = times(BRADFORD, white / white[..., 1:2])
    gain = times(BRADFORD, DISPLAY_WHITE) / before
    return times(np.linalg.inv(BRADFORD), gain * times(BRADFORD, xyz))
