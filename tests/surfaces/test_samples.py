"""Samples: layers, media and indices, the surfaces that they draw, and their smooth limit."""

import pickle
import re

import numpy as np
import pytest

import optipath as op
from optipath.surfaces import HeightField
from tables import rows

GLASS = op.Material.cauchy([1.5, 0.004])
BK7 = op.Material.sellmeier([1.04, 0.23, 1.01], [0.006, 0.02, 103.6], name="BK7")
METAL = op.Material.tabulated(["400 nm", "600 nm"], [1.0, 0.5], [1.0, 3.0], name="metal")
GOLD = op.Material.tabulated(["500 nm", "600 nm"], [0.9, 0.3], [1.8, 2.8], name="gold")
INK = op.Material.tabulated(["400 nm", "600 nm"], [1.5, 1.5], [0.0, 0.2], name="ink")
WHITE = op.Material.tabulated(["400 nm", "600 nm"], [1.6, 1.6], name="white glass")


def heights(*, periodic=False):
    bumps = np.random.default_rng(1).normal(size=(9, 12))
    return HeightField.from_heights(bumps, (20.0, 30.0), periodic=periodic)


def refused(*given, **others):
    with pytest.raises(op.errors.SurfaceError) as error:
        op.Sample(*given, **others)
    return error.value.faults


def fault_of(*given, **others):
    (fault,) = refused(*given, **others)
    return fault


def faults_at(layers, wavelength=None, **others):
    with pytest.raises(op.errors.SurfaceError) as error:
        op.Sample(layers, **others).indices(wavelength)
    return error.value.faults


def test_samples_are_equal_by_all_that_is_given_and_cannot_change():
    sample = op.Sample([(1.5, 0.1), (op.Material(0.5, 2.1), (0.1, 0.2))])
    known = [(each.index, each.roughness) for each in sample.layers]
    assert known == [(1.5, (0.1, 0.1)), (0.5 + 2.1j, (0.1, 0.2))]
    assert op.Sample(sample.layers) == sample
    plain = op.Sample([(1.5, 0.1), (0.5 + 2.1j, 0.2)], outside=1.3, cells=(400, 300))
    written = [["1.5", np.float64(0.1)], ("0.5+2.1j", np.array([0.2, 0.2]))]
    assert op.Sample(written, outside=np.array(1.3), cells=[np.int64(400), 300]) == plain
    sample = op.Sample([(1.5, 0.1)])
    others = {"outside": 1.3, "cells": 400, "surfaces": 4, "seed": 1, "periodic": False}
    for name, value in others.items():
        assert sample != op.Sample([(1.5, 0.1)], **{name: value})
    for layer in ((1.5, 0.2), (1.6, 0.1), (1.5, heights())):
        assert sample != op.Sample([layer])
    for each, name in ((sample, "seed"), (sample.layers[0], "index")):
        with pytest.raises(AttributeError):
            setattr(each, name, 3)

    # The repr says all that is not usual.
    layers = [(1.5, 0.1), (2.4, (0.1, 0.2)), (1j, 0.0)]
    assert repr(op.Sample(layers)) == f"Sample({layers})"
    others = "outside=1.3, cells=(640, 320), surfaces=4, seed=7, periodic=False"
    text = f"Sample([(1.5, 0.1)], {others})"
    assert repr(eval(text, {"Sample": op.Sample})) == text  # noqa: S307 - written above


def test_a_pickled_sample_draws_the_same_surfaces_and_takes_none_along():
    sample = op.Sample([(1.5, 0.2), (2.4, heights())], cells=200, seed=5)
    before = pickle.dumps(sample)
    fields = sample.fields(1)
    for content in (before, pickle.dumps(sample)):
        copy = pickle.loads(content)
        assert (copy, copy.fields(1), len(content)) == (sample, fields, len(before))


