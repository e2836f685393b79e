"""Layers of samples: their roughness."""

import numpy as np
import pytest

import optipath as op


def refused(roughness):
    with pytest.raises(op.SurfaceError) as error:
        op.Sample([(1.5, roughness)])
    (fault,) = error.value.faults
    return fault


@pytest.mark.parametrize("roughness", [-0.1, 1e-7, 101.0, "-0.1", (0.1, -0.1)])
def test_a_roughness_beyond_its_range_is_told_with_the_range(roughness):
    fault = refused(roughness)
    assert fault.startswith("layers[0].alpha is ")
    assert fault.endswith("give a roughness within 1e-06 .. 100, or 0 for a flat interface")


@pytest.mark.parametrize("roughness", [np.nan, np.inf, (0.1, np.nan)])
def test_a_roughness_must_be_finite(roughness):
    assert refused(roughness).endswith("give a finite roughness")


@pytest.mark.parametrize("roughness", [None, True, {}, "rough", 0.1j, op.Material(1.5)])
def test_what_is_no_roughness_is_refused(roughness):
    assert refused(roughness).startswith("layers[0].alpha")


@pytest.mark.parametrize("roughness", [(), (0.1,), (0.1, 0.2, 0.3), np.linspace(0.1, 0.5, 5)])
def test_roughnesses_of_no_pair_are_refused(roughness):
    assert refused(roughness).endswith("give one number, a pair along x and y, or heights")


@pytest.mark.parametrize("roughness", [((0.1, 0.2), 0.1), [[0.1], [0.2]], ([], 0.1)])
def test_roughnesses_within_a_pair_are_refused(roughness):
    assert refused(roughness).endswith("for one number; give a pair along x and y")


@pytest.mark.parametrize("roughness", [(0.1, 0), (0, 0.1)])
def test_an_interface_that_is_rough_along_one_axis_alone_is_refused(roughness):
    assert refused(roughness).endswith("give two numbers above 0, or 0 for a flat interface")


@pytest.mark.parametrize("roughness", [0, 0.0, (0, 0), "0"])
def test_0_is_flat(roughness):
    sample = op.Sample([(1.5, roughness)])
    assert sample.fields()[0].is_flat
    assert not sample.layers[0].is_random


@pytest.mark.parametrize("roughness", [1e-6, 100.0])
def test_the_ends_of_the_range_can_be_drawn(roughness):
    (field,) = op.Sample([(1.5, roughness)], seed=2).fields()
    assert field.mean_square_slopes == pytest.approx((roughness**2 / 2,) * 2, rel=0.02)


def test_a_parameter_for_a_roughness_is_told_by_its_name():
    fault = refused(op.Parameter("a", 0.1))
    assert fault == "layers[0].alpha is parameter 'a'; give a number, and make a sample for each"
