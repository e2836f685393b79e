"""Samples: what they keep, which surfaces they draw, and their smooth limit."""

import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.surfaces import HeightField


def heights(*, periodic=False):
    return HeightField.from_heights(
        np.random.default_rng(1).normal(size=(9, 12)), (20.0, 30.0), periodic=periodic
    )


def test_layers_keep_their_index_and_their_roughness_along_both_axes():
    upper, lower = op.Sample([(1.5, 0.1), (op.Material(0.5, 2.1), (0.1, 0.2))]).layers
    assert (upper.index, upper.roughness) == (1.5, (0.1, 0.1))
    assert (lower.index, lower.roughness) == (0.5 + 2.1j, (0.1, 0.2))


def test_numbers_may_be_texts_and_those_of_numpy():
    plain = op.Sample([(1.5, 0.1), (0.5 + 2.1j, 0.2)], outside=1.3, cells=(400, 300))
    written = op.Sample(
        [["1.5", np.float32(0.1).astype(np.float64).round(6)], ("0.5+2.1j", np.array([0.2, 0.2]))],
        outside=np.array(1.3),
        cells=[np.int64(400), 300],
    )
    assert written == plain


def test_samples_are_equal_by_all_that_is_given():
    sample = op.Sample([(1.5, 0.1)])
    assert sample == op.Sample([(op.Material(1.5), (0.1, 0.1))])
    for other in (
        op.Sample([(1.5, 0.2)]),
        op.Sample([(1.6, 0.1)]),
        op.Sample([(1.5, 0.1)], outside=1.3),
        op.Sample([(1.5, 0.1)], cells=400),
        op.Sample([(1.5, 0.1)], surfaces=4),
        op.Sample([(1.5, 0.1)], seed=1),
        op.Sample([(1.5, 0.1)], periodic=False),
        op.Sample([(1.5, heights())]),
    ):
        assert sample != other


def test_a_sample_cannot_change():
    sample = op.Sample([(1.5, 0.1)])
    with pytest.raises(AttributeError):
        sample.seed = 3
    with pytest.raises(AttributeError):
        sample.layers[0].index = 1.6


def test_the_repr_says_all_that_is_not_usual():
    layers = [(1.5, 0.1), (2.4, (0.1, 0.2)), (1j, 0.0)]
    assert repr(op.Sample(layers)) == f"Sample({layers})"
    others = "outside=1.3, cells=(640, 320), surfaces=4, seed=7, periodic=False"
    text = f"Sample([(1.5, 0.1)], {others})"
    assert repr(eval(text, {"Sample": op.Sample})) == text  # noqa: S307 - written above


@pytest.mark.parametrize("drawn", [False, True])
def test_a_pickled_sample_draws_the_same_surfaces(drawn):
    sample = op.Sample([(1.5, 0.2), (2.4, heights())], cells=200, seed=5)
    fields = sample.fields(1) if drawn else None
    copy = pickle.loads(pickle.dumps(sample))
    assert copy == sample
    assert copy.fields(1) == (fields or sample.fields(1))


def test_surfaces_that_are_drawn_are_not_pickled():
    sample = op.Sample([(1.5, 0.4)])
    before = len(pickle.dumps(sample))
    sample.fields(0)
    assert len(pickle.dumps(sample)) == before


def test_each_layer_of_each_surface_has_a_seed_of_its_own():
    sample = op.Sample([(1.5, 0.4), (2.4, (0.4, 0.8))], seed=3)
    expected = HeightField.beckmann(
        0.4,
        0.8,
        size=(200.0, 100.0),
        cells=640,
        seed=np.random.SeedSequence(3, spawn_key=(2, 1)),
    )
    assert sample.fields(2)[1] == expected
    first, second = (sample.fields(surface)[0].heights for surface in (0, 1))
    assert not np.array_equal(first, second)
    assert not np.array_equal(first, op.Sample([(1.5, 0.4)], seed=4).fields(0)[0].heights)


def test_fields_are_forty_correlation_lengths_wide_with_sixteen_cells_each():
    (field,) = op.Sample([(1.5, (0.25, 0.5))]).fields()
    assert field.size == (320.0, 160.0)
    assert field.cells == (640, 640)
    assert field.periodic


def test_a_surface_is_drawn_once():
    sample = op.Sample([(1.5, 0.4)])
    assert sample.fields(0)[0] is sample.fields(0)[0]


def test_fields_that_are_given_are_those_of_every_surface():
    given = heights()
    sample = op.Sample([(1.5, given), (2.4, 0)])
    for surface in (0, 7):
        first, second = sample.fields(surface)
        assert first is given
        assert second.is_flat


def test_random_fields_end_where_they_are_not_periodic():
    assert not op.Sample([(1.5, 0.4)], periodic=False).fields()[0].periodic


def test_too_few_cells_are_warned_of_when_they_are_drawn():
    sample = op.Sample([(1.5, 0.4)], cells=200)
    with pytest.warns(op.MeshWarning, match="200 x 200 cells"):
        sample.fields()


@pytest.mark.parametrize("surface", [-1, 0.5, True, None])
def test_a_surface_that_there_is_not_is_refused(surface):
    with pytest.raises(op.SurfaceError, match="surface must be a whole number of 0 or more"):
        op.Sample([(1.5, 0.4)]).fields(surface)


