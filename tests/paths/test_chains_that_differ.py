"""Chains of vertices that differ in events and lengths, and those that cannot be."""

import numpy as np
import pytest

import optipath as op
from batches_of_chains import quickly, random_batch
from chains import ENGINES, MATERIALS, by_engine, random_chains
from histories import coherency, stokes_in
from optipath.lab.path_reference import exact_batch
from tables import rows, slow
from wired import read_back

# What is compiled for eight events takes some seconds; two have all that there is.
MOST = {engine: 8 if engine == "numpy" else 2 for engine in ENGINES}
DOWN = [[0.0, 0, 3], [0, 0, 2], [0, 0, 1], [0, 0, 0]]
CORNER = [[0.0, 0, 3], [0, 0, 0], [0, 4, 0]]
BENT = [[0.0, 0, 1], [0, 0, 0], [0, 2, -1], [0, 4, -2]]
TURNED = [[0.0, 0, 3], [0, 0, 0], [0, 1, -1], [0, 2, -2]]
NO_LEG = [[0.0, 0, 3], [0, 0, 3], [0, 0, 0], [0, 0, -1]]
GLASS, GOLD = 1.5, op.Material(0.2, 3.0)
INTO_GLASS = [[0.0, -1.0, 1.0], [0.0, 0.0, 0.0], [0.0, 1.0, -np.sqrt(3.5)]]  # 45 degrees, 1.5
ASIDE = [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
POINTS, PAIR = random_chains(1, 2, (3,)), [1.5, 1.2 + 2j]
N, ANGLES = op.Parameter("n"), op.VerticesByAngles((0.3, 0.4), (0.1,))
LEGS = np.diff(INTO_GLASS, axis=0) / np.linalg.norm(np.diff(INTO_GLASS, axis=0), axis=-1)[:, None]
APART = r"apart; legs are within 1e-70 .. 1e\+70"
# Light of masked batches by the slow engines is that of NumPy, by a quicker test.
MOST_AT_ONCE = [("numpy", 8), slow(("numba", 8)), slow(("jax", 3))]


def path_of(batch, points=None, **others):
    points = batch.points if points is None else points
    others = {"events": batch.texts, "ids": batch.ids, **others}
    return op.path_from_vertices(points, batch.palette, **others)


def assert_alone(light, chain, alone, slack=1e-14):
    """Whether some chains of a batch are what they are alone."""
    np.testing.assert_allclose(light.stokes[chain], alone.stokes, rtol=0, atol=slack)
    np.testing.assert_allclose(light.frame.x[chain], alone.frame.x, rtol=0, atol=1e-14)
    np.testing.assert_array_equal(light.frame.z[chain], alone.frame.z)


@pytest.mark.parametrize(("engine", "most"), MOST_AT_ONCE)
def test_histories_that_differ_equal_a_reference_without_frames(engine, most):
    batch = random_batch(1, most)
    with quickly(engine):
        light = op.Composer(engine=engine).compose(path_of(batch)).run()
    expected = stokes_in(batch.expected, light.frame)
    np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=1e-13)
    np.testing.assert_allclose(light.intensity, expected[..., 0], rtol=1e-11)


@by_engine
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


def test_texts_letters_lengths_and_files_say_the_same(tmp_path):
    for bad in ("refuse", "mask"):
        path = path_of(random_batch(8, 3, several=3, each=2), bad=bad)
        np.testing.assert_array_equal(read_back(path, tmp_path).trace().stokes, path.trace().stokes)
    batch = random_batch(4, 3, several=6, each=2)
    expected = path_of(batch).trace().stokes
    letters = {"events": batch.letters, "lengths": batch.lengths}
    for given in ({"events": np.array(batch.texts)}, {"events": tuple(batch.texts)}, letters):
        np.testing.assert_array_equal(path_of(batch, **given).trace().stokes, expected)
    points = np.array([DOWN, DOWN])
    plain = op.path_from_vertices(points, [1.5, 1.0], events="TT")
    for given in ({"events": ["TT", "TT"]}, {"events": "TT", "lengths": [2, 2]}):
        assert op.path_from_vertices(points, [1.5, 1.0], **given) == plain
    points, lengths = random_chains(1, 4, (40,)), 1 + np.arange(40) % 4
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
    for kind in (np.uint8, np.float64):
        given = {"ids": ids.astype(kind), "lengths": lengths.astype(kind)}
        assert op.path_from_vertices(points, palette, **given) == expected


