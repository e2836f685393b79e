"""The layers of samples as they are given, and what does not fit with them."""

import numpy as np
import pytest

import optipath as op
from optipath.surfaces import HeightField


def heights(*, periodic=False):
    bumps = np.random.default_rng(1).normal(size=(9, 12))
    return HeightField.from_heights(bumps, (20.0, 30.0), periodic=periodic)


def refused(*given, **others):
    with pytest.raises(op.SurfaceError) as error:
        op.Sample(*given, **others)
    return error.value.faults


def test_the_layers_of_a_sample_make_another():
    sample = op.Sample([(1.5, 0.1), (0.5 + 2.1j, (0.1, 0.2))])
    assert op.Sample(sample.layers) == sample
    assert op.Sample([*sample.layers[:1], (2.4, 0.3)]) == op.Sample([(1.5, 0.1), (2.4, 0.3)])


def test_a_layer_of_a_base_that_absorbs_is_refused_above_another():
    metal = op.Sample([(0.5 + 2.1j, 0.1)]).layers
    (fault,) = refused([*metal, (1.5, 0.1)])
    assert fault.startswith("layers[0].index is (0.5+2.1j), which absorbs")


@pytest.mark.parametrize("layers", [[], (), None, 1.5, "glass", {(1.5, 0.1)}])
def test_layers_must_be_a_list_of_some(layers):
    (fault,) = refused(layers)
    assert fault.startswith("layers is ")
    assert fault.endswith("its roughness, such as [(1.5, 0.1)]")


@pytest.mark.parametrize("layer", [1.5, (1.5,), (1.5, 0.1, 0.2), None, "1.5"])
def test_a_layer_must_be_a_pair(layer):
    (fault,) = refused([(1.5, 0.1), layer])
    assert fault.startswith("layers[1] is ")
    assert fault.endswith("roughness, such as (1.5, 0.1)")


@pytest.mark.parametrize("roughness", [0, HeightField.flat(), heights()])
def test_cells_of_no_random_interface_are_refused(roughness):
    assert refused([(1.5, roughness)], cells=640) == (
        "cells is given, but no interface is random; leave it out",
    )


def test_periodic_heights_in_a_sample_that_is_not_to_be_periodic_are_refused():
    (fault,) = refused([(1.5, 0.1), (2.4, heights(periodic=True))], periodic=False)
    assert fault.startswith("periodic is False, but the heights of layers[1] are periodic")
    op.Sample([(1.5, 0.1), (2.4, heights()), (1.5, HeightField.flat())], periodic=False)


def test_equal_media_may_be_neighbours():
    assert op.Sample([(1.0, 0.1), (1.0, 0.1)]).indices().inner == (1.0,)
