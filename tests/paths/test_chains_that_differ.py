"""Batches of chains that differ in events and lengths, some of which cannot be and are masked."""

import numpy as np
import pytest

import optipath as op
from batches_of_chains import quickly, random_batch
from chains import ENGINES, MATERIALS, random_chains
from histories import coherency, stokes_in
from optipath.lab.accuracy.path_reference import exact_batch
from tables import rows
from wired import read_back

# What is compiled for eight events takes some seconds; two have all that there is.
MOST = {engine: 8 if engine == "numpy" else 2 for engine in ENGINES}
COMPILED_MORE_THAN_ONCE = [
    "numpy",
    *(pytest.param(engine, marks=pytest.mark.slow) for engine in ENGINES[1:]),
]
DOWN = [[0.0, 0, 3], [0, 0, 2], [0, 0, 1], [0, 0, 0]]
CORNER = [[0.0, 0, 3], [0, 0, 0], [0, 4, 0]]
GLASS, GOLD = 1.5, op.Material(0.2, 3.0)


def path_of(batch, points=None, **others):
    points = batch.points if points is None else points
    others = {"events": batch.texts, "ids": batch.ids, **others}
    return op.path_from_vertices(points, batch.palette, **others)


def assert_alone(light, chain, alone, slack=1e-14):
    """Whether some chains of a batch are what they are alone."""
    np.testing.assert_allclose(light.stokes[chain], alone.stokes, rtol=0, atol=slack)
    np.testing.assert_allclose(light.frame.x[chain], alone.frame.x, rtol=0, atol=1e-14)
    np.testing.assert_array_equal(light.frame.z[chain], alone.frame.z)


@pytest.mark.parametrize(
    ("engine", "most"),
    [
        ("numpy", 8),
        # Light of masked batches by these engines is that of NumPy, by a quicker test.
        pytest.param("numba", 8, marks=pytest.mark.slow),
        pytest.param("jax", 3, marks=pytest.mark.slow),
    ],
)
def test_histories_that_differ_equal_a_reference_without_frames(engine, most):
    batch = random_batch(1, most)
    with quickly(engine):
        light = op.Composer(engine=engine).compose(path_of(batch)).run()
    expected = stokes_in(batch.expected, light.frame)
    np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=1e-13)
    np.testing.assert_allclose(light.intensity, expected[..., 0], rtol=1e-11)


@pytest.mark.parametrize("engine", COMPILED_MORE_THAN_ONCE)
def test_each_chain_of_a_batch_is_what_it_is_alone_and_with_points_given_later(engine):
    batch = random_batch(2, MOST[engine], several=8, each=2)
    with quickly(engine):
        light = op.Composer(engine=engine).compose(path_of(batch)).run()
    for chain in range(len(batch.texts)):
        points, media, text = batch.alone(chain)
        assert_alone(light, chain, op.path_from_vertices(points, media, events=text).trace())
    batch = random_batch(3, 2)
    known = path_of(batch).trace()
    plan = op.Composer(engine=engine).compose(path_of(batch, op.Parameter("points")))
    with quickly(engine):
        given = plan.run(points=batch.points)
    np.testing.assert_allclose(given.stokes, known.stokes, rtol=0, atol=1e-14)
    np.testing.assert_array_equal(given.frame.x, known.frame.x)


def test_texts_letters_and_lengths_say_the_same():
    batch = random_batch(4, 3, several=6, each=2)
    expected = path_of(batch).trace().stokes
    letters = {"events": batch.letters, "lengths": batch.lengths}
    for given in ({"events": np.array(batch.texts)}, {"events": tuple(batch.texts)}, letters):
        np.testing.assert_array_equal(path_of(batch, **given).trace().stokes, expected)
    points = np.array([DOWN, DOWN])
    plain = op.path_from_vertices(points, [1.5, 1.0], events="TT")
    assert op.path_from_vertices(points, [1.5, 1.0], events=["TT", "TT"]) == plain
    assert op.path_from_vertices(points, [1.5, 1.0], events="TT", lengths=[2, 2]) == plain
    points = random_chains(1, 4, (40,))
    lengths = 1 + np.arange(40) % 4
    padded = points.copy()
    for chain, length in enumerate(lengths):
        padded[chain, length + 2 :] = [np.nan, 0.0, np.inf]
    light = op.path_from_vertices(padded, MATERIALS[:4], lengths=lengths).trace()
    for length in range(1, 5):
        some = lengths == length
        alone = op.path_from_vertices(points[some, : length + 2], MATERIALS[:length]).trace()
        assert_alone(light, some, alone)


