"""Published data of crystals, against handbooks and the papers they are from."""

import math

import mpmath
import numpy as np
import pytest
from mpmath import mpf

import optipath as op
from crystal_optics import QUARTZ, sellmeier
from tables import rows

HANDBOOK = {
    "quartz": (1.54424, 1.55335),
    "calcite": (1.65835, 1.48640),
    "MgF2": (1.37770, 1.38950),
    "sapphire": (1.76817, 1.76010),
}
"""n_o and n_e at 589.3 nm, as handbooks of optics list them."""

SORET_AND_SARASIN = {
    "760.4 nm": 12.668,
    "656.28 nm": 17.318,
    "526.96 nm": 27.543,
    "486.13 nm": 32.773,
    "430.79 nm": 42.604,
    "410.17 nm": 47.481,
    "358.18 nm": 64.459,
    "226.45 nm": 201.824,
}
"""Rotation of 1 mm of quartz in degrees, J. L. Soret and E. Sarasin (1882), as the Handbuch der
Physik of A. Winkelmann has it."""


@rows("name, indices", HANDBOOK.items())
def test_indices_are_those_of_handbooks(name, indices):
    crystal = op.Crystal.named(name)
    found = [ray.n.at("589.3 nm") for ray in (crystal.ordinary, crystal.extraordinary)]
    np.testing.assert_allclose(found, indices, rtol=0, atol=4e-4)
    assert crystal.birefringence.at("589.3 nm") == pytest.approx(found[1] - found[0], abs=1e-15)


def test_birefringence_of_quartz_has_all_its_digits():
    found = op.Crystal.named("quartz").birefringence.at(grid := np.linspace(2e-7, 2e-6, 41))
    with mpmath.workdps(50):
        exact = [
            float(sellmeier(QUARTZ["e"], mpf(float(w))) - sellmeier(QUARTZ["o"], mpf(float(w))))
            for w in grid
        ]
    np.testing.assert_allclose(found, exact, rtol=2e-15)


def test_slopes_of_the_birefringence_are_those_of_its_closed_form(jax):
    quartz = op.Crystal.named("quartz").birefringence

    def birefringence(wavelength):
        return quartz.curve.evaluated(wavelength, *quartz.given_by[1:])[0]

    with mpmath.workdps(50):
        exact = mpmath.diff(
            lambda w: sellmeier(QUARTZ["e"], w) - sellmeier(QUARTZ["o"], w), mpf(4.3e-7)
        )
        assert float(jax.grad(birefringence)(4.3e-7)) == pytest.approx(float(exact), rel=1e-13)


@rows("wavelength, degrees", SORET_AND_SARASIN.items())
def test_quartz_turns_light_as_it_was_measured(wavelength, degrees):
    power = op.Crystal.named("quartz").rotatory_power
    assert math.degrees(power.at(wavelength)) / 1e3 == pytest.approx(degrees, rel=5e-3)
    slab = op.Medium("1 mm", dextrorotation=power)
    light = (op.Source(stokes=[1, 1, 0, 0]) >> slab >> op.Detector()).trace(wavelength=wavelength)
    turned = -np.degrees(light.aop) - degrees
    assert (turned + 90.0) % 180.0 - 90.0 == pytest.approx(0.0, abs=0.005 * degrees)


def test_a_crystal_of_ones_own_has_the_difference_of_its_indices():
    same = op.Crystal(op.Material(1.5), op.Material(1.6))
    assert same.birefringence == pytest.approx(0.1)
    crystal = op.Crystal(op.Crystal.named("quartz").ordinary, op.Material(1.6))
    assert crystal.birefringence.at("589.3 nm") == pytest.approx(1.6 - 1.5442057, abs=1e-7)


def test_what_is_no_crystal_is_refused():
    with pytest.raises(op.ValueFault, match="did you mean 'quartz'"):
        op.Crystal.named("quarz")
    with pytest.raises(op.ValueFault, match=r"extraordinary of the crystal is 1\.6; give"):
        op.Crystal(op.Material(1.5), 1.6)
    with pytest.raises(op.ValueFault, match="known"):
        op.Crystal.named("quartz").birefringence.at("3 um")


def test_a_crystal_at_one_wavelength_has_a_rotatory_power_where_one_was_measured():
    assert op.Crystal.named("quartz", "1.5 um").rotatory_power is None
    exact = op.Crystal.named("quartz").rotatory_power.at("589.3 nm")
    assert op.Crystal.named("quartz", "589.3 nm").rotatory_power == pytest.approx(exact, rel=1e-15)