def slopes_of_intensity(points, text, media, step=1e-4):
    """Of a chain alone, by differences of the frame-free reference to sixth order."""
    moved = np.eye(points.size).reshape(-1, *points.shape) * step

    def intensity(far):
        return coherency(points + far * moved, text, media).trace(axis1=-2, axis2=-1).real

    near = [intensity(far) - intensity(-far) for far in (1, 2, 3)]
    return ((45 * near[0] - 9 * near[1] + near[2]) / (60 * step)).reshape(points.shape)


@pytest.mark.slow
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


@pytest.mark.slow
def test_slopes_in_an_index_are_those_of_each_chain_and_of_nothing_behind_its_end(jax):
    given = np.array([DOWN[:3], [*DOWN[:2], DOWN[0]], [*DOWN[:2], [np.nan] * 3]])
    points = op.Parameter("points")
    vertex = op.Vertex(op.Parameter("n"), points, place=1, events=[[1.0], [0.0], [2.0]])
    plan = (op.Source() >> vertex >> op.Detector()).compose()
    with quickly("jax"):
        slopes, along = jax.grad(lambda n, p: plan.run(n=n, points=p).intensity.sum(), (0, 1))(
            np.full(3, 1.5), given
        )
    assert np.all(np.isfinite(along))
    np.testing.assert_array_equal(along[2, 2], 0.0)
    through, back = 4 * (1 - 1.5**2) / 2.5**4, 4 * 0.5 / 2.5**3
    np.testing.assert_allclose(slopes, [through, back, 0.0], rtol=1e-12)


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


@by_engine
def test_chains_that_cannot_be_have_no_light_and_all_others_are_as_they_were(engine):
    batch = random_batch(11, 2)
    points, ids, bad = spoilt(batch)
    expected, masked = path_of(batch).trace(), np.isin(np.arange(len(points)), bad)
    for given, later in ((op.Parameter("points"), {"points": points}), (points, {})):
        if engine == "numpy" or later:
            plan = op.Composer(engine=engine).compose(path_of(batch, given, ids=ids, bad="mask"))
            with quickly(engine):
                light = plan.run(**later)
            assert np.all(np.isnan(light.stokes[masked]))
            found, wanted = light.stokes[~masked], expected.stokes[~masked]
            np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-14)
            np.testing.assert_array_equal(light.frame.x[~masked], expected.frame.x[~masked])


@rows("engine", ENGINES)
def test_where_no_chain_can_be_there_is_no_light_by_any_engine(engine):
    points = np.array([TURNED] * 300)[:, :3]
    path = op.path_from_vertices(points, [1.0], events="T", bad="mask").reading("intensity")
    assert np.all(np.isnan(op.Composer(engine=engine).compose(path).run().intensity))


@by_engine
def test_masked_chains_known_when_composed_have_no_light_and_no_matrix_by_any_engine(engine):
    points = np.array([DOWN, [DOWN[0], DOWN[0], *DOWN[2:]]])
    path = op.path_from_vertices(points, [GLASS, 1.0], events=["R", "TT"], bad="mask")
    with quickly(engine):
        plan = op.Composer(engine=engine).compose(path)
        matrices, light = plan.mueller().matrix, plan.run().intensity
    # At grazing incidence everything is reflected.
    np.testing.assert_allclose(light, [1.0, np.nan], rtol=1e-14)
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
    with pytest.raises(op.errors.ParameterError, match="finite"):
        refusing.run(points=np.full((3, 3), np.nan))
    given = {"ids": [[0, 0], [1, 0]], "events": "TT", "bad": "mask"}
    light = op.path_from_vertices(DOWN, [GLASS, GOLD], **given).trace()
    np.testing.assert_array_equal(np.isnan(light.intensity), [False, True])


