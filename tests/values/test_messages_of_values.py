"""What is said of values that do not fit, with the way out."""

import re

import numpy as np
import pytest

import optipath as op

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


@pytest.mark.parametrize(
    ("shapes", "cure"),
    [
        ({"rho": (4,), "delta": (7,)}, "for every pair, give rho[:, None];"),
        ({"delta": (7,), "rho": (4,), "phi": (7,)}, "give delta[:, None] and phi[:, None];"),
        (
            {"delta": (7,), "rho": (4,), "phi": (5,)},
            "for every combination, give delta[:, None, None] and rho[:, None];",
        ),
        ({"delta": (7,), "rho": (7, 4)}, "along the first axis, give delta[:, None];"),
        ({"delta": (7, 2), "rho": (4,)}, "for every pair, give delta[..., None];"),
        ({"delta": (7, 2), "rho": (4,), "phi": (1,)}, "for every pair, give delta[..., None];"),
    ],
)
def test_arrays_that_do_not_broadcast_are_told_with_what_to_give_instead(shapes, cure):
    text = fault(NPGR026.trace, **{name: np.zeros(shape) for name, shape in shapes.items()})
    assert cure in text
    assert all(f"{name} {shape}" in text for name, shape in shapes.items())
    # What is said does it.
    given = {name: np.zeros(shape) for name, shape in shapes.items()}
    for name, axes in re.findall(r"(\w+)\[(.*?)\]", cure):
        given[name] = given[name].reshape(given[name].shape + axes.count("None") * (1,))
    NPGR026.trace(**given)


def test_an_array_that_is_known_stays_as_it_is_and_goes_by_the_name_of_its_parameter():
    text = fault(NPGR026.bind(delta=np.zeros(3)).trace, rho=np.zeros(4))
    assert "delta (3,), rho (4,); for every pair, give rho[:, None];" in text
    assert "delta (3,), rho (4,);" in fault(NPGR026.bind, delta=np.zeros(3), rho=np.zeros(4))
    text = fault(NPGR026.bind(delta=np.zeros(3)).trace, phi=np.zeros(3), rho=np.zeros(4))
    assert "for every pair, give rho[:, None];" in text
    text = fault(op.fresnel_reflection, np.array([1.5, 1.6]), [0.6] * 3, [0.8] * 3)
    assert "for every pair, give index[:, None];" in text


def test_a_list_is_told_to_become_an_array_with_another_axis():
    several = ["40 deg", "50 deg"], ["none", "horizontal", "vertical"]
    text = fault(NPGR026.trace, delta=several[0], filter=several[1])
    assert "for every pair, give np.array(delta)[:, None];" in text
    # What is said does it.
    found = NPGR026.trace(delta=np.array(several[0])[:, None], filter=several[1])
    assert found.shape == (2, 3)


def test_a_medium_keeps_its_axes_and_the_other_array_gets_one():
    path = op.Source() >> op.Interface(op.Parameter("n"), op.Parameter("t")) >> op.Detector()
    medium, angles = op.Material([1.5, 1.4, 1.3], [0.0, 0.1, 0.2]), np.radians([10.0, 20.0])
    with pytest.raises(op.ParameterError, match=r"give t\[:, None\]; or make"):
        path.trace(n=medium, t=angles)
    assert path.trace(n=medium, t=angles[:, None]).shape == (2, 3)


def test_a_product_tells_of_light_that_has_axes_and_of_no_matrix():
    light = op.Light(np.ones((4, 1)) * [1.0, 0.0, 0.0, 0.0])
    waves = op.Polarizer([0.0, 1.0, 2.0])
    assert "for every pair, give light[:, None];" in fault(lambda: waves @ light)
    assert (waves @ light[:, None]).shape == (4, 3)
    assert "None" not in fault(lambda: waves @ op.Rotator([0.1, 0.2]))


def test_a_cosine_and_its_sine_belong_together_and_are_not_combined():
    assert "None" not in fault(op.CosSin, [0.6] * 3, [0.8] * 4)


def test_too_many_shapes_are_told_without_a_recipe():
    path = op.PathGraph()
    node = path.add("lamp", op.Source())
    for count in range(2, 12):
        node = node >> path.add(f"r{count}", op.Rotator(np.zeros(count)))
    node >> path.add("eye", op.Detector())
    assert "make their axes equal or 1" in fault(path.trace)


@pytest.mark.parametrize("number", [-0.01, np.float64(-0.01), np.float32(-0.01), np.array([-0.01])])
def test_one_number_beyond_its_range_is_told_with_what_a_fit_needs(number):
    assert f"give 0 or more {BOUNDS}" in fault(NPGR026.trace, k1=number)
    of_material = layered(op.Material(1.5, op.Parameter("k")))
    assert f"of 0 or more {BOUNDS}" in fault(of_material.trace, k=number)


def test_one_complex_index_beyond_its_domain_is_told_with_what_a_fit_needs():
    assert BOUNDS in fault(layered(op.Parameter("m")).trace, m=1.5 - 0.1j)
    # A fit has no part in numbers that are complex.
    outside = op.Source() >> op.Interface(2.0, 0.3, outside=op.Parameter("m")) >> op.Detector()
    assert BOUNDS in fault(outside.trace, m=1.5 - 0.1j)


@pytest.mark.parametrize("give", ["trace", "bind"])
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