def test_chains_that_end_early_have_the_media_and_digits_of_their_own():
    path = path_of(random_batch(5, 3, several=3, each=1))
    light = path.trace()
    for chain, exact in enumerate(exact_batch(path.graph)):
        numbers = [float(number) for number in exact["eye"].stokes]
        np.testing.assert_allclose(light.stokes[chain], numbers, rtol=0, atol=2e-15)
    # Into glass and back in it, against reflected at once: the second surface has another front.
    points = [[*DOWN[:3], [0, 0, 5]], [*DOWN[:2], [0, 0, 5], [0, 0, 0]]]
    path = op.path_from_vertices(points, [1.5, 1.2], events=["TR", "RR"])
    into, once = 4 * 1.5 / 2.5**2, (0.5 / 2.5) ** 2
    expected = [into * (0.3 / 2.7) ** 2, once * (0.2 / 2.2) ** 2]
    np.testing.assert_allclose(path.trace().intensity, expected, rtol=1e-14)


def test_ids_choose_the_material_of_each_vertex_and_may_be_whole_numbers_of_any_type():
    points = random_chains(2, 2, (5,))
    ids = np.array([[0, 1], [1, 2], [2, 2], [2, 0], [0, 0]])
    palette = [1.5, op.Material(0.2, 3.4), 1.12 + 2j]
    path = op.path_from_vertices(points, palette, ids=ids)
    assert [path.element(f"vertex{place}").kind for place in (1, 2)] == ["specular-vertex"] * 2
    light = path.trace()
    for chain, several in enumerate(ids):
        alone = op.path_from_vertices(points[chain], [palette[i] for i in several]).trace()
        np.testing.assert_allclose(light.stokes[chain], alone.stokes, rtol=0, atol=1e-15)
    lengths, palette = np.array([1, 2, 2, 1, 2]), [1.5, 1.2, 1.33]
    expected = op.path_from_vertices(points, palette, ids=ids, lengths=lengths)
    for kind in (np.uint8, np.int32, np.float64):
        given = {"ids": ids.astype(kind), "lengths": lengths.astype(kind)}
        assert op.path_from_vertices(points, palette, **given) == expected


def slopes_of_intensity(points, text, media, step=1e-4):
    """Of a chain alone, by differences of the frame-free reference to sixth order."""
    moved = np.eye(points.size).reshape(-1, *points.shape) * step

    def intensity(far):
        return coherency(points + far * moved, text, media).trace(axis1=-2, axis2=-1).real

    near = [intensity(far) - intensity(-far) for far in (1, 2, 3)]
    return ((45 * near[0] - 9 * near[1] + near[2]) / (60 * step)).reshape(points.shape)


def test_slopes_are_those_of_each_chain_and_of_nothing_behind_its_end(jax):
    batch = random_batch(5, 2, several=6, each=1)
    points = batch.points.copy()
    padded = np.isnan(points)
    points[padded] = np.resize([np.nan] * 3 + [0.0] * 3 + [1e300] * 3, padded.sum())
    plan = path_of(batch, op.Parameter("points")).compose()
    with quickly("jax"):
        slopes = jax.grad(lambda p: plan.run(points=p).intensity.sum())(jax.numpy.asarray(points))
    np.testing.assert_array_equal(slopes[padded], 0.0)
    assert np.all(np.isfinite(slopes))
    for chain, length in enumerate(batch.lengths):
        own, media, text = batch.alone(chain)
        expected = slopes_of_intensity(own, text, media)
        np.testing.assert_allclose(slopes[chain, : length + 2], expected, rtol=1e-8, atol=1e-10)
    points = [DOWN[:3], [*DOWN[:2], DOWN[0]], [*DOWN[:2], [np.nan] * 3]]
    vertex = op.Vertex(op.Parameter("n"), points, place=1, events=[[1.0], [0.0], [2.0]])
    plan = (op.Source() >> vertex >> op.Detector()).compose()
    with quickly("jax"):
        _, slopes = jax.jvp(lambda n: plan.run(n=n).intensity, (1.5,), (1.0,))
    through, back = 4 * (1 - 1.5**2) / 2.5**4, 4 * 0.5 / 2.5**3
    np.testing.assert_allclose(slopes, [through, back, 0.0], rtol=1e-12)