def test_normals_that_contradict_a_chain_mask_it_and_those_behind_its_end_are_not_looked_at():
    points = np.array([CORNER, CORNER, CORNER])
    normals = np.array([[[0.0, 1, 1]], [[0.0, 1, 0]], [[0.0, -2, -2]]])
    light = op.path_from_vertices(points, [GLASS], normals, bad="mask").trace()
    np.testing.assert_array_equal(np.isnan(light.intensity), [False, True, False])
    with pytest.raises(op.errors.PathError, match="vertex 1 of chain 1 is off the bisector"):
        op.path_from_vertices(points, [GLASS], normals)
    points = np.array([DOWN, DOWN])
    points[1, 2:] = [[0, 0, 5], [np.nan] * 3]
    normals = [[[0, 0, 1], [0, 0, 2]], [[0, 0, 1], [np.nan, 0, 0]]]
    path = op.path_from_vertices(points, [GLASS, 1.0], normals, events=["TT", "R"])
    np.testing.assert_allclose(path.trace().intensity, [0.96**2, 0.04], rtol=1e-14)
    normals[0][1] = [0, 1, 1]
    with pytest.raises(
        op.errors.PathError, match="vertex 2 of chain 0 is off the one that refracts"
    ):
        op.path_from_vertices(points, [GLASS, 1.0], normals, events=["TT", "R"])


@rows(
    "points, events, ids, message",
    [
        ([DOWN] * 2, ["TT", "T"], [[0, 1], [1, 0]], "absorbs, k = 3.*bad="),
        ([BENT] * 2, ["TR", "T"], [[0, 0]] * 2, "light is turned by 63.4.*bad='mask'.*of 2 paths"),
        ([DOWN, [[np.nan] * 3, *DOWN[1:]]], ["TT", "T"], None, "must be finite.*at 1, of 2"),
        ([DOWN, [*DOWN[:2], *DOWN[1:3]]], ["RR", "TT"], None, "must be finite, and legs"),
    ],
)
def test_the_first_chain_that_cannot_be_is_named_with_its_cure(points, events, ids, message):
    given = {"materials": [GLASS, GOLD if ids else 1.0], "events": events, "ids": ids}
    with pytest.raises(op.errors.PathError, match=message):
        op.path_from_vertices(points, **given)
    op.path_from_vertices(points, **given, bad="mask")
    if "absorbs" not in message:
        with pytest.raises(op.errors.ParameterError, match=message):
            op.path_from_vertices(op.Parameter("p"), **given).trace(p=points)


@rows("method", ["stable", "compensated", "amplitude", "textbook"])
@rows("composing", ["stokes", "jones"])
@rows("reading", ["full", "intensity"])
@rows("events", ["TT", "TR", "RR", "RT"])
def test_a_chain_that_cannot_be_gives_no_light_whatever_is_read(events, reading, composing, method):
    points = NO_LEG if events[0] == "R" else TURNED
    path = op.path_from_vertices(points, [1.2, 1.2], events=events, bad="mask")
    path = path if reading == "full" else path.reading(reading)
    assert np.isnan(op.Composer(method=method, composing=composing).compose(path).run().intensity)


@rows("composing", ["stokes", "jones"])
@rows("index", [1.0, 1.2])
def test_points_that_come_with_the_run_and_turn_light_too_far_are_refused(index, composing):
    path = op.path_from_vertices(op.Parameter("points"), [index], events="T")
    plan = op.Composer(composing=composing).compose(path.reading("intensity"))
    with pytest.raises(op.OptipathError, match="light is turned by 45 deg at 'vertex1'"):
        plan.run(points=TURNED[:3])


