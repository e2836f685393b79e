"""The angles of a reflection that have names: Brewster's, its like of metals, and the critical."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from optipath.elements.fresnel import fresnel_reflection

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    Numbers = npt.NDArray[np.float64]

CLEAR = 1e-5
"""Below which k over n a medium is as one that does not absorb: angles are the same to 1e-9."""

_POINTS, _ROUNDS = 1001, 5
_SEEN = 1e-9
"""By how much a least reflectance lies below that at normal incidence, if there is one."""


class Reflected(NamedTuple):
    """What a boundary reflects of light without polarisation.

    Shapes: s, p, unpolarised (...); dolp (...).
    """

    s: Numbers
    p: Numbers
    unpolarised: Numbers
    dolp: Numbers


class MarkedAngle(NamedTuple):
    """An angle of incidence that has a name.

    Units: angle in radians.
    """

    name: str
    angle: float


def reflected(index: complex, incidence: Numbers) -> Reflected:
    """Return what a boundary reflects.

    Shape: incidence (...). Units: incidence in radians.

    Examples
    --------
    >>> found = reflected(1.5, np.array(0.0))
    >>> print(found.s.round(3), found.dolp.round(3))
    0.04 0.0
    """
    mean, half, _, _ = fresnel_reflection(index, np.cos(incidence), np.sin(incidence))
    with np.errstate(invalid="ignore", divide="ignore"):
        dolp = np.abs(half) / np.where(mean > 0.0, mean, np.nan)
    return Reflected(mean + half, mean - half, mean, dolp)


def marked_angles(index: complex) -> list[MarkedAngle]:
    """Return the angles of a reflection that have names.

    Examples
    --------
    >>> [(each.name, round(float(np.degrees(each.angle)), 2)) for each in marked_angles(1 / 1.5)]
    [("Brewster's angle", 33.69), ('critical angle', 41.81)]
    """
    n = index.real
    if index == 1.0:
        return []
    if index.imag <= CLEAR * n:
        found = [MarkedAngle("Brewster's angle", float(np.arctan(n)))]
        return [*found, MarkedAngle("critical angle", float(np.arcsin(n)))] if n < 1.0 else found
    least = _least(lambda incidence: reflected(index, incidence).p)
    most = _least(lambda incidence: -reflected(index, incidence).dolp)
    upright, there = reflected(index, np.array([0.0, least])).p
    if not there < upright - _SEEN:
        return []
    return [MarkedAngle("pseudo-Brewster angle", least), MarkedAngle("highest DoLP", most)]


def _least(of: Callable[[Numbers], Numbers]) -> float:
    """Return between 0 and a right angle where a smooth function is least, by ever finer grids."""
    low, high = 0.0, np.pi / 2
    best = low
    for _ in range(_ROUNDS):
        grid = np.linspace(low, high, _POINTS)
        best = float(grid[np.nanargmin(of(grid))])
        step = float(grid[1] - grid[0])
        low, high = max(0.0, best - step), min(np.pi / 2, best + step)
    return best
