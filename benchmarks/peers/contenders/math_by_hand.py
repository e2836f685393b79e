"""Plain Python: the fused formulas with the functions of `math`, path by path."""

import math

import numpy as np

from formulas import fused
from work import Contender


def prepare(delta, rho, phi, materials):
    stokes = fused(math, materials)
    angles = delta.tolist(), rho.tolist(), phi.tolist()
    return lambda: np.array(list(map(stokes, *angles)))


CONTENDERS = (Contender("Python's math, fused", prepare, "one path a call", most=1_000),)
