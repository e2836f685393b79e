"""Engines against each other, and against steps taken one by one."""

import pickle
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import optipath as op
from optipath.engines.code_cache import CODE
from optipath.lab.bench import random_values
from optipath.lab.path_reference import exact_lights
from paths import chain
from tables import rows, slow, slow_except

METAL = {"n1": 1.12, "k1": 2.16, "n2": 0.608, "k2": 2.12}
FILTERED = {**METAL, "filter": "horizontal"}
PATH = op.load_preset("npgr026", **METAL)
JONES = {"composing": "jones"}
engines = rows("engine", ["numpy", "numba"])


def angles(rng, count, dtype="float64"):
    spans = {"delta": (0, np.pi / 2), "rho": (-6, 6), "phi": (0, np.pi / 2)}
    return {name: rng.uniform(*span, count).astype(dtype) for name, span in spans.items()}


def step_by_step(path, values, **options):
    """Return the light of batches that are too small to be compiled for."""
    plan = op.Composer(engine="numpy", **options).compose(path)
    starts = range(0, len(values["delta"]), 1000)
    cut = ({n: value[start : start + 1000] for n, value in values.items()} for start in starts)
    return np.concatenate([plan.run(**part).stokes for part in cut])


def off(found, expected):
    return np.max(np.abs(found - expected) / np.maximum(expected[..., :1], 1e-300))


@pytest.mark.parametrize(
    ("engine", "options", "values"),
    [
        *[("numpy", {}, values) for values in ({}, METAL, FILTERED)],
        *[("numpy", JONES, {}), ("numpy", JONES, METAL), ("numba", {}, FILTERED)],
        *[slow(("numba", {}, {})), slow(("numba", JONES, METAL))],
        *[("numpy", {"method": m}, METAL) for m in ("compensated", "amplitude", "textbook")],
        *[slow(("numba", {"method": m}, METAL)) for m in ("compensated", "textbook")],
    ],
)
def test_an_engine_gives_what_the_steps_give_by_every_method(rng, engine, options, values):
    path, given = op.load_preset("npgr026", **values), angles(rng, 3000)
    found = op.Composer(engine=engine, **options).compose(path).run(**given).stokes
    limit = 1e-12 if "method" in options else 1e-14
    assert off(found, step_by_step(path, given, **options)) < limit


@pytest.mark.parametrize("engine", ["numpy", slow("numba")])
def test_components_are_right_to_50_digits_as_far_as_the_angles_allow_and_so_are_matrices(
    rng, engine
):
    given, plan = angles(rng, 2000), op.Composer(engine=engine).compose(PATH)
    found = plan.run(**given).stokes
    for place in range(0, 2000, 100):
        bound = PATH.bind(**{name: float(value[place]) for name, value in given.items()})
        light = exact_lights(bound)["E"]
        for off_by, exact, condition in zip(
            found[place] - light.stokes, light.stokes, light.conditions, strict=True
        ):
            allowed = 60 * np.finfo(float).eps * (1 + float(condition))
            assert abs(float(off_by)) <= allowed * max(abs(float(exact)), 1e-300)
    few = {name: value[:50] for name, value in given.items()}
    expected = op.Composer(engine="numpy").compose(PATH).mueller(**few).matrix
    found = plan.mueller(**given).matrix
    assert found.shape == (2000, 4, 4)
    np.testing.assert_allclose(found[:50], expected, rtol=0, atol=2e-15)


@pytest.mark.parametrize(
    ("engine", "kind"),
    [
        *[(e, "float64") for e in ("numpy", "numba")],
        ("numpy", "float32"),
        slow(("numba", "float32")),
    ],
)
def test_float32_is_float32_from_arrays_of_either_precision(rng, engine, kind):
    given = angles(rng, 2000, kind)
    found = op.Composer(engine=engine, dtype="float32").compose(PATH).run(**given).stokes
    assert found.dtype == np.float32
    exact = step_by_step(PATH, {n: v.astype("float64") for n, v in given.items()})
    assert off(found, exact) < 3e-6