@pytest.mark.parametrize(
    ("layers", "isotropic"),
    [
        ([(1.5, 0.1)], True),
        ([(1.5, (0.1, 0.2))], False),
        ([(1.5, 0.1), (2.4, 0)], True),
        ([(1.5, 0.1), (2.4, (0.2, 0.1))], False),
        ([(1.5, HeightField.flat())], True),
        ([(1.5, heights())], False),
    ],
)
def test_a_sample_is_isotropic_where_all_its_interfaces_are(layers, isotropic):
    assert op.Sample(layers).isotropic is isotropic


def refused(*given, **others):
    with pytest.raises(op.SurfaceError) as error:
        op.Sample(*given, **others)
    return error.value.faults


@pytest.mark.parametrize(
    ("option", "value", "sentence"),
    [
        ("surfaces", 0, "surfaces must be a whole number of 1 or more, not 0"),
        ("surfaces", 2.0, "surfaces must be a whole number of 1 or more, not 2.0"),
        ("seed", -1, "seed must be a whole number of 0 or more, not -1"),
        ("seed", True, "seed must be a whole number of 0 or more, not True"),
        ("periodic", 1, "periodic is 1; give True or False"),
        (
            "cells",
            1,
            "cells must be a whole number of 2 or more, or two of them for x and y, not 1",
        ),
        ("description", 3, "description must be a text, not 3"),
    ],
)
def test_an_option_that_is_none_is_told_with_the_cure(option, value, sentence):
    assert refused([(1.5, 0.1)], **{option: value}) == (sentence,)


def test_all_faults_are_told_at_once():
    layers = [(1.5j, -0.1), 3, (0, np.nan)]
    others = {"outside": -1, "cells": 0, "surfaces": 0, "seed": -1, "periodic": "no"}
    places = [fault.split()[0] for fault in refused(layers, **others)]
    assert places == [
        "outside", "layers[0].index", "layers[0].alpha", "layers[1]", "layers[2].index",
        "layers[2].alpha", "cells", "surfaces", "seed", "periodic",
    ]  # fmt: skip


def test_smooth_is_the_stack_of_the_same_media_by_the_parameter_incidence():
    sample = op.Sample([(1.5, 0.1), (0.5 + 2.1j, 0.3)], outside=1.2)
    stack = op.LayerStack([1.2, 1.5, 0.5 + 2.1j], op.Parameter("incidence"))
    assert sample.smooth() == stack
    assert sample.smooth("30 deg") == op.LayerStack([1.2, 1.5, 0.5 + 2.1j], "30 deg")


def test_smooth_of_one_layer_is_its_interface():
    stack = op.Sample([(1.5, 0.1)]).smooth(0.7)
    glass = op.Interface(1.5, 0.7)
    for port in ("reflected", "transmitted"):
        given, expected = (each.mueller("in", port).matrix for each in (stack, glass))
        np.testing.assert_allclose(given, expected, rtol=0, atol=1e-15)


def test_smooth_glass_on_glass_sums_up_light_that_goes_to_and_fro():
    # Fresnel's equations and the geometric series, of light along s and along p.
    theta = np.radians([65.0])
    first, second = (np.arcsin(np.sin(theta) / n) for n in (1.5, 2.4))

    def reflectances(n1, n2, t1, t2):
        c1, c2 = np.cos(t1), np.cos(t2)
        pairs = (n1 * c1, n2 * c2), (n1 * c2, n2 * c1)
        return np.array([((a - b) / (a + b)) ** 2 for a, b in pairs])

    upper = reflectances(1.0, 1.5, theta, first)
    lower = reflectances(1.5, 2.4, first, second)
    along_s, along_p = upper + (1 - upper) ** 2 * lower / (1 - upper * lower)
    light = (op.Source() >> op.load_sample("glass-on-glass").smooth(theta) >> op.Detector()).trace()
    np.testing.assert_allclose(light.intensity, (along_s + along_p) / 2, rtol=1e-14)
    np.testing.assert_allclose(light.dolp, (along_s - along_p) / (along_s + along_p), rtol=1e-13)
    assert light.intensity == pytest.approx(0.16024, abs=5e-6)


def test_smooth_media_may_follow_from_the_wavelength():
    path = op.Source() >> op.load_sample("glass-on-gold").smooth("60 deg") >> op.Detector()
    at_once = path.trace(wavelength=["400 nm", "550 nm", "700 nm"]).intensity
    indices = op.load_sample("glass-on-gold").indices(["400 nm", "550 nm", "700 nm"])
    for index, expected in zip(indices.n + 1j * indices.k, at_once, strict=True):
        stack = op.LayerStack([1.0, 1.5, index], "60 deg")
        light = (op.Source() >> stack >> op.Detector()).trace()
        assert light.intensity == pytest.approx(expected, rel=1e-14)


@given(
    st.lists(st.tuples(st.floats(0.1, 10.0), st.floats(1e-6, 100.0)), min_size=1, max_size=5),
    st.floats(0.0, 1.5),
)
def test_smooth_layers_reflect_and_let_through_all_light(layers, incidence):
    stack = op.Sample(layers).smooth(incidence)
    ports = ("reflected", "transmitted")
    total = sum(stack.mueller("in", port).matrix[0, 0] for port in ports)
    assert total == pytest.approx(1.0, abs=1e-12)
