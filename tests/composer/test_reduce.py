from dataclasses import replace

import numpy as np
import pytest

import optipath as op
from optipath.composer.flow import Flow, evaluated
from optipath.composer.reduce import MODELS, passes_for
from paths import chain
from random_paths import Draw
from tables import rows, slow


def assert_equal_lights(found, expected, path, seed):
    """Lights are equal but for turns that are merged.

    Those round otherwise, which light nearly extinguished behind a polariser can see: its own
    S0 says nothing of that then.
    """
    sources = [e for _, e in path.graph.nodes(data="element") if isinstance(e, op.Source)]
    brightest = sum(float(source.intensity) for source in sources)
    for name, light in expected.items():
        off = np.abs(found[name].stokes - light.stokes)
        assert off.shape == light.stokes.shape
        np.testing.assert_array_equal(np.isnan(off), np.isnan(light.stokes))
        slack = 1e-14 * light.stokes[..., :1] + 1e-16 * brightest
        assert np.all((off <= slack) | np.isnan(off)), f"seed {seed}"


# Some random loops keep nearly all of their light.
@pytest.mark.filterwarnings("ignore::optipath.errors.LoopWarning")
@pytest.mark.parametrize("seeds", [range(60, 120), slow([*range(60), *range(120, 2000)])])
def test_every_reduction_equals_the_full_composition(seeds):
    for seed in seeds:
        draw = Draw(seed)
        path = draw.path(loops=seed % 3 == 0)
        full = op.Composer(model="full").compose(path).run_all(**draw.values)
        assert_equal_lights(path.trace_all(**draw.values), full, path, seed)


PASSES = passes_for("auto", "stokes", "float64")[0]


@rows("one", [*PASSES.values()])
def test_each_pass_by_itself_leaves_the_lights_equal(one):
    told = 0
    for seed in range(1000, 1020):
        draw = Draw(seed)
        path = draw.path(loops=seed % 3 == 1)
        plan = op.Composer(model="full").compose(path)
        flow = Flow(plan.draft)
        told += len(one(flow))
        program = flow.program()
        reduction = replace(plan.reduction, program=program, unreduced=False)
        found = replace(plan, reduction=reduction).run_all(**draw.values)
        assert_equal_lights(found, plan.run_all(**draw.values), path, seed)
    assert told, "no path had anything to be reduced"


def test_every_step_as_it_stands_goes_through_no_pass_and_constants_keep_their_digits():
    assert passes_for("full", "stokes", "float64")[0] == {}
    path = chain([op.Rotator(0.1), op.Rotator(0.2), op.Attenuator(1.0)])
    plan = op.Composer(model="full").compose(path)
    assert plan.program.steps == plan.whole.steps
    assert not plan.reduction.folded
    left = passes_for("auto", "stokes", "longdouble")[0]
    assert [name for name in PASSES if name not in left] == ["multiplied constants"]
    # sin^2 of a turn of 1e-6 from the crossed position.
    path = chain([op.Polarizer(0.0), op.Rotator(np.pi / 2 - 1e-6), op.Polarizer(0.0)])
    assert path.trace().intensity == pytest.approx(0.5 * np.sin(1e-6) ** 2, rel=1e-9)


def test_constants_that_are_evaluated_together_have_the_bits_of_each():
    rng = np.random.default_rng(3)
    medium = op.Medium(0.1, 2.0, dichroism=0.5, retardance=0.3, rotation=0.2, depolarization=0.4)
    elements = [op.Interface(1.5, 0.3), op.Interface(0.2 + 3j, 0.3), op.Polarizer(0.3), medium]
    elements += [op.LayerStack([2.0, 1.4, 1.5], 0.3), op.Retarder(0.7, 0.3), op.Rotator(0.3)]
    for element in elements:
        for coupling in element.couplings():
            for operation in coupling.operations:
                kernel = operation.kernel.by_method("stable")
                count = len(operation.arguments)
                rows_of = rng.uniform(0.0, 1.0, (40, count)).tolist()
                alone = [evaluated(kernel, [row])[0] for row in rows_of]
                assert evaluated(kernel, rows_of) == alone, kernel.name