# A window is a pile of plates, and compiled sooner.
PRESETS = [(engine, name) for engine in ("numpy", "numba") for name in op.preset_names()]
PRESETS.remove(("numba", "pile-of-plates"))
PRESETS.remove(("numba", "absorbing-pile"))
QUICK = ("crystal-plate", "faraday-isolator")


@pytest.mark.parametrize(
    ("engine", "name"),
    slow_except([(e, n) for e, n in PRESETS if e == "numpy" or n in QUICK], PRESETS),
)
def test_every_preset_runs_by_every_engine(engine, name):
    path = op.load_preset(name)
    plan = op.Composer(engine=engine).compose(path)
    given = random_values(plan, 1500)
    found = plan.run_all(**given)
    few = op.Composer(engine="numpy").compose(path).run_all(**{n: v[:9] for n, v in given.items()})
    for end, light in few.items():
        scale = np.nanmax(np.abs(light.stokes))
        np.testing.assert_allclose(found[end].stokes[:9], light.stokes, rtol=0, atol=4e-15 * scale)


SHAPES = [((40, 1), (1, 50)), ((0,), ()), ((2000,), ()), ((50, 40), (40,)), ((1,), (1,))]


@pytest.mark.parametrize(
    ("engine", "several"), [("numpy", SHAPES), *[slow(("numba", [shapes])) for shapes in SHAPES]]
)
def test_arrays_broadcast_as_in_numpy(rng, engine, several):
    plan = op.Composer(engine=engine).compose(PATH)
    for shapes in several:
        given = dict(zip(("delta", "phi"), (rng.uniform(0.1, 1.5, s) for s in shapes), strict=True))
        found, batch = plan.run(**given, rho=0.3).stokes, np.broadcast_shapes(*shapes)
        assert found.shape == (*batch, 4)
        for index in list(np.ndindex(batch))[::97]:
            one = {n: float(np.broadcast_to(v, batch)[index]) for n, v in given.items()}
            assert off(found[index], PATH.trace(**one, rho=0.3).stokes) < 4e-15


@engines
def test_arrays_may_lie_in_memory_as_they_like_and_hold_words(rng, engine):
    turning = [op.Retarder(op.Parameter("delta"), op.Parameter("phi"))]
    path = chain([*turning, op.Rotator(op.Parameter("rho"))], [1.0, 0.6, 0.0, 0.8])
    plan, given = op.Composer(engine=engine).compose(path), angles(rng, 4000)
    expected = plan.run(**given).stokes
    strided = {name: np.repeat(value, 2)[::2] for name, value in given.items()}
    backwards = {name: value[::-1] for name, value in given.items()}
    np.testing.assert_array_equal(plan.run(**strided).stokes, expected)
    np.testing.assert_array_equal(plan.run(**backwards).stokes, expected[::-1])
    path = op.load_preset("npgr026", **METAL, delta=0.7, phi=0.4)
    words = np.tile(np.array(["none", "horizontal", "diagonal"], dtype=object), 1000)
    found = op.Composer(engine=engine).compose(path).run(filter=words).stokes
    for place, word in enumerate(words[:3]):
        assert off(found[place], path.trace(filter=word).stokes) < 4e-15


@pytest.mark.parametrize("engine", ["numpy", slow("numba")])
def test_arrays_may_hold_cosines_and_sines(rng, engine):
    plan, given = op.Composer(engine=engine).compose(PATH), angles(rng, 4000)
    pairs = {name: op.CosSin(np.cos(value), np.sin(value)) for name, value in given.items()}
    few = {name: op.CosSin(pair.cos[:7], pair.sin[:7]) for name, pair in pairs.items()}
    steps, stepped = step_by_step(PATH, given), op.Composer(engine="numpy").compose(PATH)
    assert off(plan.run(**pairs).stokes, steps) < 1e-14
    assert off(stepped.run(**few).stokes, steps[:7]) < 1e-14


