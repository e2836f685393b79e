"""Media of samples: which there may be, and where."""

import numpy as np
import pytest

import optipath as op

BK7 = op.Material.sellmeier(
    [1.03961212, 0.231792344, 1.01046945], [0.00600069867, 0.0200179144, 103.560653], name="BK7"
)
GOLD = op.Material.tabulated(["500 nm", "600 nm"], [0.9, 0.3], [1.8, 2.8], name="gold")


def refused(layers, **others):
    with pytest.raises(op.SurfaceError) as error:
        op.Sample(layers, **others)
    return error.value.faults


@pytest.mark.parametrize("index", [1.5, 1, "1.5", 1.5 + 0j, op.Material(1.5), np.array(1.5), BK7])
def test_a_medium_that_does_not_absorb_may_be_anywhere(index):
    op.Sample([(index, 0.1), (index, 0.2), (index, 0.3)], outside=index)


@pytest.mark.parametrize("index", [0.5 + 2.1j, 1j, "0.5+2.1j", op.Material(0.5, 2.1), GOLD])
def test_the_last_medium_may_absorb(index):
    op.Sample([(1.5, 0.1), (index, 0.1)])


@pytest.mark.parametrize("index", [1.5 + 1e-9j, "1.5+0.1j", 1j, op.Material(1.5, 0.1)])
@pytest.mark.parametrize("place", ["outside", "layers[0].index"])
def test_a_medium_above_the_last_must_not_absorb(index, place):
    first, outside = (1.5, index) if place == "outside" else (index, 1.0)
    (fault,) = refused([(first, 0.1), (2.4, 0.1)], outside=outside)
    assert fault.startswith(f"{place} is ")
    assert "which absorbs; give a real index of refraction" in fault
    assert fault.endswith("since only the last medium may absorb")


def test_a_material_that_absorbs_at_every_wavelength_is_refused_above_the_last():
    faults = refused([(GOLD, 0.1), (2.4, 0.1)], outside=GOLD)
    assert faults == tuple(
        f"k of gold is 0 at no wavelength, and {place}.k takes 0, since only the last medium may "
        f"absorb: take the medium without its k, such as Material(glass.n)"
        for place in ("outside", "layers[0].index")
    )
    op.Sample([(op.Material(GOLD.n), 0.1), (2.4, 0.1)])


@pytest.mark.parametrize("index", [0, 0.0, 0j, -1.5, np.nan, np.inf, 1.5 - 0.1j])
def test_an_index_that_no_base_has_is_refused(index):
    (fault,) = refused([(index, 0.1)])
    assert fault.startswith("layers[0].index is ")


@pytest.mark.parametrize("index", [0, -1.5, np.nan, 1e-70, 1e70])
def test_an_index_that_no_medium_above_has_is_refused(index):
    (fault,) = refused([(index, 0.1), (1.5, 0.1)])
    assert fault.startswith("layers[0].index is ")


@pytest.mark.parametrize(
    "index", [None, True, "gold", op.FOLLOWS, op.Spectrum.black_body(3000.0), op.Polarizer(), {}]
)
def test_what_is_no_index_is_refused(index):
    (fault,) = refused([(index, 0.1)])
    assert fault.startswith("layers[0].index")


@pytest.mark.parametrize(
    "index",
    [(0.5, 2.1), [1.5, 1.6], np.array([1.5, 1.6]), op.Material(np.array([1.5, 1.6])), np.array([])],
)
def test_several_indices_for_one_medium_are_refused(index):
    (fault,) = refused([(index, 0.1)])
    assert "but a sample has one index there; give one, such as 1.5 or 0.5+2.1j" in fault


@pytest.mark.parametrize(
    ("index", "name"),
    [
        (op.Parameter("n"), "n"),
        (op.Parameter("n", 1.5), "n"),
        (op.Material(op.Parameter("n", 1.5)), "n"),
        (op.Material.cauchy([1.5, op.Parameter("b", 0.004)]), "b"),
        (op.Material.cauchy([1.5, 0.004], wavelength=op.Wavelength("colour")), "colour"),
        (op.Material.cauchy([1.5, 0.004], wavelength=2 * op.Wavelength()), "wavelength"),
        (op.Material.cauchy([1.5, 0.004], wavelength=op.Wavelength(default=5e-7)), "wavelength"),
    ],
)
def test_a_medium_that_follows_from_a_parameter_is_refused(index, name):
    faults = refused([(index, 0.1), (index, 0.1)])
    assert faults == tuple(
        f"layers[{place}].index follows from the parameter '{name}'; give numbers, or a Material "
        f"that follows from the wavelength alone, made without wavelength=..."
        for place in (0, 1)
    )


def test_a_material_at_a_wavelength_is_a_number():
    sample = op.Sample([(op.Material.cauchy([1.5, 0.004], wavelength="500 nm"), 0.1)])
    assert sample.layers[0].index == pytest.approx(1.516, rel=1e-15)


def test_an_index_that_jax_traces_is_refused():
    jax = pytest.importorskip("jax")
    with pytest.raises(op.SurfaceError, match="has one index there"):
        jax.grad(lambda n: op.Sample([(n, 0.1)]).seed)(1.5)
