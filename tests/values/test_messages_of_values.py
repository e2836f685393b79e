"""What is said of values that do not fit, with the way out."""

import numpy as np
import pytest

import optipath as op
from tables import rows

NPGR026 = op.load_preset("npgr026")
BOUNDS = "(in a fit, give the optimiser bounds=)"


def fault(call, *arguments, **values):
    with pytest.raises(op.OptipathError) as error:
        call(*arguments, **values)
    return str(error.value)


def layered(index):
    path = op.PathGraph()
    glass = path.add("glass", op.Interface(index, 0.3))
    path.add("lamp", op.Source()) >> glass >> path.add("eye", op.Detector())
    return path


def test_arrays_that_do_not_broadcast_are_told_with_their_shapes():
    text = fault(NPGR026.bind(delta=np.zeros(3)).trace, rho=np.zeros(4))
    assert "delta (3,), rho (4,); make their axes equal or 1, as x[:, None] does" in text
    # What is said does it.
    assert NPGR026.trace(delta=np.zeros(3)[:, None], rho=np.zeros(4)).shape == (3, 4)


def test_many_shapes_that_do_not_broadcast_are_told():
    path = op.PathGraph()
    node = path.add("lamp", op.Source())
    for count in range(2, 12):
        node = node >> path.add(f"r{count}", op.Rotator(np.zeros(count)))
    node >> path.add("eye", op.Detector())
    assert "make their axes equal or 1" in fault(path.trace)


@rows("number", [-0.01, np.float64(-0.01), np.float32(-0.01), np.array([-0.01])])
def test_one_number_beyond_its_range_is_told_with_what_a_fit_needs(number):
    assert f"give 0 or more {BOUNDS}" in fault(NPGR026.trace, k1=number)
    of_material = layered(op.Material(1.5, op.Parameter("k")))
    assert f"of 0 or more {BOUNDS}" in fault(of_material.trace, k=number)


def test_one_complex_index_beyond_its_domain_is_told_with_what_a_fit_needs():
    assert BOUNDS in fault(layered(op.Parameter("m")).trace, m=1.5 - 0.1j)
    # A fit has no part in numbers that are complex.
    outside = op.Source() >> op.Interface(2.0, 0.3, outside=op.Parameter("m")) >> op.Detector()
    assert BOUNDS in fault(outside.trace, m=1.5 - 0.1j)


@rows("give", ["trace", "bind"])
def test_a_number_that_is_wrong_in_several_places_is_told_once(give):
    n = op.Parameter("n")
    path = op.PathGraph()
    path.add("front", op.Interface(n, 0.3))
    path.add("back", op.Interface(1.0, 0.3, outside=n, incidence_in=1.0))
    path.add("lamp", op.Source()) >> path["front.in"]
    path["front.transmitted"] >> path["back.in"]
    path["back.transmitted"] >> path.add("eye", op.Detector())
    with pytest.raises(op.ParameterError, match=r"^parameter 'n' \(at front.index\)") as error:
        getattr(path, give)(n=-0.2)
    assert len(error.value.faults) == 1


def test_a_minimisation_that_steps_beyond_a_range_is_told_to_give_bounds():
    optimize = pytest.importorskip("scipy.optimize")
    path = layered(op.Material(1.5, op.Parameter("k")))

    def brightness(x):
        return float(path.trace(k=x[0]).intensity)

    assert BOUNDS in fault(optimize.minimize, brightness, [0.1])
    assert optimize.minimize(brightness, [0.1], bounds=[(0.0, None)]).fun == pytest.approx(
        0.04, abs=0.01
    )


def test_what_no_optimiser_gives_is_told_without_it():
    for values in (
        {"k1": [-0.01, 2.0]},
        {"k1": np.nan},
        {"delta": "200 deg"},
        {"k1": "x"},
        {"delta": 48.0},
    ):
        assert "bounds" not in fault(NPGR026.trace, **values)
    assert "bounds" not in fault(NPGR026.bind, k1=-0.01)
    assert "bounds" not in fault(layered(op.Material(1.5, op.Parameter("k"))).trace, k=0.1j)