@engines
def test_light_that_is_too_faint_is_done_with_more_care(engine):
    elements = [op.Attenuator(op.Parameter("t"))] * 4
    plan = op.Composer(engine=engine).compose(chain(elements, [1.0, 0.6, 0.0, 0.8]))
    given = np.where(np.arange(2000) % 500 == 7, 1e-75, 0.5)
    light = plan.run(t=given)
    np.testing.assert_allclose(light.log10_intensity[[7, 8]], [-300.0, 4 * np.log10(0.5)])
    np.testing.assert_allclose(light.normalized[7], [1.0, 0.6, 0.0, 0.8], rtol=0, atol=1e-14)


@engines
@rows("bad", [2.0, -0.1, np.nan, np.inf])
def test_one_bad_value_among_many_is_refused_in_the_same_words(engine, bad):
    path = chain([op.Attenuator(op.Parameter("t"))])
    values = np.full(3000, 0.5)
    values[1234] = bad
    with pytest.raises(op.errors.ParameterError) as one:
        path.trace(t=bad)
    with pytest.raises(op.errors.ParameterError) as many:
        op.Composer(engine=engine).compose(path).run(t=values)
    # Of several, it is told which one is no number.
    assert str(many.value).replace(" at 1234", "") == str(one.value)


@pytest.mark.parametrize("engine", ["numpy", slow("numba")])
@rows("count", [1, 2000])
def test_a_cosine_that_no_angle_can_have_keeps_its_digits(engine, count):
    path = op.load_preset("npgr026", n1=1.5)
    grazing = op.CosSin(np.full(count, 1e-40), np.ones(count))
    light = op.Composer(engine=engine).compose(path).mueller(delta=grazing, phi=0.0)
    # 1 - R_s is 4 cos / sqrt(n^2 - 1) there, far below a rounding of 1; R_s - R_p is not.
    found = (light.matrix[..., 0, 1] / light.matrix[..., 0, 0])[0]
    expected = 2.0 * (1.5**2 - 1.0) / np.sqrt(1.5**2 - 1.0) * 1e-40
    np.testing.assert_allclose(abs(found), expected, rtol=1e-12)


def test_cosines_and_sines_that_cannot_be_are_refused():
    plan = op.Composer(engine="numpy").compose(op.load_preset("npgr026"))
    for name, pair, message in (
        ("delta", (1.0, 1.0), "belong to no angle"),
        ("delta", (np.full(3000, 0.5), 0.5), "belong to no angle"),
        ("delta", (-1.0, 0.0), "outside its range"),
        ("n1", (1.0, 0.0), "is no angle"),
    ):
        with pytest.raises(op.errors.ParameterError, match=message):
            plan.run(**{name: op.CosSin(*pair)})


@engines
def test_threads_change_nothing(rng, engine):
    given = angles(rng, 200_000)
    composers = (op.Composer(engine=engine, threads=count) for count in (1, 3))
    alone, shared = (composer.compose(PATH).run(**given).stokes for composer in composers)
    np.testing.assert_array_equal(alone, shared)


def test_a_plan_may_be_run_from_several_threads_and_pickled(rng):
    plan = op.Composer(engine="numpy").compose(PATH)
    given = [angles(rng, 3000) for _ in range(8)]
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda values: plan.run(**values).stokes, given))
    np.testing.assert_array_equal(found, [plan.run(**values).stokes for values in given])
    again = pickle.loads(pickle.dumps(plan))
    assert again == plan
    np.testing.assert_array_equal(again.run(**given[0]).stokes, found[0])


def test_the_first_runs_of_one_path_and_the_later_ones_are_equal_and_touch_no_array():
    plan, called = PATH.compose(), []
    lights = [plan.run(delta=0.7, rho=0.4, phi=0.2).stokes for _ in range(8)]
    np.testing.assert_array_equal(lights, [lights[0]] * 8)

    def note(_, event, function):
        if event == "c_call" and "numpy" in str(getattr(function, "__module__", "")):
            called.append(function)

    sys.setprofile(note)
    try:
        plan.run(delta=0.3, rho=0.4, phi=0.2)
    finally:
        sys.setprofile(None)
    assert called == []


