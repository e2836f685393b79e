"""Figures of tmm: pip install tmm. It has amplitudes, psi and Delta, and no Stokes vectors."""

import numpy as np
import setups
import tmm

THICK = [np.inf, np.inf]


def asked(setup):
    n, k, outside, angle = setups.incidence(setup)
    return [outside, complex(n, k)], THICK, angle, 500.0


def amplitudes(setup):
    """Return r_s and r_p, each as a real and an imaginary part."""
    found = (complex(tmm.coh_tmm(way, *asked(setup))["r"]) for way in "sp")
    return [[r.real, r.imag] for r in found]


def angles(setup):
    found = tmm.ellips(*asked(setup))
    return [found["psi"], found["Delta"]]


setups.write("tmm", "tmm", __file__, 1e-12, amplitudes=amplitudes, psi_delta=angles)
