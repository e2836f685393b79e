"""The solid angles of the pixels of a hemisphere."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from collections.abc import Callable

Numbers = npt.NDArray[np.float64]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)


def pixel_areas(pixels: int, cap: Callable[[Numbers], Numbers]) -> Numbers:
    """Return the solid angle of each pixel of a square that just holds the hemisphere's disc.

    By Green's theorem, the solid angle of a region is the integral of (1 - cos theta) d phi along
    its border, and that over r^2 of x dy - y dx: along the sides of the pixels within the disc,
    and its rim. What neighbours share comes in with both signs, so that all add up to 2 pi.

    Shape: returns (pixels, pixels).

    Examples
    --------
    >>> print(pixel_areas(2, np.ones_like) / np.pi)
    [[0.5 0.5]
     [0.5 0.5]]
    """
    lines = np.linspace(-1.0, 1.0, pixels + 1)
    half_chord = np.sqrt(np.maximum(1.0 - lines**2, 0.0))[:, np.newaxis]
    begin, end = (np.clip(each, -half_chord, half_chord) for each in (lines[:-1], lines[1:]))
    along = np.zeros_like(begin)
    for node, weight in zip(_NODES, _WEIGHTS, strict=True):
        at = 0.5 * (begin + end) + 0.5 * (end - begin) * node
        along += weight * cap(np.hypot(at, lines[:, np.newaxis]))
    sides = 0.5 * (end - begin) * along * lines[:, np.newaxis]
    within = np.diff(sides, axis=0)
    return within + within.T + _rim(lines)


def _rim(lines: Numbers) -> Numbers:
    """Return the angle under which the part of the rim in each pixel is seen from the centre."""
    pixels = len(lines) - 1
    meets = np.arccos(lines)
    all_meets = np.concatenate([meets, -meets, np.pi / 2.0 - meets, np.pi / 2.0 + meets])
    angles = np.unique(np.concatenate([[0.0, 2.0 * np.pi], all_meets % (2.0 * np.pi)]))
    middle = 0.5 * (angles[1:] + angles[:-1])
    column, row = (
        np.clip(((each + 1.0) * (0.5 * pixels)).astype(int), 0, pixels - 1)
        for each in (np.cos(middle), np.sin(middle))
    )
    found = np.zeros((pixels, pixels))
    np.add.at(found, (row, column), np.diff(angles))
    return found
