"""tmm: its amplitudes of one interface for whole arrays, and the light from them by hand."""

import numpy as np
from tmm import interface_r

from amplitudes import light
from work import Contender


def prepare(delta, rho, phi, materials):
    m1, m2 = complex(materials.n1, materials.k1), complex(materials.n2, materials.k2)

    def run():
        # `tmm.snell` takes single angles only.
        behind1, behind2 = np.arcsin(np.sin(delta) / m1), np.arcsin(np.sin(phi) / m2)
        rs1, rp1 = (interface_r(way, 1.0, m1, delta, behind1) for way in "sp")
        # Its signs are those of optipath.
        return light(rs1, rp1, interface_r("s", 1.0, m2, phi, behind2), rho)

    return run


CONTENDERS = (
    Contender("tmm, interface_r", prepare, "on arrays; Snell's law and the light by hand in NumPy"),
)
