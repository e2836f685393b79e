"""Figures of py_pol: pip install py_pol. It has no interfaces."""

import numpy as np
import setups
from py_pol.mueller import Mueller
from py_pol.stokes import Stokes


def matrix(mueller):
    return mueller.parameters.matrix().reshape(4, 4)


def polarizer(setup):
    return matrix(Mueller().diattenuator_perfect(azimuth=np.radians(setup["angle"])))


def retarder(setup):
    angles = np.radians(setup["retardance"]), np.radians(setup["angle"])
    return matrix(Mueller().retarder_linear(ret=angles[0], azimuth=angles[1]))


def circular(setup):
    return (
        Stokes().circular_light(kind="r" if setup["clockwise"] else "l").parameters.matrix()[:, 0]
    )


def ellipse(setup):
    sign = 1.0 if setup["clockwise"] else -1.0
    light = Stokes().general_azimuth_ellipticity(
        azimuth=np.radians(setup["azimuth"]), ellipticity=sign * np.radians(setup["ellipticity"])
    )
    return light.parameters.matrix()[:, 0]


kinds = {"polarizer": polarizer, "retarder": retarder, "circular": circular, "elliptical": ellipse}
setups.write("py_pol", "py_pol", __file__, 1e-12, **kinds)
