"""The presets whose light depends on the wavelength, against closed forms in 50 digits."""

import os

import mpmath
import numpy as np
import pytest
from mpmath import mpf

import optipath as op
from crystal_optics import lyot, retardance, rhomb, solc

VISIBLE = np.linspace(4e-7, 7e-7, 61)
LONG = pytest.mark.skipif("OPTIPATH_SETS" not in os.environ, reason="JAX compiles for long")
FILTERS = {"lyot-filter": lyot, "solc-filter": solc}


@pytest.fixture(autouse=True)
def _many_digits():
    with mpmath.workdps(50):
        yield


def each(function, thickness):
    return np.array([float(function(mpf(thickness), mpf(float(one)))) for one in VISIBLE])


@pytest.mark.parametrize("name", FILTERS)
def test_a_filter_lets_through_what_its_closed_form_says(name):
    path = op.load_preset(name)
    exact = each(FILTERS[name], path.parameters["thickness"].default)
    light = op.Composer(engine="numpy").compose(path).run(wavelength=VISIBLE)
    np.testing.assert_allclose(light.intensity, exact, rtol=0, atol=1e-13)
    np.testing.assert_allclose(np.abs(light.stokes[:, 1]), light.intensity, rtol=0, atol=1e-15)


@LONG
def test_slopes_of_lyots_filter_are_those_of_its_closed_form(jax):
    path = op.load_preset("lyot-filter")
    thickness = path.parameters["thickness"].default
    plan = op.Composer(engine="jax").compose(path)

    def passed(wavelength, thickness):
        return plan.run(wavelength=wavelength, thickness=thickness).intensity

    for wavelength in (4.3e-7, 5.461e-7, 6.57e-7):
        found = jax.grad(passed, argnums=(0, 1))(wavelength, thickness)
        places = (mpf(thickness), mpf(wavelength))
        exact = [mpmath.diff(lyot, places, order) for order in ((0, 1), (1, 0))]
        np.testing.assert_allclose(found, [float(slope) for slope in exact], rtol=1e-9)


def test_the_wave_plate_of_quartz_retards_as_its_closed_form_says():
    path = op.load_preset("quartz-quarter-wave")
    thickness = path.parameters["thickness"].default
    light = path.trace(wavelength=VISIBLE)
    exact = each(retardance, thickness)
    np.testing.assert_allclose(light.stokes[:, 2], np.cos(exact), rtol=0, atol=1e-12)
    np.testing.assert_allclose(light.stokes[:, 3], np.sin(exact), rtol=0, atol=1e-12)
    assert path.trace().docp == pytest.approx(1.0, abs=1e-15)


@LONG
def test_slopes_of_the_wave_plate_are_those_of_its_closed_form(jax):
    path = op.load_preset("quartz-quarter-wave")
    thickness = path.parameters["thickness"].default
    plan = op.Composer(engine="jax").compose(path)

    def turned(wavelength, thickness):
        return plan.run(wavelength=wavelength, thickness=thickness).stokes[2]

    found = jax.grad(turned, argnums=(0, 1))(4.3e-7, thickness)
    places = (mpf(thickness), mpf(4.3e-7))
    exact = [
        mpmath.diff(lambda d, w: mpmath.cos(retardance(d, w)), places, order)
        for order in ((0, 1), (1, 0))
    ]
    np.testing.assert_allclose(found, [float(slope) for slope in exact], rtol=1e-12)


def test_the_rhomb_retards_by_nearly_a_quarter_wave_from_400_to_700_nm():
    path = op.load_preset("achromatic-rhomb")
    incidence = mpf(path.parameters["incidence"].default)
    light = path.trace(wavelength=VISIBLE)
    exact = np.array([float(rhomb(incidence, mpf(float(one)))) for one in VISIBLE])
    np.testing.assert_allclose(light.stokes[:, 2], np.cos(exact) / 2, rtol=0, atol=1e-14)
    np.testing.assert_allclose(light.stokes[:, 3], -np.sin(exact) / 2, rtol=0, atol=1e-14)
    assert np.all(np.abs(np.degrees(exact) - 90.0) < 1.2)


@LONG
def test_slopes_of_the_rhomb_are_those_of_its_closed_form(jax):
    path = op.load_preset("achromatic-rhomb")
    incidence = mpf(path.parameters["incidence"].default)
    plan = op.Composer(engine="jax").compose(path)
    for wavelength in (4.1e-7, 6.5e-7):
        found = jax.grad(lambda w: plan.run(wavelength=w).stokes[2])(wavelength)
        exact = mpmath.diff(lambda w: mpmath.cos(rhomb(incidence, w)) / 2, mpf(wavelength))
        assert float(found) == pytest.approx(float(exact), rel=1e-9)


@pytest.mark.parametrize("angle", ["0 deg", "22.5 deg", "45 deg", "70 deg"])
def test_a_band_of_wavelengths_leaves_the_depolarizer_unpolarized(angle):
    path = op.load_preset("lyot-depolarizer")
    band = 1.0 / np.linspace(1.0 / 5e-7, 1.0 / 6e-7, 4001)
    light = path.trace(wavelength=band, angle=angle, thickness="10 mm")
    np.testing.assert_allclose(light.dop, 1.0, rtol=0, atol=1e-13)
    whole = light.stokes.mean(axis=0)
    assert np.linalg.norm(whole[1:]) / whole[0] < 0.02


def test_copper_and_gold_are_those_of_johnson_and_christy():
    # Linear between 495.9 and 520.9 nm: Phys. Rev. B 6, 4370 (1972), table I.
    share = (516.0 - 495.9) / (520.9 - 495.9)
    gold = 1.04 + 1.833j + share * ((0.62 + 2.081j) - (1.04 + 1.833j))
    copper = 1.22 + 2.564j + share * ((1.18 + 2.608j) - (1.22 + 2.564j))
    known = {"delta": "48 deg", "rho": "34 deg", "phi": "20 deg"}
    same = op.load_preset("npgr026", **known).trace(
        n1=copper.real, k1=copper.imag, n2=gold.real, k2=gold.imag
    )
    light = op.load_preset("copper-gold-spectrum").trace(wavelength="516 nm")
    np.testing.assert_allclose(light.stokes, same.stokes, rtol=1e-13)


@pytest.mark.parametrize(
    "name", [*FILTERS, "quartz-quarter-wave", "achromatic-rhomb", "lyot-depolarizer"]
)
def test_cases_come_out_as_they_are_told(name):
    path = op.load_preset(name)
    for case, told in path.cases.items():
        light = op.load_preset(name, case=case).trace()
        np.testing.assert_allclose(light.stokes, told.published["eye"], rtol=0, atol=2e-9)


def test_a_wavelength_may_be_a_photon_energy_and_outside_the_range_is_refused():
    path = op.load_preset("lyot-filter")
    assert path.trace(wavelength="2.4 eV").intensity == pytest.approx(
        path.trace(wavelength=1.2398419843320026e-6 / 2.4).intensity, abs=1e-12
    )
    with pytest.raises(op.ParameterError, match=r"give 200 nm \.\. 2000 nm"):
        path.trace(wavelength="100 nm")
