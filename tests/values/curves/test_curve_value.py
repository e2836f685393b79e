"""What follows from the wavelength of a run stands in a path like a parameter."""

import copy
import pickle
from functools import partial

import numpy as np
import pytest

import optipath as op
from fake_curves import Metal, metal


def tilted_twice(index):
    tilted = op.Interface(index, op.Parameter("tilt", default="50 deg"), azimuth="20 deg")
    return op.Source(100) >> op.Interface(index, "40 deg") >> tilted >> op.Detector()


def mirror(*, slope=2e6, wavelength=None):
    return tilted_twice(op.Material(*metal(slope, wavelength)))


def by_numbers(wavelength, slope=2e6, **values):
    index = complex(2.0 - slope * wavelength, 1.0 + np.sqrt(wavelength * 1e6))
    return tilted_twice(index).trace(**values).stokes


def test_light_is_that_of_the_numbers_at_each_wavelength_of_several_runs():
    assert np.array_equal(mirror().trace(wavelength=5e-7).stokes, by_numbers(5e-7))
    plan = mirror().compose()
    for wavelength in [5e-7, 6e-7, 5e-7, 7e-7] * 3:
        assert plan.run(wavelength=wavelength).stokes == pytest.approx(by_numbers(wavelength))
    path = mirror(slope=op.Parameter("slope"))
    found = path.trace(slope=np.array([[1e6], [2e6]]), wavelength=np.array([4e-7, 5e-7])).stokes
    assert found.shape == (2, 2, 4)
    assert found[1, 1] == pytest.approx(by_numbers(5e-7))
    assert path.bind(slope=1e6).trace(wavelength=4e-7).stokes == pytest.approx(found[0, 0])


@pytest.mark.parametrize("engine", ["numpy", "numba"])
def test_a_wavelength_is_an_axis_like_any_other(engine):
    if engine == "numba":
        pytest.importorskip("numba")
    wavelengths, tilts = np.linspace(400e-9, 700e-9, 4), np.linspace(0.1, 1.0, 3)
    plan = op.Composer(engine=engine).compose(mirror())
    found = plan.run(wavelength=wavelengths[:, None], tilt=tilts).stokes
    one_by_one = [[by_numbers(w, tilt=t) for t in tilts] for w in wavelengths]
    assert found == pytest.approx(np.array(one_by_one), rel=1e-13)


def test_a_wavelength_that_stands_elsewhere_too_is_read_at_every_run():
    n, k = metal()
    plate = op.Waveplate(1e-5, 0.009, op.Wavelength(), angle="45 deg")
    path = op.Source(stokes=(1, 1, 0, 0)) >> plate >> op.Interface(op.Material(n, k), 1.0)
    plan = (path >> op.Detector()).compose()
    batches = [np.linspace(a, 7e-7, 2000) for a in (4e-7, 5e-7, 4e-7)]
    found = [[plan.run(wavelength=batch).stokes[0] for batch in batches] for _ in range(6)]
    for row in found:
        assert np.array_equal(row[0], row[2])
        assert not np.array_equal(row[0], row[1])


def test_one_by_itself_comes_to_the_same_bits_as_among_others():
    wavelengths = np.linspace(400e-9, 700e-9, 1001)
    together = Metal().evaluated(wavelengths, 2e6)
    for place in (0, 17, 500, 1000):
        alone = Metal().evaluated(wavelengths[place], 2e6)
        assert [part[place] for part in together] == [part.item() for part in alone]


def test_a_wavelength_that_is_bound_known_or_a_default_gives_numbers():
    bound = mirror().bind(wavelength="500 nm")
    assert bound.trace().stokes == pytest.approx(by_numbers(5e-7))
    with pytest.raises(op.ParameterError, match="bound to 500 nm"):
        bound.trace(wavelength=6e-7)
    path = mirror(wavelength=op.Wavelength(default="500 nm"))
    assert path.trace().stokes == pytest.approx(by_numbers(5e-7))
    assert path.trace(wavelength="600 nm").stokes == pytest.approx(by_numbers(6e-7))
    n, k = metal(wavelength=5e-7)
    assert (float(n), float(k)) == (1.0, 1.0 + np.sqrt(0.5))


def test_a_wavelength_out_of_range_or_not_given_is_told_once():
    with pytest.raises(op.ParameterError) as caught:
        mirror().trace(wavelength="900 nm")
    assert len(caught.value.faults) == 1
    for word in ("900 nm", "300 nm .. 800 nm", "a metal", "take another metal"):
        assert word in str(caught.value)
    with pytest.raises(op.ParameterError, match="'wavelength' has no value"):
        mirror().trace()
    path = mirror()
    n, _ = metal()
    assert [*path.compose().inputs.open] == ["wavelength", "tilt"]
    with pytest.raises(op.ParameterError):
        path.trace(wavelength=5e-7, **{n.name: 1.0})


def test_slopes_along_the_wavelength_are_those_of_differences(jax_once):
    plan = op.Composer(engine="jax").compose(mirror())
    slope = jax_once.grad(lambda w: plan.run(wavelength=w).stokes[0])
    step = 1e-11
    apart = by_numbers(5e-7 + step)[0] - by_numbers(5e-7 - step)[0]
    assert float(slope(5e-7)) == pytest.approx(apart / (2 * step), rel=1e-6)


def test_jax_gives_nan_beyond_the_range(jax):
    plan = op.Composer(engine="jax").compose(mirror())
    assert np.isnan(jax.jit(lambda w: plan.run(wavelength=w).stokes)(9e-7)).all()


def test_equal_curves_and_their_copies_are_equal_values_and_others_are_not():
    n, _ = metal(slope=op.Parameter("slope"))
    assert copy.deepcopy(n) == n
    assert pickle.loads(pickle.dumps(n)).name == n.name
    assert metal()[0] == metal()[0]
    assert metal()[0] != metal()[1]
    assert metal()[0] != metal(slope=1e6)[0]
    assert metal()[0] != metal(wavelength=op.Wavelength("probe"))[0]


def test_nanometres_that_are_taken_for_metres_are_refused():
    makes = [
        partial(op.Material.cauchy, [1.5]),
        partial(op.Material.sellmeier, [1.2], [0.01]),
        partial(op.Material.drude_lorentz, 9.0, 0.1),
        partial(op.Material.tauc_lorentz, [(100, 3, 2, 1)]),
    ]
    for make in makes:
        with pytest.raises(op.ValueFault) as fault:
            make(span=(400, 700), name="x")
        assert str(fault.value) == (
            "the least wavelength of the span of x is 400 metres, which is no wavelength of light; "
            "multiply those in nanometres by 1e-9, and those in micrometres by 1e-6"
        )
        assert "400 nm .. 700 nm" in repr(make(span=(400e-9, 700e-9), name="x"))
