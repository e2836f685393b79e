import copy
import json
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.kernels.catalog import METHODS
from paths import chain
from tables import rows, slow_except
from wired import wired

RANGES = {
    **dict.fromkeys(("delta", "phi"), (0.0, np.pi / 2)),
    **dict.fromkeys(("rho", "filter"), (-3.0, 3.0)),
    **dict.fromkeys(("n1", "n2"), (0.3, 3.0)),
    **dict.fromkeys(("k1", "k2"), (0.0, 4.0)),
    "intensity": (0.0, 100.0),
}
NPGR026 = op.load_preset("npgr026")
MALUS = op.load_preset("malus").compose()


@st.composite
def batches(draw):
    """Values for every parameter, each a scalar or an array on one of two axes."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    shapes = {name: draw(st.sampled_from([(), (3,), (2, 1), (2, 3)])) for name in RANGES}
    return {name: rng.uniform(*RANGES[name], size=shapes[name]) for name in RANGES}


@given(values=batches())
def test_light_is_never_negative_nor_more_than_polarised_and_is_matrix_times_source(values):
    light = NPGR026.trace(**values)
    assert np.all(light.intensity >= 0.0)
    assert np.all(light.intensity <= values["intensity"] * (1 + 1e-14))
    # Light that a reflection next to Brewster's angle has all but extinguished has a
    # degree of polarisation that its S2 and S3 cannot keep in Stokes components.
    bright = light.intensity > 1e-6 * values["intensity"]
    assert np.all(light.dop[bright] <= 1.0 + 1e-9)
    expected = NPGR026.mueller(**values).matrix[..., 0] * values["intensity"][..., np.newaxis]
    np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=1e-12)


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
    program = op.load_preset("fresnel-rhomb").compose().program
    kernels = [evaluation.kernel.name for evaluation in program.evaluations]
    assert sum(name.startswith("Fresnel reflection") for name in kernels) == 1
    assert len(program.steps) > len(kernels)
    path = op.load_preset("malus")
    copy.copy(path).add("more", op.Source())
    assert "more" not in path.graph
    # Of a long path, light takes few steps, and its matrix all.
    plates = [op.Retarder(op.Parameter("d"), op.Parameter(f"t{i % 5}")) for i in range(100)]
    plan = chain([*plates, op.Polarizer(0.1)], reads="intensity").compose()
    assert len(plan.program.steps) < 64 < len(plan.whole.steps)
    assert plan.engine_for(70_000) != plan.answers.whole.engine_for(70_000)


def test_several_detectors_are_read_by_name_and_what_is_not_read_is_nan():
    split, eyes = op.BeamSplitter(), {n: op.Detector(n) for n in ("intensity", "linear")}
    nodes = {"lamp": op.Source(stokes=[1.0, 0.5, 0.5, 0.5]), "split": split, **eyes}
    links = "lamp -> split, split.reflected -> intensity, split.transmitted -> linear"
    lights = wired(nodes, links).trace_all()
    np.testing.assert_array_equal(lights["intensity"].stokes, [0.5, np.nan, np.nan, np.nan])
    np.testing.assert_array_equal(lights["linear"].stokes, [0.5, 0.25, 0.25, np.nan])
    splitters = {"split": op.BeamSplitter(0.25), "split2": op.BeamSplitter(0.5)}
    ends = {"a": op.Detector(), "b": op.Dump(), "c": op.Detector()}
    links = "lamp -> split, split.reflected -> a, split.transmitted -> split2, "
    links += "split2.reflected -> b, split2.transmitted -> c"
    path = wired({"lamp": op.Source(), **splitters, **ends}, links)
    with pytest.raises(op.errors.ParameterError, match=r"2 detectors \(a, c\); use trace_all"):
        path.trace()
    found = {name: float(light.intensity) for name, light in path.trace_all().items()}
    assert found == {"a": 0.25, "b": 0.375, "c": 0.375}
    assert path.mueller("lamp", "b").matrix[0, 0] == 0.375
    with pytest.raises(
        op.errors.ParameterError, match="'lmap' does not exist; did you mean 'lamp'"
    ):
        path.mueller("lmap", "a")


def test_every_precision_is_carried_or_refused_where_longdouble_is_no_more_than_float64():
    expected = NPGR026.trace(filter="diagonal").stokes
    for dtype, rtol in (("float32", 1e-4), ("longdouble", 1e-14)):
        if np.finfo(dtype).eps == np.finfo(np.float64).eps:
            with pytest.raises(op.errors.ComposerError, match="no more than float64"):
                op.Composer(dtype=dtype)
            continue
        found = op.Composer(dtype=dtype).compose(NPGR026).run(filter="diagonal").stokes
        assert found.dtype == dtype
        np.testing.assert_allclose(found.astype(float), expected, rtol=rtol)


@rows(
    "values, messages",
    [
        ({"delta": 2.0}, ["'delta'", "114.59", "0 deg .. 90 deg"]),
        ({"n1": [1.0, np.inf]}, ["'n1' is inf"]),
        ({"filter": "horizntal"}, ["horizntal", "did you mean 'horizontal'"]),
        ({"delta": np.ones(3), "rho": np.ones(4)}, ["delta (3,)", "rho (4,)"]),
        ({"delta": 1j}, ["delta", "complex"]),
        ({"delta": "48"}, ["'delta': '48' has no unit"]),
        ({"delta": 10**400}, ["'delta'", "must be a number"]),
        ({"n1": 10**20, "phi": 2.0}, ["'phi'"]),
        ({"delta": None, "phi": True}, ["'phi' must be a number"]),
        ({"delta": [[1.0], [1.0, 2.0]]}, ["'delta'", "unequal"]),
        ({"detla": 1, "n1": -1, "phi": 9}, ["did you mean 'delta'", "'n1'", "'phi'", "3 faults"]),
    ],
)
def test_values_that_cannot_be_are_refused_all_at_once(values, messages):
    with pytest.raises(op.errors.ParameterError) as error:
        NPGR026.trace(**values)
    for message in messages:
        assert message in str(error.value)


def test_light_that_is_not_finite_is_refused():
    plan = op.Composer(method="textbook").compose(NPGR026)
    with pytest.raises(
        op.errors.ParameterError, match="not finite in float64 by method 'textbook'"
    ):
        plan.run(n1=1e200)
    assert NPGR026.trace(n1=1e200).intensity > 0.0


def test_a_parameter_must_be_given_once_and_may_have_any_name():
    path = op.Source(op.Parameter("self")) >> op.Detector()
    assert path.trace(self=2.0).intensity == 2.0
    assert path.compose().run(self=3.0).intensity == 3.0
    assert path.bind(self=3.0).trace().intensity == 3.0
    with pytest.raises(op.errors.ParameterError, match="'self' has no value"):
        path.trace()
    with pytest.raises(op.errors.ParameterError, match="'delta' is bound to 48 deg"):
        op.load_preset("npgr026", delta="48 deg").trace(delta=0.1)


@rows("copied", [copy.copy, copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x))])
def test_paths_and_plans_of_every_method_can_be_copied_and_pickled(copied):
    path = op.load_preset("npgr026", filter=[0.1, "none"])
    assert copied(path) == path
    assert copied(path.compose()) == path.compose()
    for method in METHODS:
        for composing in ("stokes", "jones"):
            plan = op.Composer(method=method, composing=composing).compose(path)
            assert copied(plan).run() == plan.run()


NO_NAME, NO_COUNT = "values are given by name: mueller", "paths must be a whole number"
DAYS = np.timedelta64(3, "D")


@rows(
    "ask, message",
    [
        *((lambda odd=odd: MALUS.engine_for(odd), NO_COUNT) for odd in (np.eye(2), None, 2.5, -1)),
        *((lambda odd=odd: MALUS.mueller(odd, angle=0.3), NO_NAME) for odd in (np.eye(2), [1], {})),
        (lambda: MALUS.mueller(None, 1.5, angle=0.3), NO_NAME),
        (
            lambda: op.load_preset("glass-slab").mueller(detector="transmitted"),
            r"detector is given by its place: .* such as mueller\('lamp', 'transmitted'\)",
        ),
        (lambda: op.Case(np.eye(3)), "values of a case must be a mapping"),
        (lambda: op.Case({}, "words"), "published of a case must be a mapping"),
        (lambda: op.Case({}, {"eye": "words"}), "published at eye must be numbers"),
        # A duration is no number.
        (lambda: op.Composer(threads=DAYS), "must be a"),
        (lambda: op.load_preset("malus").paths(limit=DAYS), "must be a"),
        (lambda: MALUS.engine_for(DAYS), "must be a"),
        (lambda: next(MALUS.stream(DAYS, angle=[0.1])), "must be a"),
        *(
            (lambda odd=odd: op.Composer(tolerance=odd), "tolerance must be a number between 0 and")
            for odd in (0, 1.0, "0.1", True, np.nan)
        ),
        (lambda: op.Composer(tolerance=0.1, model="full"), "takes no tolerance"),
        (lambda: op.Composer(tolerance=0.1, composing="jones"), "takes no tolerance"),
        *(
            (lambda option=option, odd=odd: op.Composer(**{option: odd}), f"{option} .* is unknown")
            for option in ("method", "model", "engine", "dtype", "composing", "keep")
            for odd in ("x", np.eye(2), [1], {}, 1.5)
        ),
    ],
)
def test_what_cannot_be_asked_of_plans_cases_and_composers_is_refused(ask, message):
    with pytest.raises(op.OptipathError, match=message):
        ask()


def test_the_explanation_is_short_and_tells_steps_readings_and_what_is_left_out():
    elements = [op.Interface(1.5, op.Parameter(f"a{i}"), azimuth=0.1) for i in range(500)]
    assert len(chain(elements).compose().explain().splitlines()) < 120
    text = NPGR026.compose().explain()
    assert text.splitlines()[0].startswith("1 source, 1 detector, 6 steps; method stable")
    for part in ("X2.reflected -> X1.in", "E reads S0, S1, S2, S3", "X1.transmitted", "delta"):
        assert part in text
    path = chain([op.Retarder(op.Parameter("r")), op.Interface(1.5, 0.7)], reads="intensity")
    text = path.compose().explain()
    assert "left out, since it changes nothing alive: retarder at 'e0.out'" in text
    assert "cheaper at 'e1.reflected'" in text
    assert "certificate" in chain([op.Attenuator(np.ones(0))]).compose().explain()


def test_live_components_and_operations_fewer_than_those_of_the_full_composition_are_told():
    path = chain([op.Polarizer(0.3), op.Retarder(1.0), op.Polarizer(op.Parameter("a"))])
    found = path.compose().explanation()
    live = {step.label: step.live for step in found.steps}
    assert live["lamp.out"] == ("S0",)
    # S3 is made by the retarder, and nothing behind it asks for it.
    assert all("S3" not in components for components in live.values())
    assert found.manner["model"] == "linear"
    glass = {"n1": 1.5, "k1": 0.0, "n2": 1.5, "k2": 0.0, "filter": "none"}
    plan = op.load_preset("npgr026", **glass).reading("intensity").compose()
    counts = plan.explanation().operations
    assert counts["plan"]["all"] < 0.6 * counts["full"]["all"]
    assert counts["plan"]["divide"] < counts["full"]["divide"]
    full = op.Composer(model="full").compose(op.load_preset("npgr026")).explanation().operations
    assert full["plan"] == full["full"]


def test_a_certificate_stands_there_where_all_values_are_known_however_faint_light_is():
    panes = op.Interface(1.5, 0.7), op.Interface(1.5, op.Parameter("a", 0.7))
    path = chain(panes, reads="intensity")
    bounds = path.compose().explanation().certificate["bounds"]["eye"]
    A, B, _, _ = op.fresnel_reflection(1.5, np.cos(0.7), np.sin(0.7))
    assert bounds["upper"] == pytest.approx(1 + (B / A) ** 2)
    assert bounds["lower"] == pytest.approx(1 - (B / A) ** 2)
    opened = chain([op.Interface(1.5, op.Parameter("a"))]).compose().explain()
    assert "certificate: depends on a" in opened
    for intensity in (0.0, 1e-300):
        lamp, dim = op.Source(op.Parameter("i", intensity)), op.Attenuator(1e-100)
        path = lamp >> dim >> op.Interface(1.5, 0.3) >> op.Detector()
        found = path.compose().explanation()
        (bounds,) = found.certificate["bounds"].values()
        assert bounds["upper"] == pytest.approx(1.0)
        json.dumps(found.as_dict(), allow_nan=False)
    element = op.MuellerElement(np.diag([1.0, 3.0, 1.0, 1.0]), physical=False)
    path = chain([element], [1.0, 0.1, 0.0, 0.0])
    found = path.compose().explanation()
    assert "none, since the Mueller matrix of 'e0' is unphysical" in str(found)
    json.dumps(found.as_dict(), allow_nan=False)


@rows("angle", [0.7, op.Parameter("a", 0.7)])
def test_a_model_that_is_exact_by_itself_stands_beside_no_certificate(angle):
    panes = [op.Interface(1.5, angle), op.Interface(1.5, 0.7, azimuth=1.5)]
    plan = op.Composer(tolerance=0.1).compose(chain(panes, reads="intensity"))
    text, is_constant = plan.explain(), angle == 0.7
    assert ("model scalar is exact" in text) is is_constant
    assert ("S0 is 0." in text) is not is_constant
    assert ("certificate: not needed, since model scalar is exact" in text) is is_constant
    # What was multiplied is more than the scalar model, which the certificate is of.
    assert plan.certificate().lower < 0.7


# Light that goes round, or through a stack, has no one Jones vector; a medium that does several
# things at once and a rough sample have no Jones matrix here.
STACKS = {"coated-metal", "pile-of-plates", "absorbing-pile", "sky-and-window"}
WITHOUT_JONES = {"glass-slab", "dichroic-sheet", "ellipsometer-rough", *STACKS}
EXPLAINED = [(name, options) for name in op.preset_names() for options in ({}, {"model": "full"})]
WITH_JONES = sorted({*op.preset_names()} - WITHOUT_JONES)
EXPLAINED += [(name, {"composing": "jones"}) for name in WITH_JONES]


@pytest.mark.parametrize(("name", "options"), slow_except(EXPLAINED[::5], EXPLAINED))
def test_every_preset_is_explained_as_json_too(name, options):
    found = op.Composer(**options).compose(op.load_preset(name)).explanation()
    text = json.dumps(found.as_dict(), allow_nan=False)
    assert json.loads(text)["counts"]["step"] == len(found.steps)
    assert len(str(found).splitlines()) < 60


@rows("name", sorted(WITHOUT_JONES))
def test_presets_without_a_jones_vector_are_refused_one(name):
    with pytest.raises(op.errors.ComposerError, match=r"no Jones .*composing='stokes'"):
        op.Composer(composing="jones").compose(op.load_preset(name))


@rows(
    "reads, model, words",
    [
        ("stokes", "auto", "certificates are for intensities, and more is read by eye"),
        ("intensity", "linear", "not needed, since model linear is exact"),
        ("intensity", "auto", "model scalar where its certificate is within it, sp elsewhere"),
    ],
)
def test_what_becomes_of_a_tolerance_is_told(reads, model, words):
    path = op.load_preset("malus").reading(reads)
    assert words in op.Composer(model=model, tolerance=0.1).compose(path).explain()


def test_plans_of_traced_constants_are_explained_and_have_matrices():
    jax = pytest.importorskip("jax")

    def entry(retardance):
        elements = [op.Attenuator(0.5), op.Retarder(retardance)]
        plan = op.Composer(dtype="float32").compose(chain(elements, [1.0, 0.5, 0.0, 0.0]))
        assert "values that JAX traces" in plan.explain()
        return plan.mueller().matrix[0, 0]

    assert jax.grad(entry)(0.3) == 0.0