def test_each_layer_of_each_surface_has_a_seed_of_its_own_and_given_fields_are_those_of_all():
    sample = op.Sample([(1.5, 0.4), (2.4, (0.4, 0.8))], seed=3)
    key = np.random.SeedSequence(3, spawn_key=(2, 1))
    expected = HeightField.beckmann(0.4, 0.8, size=(200.0, 100.0), cells=640, seed=key)
    assert sample.fields(2)[1] == expected
    first, second = (sample.fields(surface)[0].heights for surface in (0, 1))
    assert not np.array_equal(first, second)
    assert not np.array_equal(first, op.Sample([(1.5, 0.4)], seed=4).fields(0)[0].heights)
    assert sample.fields(0)[0] is sample.fields(0)[0], "drawn once"
    sample = op.Sample([(1.5, bumps := heights()), (2.4, 0)])
    for surface in (0, 7):
        first, second = sample.fields(surface)
        assert first is bumps
        assert second.is_flat


def test_fields_are_forty_correlation_lengths_wide_with_sixteen_cells_each():
    (field,) = op.Sample([(1.5, (0.25, 0.5))]).fields()
    assert (field.size, field.cells, field.periodic) == ((320.0, 160.0), (640, 640), True)
    assert not op.Sample([(1.5, 0.4)], periodic=False).fields()[0].periodic
    # Too few cells are warned of when they are drawn.
    sample = op.Sample([(1.5, 0.4)], cells=200)
    with pytest.warns(op.errors.MeshWarning, match="200 x 200 cells"):
        sample.fields()


def test_a_sample_is_isotropic_where_all_its_interfaces_are():
    for layers in ([(1.5, 0.1), (2.4, 0)], [(1.5, HeightField.flat())]):
        assert op.Sample(layers).isotropic
    for layers in ([(1.5, (0.1, 0.2))], [(1.5, 0.1), (2.4, (0.2, 0.1))], [(1.5, heights())]):
        assert not op.Sample(layers).isotropic


@rows(
    "roughness",
    [
        *(9e-7, 101.0, np.nan, None, op.Parameter("a", 0.1), np.linspace(0.1, 0.5, 5)),
        *((0.1, -0.1), (0.1,), (0.1, 0.2, 0.3), ((0.1, 0.2), 0.1), (0.1, 0), (0, 0.1)),
    ],
)
def test_what_is_no_roughness_is_refused(roughness):
    fault = fault_of([(1.5, roughness)])
    assert fault.startswith("layers[0].alpha is ")
    assert fault.endswith("along x and y, 0 for a flat interface, or a HeightField")


@rows("roughness", [0, (0, 0), 1e-6, 100.0])
def test_all_of_the_range_can_be_drawn_and_0_is_flat(roughness):
    sample = op.Sample([(1.5, roughness)], seed=2)
    (field,) = sample.fields()
    if roughness not in (1e-6, 100.0):
        assert field.is_flat
        assert not sample.layers[0].is_random
    else:
        assert field.mean_square_slopes == pytest.approx((roughness**2 / 2,) * 2, rel=0.02)


FIRST, SEVERAL = "layers[0].index is ", "but a sample has one index there; give one, such as 1.5 or"
ABSORBS = "which absorbs; give a real index of refraction"


@rows(
    "layers, start, within",
    [
        *(([(each, 0.1)], FIRST, "") for each in (0, -1.5, np.nan, 1.5 - 0.1j)),
        *(([(each, 0.1), (1.5, 0.1)], FIRST, "") for each in (0, -1.5)),
        *(([(each, 0.1)], "layers[0].index", "") for each in (None, "gold", op.Polarizer())),
        *(
            ([(each, 0.1)], FIRST, f"{SEVERAL} 0.5+2.1j")
            for each in ((0.5, 2.1), np.array([1.5, 1.6]), op.Material(np.array([1.5, 1.6])))
        ),
        *((each, "layers is ", "such as [(1.5, 0.1)]") for each in ([], None)),
        *(([(1.5, 0.1), each], "layers[1] is ", "roughness: (1.5, 0.1)") for each in (1.5, (1.5,))),
        *(
            ([(each, 0.1), (2.4, 0.1)], FIRST, ABSORBS)
            for each in (1.5 + 1e-9j, "1.5+0.1j", op.Material(1.5, 0.1))
        ),
        ([*op.Sample([(0.5 + 2.1j, 0.1)]).layers, (1.5, 0.1)], f"{FIRST}(0.5+2.1j)", ABSORBS),
    ],
)
def test_layers_and_indices_that_are_none_are_refused(layers, start, within):
    fault = fault_of(layers)
    assert fault.startswith(start)
    assert within in fault