def of(*arguments, **others):
    return arguments, others


def bent(points=INTO_GLASS, materials=(1.5,), **given):
    return of(points, [*materials], **{"events": "T", **given})


def many(**given):
    return of(POINTS, PAIR, **given)


def chosen(second):
    return of(POINTS, [1.5, second], ids=[[0, 1]] * 3)


@rows(
    "given, messages",
    [
        (of(CORNER, []), ["materials must be a sequence"]),
        (of(CORNER, 1.5), ["materials must be a sequence", "not 1.5"]),
        (of(CORNER, [1.5, 1.5]), ["(..., m + 2, 3), m = 2 for 2 materials, not (3, 3)"]),
        (of(CORNER[:2], [-1.5]), ["m = 1 for 1 material, not (2, 3)"]),
        (of([[0, 0], [1, 1], [2, 0]], [1.5]), ["not (3, 2)"]),
        (of([[0, 0, 0], [1, 1]], [1.5]), ["rows of unequal lengths"]),
        (of([[0, 0, np.inf], *CORNER[1:]], [-1.5]), ["finite", "-1.5"]),
        (of(CORNER, ["glass"]), ["'glass'"]),
        (of(CORNER, [1.5], [[0, 0]]), ["normals must have shape (..., 1, 3), not (1, 2)"]),
        (of(CORNER, [1.5], [[0, 0, 1]] * 2), ["(..., 1, 3), not (2, 3)"]),
        (of(CORNER, [1.5], [[0, 1, 0]]), ["off the bisector"]),
        (of(CORNER, [1.5], [[0, 0, 0]]), ["the normal of vertex 1 has no length"]),
        (of(op.Parameter("v"), [1.5], [[0, 0, 1]]), ["points that are known"]),
        (of(op.VerticesByAngles((0.3,)), PAIR), ["1 incidence, m = 2 for 2 materials"]),
        (of(op.VerticesByAngles((2.0,)), [1.5]), ["vertices.incidences[0] is 114.592 deg"]),
        (of("abc", [1.5]), ["m = 1 for 1 material, not 'abc'"]),
        (of(CORNER, [1.5], [[0, 1j, 1]]), ["normals must be real numbers, not"]),
        (of(CORNER, [1.5], [[0, 1], [1]]), ["the array of normals has rows of unequal lengths"]),
        (of(CORNER, [1.5], [[0, np.nan, 1]]), ["the normal of vertex 1 is not finite"]),
        (of([[CORNER] * 3] * 2, [1.5], [[[0, 1, 1]]] * 2), ["vertices (2, 3), normals (2,)"]),
        (
            of([CORNER[0], CORNER[0], [0, 0, np.nan]], [-1.5]),
            ["2 faults", "is nan at (2, 2)", "-1.5"],
        ),
        (of([CORNER[0], *CORNER[::2]], [1.5], [[0, 1, 1]]), ["vertices 0 and 1", "are one point"]),
        (of(CORNER, [1.5], bad=np.zeros((1, 2))), ["bad ", "is unknown; there are: refuse, ma"]),
        # Ids, lengths and events of chains that differ.
        (many(ids=[[0, 1], [1, 2], [0, 0]]), ["ids is 2 at (1, 1)", "0 .. 1"]),
        *((many(ids=[[0, n]] * 3), [f"ids is {n} at (0, 1)"]) for n in (-1, 0.5, np.nan)),
        (many(ids="01"), ["ids must be whole numbers, not '01'"]),
        (many(ids=1), ["ids must have shape (..., m)"]),
        (many(ids=[[0, 1, 0]]), ["vertices must have shape (..., m + 2, 3), m = 3"]),
        (many(lengths=[1, 2, 3]), ["lengths is 3 at 2", "1 .. 2"]),
        *((many(lengths=[n, 2, 1]), [f"lengths is {n} at 0"]) for n in (0, 1.5)),
        (many(lengths="abc"), ["lengths must be whole numbers"]),
        (many(events=["RR", "RX", "R"]), ["events: letter 2 of chain 1 is 'X'; give R for each"]),
        (many(events=["RR", "", "R"]), ["letter 1 of chain 1 is missing"]),
        (many(events=["RR", "RRR", "R"]), ["events has 3 letters for a chain of 2 vertices"]),
        (many(events=[1, 2, 3]), ["events is [1, 2, 3]; give R for each"]),
        (many(events=[["RR"] * 2] * 3), ["a text for each chain, in one row"]),
        (many(events=[["R"] * 3] * 3), ["single letters of shape (..., 2)"]),
        (many(events=[["", "R"]] * 3), ["letter 1 of chain 0 is missing"]),
        (many(events="RRR", lengths=[1, 2, 1]), ["has 3 letters for a chain of 2"]),
        (many(bad="maks"), ["bad 'maks' is unknown; did you mean 'mask'?"]),
        (many(ids=[[0, 1]] * 2, lengths=[1] * 4, events=["R"] * 5), ["lengths (4,), events (5,)"]),
        (many(bad="no", outside=-1.0), ["'no'"]),
        *((chosen(n), ["materials[1] is given when the path runs"]) for n in (N, op.Material(N))),
        (chosen(np.array([1.0, 2.0])), ["materials[1] is an array, and ids choose from numbers"]),
        *((chosen(wrong), ["materials[1]", str(wrong)]) for wrong in ("glass", -1)),
        (of(POINTS, [1.5, N], events=["RR", "R", "RR"]), ["materials[1] is given", "differ"]),
        (many(events=["RR", "R", "RR"], outside=N), ["outside is given when the path runs"]),
        (of(ANGLES, [1.5, 1.5], lengths=[1, 2]), ["one length and reflect; give the points"]),
    ],
)
def test_what_is_wrong_is_told_in_words(given, messages):
    arguments, others = given
    with pytest.raises(op.errors.PathError) as error:
        op.path_from_vertices(*arguments, **others)
    for message in messages:
        assert message in str(error.value)


