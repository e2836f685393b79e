"""Figures of py_pol: pip install py_pol. It has no interfaces."""

import setups
from py_pol.mueller import Mueller
from py_pol.stokes import Stokes


def matrix(mueller):
    return mueller.parameters.matrix().reshape(4, 4)


def elliptical(azimuth, ellipticity, clockwise):
    signed = ellipticity if clockwise else -ellipticity
    light = Stokes().general_azimuth_ellipticity(azimuth=azimuth, ellipticity=signed)
    return light.parameters.matrix()[:, 0]


def circular(clockwise):
    return Stokes().circular_light(kind="r" if clockwise else "l").parameters.matrix()[:, 0]


answers = {
    "polarizer": lambda angle: matrix(Mueller().diattenuator_perfect(azimuth=angle)),
    "retarder": lambda retardance, angle: matrix(
        Mueller().retarder_linear(ret=retardance, azimuth=angle)
    ),
}
answers |= {"circular": circular, "elliptical": elliptical}
setups.write("py_pol", "py_pol", __file__, 1e-12, answers)
