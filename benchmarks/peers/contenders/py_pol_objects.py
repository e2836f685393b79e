"""py_pol: Mueller objects of all paths together."""

import numpy as np
from py_pol.mueller import Mueller
from py_pol.stokes import Stokes

from amplitudes import fresnel, parts
from work import INTENSITY, Contender


def prepare(delta, rho, phi, materials):
    n1, k1, n2, k2 = materials

    def run():
        lamp = Stokes().from_components((INTENSITY, 0.0, 0.0, 0.0))
        light = Mueller().diattenuator_perfect(azimuth=0.0) * lamp
        light = reflection(*fresnel(n2, k2, phi)) * light
        light = turn(-rho) * light
        light = reflection(*fresnel(n1, k1, delta)) * light
        return np.ascontiguousarray(light.parameters.matrix().T)

    return run


def reflection(rs, rp):
    A, B, C, S = parts(rs, rp)
    O = np.zeros_like(A)
    return Mueller().from_components((A, B, O, O, B, A, O, O, O, O, C, S, O, O, -S, C))


def turn(angles):
    c, s, O, one = np.cos(2 * angles), np.sin(2 * angles), 0 * angles, 0 * angles + 1
    return Mueller().from_components((one, O, O, O, O, c, s, O, O, -s, c, O, O, O, O, one))


CONTENDERS = (
    Contender("py_pol, Mueller objects", prepare, "reflections by hand in NumPy", most=10_000),
)
