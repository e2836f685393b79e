import copy
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.kernels.catalogue import METHODS
from tables import rows

RANGES = {
    "delta": (0.0, np.pi / 2),
    "rho": (-3.0, 3.0),
    "phi": (0.0, np.pi / 2),
    "n1": (0.3, 3.0),
    "k1": (0.0, 4.0),
    "n2": (0.3, 3.0),
    "k2": (0.0, 4.0),
    "filter": (-3.0, 3.0),
    "intensity": (0.0, 100.0),
}
NPGR026 = op.load_preset("npgr026")


@st.composite
def batches(draw):
    """Values for every parameter, each a scalar or an array on one of two axes."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    shapes = {name: draw(st.sampled_from([(), (3,), (2, 1), (2, 3)])) for name in RANGES}
    return {name: rng.uniform(*RANGES[name], size=shapes[name]) for name in RANGES}


@given(values=batches())
def test_arrays_give_what_the_values_give_one_by_one(values):
    whole = NPGR026.trace(**values).stokes
    shape = np.broadcast_shapes(*(np.shape(value) for value in values.values()))
    assert whole.shape == (*shape, 4)
    spread = {name: np.broadcast_to(value, shape) for name, value in values.items()}
    for index in np.ndindex(shape):
        single = NPGR026.trace(**{name: float(value[index]) for name, value in spread.items()})
        assert single.stokes.shape == (4,)
        slack = 1e-14 * single.stokes[0]
        np.testing.assert_allclose(whole[index], single.stokes, rtol=0, atol=slack)


@given(values=batches())
def test_light_is_never_negative_nor_more_than_polarised(values):
    light = NPGR026.trace(**values)
    assert np.all(light.intensity >= 0.0)
    assert np.all(light.intensity <= values["intensity"] * (1 + 1e-14))
    # Light that a reflection next to Brewster's angle has all but extinguished has a
    # degree of polarisation that its S2 and S3 cannot keep in Stokes components.
    bright = light.intensity > 1e-6 * values["intensity"]
    assert np.all(light.dop[bright] <= 1.0 + 1e-9)


@given(values=batches())
def test_the_mueller_matrix_times_the_source_is_the_light(values):
    mueller = NPGR026.mueller(**values)
    source = np.multiply.outer(values["intensity"], np.eye(4)[0])[..., np.newaxis]
    traced = NPGR026.trace(**values).stokes
    np.testing.assert_allclose((mueller.matrix @ source)[..., 0], traced, rtol=0, atol=1e-12)


def test_a_filter_that_is_left_out_is_not_in_the_plan_and_words_stand_beside_angles():
    together = NPGR026.trace(filter=["none", "horizontal", 0.3]).stokes
    for stokes, single in zip(together, ["none", "horizontal", 0.3], strict=True):
        np.testing.assert_allclose(stokes, NPGR026.trace(filter=single).stokes, rtol=1e-15)
    bound = op.load_preset("npgr026", filter="none").compose()
    assert not any(step.label.startswith("P.") for step in bound.program.steps)
    assert any(step.label.startswith("P.") for step in NPGR026.compose().program.steps)


def test_a_plan_is_composed_once_and_evaluates_equal_values_once():
    plan = op.Composer().compose(NPGR026)
    assert NPGR026.compose() is NPGR026.compose()
    assert plan == NPGR026.compose()
    one, other = plan.run(delta=0.1).stokes, plan.run(delta=1.0).stokes
    assert not np.allclose(one, other)
    assert np.array_equal(plan.run(delta=0.1).stokes, one)
    path = op.load_preset("fresnel-rhomb")
    kernels = [e.kernel.name for e in path.compose().program.evaluations]
    assert len([name for name in kernels if name.startswith("Fresnel reflection")]) == 1
    assert len(path.compose().program.steps) > len(kernels)
    path = op.load_preset("malus")
    copy.copy(path).add("more", op.Source())
    assert "more" not in path.graph


def test_components_that_are_not_read_are_nan():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(stokes=[1.0, 0.5, 0.5, 0.5]))
    split = path.add("split", op.BeamSplitter())
    lamp >> split
    path.add("a", op.Detector(reads="intensity"))
    path.add("b", op.Detector(reads="linear"))
    path.connect("split.reflected", "a.in")
    path.connect("split.transmitted", "b.in")
    lights = path.trace_all()
    np.testing.assert_array_equal(lights["a"].stokes, [0.5, np.nan, np.nan, np.nan])
    np.testing.assert_array_equal(lights["b"].stokes, [0.5, 0.25, 0.25, np.nan])


def test_float32_is_carried_as_float32():
    plan = op.Composer(dtype="float32").compose(NPGR026)
    light = plan.run(filter="diagonal")
    assert light.stokes.dtype == np.float32
    np.testing.assert_allclose(light.stokes, NPGR026.trace(filter="diagonal").stokes, rtol=1e-4)


@rows(
    "values, messages",
    [
        ({"detla": 1.0}, ["'detla'", "did you mean 'delta'"]),
        ({"delta": 2.0}, ["'delta'", "114.59", "0 deg .. 90 deg"]),
        ({"k1": -1.0}, ["'k1' is -1", "0 or more"]),
        ({"n1": np.nan}, ["'n1' is nan"]),
        ({"n1": [1.0, np.inf]}, ["'n1' is inf"]),
        ({"filter": "horizntal"}, ["horizntal", "did you mean 'horizontal'"]),
        ({"delta": np.ones(3), "rho": np.ones(4)}, ["delta (3,)", "rho (4,)"]),
        ({"delta": 1j}, ["delta", "complex"]),
        ({"delta": "48"}, ["'delta': '48' has no unit"]),
        ({"delta": 10**400}, ["'delta'", "must be a number"]),
        ({"n1": 10**20, "phi": 2.0}, ["'phi'"]),
        ({"delta": "48 dge"}, ["'dge'", "did you mean 'deg'"]),
        ({"delta": None, "phi": True}, ["'phi' must be a number"]),
        ({"delta": [[1.0], [1.0, 2.0]]}, ["'delta'", "unequal"]),
        ({"detla": 1.0, "n1": -1.0, "phi": 9.0}, ["'detla'", "'n1'", "'phi'", "3 faults"]),
    ],
)
def test_values_that_cannot_be_are_refused_all_at_once(values, messages):
    with pytest.raises(op.ParameterError) as error:
        NPGR026.trace(**values)
    for message in messages:
        assert message in str(error.value)


def test_light_that_is_not_finite_is_refused():
    plan = op.Composer(method="textbook").compose(NPGR026)
    with pytest.raises(op.ParameterError, match="not finite in float64 by method 'textbook'"):
        plan.run(n1=1e200)
    assert NPGR026.trace(n1=1e200).intensity > 0.0


def test_a_parameter_must_be_given_once_and_may_have_any_name():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(op.Parameter("self")))
    lamp >> path.add("eye", op.Detector())
    assert path.trace(self=2.0).intensity == 2.0
    assert path.compose().run(self=3.0).intensity == 3.0
    assert path.bind(self=3.0).trace().intensity == 3.0
    with pytest.raises(op.ParameterError, match="'delta' is bound to 48 deg"):
        op.load_preset("npgr026", delta="48 deg").trace(delta=0.1)
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(op.Parameter("I")))
    lamp >> path.add("eye", op.Detector())
    with pytest.raises(op.ParameterError, match="'I' has no value"):
        path.trace()
    assert path.trace(I=2.0).intensity == 2.0


@rows("copied", [copy.copy, copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x))])
def test_paths_and_plans_can_be_copied_and_pickled(copied):
    path = op.load_preset("npgr026", filter=[0.1, "none"])
    assert copied(path) == path
    assert copied(path.compose()) == path.compose()
    np.testing.assert_array_equal(copied(path.compose()).run().stokes, path.trace().stokes)


def test_several_detectors_are_read_by_name():
    path = op.PathGraph()
    split = path.add("split", op.BeamSplitter(0.25))
    path.add("lamp", op.Source()) >> split
    path.add("a", op.Detector())
    path.add("b", op.Dump())
    path.add("c", op.Detector())
    path.add("split2", op.BeamSplitter(0.5))
    path.connect("split.reflected", "a.in")
    path.connect("split.transmitted", "split2.in")
    path.connect("split2.reflected", "b.in")
    path.connect("split2.transmitted", "c.in")
    with pytest.raises(op.ParameterError, match=r"2 detectors \(a, c\); use trace_all"):
        path.trace()
    lights = path.trace_all()
    assert {name: float(light.intensity) for name, light in lights.items()} == {
        "a": 0.25,
        "b": 0.375,
        "c": 0.375,
    }
    assert path.mueller("lamp", "b").matrix[0, 0] == 0.375
    with pytest.raises(op.ParameterError, match="'lmap' does not exist; did you mean 'lamp'"):
        path.mueller("lmap", "a")


@rows("option", ["method", "model", "engine", "dtype"])
def test_unknown_composer_options_are_refused(option):
    with pytest.raises(op.ComposerError, match=f"{option} 'x' is unknown"):
        op.Composer(**{option: "x"})


def test_the_explanation_lists_steps_readings_and_what_leaves():
    text = NPGR026.compose().explain()
    assert text.splitlines()[0].startswith("1 source, 1 detector, 6 steps; method stable")
    for part in ("X2.reflected -> X1.in", "E reads S0, S1, S2, S3", "X1.transmitted", "delta"):
        assert part in text


@rows("method", METHODS)
@rows("composing", ["stokes", "jones"])
def test_plans_of_every_method_can_be_pickled(method, composing):
    plan = op.Composer(method=method, composing=composing).compose(NPGR026)
    again = pickle.loads(pickle.dumps(plan))
    assert again.run() == plan.run()


@rows("composing", ["jonse", "mueller", None])
def test_an_unknown_way_of_composing_is_refused(composing):
    with pytest.raises(op.ComposerError, match="composing"):
        op.Composer(composing=composing)


LONG = np.finfo(np.longdouble).eps < np.finfo(np.float64).eps


@pytest.mark.skipif(not LONG, reason="longdouble is float64 here")
def test_longdouble_is_computed_in_longdouble():
    light = op.Composer(dtype="longdouble").compose(NPGR026).run()
    assert light.stokes.dtype == np.longdouble
    np.testing.assert_allclose(light.stokes.astype(float), NPGR026.trace().stokes, rtol=1e-14)


@pytest.mark.skipif(LONG, reason="longdouble is more than float64 here")
def test_a_longdouble_that_is_no_more_than_float64_is_refused():
    with pytest.raises(op.ComposerError, match="no more than float64"):
        op.Composer(dtype="longdouble")


@rows("odd", [np.eye(2), [1], {}, 1.5, object(), op.CosSin(1.0, 0.0)])
@rows("option", ["method", "model", "engine", "dtype", "composing", "keep"])
def test_an_option_that_is_no_word_is_refused(option, odd):
    with pytest.raises(op.ComposerError, match=f"{option} .* is unknown"):
        op.Composer(**{option: odd})


@rows("odd", [np.eye(2), "two", None, [1], 2.5, -1])
def test_what_is_no_number_of_paths_is_refused(odd):
    plan = op.load_preset("malus").compose()
    with pytest.raises(op.ParameterError, match="number of paths must be a whole number"):
        plan.engine_for(odd)


@rows("odd", [np.eye(2), [1], {}, 1.5])
def test_what_is_no_name_of_a_source_or_detector_is_refused(odd):
    plan = op.load_preset("malus").compose()
    for names in [(odd,), (None, odd)]:
        with pytest.raises(op.ParameterError, match="values are given by name: mueller"):
            plan.mueller(*names, angle=0.3)


@rows("odd", [np.eye(3), "words", 0.5, None])
def test_a_case_of_what_is_no_mapping_is_refused(odd):
    with pytest.raises(op.ParameterError, match="values of a case must be a mapping"):
        op.Case(odd)
    with pytest.raises(op.ParameterError, match="published of a case must be a mapping"):
        op.Case({}, odd)
    with pytest.raises(op.ParameterError, match="published at eye must be numbers"):
        op.Case({}, {"eye": odd if isinstance(odd, str) else "words"})


@rows("give", ["threads", "tolerance", "limit", "count", "size"])
def test_a_duration_is_no_number(give):
    days = np.timedelta64(3, "D")
    path = op.load_preset("malus")
    with pytest.raises(op.OptipathError, match="must be a"):
        {
            "threads": lambda: op.Composer(threads=days),
            "tolerance": lambda: op.Composer(tolerance=days),
            "limit": lambda: path.paths(limit=days),
            "count": lambda: path.compose().engine_for(days),
            "size": lambda: next(path.compose().stream(days, angle=[0.1])),
        }[give]()


def test_the_ends_of_a_matrix_are_given_by_place():
    path = op.load_preset("glass-slab")
    told = r"detector is given by its place: .* such as mueller\('lamp', 'transmitted'\)"
    with pytest.raises(op.ParameterError, match=told):
        path.mueller(detector="transmitted")
