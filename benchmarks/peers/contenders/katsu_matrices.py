"""katsu: its filter and its turns; it has no Fresnel equations, so the reflections are by hand."""

import numpy as np
from katsu.mueller import linear_polarizer, mueller_rotation

from amplitudes import fresnel, mueller
from work import INTENSITY, Contender


def prepare(delta, rho, phi, materials):
    n1, k1, n2, k2 = materials

    def run():
        first, second = mueller(*fresnel(n1, k1, delta)), mueller(*fresnel(n2, k2, phi))
        filtered = linear_polarizer(0.0) @ np.array([INTENSITY, 0.0, 0.0, 0.0])
        # Its rotation turns the frame, as optipath's.
        return (first @ mueller_rotation(-rho, shape=rho.shape) @ second) @ filtered

    return run


CONTENDERS = (
    Contender("katsu, 4x4 matrices", prepare, "reflections by hand in NumPy", most=100_000),
)