def test_parts_engines_and_threads_that_cannot_be_are_refused():
    plan = op.load_preset("malus").compose()
    for size in (0, 1.5, True):
        with pytest.raises(op.errors.ParameterError, match="a whole number of 1 or more"):
            next(plan.stream(size, angle=[0.1, 0.2]))
    for options, message in (
        ({"engine": "fortran"}, "'fortran' is unknown"),
        ({"threads": 0}, "threads must be a whole number of 1 or more"),
        ({"threads": True}, "threads must be"),
    ):
        with pytest.raises(op.errors.ComposerError, match=message):
            op.Composer(**options)


def test_what_runs_a_batch_can_be_asked_and_numba_takes_nothing_too_long():
    plan = op.load_preset("npgr026").compose()
    ran = [plan.engine_for(count) for count in (1, 10, 100, 100_000)]
    assert ran == ["floats", "floats", "numpy", "numpy"]
    assert plan.engine_for(10**8) == plan.engine == "numba"
    assert "paths, numba" in plan.explain()
    stepped = op.Composer(engine="numpy").compose(op.load_preset("npgr026"))
    assert (stepped.engine_for(10), stepped.engine_for(5000)) == ("numpy, step by step", "numpy")
    turning = [op.Polarizer(op.Parameter("a")), op.Retarder(op.Parameter("b"), 0.3)]
    long = op.Composer(engine="numba").compose(chain(turning * 110))
    assert long.engine == "numpy"
    assert "step by step" in long.explain()
    angles = [op.Parameter(f"a{i}") for i in range(20)]
    plan = chain([op.Interface(0.2 + 3j, angle, azimuth=0.3) for angle in angles]).compose()
    assert plan.engine_for(10**8) == plan.engine == "numpy"
    assert "paths, numba" not in plan.explain()
    given = {f"a{i}": np.linspace(0.1, 1.0, 70_000) for i in range(20)}
    few = {name: values[:5] for name, values in given.items()}
    np.testing.assert_allclose(plan.run(**given).stokes[:5], plan.run(**few).stokes, rtol=1e-13)


COMPILES = """
import logging, sys
logging.basicConfig(stream=sys.stdout, format="%(message)s")
import numpy as np, optipath as op
plan = op.Composer(engine="numba").compose(op.load_preset("malus"))
print(plan.run(angle=np.linspace(0, 1, 50)).stokes.sum())
"""


def printed(code=COMPILES):
    """What a process of its own prints."""
    command = [sys.executable, "-c", code]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def test_compiled_code_survives_in_a_second_process(tmp_path, monkeypatch):
    monkeypatch.setenv("OPTIPATH_CACHE", str(tmp_path / "cache"))
    # What memory holds is compiled anew, and kept.
    monkeypatch.setattr(CODE, "_functions", type(CODE._functions)())
    plan = op.Composer(engine="numba").compose(op.load_preset("malus"))
    total = plan.run(angle=np.linspace(0, 1, 50)).stokes.sum()
    assert printed().splitlines() == [str(total)]


@pytest.mark.slow
def test_compiled_code_does_not_survive_if_it_is_damaged_or_has_no_place(tmp_path, monkeypatch):
    monkeypatch.setenv("OPTIPATH_CACHE", str(tmp_path / "cache"))
    first, second = printed(), printed()
    assert "compiling" in first
    assert second.splitlines() == first.splitlines()[-1:]
    # One flipped bit, and it is compiled anew.
    (file,) = (tmp_path / "cache").iterdir()
    damaged = bytearray(file.read_bytes())
    damaged[-100] ^= 4
    file.write_bytes(damaged)
    again = printed()
    assert "damaged" in again
    assert again.splitlines()[-1] == first.splitlines()[-1]
    # Without a place to keep it, it is compiled all the same.
    monkeypatch.setenv("OPTIPATH_CACHE", str(file))
    assert printed().count("not kept") == 1