def test_media_that_do_not_absorb_may_be_anywhere_and_the_last_may_absorb():
    for index in (1.5, 1, "1.5", 1.5 + 0j, op.Material(1.5), np.array(1.5), BK7):
        op.Sample([(index, 0.1), (index, 0.2), (index, 0.3)], outside=index)
    for index in (0.5 + 2.1j, "0.5+2.1j", op.Material(0.5, 2.1), GOLD):
        op.Sample([(1.5, 0.1), (index, 0.1)])
    assert fault_of([(1.5, 0.1)], outside=1j).startswith(f"outside is 1j, {ABSORBS}")
    # A material is looked at where its index is known.
    sample = [(GOLD, 0.1), (2.4, 0.1)]
    for place, fault in zip(
        ("outside", "layers[0].index"), faults_at(sample, "500 nm", outside=GOLD), strict=True
    ):
        assert fault.startswith(f"{place} is (0.9+1.8j), {ABSORBS}")
    op.Sample([(op.Material(GOLD.n), 0.1), (2.4, 0.1)])


@rows(
    "option, value, sentence",
    [
        ("surfaces", 0, "must be a whole number of 1 or more, not 0"),
        ("seed", -1, "must be a whole number of 0 or more, not -1"),
        ("periodic", 1, "is 1; give True or False"),
        ("cells", 1, "must be a whole number from 2, or two for x and y, not 1"),
    ],
)
def test_an_option_that_is_none_is_told_with_the_cure_and_all_faults_at_once(
    option, value, sentence
):
    assert fault_of([(1.5, 0.1)], **{option: value}) == f"{option} {sentence}"
    layers = [(1.5j, -0.1), 3, (0, np.nan)]
    others = {"outside": -1, "cells": 0, "surfaces": 0, "seed": -1, "periodic": "no"}
    first = "outside layers[0].index layers[0].alpha layers[1] layers[2].index layers[2].alpha"
    places = [fault.split()[0] for fault in refused(layers, **others)]
    assert places == [*first.split(), "cells", "surfaces", "seed", "periodic"]
    # Cells and periods are of random interfaces.
    for roughness in (0, HeightField.flat(), heights()):
        fault = fault_of([(1.5, roughness)], cells=640)
        assert fault == "cells is given, but no interface is random; leave it out"
    op.Sample([(1.5, 0.1), (2.4, heights()), (1.5, HeightField.flat())], periodic=False)


def test_a_medium_that_follows_from_a_parameter_is_refused():
    of = op.Material.cauchy
    for index, name in (
        (op.Parameter("n"), "n"),
        (op.Material(op.Parameter("n", 1.5)), "n"),
        (of([1.5, op.Parameter("b", 0.004)]), "b"),
        (of([1.5, 0.004], wavelength=2 * op.Wavelength()), "wavelength"),
        (of([1.5, 0.004], wavelength=op.Wavelength(default=5e-7)), "wavelength"),
    ):
        for place, fault in zip((0, 1), refused([(index, 0.1), (index, 0.1)]), strict=True):
            told = f"layers[{place}].index follows from the parameter '{name}'; give numbers, or a"
            assert fault.startswith(told)


def test_indices_are_numbers_and_those_of_materials_at_the_wavelength():
    found = op.Sample([(1.5, 0.1), (2.4, 0.1), (0.5 + 2.1j, 0.1)], outside=1.3).indices()
    assert (found.outside, found.inner, found.base) == (1.3, (1.5, 2.4), 0.5 + 2.1j)
    assert found.n.shape == found.k.shape == ()
    assert op.Sample([(1.0, 0.1), (1.0, 0.1)]).indices().inner == (1.0,), "equal neighbours"
    for index, opaque in ((1.5, False), (1.5 + 1e-9j, True)):
        assert op.Sample([(index, 0.1)]).indices().opaque is opaque
    # Cauchy's formula: 1.5 + 0.004 / 0.5^2; and halfway between two samples.
    found = op.Sample([(GLASS, 0.1), (METAL, 0.1)], outside=GLASS).indices("500 nm")
    assert [found.outside, *found.inner] == pytest.approx([1.516, 1.516], rel=1e-15)
    assert found.n.shape == ()
    np.testing.assert_allclose([found.n, found.k], [0.75, 2.0], rtol=1e-12)