@rows(
    "given, message",
    [
        (bent(ASIDE), "by 90 deg at 'vertex1', but .* turns it by 48.18968"),
        (bent([INTO_GLASS, ASIDE]), r"90 deg at 'vertex1'.*\(at 1, of 2 paths\)"),
        (bent(materials=[1.0]), "from n = 1 into n = 1 lets it go straight on; move the point"),
        (bent(materials=[1.0], outside=1.01), "turns it by 8.0693"),
        (bent(materials=[1.5 + 0.1j]), "vertex1.index is complex; give a real index"),
        (bent(materials=[op.Material(1.5, 0.1)]), "vertex1.index.k is 0.1; give 0, since light"),
        (bent(materials=[0.0]), "vertex1.index is 0"),
        (bent(op.VerticesByAngles((0.3,))), "'?vertex1'?.vertices are angles, which say refl"),
        (bent(events="t"), "events: letter 1 is 't'; give R"),
        (bent(events=1), "events is 1; give R .*, such as 'RT'"),
        (bent(events="TT"), "events has 2 letters for a chain of 1 vertices at most; give R"),
        (bent(events=""), "events: letter 1 is missing"),
        (bent(outside=1j), "outside is complex; give a real index"),
        (bent(outside=-1.0), "outside is -1"),
        (bent(outside=op.FOLLOWS), "outside .*FOLLOWS"),
        (bent(materials=[N], normals=[[0, 0, 1]]), "media that are known; leave"),
        (bent(normals=[[0, 1, 1]]), "vertex 1 is off the one that refracts"),
        # Events are not counted against materials that are none.
        (of(CORNER, 1.5, events="T"), "materials must be a sequence"),
    ],
)
def test_one_thing_that_is_wrong_with_a_refraction_is_told_once(given, message):
    arguments, others = given
    with pytest.raises(op.errors.PathError, match=message) as error:
        op.path_from_vertices(*arguments, **others)
    assert len(error.value.faults) == 1