def test_a_matrix_has_the_rows_that_its_detector_reads():
    path = op.PathGraph()
    path.add("lamp", op.Source()) >> path.add("filter", op.Polarizer(op.Parameter("a")))
    path.add("dim", op.Detector(reads="intensity"))
    path["filter"] >> path.add("full", op.Detector())
    path.connect("filter.out", "dim.in", tap=True)
    plan = op.Composer(engine="numpy").compose(path)
    given = np.linspace(0, 1, 2000)
    dim, full = (plan.mueller("lamp", end, a=given).matrix for end in ("dim", "full"))
    assert np.all(np.isnan(dim[:, 1:]))
    assert np.all(np.isfinite(full))


@engines
def test_streams_cut_what_elements_hold(engine):
    elements = [op.Polarizer(np.linspace(0, 1, 4000)), op.Attenuator(op.Parameter("t"))]
    plan = op.Composer(engine=engine).compose(chain(elements, [1.0, 0.6, 0.0, 0.8]))
    # One path in ten is too faint for floats, so that parts of parts are cut too.
    given = np.where(np.arange(4000) % 10, 0.5, 1e-295)
    whole = plan.run(t=given)
    parts = [part.light.normalized for part in plan.stream(1500, t=given)]
    np.testing.assert_array_equal(np.concatenate(parts), whole.normalized)


@engines
@rows("dtype", ["float64", "float32"])
def test_no_rounding_brings_a_value_into_its_range(engine, dtype):
    path = chain([op.Attenuator(op.Parameter("t", minimum=0.1, maximum=1.0))])
    plan = op.Composer(engine=engine, dtype=dtype).compose(path)
    for bad in (0.0, 0.1 - 1e-12, 1.0 + 1e-12):
        for given in (bad, np.full(2000, bad)):
            with pytest.raises(op.errors.ParameterError, match="outside its range"):
                plan.run(t=given)


@engines
def test_numbers_of_any_sort_are_taken_and_none_are_empty_light(engine):
    plan = op.Composer(engine=engine).compose(op.load_preset("malus"))
    expected = plan.run(angle=np.ones(2000)).stokes[0]
    for dtype in (">f8", "longdouble", "float16", "int64"):
        found = plan.run(angle=np.ones(2000).astype(dtype)).stokes[0]
        np.testing.assert_array_equal(found, expected)
    plan = op.Composer(engine=engine).compose(chain([], op.Parameter("s")))
    assert plan.run(s=np.empty((0, 4))).stokes.shape == (0, 4)


def test_where_numba_may_not_compile_numpy_runs_which_is_told_once(tmp_path, monkeypatch):
    monkeypatch.setenv("OPTIPATH_CACHE", str(tmp_path))
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")
    told, total = printed(f"{COMPILES}plan.run(angle=np.ones((9, 9)))").splitlines()
    plan = op.Composer(engine="numpy").compose(op.load_preset("malus"))
    assert "NUMBA_DISABLE_JIT" in told
    assert float(total) == plan.run(angle=np.linspace(0, 1, 50)).stokes.sum()


class Branching(op.Element, kind="test-branching"):
    """An element that asks what its numbers are, and computes with NumPy itself."""

    angle: op.fields.Angle = 0.0

    @staticmethod
    def mueller_rows(xp, angle):
        del xp
        c, s = np.cos(2 * angle), np.sin(2 * angle)
        s = s if np.all(c > -2.0) else -s
        return (1, 0, 0, 0), (0, c, -s, 0), (0, s, c, 0), (0, 0, 0, 1)


@rows("engine", ["auto", "numpy", "numba"])
def test_an_element_that_cannot_be_compiled_is_run_step_by_step(engine):
    path = chain([Branching(op.Parameter("angle"))], [1.0, 1.0, 0.0, 0.0])
    plan = op.Composer(engine=engine).compose(path)
    expected = [1.0, np.cos(0.6), np.sin(0.6), 0.0]
    np.testing.assert_allclose(plan.run(angle=np.full(2000, 0.3)).stokes[-1], expected)
    for _ in range(6):
        np.testing.assert_allclose(plan.run(angle=0.3).stokes, expected)
    assert plan.engine == "numpy"
    assert "compute with xp alone" in plan.explain()
