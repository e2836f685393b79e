import numpy as np
import pytest

import optipath as op
from paths import chain


def test_light_along_and_across_the_axis_passes_by_the_principal_transmittances():
    path = chain([op.Diattenuator(0.8, 0.3, angle=0.4)], op.Parameter("state"))
    along, across = ([1.0, s * np.cos(0.8), s * np.sin(0.8), 0.0] for s in (1, -1))
    np.testing.assert_allclose(path.trace(state=[along, across]).intensity, [0.8, 0.3], atol=1e-16)


def test_unpolarised_light_gains_the_diattenuation():
    light = chain([op.Diattenuator(0.8, 0.2)]).trace()
    np.testing.assert_allclose(light.stokes, [0.5, 0.3, 0.0, 0.0], atol=1e-16)
    assert light.dop == pytest.approx(0.6, abs=1e-15)


def test_a_diattenuator_is_a_polariser_that_leaks():
    state = [1.0, 0.5, 0.6, 0.4]
    found = chain([op.Diattenuator(0.9, 0.05, angle=0.3, azimuth=0.2)], state).trace()
    wanted = chain([op.Polarizer(0.3, 0.2, 0.9, 0.05)], state).trace()
    np.testing.assert_array_equal(found.stokes, wanted.stokes)


def test_a_diattenuator_is_an_ideal_polariser_by_default():
    assert op.Diattenuator().mueller() == op.Polarizer().mueller()


def test_transmittances_that_give_light_are_refused():
    with pytest.raises(op.PathError, match=r"diattenuator\.maximum is 1\.2"):
        op.Diattenuator(1.2).mueller()


def test_the_axis_is_that_of_the_first_transmittance_though_it_be_the_lesser():
    swapped = op.Diattenuator(0.2, 0.7).mueller().matrix
    turned = op.Diattenuator(0.7, 0.2, angle=np.pi / 2).mueller().matrix
    np.testing.assert_allclose(swapped, turned, atol=1e-16)
    assert swapped[0, 1] < -0.2