def test_points_that_may_be_those_of_a_refraction_are_asked_about_for_whole_chains():
    message = "by 16.8745 deg at vertex 1, .* n = 1 into n = 1.5; say"
    with pytest.raises(op.errors.PathError, match=message):
        op.path_from_vertices(INTO_GLASS, [1.5])
    for event, least, most in (("R", 0.0, 0.5), ("T", 0.9, 1.0)):
        path = op.path_from_vertices(INTO_GLASS, [1.5], events=event)
        assert least < path.trace().intensity < most
    # Defaults of parameters are known enough.
    points, n = op.Parameter("points", default=INTO_GLASS), op.Parameter("n", default=1.5)
    with pytest.raises(op.errors.PathError, match="say which"):
        op.path_from_vertices(points, [n])
    slab = np.array([[0, -1, 1], [0, 0, 0], [0, 1, -np.sqrt(3.5)], [0, 2, -np.sqrt(3.5) - 1]])
    with pytest.raises(
        op.errors.PathError, match=r"events='RR' where .* events='TT' where it goes"
    ):
        op.path_from_vertices(slab, [1.5, 1.0])
    op.path_from_vertices(slab, [1.5, 1.0], events="TT")
    through = [[0.0, 0, 2], [0, 0.1, 1], [0, 0.1, 0], [0, 5, 1]]
    points = np.array([through, through])
    points[0, 3] = np.nan
    with pytest.raises(op.errors.PathError, match="events='RR' where it is reflected"):
        op.path_from_vertices(points, [1.5, 1.5], lengths=[1, 2])
    op.path_from_vertices(points, [1.5, 1.5], lengths=[1, 2], events="RR")


@rows(
    "points, materials, others",
    [
        (INTO_GLASS, [1.5 + 2j], {}),  # What absorbs lets nothing through.
        (INTO_GLASS, [1.0], {}),  # Equal media do not turn light.
        ([INTO_GLASS, ASIDE], [1.5], {}),  # One chain can only be reflected.
        ([[0, 0, 0], [0, 0, 1], [0, 0, 2]], [1.5], {}),  # Straight on.
        (op.Parameter("points"), [1.5], {}),  # Not known yet.
        (INTO_GLASS, [N], {}),
        (INTO_GLASS, [np.array([])], {}),
        (op.VerticesByAngles((1.5,)), [1.5], {}),
        (INTO_GLASS, [1.5], {"normals": np.diff(LEGS, axis=0)}),
    ],
)
def test_nothing_is_asked_where_there_is_one_reading(points, materials, others):
    path = op.path_from_vertices(points, materials, **others)
    assert path.element("vertex1").kind == "specular-vertex"


