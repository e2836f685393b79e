"""Numba: a serial loop over the fused formulas, with the functions of `math`."""

import math

import numba
import numpy as np

from formulas import fused
from work import Contender


def prepare(delta, rho, phi, materials):
    stokes = numba.njit(fused(math, materials))

    @numba.njit
    def loop(delta, rho, phi):
        out = np.empty((delta.size, 4))
        for i in range(delta.size):
            out[i, 0], out[i, 1], out[i, 2], out[i, 3] = stokes(delta[i], rho[i], phi[i])
        return out

    return lambda: loop(delta, rho, phi)


CONTENDERS = (Contender("Numba, fused", prepare, "a serial loop, the functions of math"),)