VALUES = dict(zip("ab", np.random.default_rng(5).uniform(0.0, 1.5, (2, 50)), strict=True))
A, B, METAL = op.Parameter("a"), op.Parameter("b"), 0.2 + 3j


@rows(
    "elements, state, reads, model",
    [
        ([op.Retarder(A, 0.3)], (1.0, 0.0, 0.0, 0.0), "stokes", "scalar"),
        ([op.Interface(1.5, 0.7)], (1.0, 0.0, 0.0, 0.0), "intensity", "scalar"),
        ([op.Interface(1.5, B)] * 2, (1.0, 0.0, 0.0, 0.0), "intensity", "sp"),
        ([op.Interface(METAL, B)], (1.0, 0.0, 0.0, 0.0), "stokes", "sp"),
        ([op.Rotator(A)], (1.0, 0.5, 0.0, 0.0), "stokes", "linear"),
        ([op.Polarizer(A)], (1.0, 0.5, 0.3, 0.5), "intensity", "linear"),
        ([op.Interface(1.5, 0.7, azimuth=0.3)] * 2, (1.0, 0.0, 0.0, 0.0), "stokes", "linear"),
        ([op.Interface(METAL, 0.7, azimuth=0.3)] * 2, (1.0, 0.0, 0.0, 0.0), "stokes", "full"),
        ([op.Retarder(1.0, 0.3), op.Polarizer(0.2)], (1.0, 0.0, 0.0, 0.5), "intensity", "full"),
    ],
)
def test_the_smallest_exact_model_is_found(elements, state, reads, model):
    path = chain(elements, state, reads=reads)
    assert path.compose().model == model
    values = {name: VALUES[name] for name in path.compose().inputs.open}
    reference = op.Composer(model="full").compose(path).run(**values).stokes
    smaller = MODELS.index(model)
    for name in MODELS[smaller:]:
        found = op.Composer(model=name).compose(path).run(**values).stokes
        np.testing.assert_allclose(found, reference, rtol=2e-15, atol=1e-15)
    for name in MODELS[:smaller]:
        with pytest.raises(
            op.errors.ComposerError, match=f"'{name}' is not exact .* '{model}' or 'auto'"
        ):
            op.Composer(model=name).compose(path)


def test_where_the_same_operations_remain_the_bits_are_the_same():
    path = op.load_preset("npgr026", n1=1.12, k1=2.16, n2=0.608, k2=2.12, filter=0.3)
    values = dict(zip(("delta", "phi"), VALUES.values(), strict=True))
    full = op.Composer(model="full").compose(path).run(**values)
    np.testing.assert_array_equal(path.trace(**values).stokes, full.stokes)


def test_a_scene_without_s3_carries_none_and_says_so():
    plan = chain([op.Polarizer(0.3), op.Interface(1.5, B), op.Rotator(0.2)]).compose()
    assert (plan.model, max(plan.program.counts)) == ("linear", 3)
    assert "S3 nowhere" in plan.explain()
    assert all("S3" not in step.live for step in plan.explanation().steps)
    assert plan.run(b=0.7).stokes[3] == 0.0


@rows(
    "elements, labels",
    [
        ([op.Rotator(0.1), op.Rotator(0.2)], ["e0.out, e1.out"]),
        ([op.Rotator(A), op.Rotator(-A)], []),
        ([op.Attenuator(0.5), op.Attenuator(0.5)], ["e0.out, e1.out"]),
        ([op.Attenuator(1.0), op.Retarder(0.0), op.Rotator(0.0)], []),
        ([op.Retarder(1.0, 0.3)], ["e0.out"]),
        ([op.Polarizer(0.0), op.Polarizer(0.0, transmittance=0.5)], ["e0.out, e1.out"]),
    ],
)
def test_what_is_constant_is_multiplied_and_what_undoes_itself_vanishes(elements, labels):
    path = chain(elements, [1.0, 0.2, 0.3, 0.4])
    plan = path.compose()
    assert [step.label for step in plan.program.steps[1:]] == labels
    values = {"a": 0.7} if "a" in plan.inputs.open else {}
    full = op.Composer(model="full").compose(path).run(**values)
    np.testing.assert_allclose(plan.run(**values).stokes, full.stokes, rtol=0, atol=1e-15)