@rows("batch, chain, told", [((7,), (5,), "chain 5"), ((2, 4), (1, 2), r"chain \(1, 2\)")])
def test_the_one_chain_normal_or_coordinate_that_is_wrong_is_named(batch, chain, told):
    tilted = [0.0, np.sin(np.radians(46.0)), np.cos(np.radians(46.0))]
    with pytest.raises(op.errors.PathError, match=r"vertex 1 is off the bisector .* by 1 deg"):
        op.path_from_vertices(CORNER, [1.5], [tilted])
    # Of faulty vertices, no angle.
    with pytest.raises(op.errors.PathError, match=r"(?s)^(?!.*off the bisector)"):
        op.path_from_vertices(np.array(CORNER) * np.nan, [1.5], [[0, 1, 0]])
    points = random_chains(18, 3, (10_000,))
    points[7777, 3, 2] = np.nan
    with pytest.raises(op.errors.PathError, match=r"is nan at \(7777, 3, 2\)"):
        op.path_from_vertices(points, MATERIALS[:3])
    plan = op.path_from_vertices(op.Parameter("points"), MATERIALS[:3]).compose()
    with pytest.raises(op.errors.ParameterError, match=r"'points' is nan at \(7777, 3, 2\)"):
        plan.run(points=points)
    points = np.broadcast_to(np.array(CORNER), (*batch, 3, 3)).copy()
    normals = np.broadcast_to([[0.0, 1.0, 1.0]], (*batch, 1, 3)).copy()
    for wrong, message in (
        (np.nan, r"is nan at \("),
        (points[(*chain, 1)], rf"vertices 1 and 2 of {told}"),
        (1e80, rf"vertices 1 and 2 of {told}, .*1e\+80 apart; legs are within 1e-70 .. 1e\+70"),
    ):
        faulty = points.copy()
        faulty[(*chain, 2)] = wrong
        with pytest.raises(op.errors.PathError, match=message):
            op.path_from_vertices(faulty, [1.5], normals)
    normals[chain] = [[0.0, 1.0, 1.001]]
    with pytest.raises(
        op.errors.PathError, match=rf"the normal of vertex 1 of {told} is off .* 0.0286 d"
    ):
        op.path_from_vertices(points, [1.5], normals)


@rows("seed", range(3))
def test_normals_next_to_the_tolerance_are_told_apart_exactly(seed):
    points = random_chains(20 + seed, 3, (5000,))
    legs = np.diff(points, axis=-2)
    legs /= np.linalg.norm(legs, axis=-1, keepdims=True)
    bisectors = np.diff(legs, axis=-2)
    across = np.cross(bisectors, legs[:, 1:])
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    size = np.linalg.norm(bisectors, axis=-1, keepdims=True)
    op.path_from_vertices(points, MATERIALS[:3], bisectors + 0.99e-6 * size * across)
    off = np.zeros((5000, 3, 1))
    off[4321, 1] = 1.01e-6
    with pytest.raises(op.errors.PathError, match="vertex 2 of chain 4321 is off"):
        op.path_from_vertices(points, MATERIALS[:3], bisectors + off * size * across)


@by_engine
def test_points_given_later_and_what_no_surface_refracts_are_refused_by_every_engine(engine):
    plan = op.Composer(engine=engine).compose(op.path_from_vertices(op.Parameter("points"), [1.5]))
    for count in (1, 3, 3000):
        points = random_chains(13, 1, (count,))
        together, nan = points.copy(), points.copy()
        together[-1, 2], nan[-1, 2, 1] = together[-1, 1], np.nan
        wrong = [(together, r"vertices 1 and 2.* are one point"), (nan, "is nan")]
        wrong += [(other, r"must have shape \(\.\.\., 3, 3\)") for other in (points[:, :2], 0.5)]
        for scale in (1e-160, 1e-75, 1e75, 1e155):
            scaled = points.copy()
            scaled[-1] *= scale
            with pytest.raises(op.errors.PathError, match=APART):
                op.path_from_vertices(scaled, [1.5])
            wrong.append((scaled, APART))
        for given, message in wrong:
            with pytest.raises(op.errors.ParameterError, match=message):
                plan.run(points=given)
    path = op.path_from_vertices(op.Parameter("points"), [N], events="T")
    plan = op.Composer(engine=engine).compose(path)
    message = r"turned by 90 deg at 'vertex1', but a refraction from n = 1 into n = 1.5 \(par"
    for count in (1, 7, 3000):
        points = np.array([INTO_GLASS] * count)
        assert np.all(plan.run(points=points, n=1.5).intensity > 0.9)
        points[-1] = ASIDE
        with pytest.raises(op.errors.ParameterError, match=message) as error:
            plan.run(points=points, n=1.5)
        assert count == 1 or f"of {count} paths" in str(error.value)
    with pytest.raises(op.errors.ParameterError, match="lets it go straight on"):
        plan.run(points=points[0], n=1.0)
