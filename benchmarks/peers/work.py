"""The work that every contender does: npgr026 with a horizontal filter, over random angles."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

PRESET = "npgr026"
FILTER = {"filter": "horizontal"}
INTENSITY = 100.0


class Materials(NamedTuple):
    """The indices n + ik of X1 and X2."""

    n1: float
    k1: float
    n2: float
    k2: float


MATERIALS = {
    "absorbing": Materials(1.12, 2.16, 0.608, 2.12),
    "lossless": Materials(1.33, 0.0, 1.5, 0.0),
}


class Angles(NamedTuple):
    """Radians, one of each for every path."""

    delta: np.ndarray
    rho: np.ndarray
    phi: np.ndarray

    def at(self, where):
        return Angles(*(angles[where] for angles in self))


class Contender(NamedTuple):
    """Somebody who does the work.

    `prepare(delta, rho, phi, materials)` returns what is timed: a function without arguments
    that returns the Stokes vectors, of shape (N, 4). `most` is how many paths it is given.
    """

    name: str
    prepare: Callable
    how: str
    most: int = 10**9


def random_angles(count, seed=1):
    draw = np.random.default_rng(seed).uniform
    delta, phi = draw(0.0, np.pi / 2, (2, count))
    return Angles(delta, draw(-np.pi, np.pi, count), phi)