def test_equal_arrays_are_evaluated_once_in_every_precision():
    angles = np.array([0.3, 0.5])
    path = chain([op.Interface(1.5, angles), op.Interface(1.5, angles.copy(), azimuth=0.2)])
    kernels = [evaluation.kernel.name for evaluation in path.compose().program.evaluations]
    assert sum(name.startswith("Fresnel") for name in kernels) == 1
    path = chain([op.Interface(1.5, 0.5, outside=op.Parameter("x"))])
    media = np.linspace(1.0, 1.2, 2000)
    found = op.Composer(dtype="float32", engine="numpy").compose(path).run(x=media).stokes
    np.testing.assert_allclose(found, path.trace(x=media).stokes, rtol=1e-5, atol=1e-8)


def test_a_mueller_matrix_is_whole_though_light_is_reduced():
    path = chain([op.Retarder(A, 0.3), op.Interface(METAL, 0.7)])
    assert path.compose().model == "sp"
    wanted = op.Interface(METAL, 0.7).mueller().matrix @ op.Retarder(0.4, 0.3).mueller().matrix
    np.testing.assert_allclose(path.mueller(a=0.4).matrix, wanted, rtol=0, atol=1e-15)


def test_values_that_nothing_needs_must_be_given_and_are_checked():
    plan = chain([op.Retarder(op.Parameter("a", maximum=1.0)), op.Attenuator(0.5)]).compose()
    assert plan.model == "scalar"
    with pytest.raises(op.errors.ParameterError, match="'a'"):
        plan.run(a=2.0)
    for _ in range(6):
        assert plan.run(a=np.linspace(0, 1, 5)).stokes.shape == (5, 4)
        plan.run(a=0.1)
    with pytest.raises(op.errors.ParameterError, match="'a' has no value"):
        plan.run()


LIT = [
    (op.Polarizer(A), (1.0, 0.3, 0.4, 0.0)),
    (op.Polarizer(A), (1.0, 0.0, 0.0, 0.0)),
    (op.Retarder(A), (1.0, 0.0, 1.0, 0.0)),
]
LIT_BY = [("numpy", "float32", LIT), ("numpy", "float64", LIT), ("numba", "float32", LIT[2:])]
LIT_BY += [slow(("numba", "float32", LIT[:2])), slow(("numba", "float64", LIT))]


@pytest.mark.parametrize(("engine", "dtype", "lit"), LIT_BY)
def test_what_nobody_asked_for_is_nan_and_what_needs_no_batch_has_its_shape(engine, dtype, lit):
    for element, state in lit:
        for reads in ("intensity", "stokes"):
            path = chain([element], state, reads=reads)
            plan = op.Composer(engine=engine, dtype=dtype).compose(path)
            light = plan.run(a=np.linspace(0.0, 1.0, 5000))
            assert (light.intensity.shape, light.stokes.shape) == ((5000,), (5000, 4))
            assert light.intensity.dtype == light.stokes.dtype == dtype
            assert np.all(np.isnan(light.stokes[:, 1:]) == (reads == "intensity"))
            np.testing.assert_array_equal(light.intensity, light.stokes[:, 0])


class Half(op.Element):
    """Its second value is seen by S2 and S3 alone."""

    t: op.fields.Real = 0.5
    u: op.fields.Real = 0.1

    @staticmethod
    def mueller_rows(xp, t, u):
        return (t, 0.1, 0, 0), (0.1, t, 0, 0), (0, 0, u, 0), (0, 0, 0, u)


