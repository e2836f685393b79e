"""Figures of pyElli, and in the convention of ellipsometry: pip install pyElli.

Its matrices are over M00. In the convention of ellipsometry the matrix, and the light that +45
degrees become, are made of its psi and Delta as the books print it: Fujiwara, Spectroscopic
Ellipsometry (2007), sec. 3.4; Hauge, Muller and Smith, Surf. Sci. 96, 81 (1980).
"""

import elli
import numpy as np
import setups


def result(n, k, incidence, outside=1.0):
    before, behind = (
        elli.IsotropicMaterial(elli.ConstantRefractiveIndex(index))
        for index in (outside, complex(n, k))
    )
    sample = elli.Structure(before, [], behind)
    return sample.evaluate(np.array([500.0]), np.degrees(incidence), solver=elli.Solver4x4)


def over_m00(**setup):
    return result(**setup).mueller_matrix[0]


def psi_delta(**setup):
    found = result(**setup)
    return np.radians([found.psi[0], found.delta[0]])


def of_a_sample(**setup):
    psi, delta = psi_delta(**setup)
    N, C = np.cos(2 * psi), np.sin(2 * psi) * np.cos(delta)
    S = np.sin(2 * psi) * np.sin(delta)
    return [[1.0, -N, 0.0, 0.0], [-N, 1.0, 0.0, 0.0], [0.0, 0.0, C, S], [0.0, 0.0, -S, C]]


answers = {"normalized_reflection": over_m00, "psi_delta": psi_delta}
setups.write("pyelli", "pyElli", __file__, 1e-12, answers)
answers["normalized_reflection"] = of_a_sample
# Light of +45 degrees: S2 alone besides S0.
answers["reflected_at_45"] = lambda **setup: np.array(of_a_sample(**setup)) @ [1.0, 0.0, 1.0, 0.0]
setups.write("ellipsometry", "pyElli", __file__, 1e-12, answers)
