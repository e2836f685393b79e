"""Figures of Mitsuba 3: pip install mitsuba. Single precision is all that its wheel has."""

import mitsuba
import numpy as np
import setups

mitsuba.set_variant("scalar_spectral_polarized")
optics = mitsuba.mueller


def reflection(setup):
    n, k, outside, angle = setups.incidence(setup)
    return optics.specular_reflection(np.cos(angle), mitsuba.Complex2f(n / outside, k / outside))


def transmission(setup):
    n, _, outside, angle = setups.incidence(setup)
    return optics.specular_transmission(np.cos(angle), n / outside)


def polarizer(setup):
    return optics.rotated_element(np.radians(setup["angle"]), optics.linear_polarizer(1.0))


def retarder(setup):
    plate = optics.linear_retarder(np.radians(setup["retardance"]))
    return optics.rotated_element(np.radians(setup["angle"]), plate)


def circular(setup):
    # "Right" is clockwise to the sensor, which looks at the source.
    clockwise = setup["clockwise"]
    filter_ = optics.right_circular_polarizer if clockwise else optics.left_circular_polarizer
    return 2.0 * np.array(filter_())[:, 0]


def ellipse(setup):
    """Light of a polariser behind a quarter-wave plate whose fast axis is the major axis.

    The component across falls behind by a quarter, so that the field turns from the major axis
    to where the polariser stands.
    """
    azimuth, away = np.radians(setup["azimuth"]), np.radians(setup["ellipticity"])
    filter_ = optics.rotated_element(
        azimuth + (-away if setup["clockwise"] else away), optics.linear_polarizer(1.0)
    )
    plate = optics.rotated_element(azimuth, optics.linear_retarder(np.pi / 2))
    return 2.0 * np.array(plate @ filter_)[:, 0]


def rotated_basis(setup):
    """Numbers of one light in a frame that is turned about its direction of travel."""
    angle = np.radians(setup["angle"])
    target = mitsuba.Vector3f(np.cos(angle), np.sin(angle), 0.0)
    x, z = mitsuba.Vector3f(1.0, 0.0, 0.0), mitsuba.Vector3f(0.0, 0.0, 1.0)
    return optics.rotate_stokes_basis(z, x, target)


setups.write(
    "mitsuba",
    "mitsuba",
    __file__,
    1e-6,
    reflection=reflection,
    transmission=transmission,
    polarizer=polarizer,
    retarder=retarder,
    turned_frame=rotated_basis,
    circular=circular,
    elliptical=ellipse,
)
