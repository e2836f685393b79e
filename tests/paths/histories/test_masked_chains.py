"""Chains of a batch that cannot be: refused in words, or masked, and no harm to the others."""

import numpy as np
import pytest

import optipath as op
from batches_of_chains import FEWER, quickly, random_batch
from chains import ENGINES

GLASS, GOLD = 1.5, op.Material(0.2, 3.0)
CORNER = [[0.0, 0, 3], [0, 0, 0], [0, 4, 0]]
DOWN = [[0.0, 0, 3], [0, 0, 2], [0, 0, 1], [0, 0, 0]]


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
    [*((engine, True) for engine in ENGINES), *((engine, False) for engine in FEWER)],
)
def test_the_light_of_chains_that_cannot_be_is_not_a_number_and_all_other_is_as_it_was(
    engine, later
):
    batch = random_batch(11, 2)
    points, ids, bad = spoilt(batch)
    composer = op.Composer(engine=engine)
    expected = op.path_from_vertices(
        batch.points, batch.palette, ids=batch.ids, events=batch.texts
    ).trace()
    given = op.Parameter("points") if later else points
    path = op.path_from_vertices(given, batch.palette, ids=ids, events=batch.texts, bad="mask")
    plan, values = composer.compose(path), {"points": points} if later else {}
    with quickly(engine):
        light = plan.run(**values)
    masked = np.isin(np.arange(len(points)), bad)
    assert np.all(np.isnan(light.stokes[masked]))
    np.testing.assert_allclose(light.stokes[~masked], expected.stokes[~masked], rtol=0, atol=1e-14)
    np.testing.assert_array_equal(light.frame.x[~masked], expected.frame.x[~masked])


@pytest.mark.parametrize("engine", ENGINES)
def test_the_matrix_of_a_chain_that_cannot_be_is_not_a_number_either(engine):
    points = np.array([DOWN, [DOWN[0], DOWN[0], *DOWN[2:]]])
    path = op.path_from_vertices(points, [GLASS, 1.0], events=["R", "TT"], bad="mask")
    with quickly(engine):
        matrices = op.Composer(engine=engine).compose(path).mueller().matrix
    np.testing.assert_array_equal(np.isnan(matrices), [np.full((4, 4), bad) for bad in (0, 1)])


def test_masked_light_has_no_figures_and_is_left_out_of_a_sum_by_nansum():
    points = np.array([CORNER, [CORNER[0], CORNER[0], CORNER[2]]])
    light = op.path_from_vertices(points, [GLASS], bad="mask").trace()
    alone = op.path_from_vertices(CORNER, [GLASS]).trace()
    assert np.isnan(light.intensity.sum())
    assert np.nansum(light.intensity) == alone.intensity
    for figure in (light.dop, light.aop, light.normalized, light.in_frame(light.frame).stokes):
        assert np.all(np.isnan(figure[1]))
    np.testing.assert_array_equal(light.to("mitsuba")[0], alone.to("mitsuba"))
    assert light[0] == alone


def test_a_plan_of_one_chain_masks_it_too():
    plan = op.path_from_vertices(op.Parameter("points"), [GLASS], bad="mask").compose()
    assert np.all(np.isnan(plan.run(points=[CORNER[0], CORNER[0], CORNER[2]]).stokes))
    assert plan.run(points=CORNER) == op.path_from_vertices(CORNER, [GLASS]).trace()


def test_chains_in_a_stream_are_masked():
    points = np.array([CORNER] * 5)
    points[3, 1] = np.nan
    plan = op.path_from_vertices(op.Parameter("points"), [GLASS], bad="mask").compose()
    parts = [light.intensity for _, light in plan.stream(2, points=points)]
    np.testing.assert_array_equal(np.isnan(np.concatenate(parts)), np.arange(5) == 3)


def test_normals_that_contradict_a_chain_mask_it():
    points = np.array([CORNER, CORNER, CORNER])
    normals = np.array([[[0.0, 1, 1]], [[0.0, 1, 0]], [[0.0, -2, -2]]])
    light = op.path_from_vertices(points, [GLASS], normals, bad="mask").trace()
    np.testing.assert_array_equal(np.isnan(light.intensity), [False, True, False])
    with pytest.raises(op.PathError, match="vertex 1 of chain 1 is off the bisector"):
        op.path_from_vertices(points, [GLASS], normals)


