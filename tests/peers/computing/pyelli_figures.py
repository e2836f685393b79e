"""Figures of pyElli, and in the convention of ellipsometry: pip install pyElli.

Its matrices are over M00. In the convention of ellipsometry the matrix, and the light that +45
degrees become, are made of its psi and Delta as the books print it: Fujiwara, Spectroscopic
Ellipsometry (2007), sec. 3.4; Hauge, Muller and Smith, Surf. Sci. 96, 81 (1980).
"""

import elli
import numpy as np
import setups


def result(setup):
    n, k, outside, _ = setups.incidence(setup)
    before, behind = (
        elli.IsotropicMaterial(elli.ConstantRefractiveIndex(index))
        for index in (outside, complex(n, k))
    )
    sample = elli.Structure(before, [], behind)
    return sample.evaluate(np.array([500.0]), setup["incidence"], solver=elli.Solver4x4)


def angles(setup):
    found = result(setup)
    return np.radians([found.psi[0], found.delta[0]])


def over_m00(setup):
    return result(setup).mueller_matrix[0]


def sample(setup):
    psi, delta = angles(setup)
    N, C = np.cos(2 * psi), np.sin(2 * psi) * np.cos(delta)
    S = np.sin(2 * psi) * np.sin(delta)
    return [[1.0, -N, 0.0, 0.0], [-N, 1.0, 0.0, 0.0], [0.0, 0.0, C, S], [0.0, 0.0, -S, C]]


def light(setup):
    psi, delta = angles(setup)
    cross = np.sin(2 * psi)
    return [1.0, -np.cos(2 * psi), cross * np.cos(delta), -cross * np.sin(delta)]


kinds = {"normalized_reflection": over_m00, "psi_delta": angles}
setups.write("pyelli", "pyElli", __file__, 1e-12, **kinds)
kinds = {"normalized_reflection": sample, "reflected_at_45": light, "psi_delta": angles}
setups.write("ellipsometry", "pyElli", __file__, 1e-12, **kinds)