@rows("bad", ["refuse", "mask"])
def test_histories_can_be_written_to_a_file_and_read_again(bad, tmp_path):
    path = path_of(random_batch(8, 3, several=3, each=2), bad=bad)
    again = read_back(path, tmp_path)
    np.testing.assert_array_equal(again.trace().stokes, path.trace().stokes)


def spoilt(batch):
    """Points and ids, of which chains 1, 2 and 3 cannot be for one reason each; which those are."""
    points, ids = batch.points.copy(), batch.ids.copy()
    points[1, 1] = points[1, 0]
    points[2, 0, 1] = np.inf
    absorbing = next(i for i, index in enumerate(batch.palette) if isinstance(index, complex))
    through = next(i for i, text in enumerate(batch.texts) if i > 2 and "T" in text)
    ids[through, batch.texts[through].index("T")] = absorbing
    bent = next(i for i, text in enumerate(batch.texts) if i > through and text[0] == "T")
    points[bent, 2:] += 2.0 * (points[bent, 0] - points[bent, 1])
    return points, ids, [1, 2, through, bent]


@pytest.mark.parametrize(
    ("engine", "later"),
    [
        ("numpy", False),
        *((engine, True) for engine in ENGINES),
        *(pytest.param(engine, False, marks=pytest.mark.slow) for engine in ENGINES[1:]),
    ],
)
def test_chains_that_cannot_be_have_no_light_and_all_others_are_as_they_were(engine, later):
    batch = random_batch(11, 2)
    points, ids, bad = spoilt(batch)
    expected = path_of(batch).trace()
    path = path_of(batch, op.Parameter("points") if later else points, ids=ids, bad="mask")
    plan = op.Composer(engine=engine).compose(path)
    with quickly(engine):
        light = plan.run(**({"points": points} if later else {}))
    masked = np.isin(np.arange(len(points)), bad)
    assert np.all(np.isnan(light.stokes[masked]))
    np.testing.assert_allclose(light.stokes[~masked], expected.stokes[~masked], rtol=0, atol=1e-14)
    np.testing.assert_array_equal(light.frame.x[~masked], expected.frame.x[~masked])


@pytest.mark.parametrize("engine", COMPILED_MORE_THAN_ONCE)
def test_the_matrix_of_a_chain_that_cannot_be_is_not_a_number_either(engine):
    points = np.array([DOWN, [DOWN[0], DOWN[0], *DOWN[2:]]])
    path = op.path_from_vertices(points, [GLASS, 1.0], events=["R", "TT"], bad="mask")
    with quickly(engine):
        matrices = op.Composer(engine=engine).compose(path).mueller().matrix
    np.testing.assert_array_equal(np.isnan(matrices), [np.full((4, 4), bad) for bad in (0, 1)])


def test_masked_light_has_no_figures_in_batches_plans_and_streams():
    points = np.array([CORNER, [CORNER[0], CORNER[0], CORNER[2]]])
    light = op.path_from_vertices(points, [GLASS], bad="mask").trace()
    alone = op.path_from_vertices(CORNER, [GLASS]).trace()
    assert np.isnan(light.intensity.sum())
    assert np.nansum(light.intensity) == alone.intensity
    for figure in (light.dop, light.aop, light.normalized, light.in_frame(light.frame).stokes):
        assert np.all(np.isnan(figure[1]))
    np.testing.assert_array_equal(light.to("mitsuba")[0], alone.to("mitsuba"))
    assert light[0] == alone
    plan, refusing = (
        op.path_from_vertices(op.Parameter("points"), [GLASS], bad=bad).compose()
        for bad in ("mask", "refuse")
    )
    assert np.all(np.isnan(plan.run(points=[CORNER[0], CORNER[0], CORNER[2]]).stokes))
    assert plan.run(points=CORNER) == op.path_from_vertices(CORNER, [GLASS]).trace()
    points = np.array([CORNER] * 5)
    points[3, 1] = np.nan
    parts = [light.intensity for _, light in plan.stream(2, points=points)]
    np.testing.assert_array_equal(np.isnan(np.concatenate(parts)), np.arange(5) == 3)
    with pytest.raises(op.ParameterError, match="finite"):
        refusing.run(points=np.full((3, 3), np.nan))
    light = op.path_from_vertices(
        DOWN, [GLASS, GOLD], ids=[[0, 0], [1, 0]], events="TT", bad="mask"
    ).trace()
    np.testing.assert_array_equal(np.isnan(light.intensity), [False, True])