def test_numbers_that_jax_traces_are_refused():
    jax = pytest.importorskip("jax")
    with pytest.raises(op.errors.SurfaceError, match="has one index there"):
        jax.grad(lambda n: op.Sample([(n, 0.1)]).seed)(1.5)
    sample = op.Sample([(METAL, 0.1)])
    with pytest.raises(op.errors.SurfaceError, match="wavelength is traced by JAX"):
        jax.grad(lambda wavelength: sample.indices(wavelength).n)(5e-7)


@rows("wavelength", [["400 nm", "500 nm"], np.array([[4e-7], [5e-7]])])
def test_the_base_has_the_shape_of_the_wavelengths(wavelength):
    found = op.Sample([(1.5, 0.1), (METAL, 0.1)]).indices(wavelength)
    assert found.n.shape == found.k.shape == np.shape(wavelength)
    parts = [found.n.ravel(), found.k.ravel()]
    np.testing.assert_allclose(parts, [[1.0, 0.75], [1.0, 2.0]], rtol=1e-12)
    assert found.inner == (1.5,)
    # Of numbers too, where a medium above takes a wavelength.
    found = op.Sample([(WHITE, 0.1), (0.5 + 2.1j, 0.1)]).indices(wavelength)
    assert found.inner == (1.6,)
    np.testing.assert_array_equal([found.n.ravel(), found.k.ravel()], [[0.5] * 2, [2.1] * 2])


ONE, BOTH = "give one wavelength at a time", ["400 nm", "500 nm"]


@rows(
    "layers, wavelength, sentence",
    [
        ([GLASS, METAL], None, "depends on the wavelength; give one, such as '550 nm'$"),
        ([1.5], "550 nm", "^wavelength is given, but no medium depends on it; leave it out"),
        ([INK, 1.5], "500 nm", r"^layers\[0\]\.index is \(1\.5\+0\.1j\), which absorbs"),
        ([INK], BOTH, rf"^layers\[0\]\.index lets light .*{ONE}$"),
        ([INK], BOTH[::-1], rf"^layers\[0\]\.index lets light .*{ONE}$"),
        ([GLASS], 550, "550 metres, which is no wavelength of light; for nanometres write"),
        ([GLASS], [], "wavelength is empty; give one or more"),
    ],
)
def test_what_is_no_wavelength_or_does_not_fit_the_media_is_refused(layers, wavelength, sentence):
    (fault,) = faults_at([(index, 0.1) for index in layers], wavelength)
    assert re.search(sentence, fault)
    assert op.Sample([(INK, 0.1), (1.5, 0.1)]).indices("400 nm").inner == (1.5,)


def test_a_wavelength_that_several_places_cannot_have_is_told_for_each():
    faults = faults_at([(WHITE, 0.1), (METAL, 0.1)], "700 nm")
    assert [fault.partition(": the wavelength is ")[0] for fault in faults] == [
        f"layers[{place}].index" for place in (0, 1)
    ]
    # Media above the base must be the same at all wavelengths.
    faults = faults_at([(GLASS, 0.1), (METAL, 0.1)], BOTH, outside=GLASS)
    assert [fault.partition(" ")[0] for fault in faults] == ["outside", "layers[0].index"]
    assert all(fault.endswith(ONE) for fault in faults)


def test_smooth_is_the_stack_of_the_same_media_by_the_parameter_incidence():
    sample, media = op.Sample([(GLASS, 0.1), (METAL, 0.3)], outside=1.2), [1.2, GLASS, METAL]
    assert sample.smooth() == op.LayerStack(media, op.Parameter("incidence"))
    assert sample.smooth("30 deg") == op.LayerStack(media, "30 deg")