@rows("engine", ["numpy", "numba"])
def test_ranges_of_what_a_formula_does_not_read_are_checked_in_float32_too(engine):
    element = Half(op.Parameter("t"), op.Parameter("u", minimum=0.0, maximum=0.2))
    path = chain([element, op.Polarizer(0.0, leakage=0.1)], reads="intensity")
    plan = op.Composer(dtype="float32", engine=engine).compose(path)
    values = {"t": np.linspace(0.4, 0.5, 3000), "u": np.full(3000, 0.1)}
    plan.run(**values)
    with pytest.raises(op.errors.ParameterError, match="'u'"):
        plan.run(**values | {"u": np.full(3000, 5.0)})


class Branch(op.Element):
    """Asks what its number is."""

    a: op.fields.Real = 0.0

    @staticmethod
    def mueller_rows(xp, a):
        t = 0.5 if a > 1.0 else 0.25
        return (t, 0.1, 0, 0), (0.1, t, 0, 0), (0, 0, 0.9 * t, 0), (0, 0, 0, 0.9 * t)


@rows("model", ["auto", "full"])
def test_elements_that_ask_what_their_numbers_are_run_where_these_are_known(model):
    path = chain([Branch(2.0), op.Polarizer(op.Parameter("x"))], reads="intensity")
    plan = op.Composer(model=model).compose(path)
    assert "polarizer" in plan.explain()
    np.testing.assert_allclose(plan.run(x=np.zeros(3000)).intensity, 0.3)


def test_turns_of_more_digits_are_not_added_in_double_precision():
    if np.finfo(np.longdouble).eps == np.finfo(np.float64).eps:
        pytest.skip("longdouble is float64 here")
    path = chain([op.Rotator(0.1), op.Rotator(0.2), op.Rotator(0.7)], [1.0, 1.0, 0.0, 0.0])
    full, auto = (
        op.Composer(dtype="longdouble", model=model).compose(path).run().stokes
        for model in ("full", "auto")
    )
    np.testing.assert_allclose(auto, full, rtol=0, atol=2e-18)


@rows("reads", ["stokes", "linear", "intensity"])
@rows("angle", [np.pi / 2, 0.0, 0.3])
def test_a_polariser_halves_circular_light_however_it_stands(angle, reads):
    # Each turn is idle by itself, one since nobody needs what it does, the other since nothing
    # reaches it; without the first, something would.
    quarter = op.Retarder(np.pi / 2, np.pi / 4)
    path = chain([quarter, op.Polarizer(angle)], [1.0, 1.0, 0.0, 0.0], reads=reads)
    assert path.trace().intensity == pytest.approx(0.5, rel=1e-15)


@rows("seed", range(40))
def test_elements_at_angles_that_are_exact_give_what_every_step_gives(seed):
    rng = np.random.default_rng(seed)
    angles = [0.0, np.pi / 4, np.pi / 2, -np.pi / 4]
    some = [
        lambda: op.Retarder(rng.choice([np.pi / 2, np.pi]), rng.choice(angles)),
        lambda: op.Polarizer(rng.choice(angles)),
        lambda: op.Rotator(rng.choice(angles)),
        lambda: op.Interface(1.5, 0.5, azimuth=rng.choice(angles)),
    ]
    states = [[1.0, 0, 0, 0], [1.0, 1.0, 0, 0], [1.0, 0, 1.0, 0], [1.0, 0, 0, 1.0]]
    elements = [some[i]() for i in rng.integers(0, len(some), 5)]
    path = chain(elements, states[rng.integers(0, 4)])
    every = op.Composer(model="full").compose(path).run()
    np.testing.assert_allclose(path.trace().stokes, every.stokes, rtol=0, atol=1e-15)


@rows("model, component", [("linear", 3), ("scalar", 2)])
def test_a_model_too_small_is_refused_with_the_last_component_that_is_needed(model, component):
    plates = [op.Retarder(0.3, 0.4), op.Retarder(0.7, 1.1), op.Polarizer(0.2)]
    with pytest.raises(
        op.errors.ComposerError, match=f"not exact for this path: S{component} is alive"
    ):
        op.Composer(model=model).compose(chain(plates, (1.0, 0.5, 0.5, 0.0)))