def test_normals_behind_the_end_of_a_chain_are_not_looked_at():
    points = np.array([DOWN, DOWN])
    points[1, 2:] = [[0, 0, 5], [np.nan] * 3]
    normals = [[[0, 0, 1], [0, 0, 2]], [[0, 0, 1], [np.nan, 0, 0]]]
    path = op.path_from_vertices(points, [GLASS, 1.0], normals, events=["TT", "R"])
    np.testing.assert_allclose(path.trace().intensity, [0.96**2, 0.04], rtol=1e-14)
    normals[0][1] = [0, 1, 1]
    with pytest.raises(op.PathError, match="vertex 2 of chain 0 is off the one that refracts"):
        op.path_from_vertices(points, [GLASS, 1.0], normals, events=["TT", "R"])


def test_going_into_a_medium_that_absorbs_is_masked_where_all_chains_have_one_text():
    light = op.path_from_vertices(
        DOWN, [GLASS, GOLD], ids=[[0, 0], [1, 0]], events="TT", bad="mask"
    ).trace()
    np.testing.assert_array_equal(np.isnan(light.intensity), [False, True])


BENT = [[0.0, 0, 1], [0, 0, 0], [0, 2, -1]]


@pytest.mark.parametrize(
    ("points", "given", "messages"),
    [
        (
            [DOWN, DOWN],
            {"events": ["TT", "T"], "ids": [[0, 1], [1, 0]]},
            ["absorbs, k = 3", "bad="],
        ),
        (
            [[*BENT, [0, 4, -2]], [*BENT, [0, 4, -2]]],
            {"events": ["TR", "T"], "ids": [[0, 0], [0, 0]]},
            ["light is turned by 63.4", "bad='mask'", "of 2 paths"],
        ),
        ([DOWN, [[np.nan] * 3, *DOWN[1:]]], {"events": ["TT", "T"]}, ["not finite", "at 1, of 2"]),
        ([DOWN, [*DOWN[:2], *DOWN[1:3]]], {"events": ["RR", "TT"]}, ["legs before and behind"]),
    ],
)
def test_the_first_chain_that_cannot_be_is_named_with_its_cure(points, given, messages):
    palette = [GLASS, GOLD] if "ids" in given else [GLASS, 1.0]
    with pytest.raises(op.PathError) as error:
        op.path_from_vertices(points, palette, **given)
    for message in messages:
        assert message in str(error.value)
    op.path_from_vertices(points, palette, **given, bad="mask")
    plan = op.path_from_vertices(op.Parameter("p"), palette, **given)
    if "absorbs" in messages[0]:
        return
    with pytest.raises(op.ParameterError) as error:
        plan.trace(p=points)
    for message in messages:
        assert message in str(error.value)


def test_what_cannot_be_is_refused_where_nobody_asks_for_a_mask():
    plan = op.path_from_vertices(op.Parameter("points"), [GLASS]).compose()
    with pytest.raises(op.ParameterError, match="finite"):
        plan.run(points=np.full((3, 3), np.nan))


TURNED = [[0.0, 0, 3], [0, 0, 0], [0, 1, -1], [0, 2, -2]]
NO_LEG = [[0.0, 0, 3], [0, 0, 3], [0, 0, 0], [0, 0, -1]]


@pytest.mark.parametrize("method", ["stable", "compensated", "amplitude", "textbook"])
@pytest.mark.parametrize("composing", ["stokes", "jones"])
@pytest.mark.parametrize("reading", ["full", "intensity"])
@pytest.mark.parametrize("events", ["TT", "TR", "RR", "RT"])
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


@pytest.mark.parametrize("composing", ["stokes", "jones"])
@pytest.mark.parametrize("index", [1.0, 1.2])
def test_points_that_come_with_the_run_and_turn_light_too_far_are_refused(index, composing):
    path = op.path_from_vertices(op.Parameter("points"), [index], events="T")
    plan = op.Composer(composing=composing).compose(path.reading("intensity"))
    with pytest.raises(op.OptipathError, match="light is turned by 45 deg at 'vertex1'"):
        plan.run(points=TURNED[:3])