def test_normals_that_contradict_a_chain_mask_it_and_those_behind_its_end_are_not_looked_at():
    points = np.array([CORNER, CORNER, CORNER])
    normals = np.array([[[0.0, 1, 1]], [[0.0, 1, 0]], [[0.0, -2, -2]]])
    light = op.path_from_vertices(points, [GLASS], normals, bad="mask").trace()
    np.testing.assert_array_equal(np.isnan(light.intensity), [False, True, False])
    with pytest.raises(op.PathError, match="vertex 1 of chain 1 is off the bisector"):
        op.path_from_vertices(points, [GLASS], normals)
    points = np.array([DOWN, DOWN])
    points[1, 2:] = [[0, 0, 5], [np.nan] * 3]
    normals = [[[0, 0, 1], [0, 0, 2]], [[0, 0, 1], [np.nan, 0, 0]]]
    path = op.path_from_vertices(points, [GLASS, 1.0], normals, events=["TT", "R"])
    np.testing.assert_allclose(path.trace().intensity, [0.96**2, 0.04], rtol=1e-14)
    normals[0][1] = [0, 1, 1]
    with pytest.raises(op.PathError, match="vertex 2 of chain 0 is off the one that refracts"):
        op.path_from_vertices(points, [GLASS, 1.0], normals, events=["TT", "R"])


BENT = [[0.0, 0, 1], [0, 0, 0], [0, 2, -1], [0, 4, -2]]


@rows(
    "points, given, messages",
    [
        ([DOWN] * 2, {"events": ["TT", "T"], "ids": [[0, 1], [1, 0]]}, ["absorbs, k = 3", "bad="]),
        (
            *([BENT] * 2, {"events": ["TR", "T"], "ids": [[0, 0]] * 2}),
            ["light is turned by 63.4", "bad='mask'", "of 2 paths"],
        ),
        ([DOWN, [[np.nan] * 3, *DOWN[1:]]], {"events": ["TT", "T"]}, ["not finite", "at 1, of 2"]),
        ([DOWN, [*DOWN[:2], *DOWN[1:3]]], {"events": ["RR", "TT"]}, ["legs before and behind"]),
    ],
)
def test_the_first_chain_that_cannot_be_is_named_with_its_cure(points, given, messages):
    palette = [GLASS, GOLD] if "ids" in given else [GLASS, 1.0]
    with pytest.raises(op.PathError) as known:
        op.path_from_vertices(points, palette, **given)
    op.path_from_vertices(points, palette, **given, bad="mask")
    plan, errors = op.path_from_vertices(op.Parameter("p"), palette, **given), [known]
    if "absorbs" not in messages[0]:
        with pytest.raises(op.ParameterError) as later:
            plan.trace(p=points)
        errors.append(later)
    for error in errors:
        for message in messages:
            assert message in str(error.value)


TURNED = [[0.0, 0, 3], [0, 0, 0], [0, 1, -1], [0, 2, -2]]
NO_LEG = [[0.0, 0, 3], [0, 0, 3], [0, 0, 0], [0, 0, -1]]


@rows("method", ["stable", "compensated", "amplitude", "textbook"])
@rows("composing", ["stokes", "jones"])
@rows("reading", ["full", "intensity"])
@rows("events", ["TT", "TR", "RR", "RT"])
def test_a_chain_that_cannot_be_gives_no_light_whatever_is_read(events, reading, composing, method):
    points = NO_LEG if events[0] == "R" else TURNED
    path = op.path_from_vertices(points, [1.2, 1.2], events=events, bad="mask")
    path = path if reading == "full" else path.reading(reading)
    light = op.Composer(method=method, composing=composing).compose(path).run()
    assert np.isnan(light.intensity)


@pytest.mark.parametrize("engine", ENGINES)
def test_batches_of_chains_that_cannot_be_give_no_light_whatever_is_read(engine):
    points = np.array([TURNED] * 300)[:, :3]
    path = op.path_from_vertices(points, [1.0], events="T", bad="mask").reading("intensity")
    assert np.all(np.isnan(op.Composer(engine=engine).compose(path).run().intensity))


@rows("composing", ["stokes", "jones"])
@rows("index", [1.0, 1.2])
def test_points_that_come_with_the_run_and_turn_light_too_far_are_refused(index, composing):
    path = op.path_from_vertices(op.Parameter("points"), [index], events="T")
    plan = op.Composer(composing=composing).compose(path.reading("intensity"))
    with pytest.raises(op.OptipathError, match="light is turned by 45 deg at 'vertex1'"):
        plan.run(points=TURNED[:3])
