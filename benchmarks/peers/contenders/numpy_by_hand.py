"""NumPy: matrices as in a textbook, and the fused formulas, also in blocks that fit a cache."""

from functools import partial

import numpy as np

from amplitudes import fresnel, mueller
from formulas import fused
from work import INTENSITY, Contender

FILTERED = np.array([0.5, 0.5, 0.0, 0.0]) * INTENSITY
BLOCK = 4096


def prepare_matrices(delta, rho, phi, materials):
    n1, k1, n2, k2 = materials

    def run():
        first, second = mueller(*fresnel(n1, k1, delta)), mueller(*fresnel(n2, k2, phi))
        return (first @ turns(-rho) @ second) @ FILTERED

    return run


def turns(angles):
    matrices = np.zeros((*angles.shape, 4, 4))
    matrices[:, 0, 0] = matrices[:, 3, 3] = 1.0
    matrices[:, 1, 1] = matrices[:, 2, 2] = np.cos(2.0 * angles)
    matrices[:, 1, 2] = np.sin(2.0 * angles)
    matrices[:, 2, 1] = -matrices[:, 1, 2]
    return matrices


def prepare_fused(delta, rho, phi, materials, *, block):
    stokes = fused(np, materials)

    def run():
        out = np.empty((delta.size, 4))
        for start in range(0, delta.size, block):
            at = slice(start, start + block)
            out[at, 0], out[at, 1], out[at, 2], out[at, 3] = stokes(delta[at], rho[at], phi[at])
        return out

    return run


CONTENDERS = (
    Contender("NumPy, 4x4 matrices", prepare_matrices, "batched matmul", most=100_000),
    Contender("NumPy, fused", partial(prepare_fused, block=10**9), "no matrices, real numbers"),
    Contender(
        "NumPy, fused, in blocks", partial(prepare_fused, block=BLOCK), f"{BLOCK} paths at a time"
    ),
)
