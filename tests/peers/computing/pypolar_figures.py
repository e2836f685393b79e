"""Figures of pypolar: pip install pypolar."""

import numpy as np
import setups
from pypolar import ellipsometry, jones, mueller


def reflection(n, k, incidence, outside=1.0):
    return mueller.op_fresnel_reflection(complex(n, -k), incidence, n_i=outside)


def psi_delta(n, k, incidence, outside=1.0):
    if outside != 1.0:  # Its rho knows no medium in front but air.
        return None
    rho = ellipsometry.rho_from_m(complex(n, -k), incidence)
    return [np.arctan(np.abs(rho)), np.angle(rho)]


# The view is that of who looks at the source, by the page of conventions.
CIRCULAR = {True: mueller.stokes_right_circular, False: mueller.stokes_left_circular}


def elliptical(azimuth, ellipticity, clockwise):
    signed = ellipticity if clockwise else -ellipticity
    return jones.jones_to_stokes(jones.field_elliptical(azimuth, signed))


answers = {"reflection": reflection, "psi_delta": psi_delta, "elliptical": elliptical}
answers |= {
    "polarizer": lambda angle: mueller.op_linear_polarizer(theta=angle),
    "retarder": lambda retardance, angle: mueller.op_retarder(angle, retardance),
    "circular": lambda clockwise: CIRCULAR[clockwise](),
}
setups.write("pypolar", "pypolar", __file__, 1e-12, answers)
