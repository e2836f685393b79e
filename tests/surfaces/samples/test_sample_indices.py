"""The indices of a sample, at a wavelength and at several."""

import numpy as np
import pytest

import optipath as op

GLASS = op.Material.cauchy([1.5, 0.004])
METAL = op.Material.tabulated(["400 nm", "600 nm"], [1.0, 0.5], [1.0, 3.0], name="metal")
INK = op.Material.tabulated(["400 nm", "600 nm"], [1.5, 1.5], [0.0, 0.2], name="ink")
WHITE = op.Material.tabulated(["400 nm", "600 nm"], [1.6, 1.6], name="white glass")


def refused(layers, wavelength=None, **others):
    sample = op.Sample(layers, **others)
    with pytest.raises(op.SurfaceError) as error:
        sample.indices(wavelength)
    return error.value.faults


def test_numbers_are_what_they_are():
    found = op.Sample([(1.5, 0.1), (2.4, 0.1), (0.5 + 2.1j, 0.1)], outside=1.3).indices()
    assert (found.outside, found.inner) == (1.3, (1.5, 2.4))
    assert (found.n.shape, found.k.shape) == ((), ())
    assert (float(found.n), float(found.k)) == (0.5, 2.1)


def test_materials_are_taken_at_the_wavelength():
    # Cauchy's formula: 1.5 + 0.004 / 0.5^2; and halfway between two samples.
    found = op.Sample([(GLASS, 0.1), (METAL, 0.1)], outside=GLASS).indices("500 nm")
    assert found.outside == pytest.approx(1.516, rel=1e-15)
    assert found.inner == pytest.approx((1.516,), rel=1e-15)
    assert (found.n.shape, float(found.n)) == ((), pytest.approx(0.75, rel=1e-12))
    assert float(found.k) == pytest.approx(2.0, rel=1e-12)


@pytest.mark.parametrize(
    "wavelength", [["400 nm", "500 nm"], [4e-7, 5e-7], np.array([[4e-7], [5e-7]])]
)
def test_the_base_has_the_shape_of_the_wavelengths(wavelength):
    found = op.Sample([(1.5, 0.1), (METAL, 0.1)]).indices(wavelength)
    assert found.n.shape == found.k.shape == np.shape(wavelength)
    np.testing.assert_allclose(found.n.ravel(), [1.0, 0.75], rtol=1e-12)
    np.testing.assert_allclose(found.k.ravel(), [1.0, 2.0], rtol=1e-12)
    assert found.inner == (1.5,)


def test_a_base_of_numbers_is_laid_out_where_a_medium_above_takes_a_wavelength():
    found = op.Sample([(WHITE, 0.1), (0.5 + 2.1j, 0.1)]).indices(["400 nm", "500 nm"])
    assert found.inner == (1.6,)
    np.testing.assert_array_equal(found.n, [0.5, 0.5])
    np.testing.assert_array_equal(found.k, [2.1, 2.1])


@pytest.mark.parametrize(
    ("index", "opaque"), [(1.5, False), (0.5 + 2.1j, True), (1.5 + 1e-9j, True)]
)
def test_a_base_that_absorbs_is_opaque(index, opaque):
    assert op.Sample([(index, 0.1)]).indices().opaque is opaque


def test_a_material_without_a_wavelength_asks_for_one():
    (fault,) = refused([(GLASS, 0.1), (METAL, 0.1)])
    assert fault.endswith("depends on the wavelength; give one, such as '550 nm'")


def test_a_wavelength_that_nothing_asks_for_is_refused():
    (fault,) = refused([(1.5, 0.1)], "550 nm")
    assert fault == "wavelength is given, but no medium depends on it; leave it out"


@pytest.mark.parametrize(
    ("wavelength", "sentence"),
    [
        (550, "550 metres, which is no wavelength of light; for nanometres write '550 nm'"),
        ("550", "has no unit"),
        ("a", "knows no word 'a'"),
        (np.nan, "is nan"),
        (True, "True"),
        ([], "wavelength is empty; give one or more"),
    ],
)
def test_what_is_no_wavelength_is_refused(wavelength, sentence):
    (fault,) = refused([(GLASS, 0.1)], wavelength)
    assert sentence in fault


def test_a_wavelength_at_which_a_material_is_not_known_is_told_once_for_each_place():
    faults = refused([(WHITE, 0.1), (METAL, 0.1)], "700 nm")
    assert [fault.partition(" is ")[0] for fault in faults] == [
        "parameter 'wavelength' (at layers[0].index)",
        "parameter 'wavelength' (at layers[1].index)",
    ]


def test_a_medium_above_the_last_that_absorbs_at_the_wavelength_is_refused():
    layers = [(INK, 0.1), (1.5, 0.1)]
    assert op.Sample(layers).indices("400 nm").inner == (1.5,)
    (fault,) = refused(layers, "500 nm")
    assert fault.startswith("k of ink at 500 nm is 0.1, and layers[0].index.k takes 0")


def test_media_above_the_base_must_be_the_same_at_all_wavelengths():
    faults = refused([(GLASS, 0.1), (METAL, 0.1)], ["400 nm", "500 nm"], outside=GLASS)
    assert [fault.partition(" ")[0] for fault in faults] == ["outside", "layers[0].index"]
    assert all(fault.endswith("give one wavelength at a time") for fault in faults)


@pytest.mark.parametrize("wavelengths", [["400 nm", "500 nm"], ["500 nm", "400 nm"]])
def test_a_base_that_lets_light_of_one_of_the_wavelengths_through_is_refused(wavelengths):
    (fault,) = refused([(INK, 0.1)], wavelengths)
    assert fault.startswith("layers[0].index lets light through")
    assert fault.endswith("give one wavelength at a time")


def test_a_wavelength_that_jax_traces_is_refused():
    jax = pytest.importorskip("jax")
    sample = op.Sample([(METAL, 0.1)])
    with pytest.raises(op.SurfaceError, match="wavelength is traced by JAX"):
        jax.grad(lambda wavelength: sample.indices(wavelength).n)(5e-7)
