"""Figures in the convention of ellipsometry: pip install pyElli, which computes psi and Delta.

The matrix, and the light that +45 degrees become, are made of them as the books print it: Fujiwara,
Spectroscopic Ellipsometry (2007), sec. 3.4; Hauge, Muller and Smith, Surf. Sci. 96, 81 (1980).
"""

import numpy as np
import setups
from pyelli_figures import angles


def sample(setup):
    psi, delta = angles(setup)
    N, C = np.cos(2 * psi), np.sin(2 * psi) * np.cos(delta)
    S = np.sin(2 * psi) * np.sin(delta)
    return [[1.0, -N, 0.0, 0.0], [-N, 1.0, 0.0, 0.0], [0.0, 0.0, C, S], [0.0, 0.0, -S, C]]


def light(setup):
    psi, delta = angles(setup)
    cross = np.sin(2 * psi)
    return [1.0, -np.cos(2 * psi), cross * np.cos(delta), -cross * np.sin(delta)]


kinds = {"normalized_reflection": sample, "reflected_at_45": light, "psi_delta": angles}
setups.write("ellipsometry", "pyElli", __file__, 1e-12, **kinds)
