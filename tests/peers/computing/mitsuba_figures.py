"""Figures of Mitsuba 3: pip install mitsuba. Single precision is all that its wheel has."""

import mitsuba
import numpy as np
import setups

mitsuba.set_variant("scalar_spectral_polarized")
optics = mitsuba.mueller


def reflection(n, k, incidence, outside=1.0):
    index = mitsuba.Complex2f(n / outside, k / outside)
    return optics.specular_reflection(np.cos(incidence), index)


def transmission(n, k, incidence, outside=1.0):
    del k  # It is 0.
    return optics.specular_transmission(np.cos(incidence), n / outside)


def polarizer(angle):
    return optics.rotated_element(angle, optics.linear_polarizer(1.0))


def retarder(retardance, angle):
    return optics.rotated_element(angle, optics.linear_retarder(retardance))


def circular(clockwise):
    # "Right" is clockwise to the sensor, which looks at the source.
    filter_ = optics.right_circular_polarizer if clockwise else optics.left_circular_polarizer
    return 2.0 * np.array(filter_())[:, 0]


def elliptical(azimuth, ellipticity, clockwise):
    """Light of a polariser behind a quarter-wave plate whose fast axis is the major axis.

    The component across falls behind by a quarter, so that the field turns from the major axis
    to where the polariser stands.
    """
    filter_ = polarizer(azimuth + (-ellipticity if clockwise else ellipticity))
    return 2.0 * np.array(retarder(np.pi / 2, azimuth) @ filter_)[:, 0]


def turned_frame(angle):
    """Numbers of one light in a frame that is turned about its direction of travel."""
    target = mitsuba.Vector3f(np.cos(angle), np.sin(angle), 0.0)
    x, z = mitsuba.Vector3f(1.0, 0.0, 0.0), mitsuba.Vector3f(0.0, 0.0, 1.0)
    return optics.rotate_stokes_basis(z, x, target)


answers = {"reflection": reflection, "transmission": transmission, "polarizer": polarizer}
answers |= {"retarder": retarder, "turned_frame": turned_frame}
answers |= {"circular": circular, "elliptical": elliptical}
setups.write("mitsuba", "mitsuba", __file__, 1e-6, answers)
