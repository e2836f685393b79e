"""Figures of pypolar: pip install pypolar."""

import numpy as np
import setups
from pypolar import ellipsometry, jones, mueller


def reflection(setup):
    n, k, outside, angle = setups.incidence(setup)
    return mueller.op_fresnel_reflection(complex(n, -k), angle, n_i=outside)


def ratio(setup):
    n, k, outside, angle = setups.incidence(setup)
    if outside != 1.0:  # Its rho knows no medium in front but air.
        return None
    rho = ellipsometry.rho_from_m(complex(n, -k), angle)
    return [np.arctan(np.abs(rho)), np.angle(rho)]


def polarizer(setup):
    return mueller.op_linear_polarizer(np.radians(setup["angle"]))


def retarder(setup):
    return mueller.op_retarder(np.radians(setup["angle"]), np.radians(setup["retardance"]))


def circular(setup):
    # The view is that of who looks at the source, by the page of conventions.
    clockwise = setup["clockwise"]
    return (mueller.stokes_right_circular if clockwise else mueller.stokes_left_circular)()


def ellipse(setup):
    sign = 1.0 if setup["clockwise"] else -1.0
    angles = np.radians(setup["azimuth"]), sign * np.radians(setup["ellipticity"])
    return jones.jones_to_stokes(jones.field_elliptical(*angles))


setups.write(
    "pypolar",
    "pypolar",
    __file__,
    1e-12,
    reflection=reflection,
    psi_delta=ratio,
    polarizer=polarizer,
    retarder=retarder,
    circular=circular,
    elliptical=ellipse,
)
