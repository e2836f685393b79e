"""A sweep in memory against a loop over single runs."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import optipath as op
from chains import ENGINES
from optipath.plan.answers import Answers
from random_paths import Draw
from tables import rows

pytest.importorskip("xarray")

DERIVED = {
    "DoP": "dop",
    "DoLP": "dolp",
    "AoP": "aop",
    "ellipticity": "ellipticity",
    "psi": "psi",
    "delta": "delta",
}


def with_two_detectors():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(2.0))
    sheet = path.add("filter", op.Polarizer(op.Parameter("angle")))
    glass = path.add("glass", op.Interface(1.5, op.Parameter("theta")))
    lamp >> sheet >> glass
    path.add("above", op.Detector())
    path.add("below", op.Detector())
    path.connect("glass.reflected", "above.in")
    path.connect("glass.transmitted", "below.in")
    return path


def names_of(found):
    """What each derived variable is called, and the attribute of light that it is."""
    beside = {"psi": "Psi", "delta": "Delta"} if "Psi" in found else {}
    return {beside.get(name, name): attribute for name, attribute in DERIVED.items()}


def assert_equals_the_loop(path, axes, **fixed):
    """Every variable has the bits that a run for one point alone has."""
    found = path.sweep(**axes, **fixed)
    ends = found["detector"].values if "detector" in found.dims else [None]
    for point in product(*[range(len(values)) for values in axes.values()]):
        at = dict(zip(axes, point, strict=True))
        lights = path.trace_all(**{name: axes[name][i] for name, i in at.items()}, **fixed)
        for end in ends:
            part = found.isel(at) if end is None else found.isel(at).sel(detector=end)
            light = next(iter(lights.values())) if end is None else lights[end]
            stokes = [part[f"S{i}"].values for i in range(4)]
            np.testing.assert_array_equal(stokes, light.stokes)
            for name, attribute in names_of(found).items():
                np.testing.assert_array_equal(part[name].values, getattr(light, attribute))


@settings(max_examples=12, deadline=None)
@given(seed=st.integers(0, 10_000))
def test_a_sweep_of_a_random_path_is_the_loop_over_single_runs(seed):
    draw = Draw(seed, arrays=False)
    path = draw.path()
    opened = [name for name, value in draw.values.items() if isinstance(value, float)][:3]
    axes = {name: np.array([1.0, 0.999]) * draw.values[name] for name in opened}
    fixed = {name: value for name, value in draw.values.items() if name not in axes}
    assert_equals_the_loop(path, axes, **fixed)


def test_a_sweep_of_several_detectors_is_the_loop_over_single_runs():
    axes = {"theta": np.linspace(0.0, 1.5, 4), "angle": np.linspace(-1.0, 1.0, 3)}
    assert_equals_the_loop(with_two_detectors(), axes)


def test_a_sweep_of_a_spectrum_is_the_loop_over_single_runs():
    axes = {"wavelength": np.array([450e-9, 516e-9, 640e-9]), "phi": np.array([0.2, 0.9])}
    assert_equals_the_loop(op.load_preset("copper-gold-spectrum"), axes)


def test_what_is_dark_but_for_rounding_has_no_polarisation_as_in_a_single_run():
    angles = np.array([0.0, np.pi / 4, np.pi / 2])
    path = op.Source() >> op.Polarizer(0.0) >> op.Polarizer(op.Parameter("angle")) >> op.Detector()
    found = path.sweep(angle=angles)
    assert np.isnan(found.DoP.values).tolist() == [False, False, True]
    assert_equals_the_loop(path, {"angle": angles})


def test_axes_that_vary_together_are_one_dimension():
    deltas, phis = np.linspace(0.1, 1.0, 5), np.linspace(0.3, 1.2, 5)
    path = op.load_preset("npgr026")
    found = path.sweep(delta=deltas, phi=phis, rho=[0.1, 0.2], zip=("delta", "phi"))
    (together,) = set(found.S0.dims) - {"rho"}
    for place, (delta, phi) in enumerate(zip(deltas, phis, strict=True)):
        alone = path.trace(delta=delta, phi=phi, rho=0.2)
        assert found.S1.isel({together: place, "rho": 1}) == alone.S1
        assert found.DoP.isel({together: place, "rho": 1}) == alone.dop


def test_words_are_the_values_of_a_coordinate():
    found = op.load_preset("npgr026").sweep(filter=["none", "horizontal"], delta=[0.2, 0.9])
    alone = op.load_preset("npgr026").trace(filter="horizontal", delta=0.9)
    assert found.S0.sel(filter="horizontal", delta=0.9) == alone.S0
    assert found["filter"].values.tolist() == ["none", "horizontal"]


@rows(
    "path, names",
    [(op.load_preset("malus"), ["angle"]), (with_two_detectors(), ["angle", "theta"])],
)
def test_components_are_views_of_one_array_that_cannot_be_written_to(path, names):
    found = path.sweep(**dict.fromkeys(names, np.linspace(0.1, 1.0, 300)))
    s0, s1 = (found[name].values for name in ("S0", "S1"))
    assert np.may_share_memory(s0, s1)
    assert not s0.flags.writeable


def test_a_sweep_without_axes_is_a_single_run():
    found = op.load_preset("malus").sweep(angle=0.3)
    assert found.S0.shape == ()
    assert found.S0 == op.load_preset("malus").trace(angle=0.3).S0
    assert found.DoP == 1.0


def test_an_axis_on_which_an_element_does_not_depend_costs_no_evaluation(monkeypatch):
    path, ran = op.load_preset("npgr026"), {}
    lights = Answers.lights
    monkeypatch.setattr(Answers, "lights", lambda self, p: ran.update(p) or lights(self, p))
    path.sweep(delta=np.linspace(0.1, 1.0, 20), phi=np.linspace(0.1, 1.0, 30))
    counts = path.compose().evaluations(**ran)
    assert (counts["X1.reflected"], counts["X2.reflected"]) == (20, 30)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_every_engine_and_precision_gives_variables_of_that_precision(engine, dtype):
    composer = op.Composer(engine=engine, dtype=dtype)
    path = op.load_preset("npgr026")
    axes = {"delta": np.linspace(0.1, 1.0, 4), "phi": np.linspace(0.2, 1.1, 3)}
    found = path.sweep(**axes, composer=composer)
    light = composer.compose(path).run(delta=axes["delta"][:, None], phi=axes["phi"])
    assert {found[name].dtype.name for name in found.data_vars} == {dtype}
    np.testing.assert_array_equal(found.S1.values, light.S1)
    np.testing.assert_array_equal(found.DoP.values, light.dop)
    assert (found.attrs["engine"], found.attrs["dtype"]) == (engine, dtype)


def test_longdouble_stays_longdouble():
    composer = op.Composer(dtype="longdouble")
    found = op.load_preset("malus").sweep(angle=[0.1, 0.2], composer=composer)
    assert found.S0.dtype == found.DoP.dtype == np.longdouble


def test_a_tolerance_is_that_of_the_plan():
    composer = op.Composer(tolerance=0.01)
    path = op.load_preset("npgr026").reading("intensity")
    deltas = np.linspace(0.0, 0.2, 5)
    found = path.sweep(delta=deltas, composer=composer)
    np.testing.assert_array_equal(found.S0.values, composer.compose(path).run(delta=deltas).S0)
    assert found.attrs["tolerance"] == 0.01


def test_what_a_detector_does_not_read_is_nan_and_the_dataset_says_so():
    path = op.load_preset("npgr026").reading("intensity")
    found = path.sweep(delta=[0.1, 0.2], phi=[0.3, 0.4, 0.5])
    assert np.isnan(found.S1.values).all()
    assert np.isnan(found.DoP.values).all()
    assert not np.isnan(found.S0.values).any()
    assert found.attrs["unread"] == "NaN: S1, S2 and S3 at E, which reads S0"


def test_faint_light_has_its_polarisation_and_the_logarithm_of_its_intensity():
    path = op.Source(1.0, [1, 0.5, 0, 0])
    for _ in range(3):
        path = path >> op.Attenuator(op.Parameter("t"))
    found = (path >> op.Detector()).sweep(t=[1e-200, 0.5])
    assert found.S0.values.tolist() == [0.0, 0.125]
    np.testing.assert_allclose(found.DoP.values, 0.5, rtol=1e-15)
    np.testing.assert_allclose(found.log10_intensity.values, [-600.0, np.log10(0.125)], rtol=1e-14)


def test_light_that_is_not_faint_has_no_logarithm():
    assert "log10_intensity" not in op.load_preset("malus").sweep(angle=[0.1, 0.2])


def test_errors_of_the_run_come_through():
    with pytest.raises(op.ParameterError, match="delta"):
        op.load_preset("npgr026").sweep(delta=[0.1, 2.5])


def test_light_on_every_link_is_no_sweep():
    with pytest.raises(op.ParameterError, match="leave keep out"):
        op.load_preset("malus").sweep(angle=[0.1], composer=op.Composer(keep="all"))


def test_a_composer_is_a_composer():
    with pytest.raises(op.ParameterError, match="composer= takes a Composer, not 'numba'"):
        op.load_preset("malus").sweep(angle=[0.1], composer="numba")


def test_a_deep_copy_can_be_written_to_as_the_docs_say():
    found = op.load_preset("malus").sweep(angle=[0.1, 0.2])
    with pytest.raises(ValueError, match="read-only"):
        found.S0.values[0] = 0.0
    copied = found.copy(deep=True)
    for name in copied.data_vars:
        copied[name].values[0] = 0.0
        assert copied[name].values[0] == 0.0
    assert found.S0.values[0] > 0.0
