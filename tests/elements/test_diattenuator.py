import numpy as np
import pytest

import optipath as op
from paths import chain
from tables import rows


def test_light_along_and_across_the_axis_passes_by_the_principal_transmittances():
    path = chain([op.Diattenuator(0.8, 0.3, angle=0.4)], op.Parameter("state"))
    along, across = ([1.0, s * np.cos(0.8), s * np.sin(0.8), 0.0] for s in (1, -1))
    np.testing.assert_allclose(
        path.trace(state=[along, across]).intensity, [0.8, 0.3], rtol=1e-15, atol=1e-16
    )


def test_unpolarised_light_gains_the_diattenuation():
    light = chain([op.Diattenuator(0.8, 0.2)]).trace()
    np.testing.assert_allclose(light.stokes, [0.5, 0.3, 0.0, 0.0], rtol=1e-15, atol=1e-16)
    assert light.dop == pytest.approx(0.6, abs=1e-15)


def chipman(q, r, angle):
    """Chipman, Lam & Young (2018), eq. 6.54: a diattenuator of transmittances q and r."""
    c, s, cross = np.cos(2 * angle), np.sin(2 * angle), 2 * np.sqrt(q * r)
    return 0.5 * np.array(
        [
            [q + r, (q - r) * c, (q - r) * s, 0],
            [(q - r) * c, (q + r) * c**2 + cross * s**2, (q + r - cross) * c * s, 0],
            [(q - r) * s, (q + r - cross) * c * s, cross * c**2 + (q + r) * s**2, 0],
            [0, 0, 0, cross],
        ]
    )


@rows("named", [op.Diattenuator, lambda q, r, a, z: op.Polarizer(a, z, q, r)])
def test_a_diattenuator_and_a_polariser_that_leaks_are_chipmans(named):
    matrix = named(0.9, 0.05, 0.3, 0.0).mueller().matrix
    np.testing.assert_allclose(matrix, chipman(0.9, 0.05, 0.3), rtol=0, atol=2e-16)
    state = np.array([1.0, 0.5, 0.6, 0.4])
    # Light seen in a frame turned by the azimuth.
    c, s = np.cos(0.4), np.sin(0.4)
    seen = [1.0, 0.5 * c + 0.6 * s, 0.6 * c - 0.5 * s, 0.4]
    found = chain([named(0.9, 0.05, 0.3, 0.2)], state).trace().stokes
    np.testing.assert_allclose(found, chipman(0.9, 0.05, 0.3) @ seen, rtol=0, atol=4e-16)


def test_a_diattenuator_is_an_ideal_polariser_along_x_by_default():
    expected = np.zeros((4, 4))
    expected[:2, :2] = 0.5
    np.testing.assert_array_equal(op.Diattenuator().mueller().matrix, expected)


def test_transmittances_that_give_light_are_refused():
    with pytest.raises(op.ValueFault, match=r"^Diattenuator maximum is 1\.2"):
        op.Diattenuator(1.2)


def test_the_axis_is_that_of_the_first_transmittance_though_it_be_the_lesser():
    swapped = op.Diattenuator(0.2, 0.7).mueller().matrix
    turned = op.Diattenuator(0.7, 0.2, angle=np.pi / 2).mueller().matrix
    np.testing.assert_allclose(swapped, turned, rtol=1e-15, atol=1e-16)
    assert swapped[0, 1] < -0.2
