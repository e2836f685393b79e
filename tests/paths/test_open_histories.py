"""Chains whose events, ids and lengths are given when the path runs; and points that stay."""

import copy
import pickle
import tracemalloc
from itertools import combinations

import numpy as np
import pytest

import optipath as op
from batches_of_chains import quickly, random_batch
from chains import ENGINES, by_engine, random_chains
from tables import rows

PARTS = ("points", "ids", "events", "lengths")
LATER = {name: op.Parameter(name) for name in PARTS}
BATCH = random_batch(5, 3, several=6, each=2)


def given(batch):
    """What is given of a batch, by name."""
    return {
        "points": batch.points,
        "ids": batch.ids,
        "events": batch.letters,
        "lengths": batch.lengths,
    }


def path_of(batch, later=(), **others):
    parts = given(batch) | {name: LATER[name] for name in later}
    return op.path_from_vertices(parts.pop("points"), batch.palette, **parts, **others)


@by_engine
def test_a_plan_runs_batches_of_other_chains_and_sizes_as_paths_of_their_own_do(engine):
    composer = op.Composer(engine=engine)
    # Palettes are of the path, and 3 vertices at most.
    batches = [random_batch(seed, 3, several=several, each=2) for seed, several in ((6, 3), (7, 7))]
    palette = [*batches[0].palette, *batches[1].palette]
    batches[0].palette = batches[1].palette = palette
    batches[1].ids = np.where(batches[1].ids < 0, -1, batches[1].ids + 6)
    batches[1].ids = np.where(batches[1].ids >= len(palette), 0, batches[1].ids)
    plan = composer.compose(path_of(batches[0], PARTS, count=3, bad="mask"))
    with quickly(engine):
        for batch in batches:
            own = composer.compose(path_of(batch, bad="mask")).run()
            light = plan.run(**given(batch))
            compare = np.testing.assert_array_equal
            if engine == "jax":
                compare = lambda *both: np.testing.assert_allclose(*both, rtol=0, atol=1e-14)  # noqa: E731
            compare(light.stokes, own.stokes)
            np.testing.assert_array_equal(light.frame.x, own.frame.x)


@pytest.mark.parametrize("bad", ["refuse", "mask"])
def test_whatever_is_given_later_comes_to_the_same_bits(bad):
    known = path_of(BATCH, bad=bad).trace()
    for size in range(1, 5):
        for later in combinations(PARTS, size):
            path = path_of(BATCH, later, bad=bad, count=3)
            assert {*path.parameters} == {*later}
            light = path.trace(**{name: given(BATCH)[name] for name in later})
            np.testing.assert_array_equal(light.stokes, known.stokes, err_msg=str(later))
            np.testing.assert_array_equal(light.frame.z, known.frame.z)


def test_events_may_be_given_as_texts_and_one_text_for_all():
    path = path_of(BATCH, ("events",), bad="mask")
    np.testing.assert_array_equal(
        path.trace(events=BATCH.texts).stokes, path.trace(events=BATCH.letters).stokes
    )
    down = [[0.0, 0, 3], [0, 0, 2], [0, 0, 1], [0, 0, 2]]
    glass = op.path_from_vertices(down, [1.5, 1.0], events=op.Parameter("events"))
    assert glass.trace(events="TR").intensity == pytest.approx(0.96 * 0.04)


def test_materials_of_each_vertex_and_lengths_alone_given_later():
    points, materials = random_chains(3, 3, (5,)), [1.5, 1.2 + 2j, 0.6 + 2j]
    lengths = np.array([3, 1, 2, 2, 1])
    path = op.path_from_vertices(points, materials, lengths=op.Parameter("l"))
    known = op.path_from_vertices(points, materials, lengths=lengths)
    np.testing.assert_array_equal(path.trace(l=lengths).stokes, known.trace().stokes)


def test_what_is_bound_copied_or_pickled_is_the_same():
    whole, path = given(BATCH), path_of(BATCH, PARTS, count=3)
    whole["points"] = np.nan_to_num(whole["points"], nan=9.0)  # Defaults are finite.
    known = path.trace(**whole).stokes
    for again in (copy.deepcopy(path), pickle.loads(pickle.dumps(path))):
        assert again == path
        np.testing.assert_array_equal(again.trace(**whole).stokes, known)
    for name in PARTS:
        others = {other: value for other, value in whole.items() if other != name}
        np.testing.assert_array_equal(
            path.bind(**{name: whole[name]}).trace(**others).stokes, known
        )
    np.testing.assert_array_equal(path.bind(**whole).trace().stokes, known)
    parts = [part.light.stokes for part in path.compose().stream(5, **whole)]
    np.testing.assert_array_equal(np.concatenate(parts), known)
    assert "n of the chains follows from events, ids and lengths" in path.compose().explain()


@rows(
    "others, message",
    [
        ({"ids": [[99, 0, 0]]}, r"ids is 99 at \(0, 0\); give the place of one of the materials"),
        ({"ids": [[0.5, 0, 0]]}, r"ids is 0.5 at \(0, 0\)"),
        ({"ids": "01"}, "ids must be whole numbers, not '01'"),
        (
            {"ids": [[0, 0]]},
            r"ids must have shape \(\.\.\., 3\), one for each vertex, not \(1, 2\)",
        ),
        ({"ids": np.zeros((5, 3), int)}, r"do not broadcast together: .*ids \(5,\)"),
        ({"lengths": 0}, "lengths is 0; give how many vertices each chain has, 1 .. 3"),
        ({"lengths": "abc"}, "lengths must be whole numbers, not 'abc'"),
        ({"events": ["RXR"]}, "events: letter 2 of chain 0 is 'X'; give R for each"),
        ({"events": [1, 2, 3]}, r"events is \[1, 2, 3\]; give R for each"),
        ({"events": ["RRRR"]}, "events has 4 letters for a chain of 3 vertices at most"),
        ({"points": BATCH.points[:, :4]}, r"must have shape \(\.\.\., 5, 3\)"),
        ({"points": [np.full((5, 3), np.nan)]}, "the points around 'vertex1' are .*must be finite"),
        ({"events": None}, "parameter 'events' has no value"),
    ],
)
def test_what_is_wrong_with_what_is_given_is_told_when_it_runs(others, message):
    plan = path_of(BATCH, PARTS, count=3).compose()
    sound = {"ids": np.maximum(BATCH.ids, 0), "lengths": 3, "events": "RRR"}
    with pytest.raises(op.errors.ParameterError, match=message):
        plan.run(**given(BATCH) | sound | others)


@rows(
    "others, message",
    [
        ({"ids": LATER["ids"]}, "ids is a parameter; say how many vertices chains have, count="),
        ({"ids": LATER["ids"], "count": 0.5}, "count must be a whole number above 0, not 0.5"),
        ({"ids": LATER["ids"], "events": "RR", "count": 3}, "count is 3, but .* say 2"),
        (
            {"lengths": LATER["lengths"], "count": 3},
            "count is 3, but materials say 2; leave it out",
        ),
        ({"count": 3}, "count is 3, but materials say 2; leave it out"),
        ({"ids": 2 * LATER["ids"], "count": 2}, "takes several numbers that belong together"),
        ({"lengths": LATER["points"]}, "'points' .* has another shape; use two names"),
        ({"lengths": LATER["lengths"], "outside": op.Parameter("n")}, "outside is given when"),
        ({"lengths": LATER["lengths"], "normals": [[0, 0, 1]]}, "normals need points that are"),
    ],
)
def test_what_cannot_be_given_later_is_told_at_once(others, message):
    with pytest.raises(op.errors.PathError, match=message):
        op.path_from_vertices(LATER["points"], [1.5, 1.2 + 2j], **others)


def test_media_in_an_array_fit_what_is_given_of_each_chain():
    index = [np.array([1.5, 1.6]), 1.4]
    path = op.path_from_vertices(op.Parameter("points"), index, events=op.Parameter("events"))
    points = random_chains(5, 2)
    with pytest.raises(op.errors.ParameterError, match=r"together: events \(5,\), materials\[0\]"):
        path.trace(points=points, events=["RR"] * 5)


def test_a_range_of_the_parameter_is_kept():
    points, index = random_chains(3, 3), [1.5, 1.4, 1.3]
    path = op.path_from_vertices(points, index, lengths=op.Parameter("l", maximum=2))
    with pytest.raises(op.errors.ParameterError, match=r"parameter 'l' is 3, .*range"):
        path.trace(l=3)


def test_values_of_jax_are_traced_through_points_alone(jax):
    path, whole = path_of(BATCH, PARTS, count=3, bad="mask"), given(BATCH)
    light = path.trace(**whole | {"points": jax.numpy.asarray(whole["points"])})
    np.testing.assert_allclose(light.stokes, path.trace(**whole).stokes, rtol=0, atol=1e-13)


@rows("events", ["RR", np.array([["R", "R"]]), "TR"])
def test_points_are_used_where_they_stand(events):
    straight = [[[0.0, 0, 3], [0, 0, 2], [0, 0, 1], [0, 0, 2]]]
    chain = straight if isinstance(events, str) and "T" in events else random_chains(4, 2, (1,))
    points = np.repeat(np.repeat(chain, 100_000, axis=0), 2, axis=-1)[..., ::2]
    making = {"materials": [1.5, 1.33], "ids": np.zeros((len(points), 2), np.int8)}
    op.path_from_vertices(points[:9], events=events, **making | {"ids": [[0, 0]]})
    tracemalloc.start()
    try:
        path = op.path_from_vertices(points, events=events, **making)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert np.shares_memory(path.element("vertex1").vertices, points)
    assert peak < 0.75 * points.nbytes
    with pytest.raises(ValueError, match="read-only"):
        path.element("vertex1").vertices[0] = 0.0


@rows(
    "events, point, message",
    [
        ("RR", [0, 0, 2], "vertices 1 and 2 of chain 77777, .* are one point"),
        ("TR", [0, 0, np.inf], "is inf"),
        ("TR", [9, 0, 2], "light is turned by .* at 'vertex1'"),
    ],
)
def test_one_chain_that_cannot_be_is_told_among_many(events, point, message):
    points = np.repeat([[[0.0, 0, 3], [0, 0, 2], [0, 0, 1], [0, 0, 2]]], 100_000, axis=0)
    op.path_from_vertices(points.copy(), [1.5, 1.33], events=events)
    points[77_777, 2] = point
    with pytest.raises(op.errors.PathError, match=message):
        op.path_from_vertices(points, [1.5, 1.33], events=events)


def test_few_points_may_be_overwritten():
    points = random_chains(6, 2, (50,))
    path = op.path_from_vertices(points, [1.5, 1.33])
    light, expected = path.trace(), path_of_copy(points)
    points[...] = random_chains(7, 2, (50,))
    assert np.array_equal(light.frame.x, expected.frame.x)
    assert np.array_equal(path.trace().stokes, expected.stokes)


def path_of_copy(points):
    return op.path_from_vertices(points.copy(), [1.5, 1.33]).trace()


@rows("ask", ["frame", "run", "matrix", "stream"])
def test_many_points_that_are_overwritten_give_no_wrong_light(ask):
    points = random_chains(6, 2, (5000,))
    path = op.path_from_vertices(points, [1.5, 1.33], events="RR")
    light = path.trace()
    points[...] = random_chains(7, 2, (5000,))
    asked = {
        "frame": lambda: light.frame,
        "run": path.trace,
        "matrix": path.mueller,
        "stream": lambda: [*path.compose().stream(1000)],
    }
    with pytest.raises(op.errors.PathError, match="array of vertices has been overwritten since"):
        asked[ask]()


def test_a_view_that_cannot_be_written_to_is_copied_if_its_owner_can():
    points = random_chains(6, 2, (50,))
    view, expected = points.view(), path_of_copy(points)
    view.flags.writeable = False
    light = op.path_from_vertices(op.Parameter("points"), [1.5, 1.33]).trace(points=view)
    points[...] = random_chains(7, 2, (50,))
    assert np.array_equal(light.frame.x, expected.frame.x)


@pytest.mark.parametrize("engine", [engine for engine in ENGINES if engine != "jax"])
def test_dark_chains_leave_their_neighbors_as_they_are_alone(engine):
    points, ids = random_chains(5, 2, (300,)), np.arange(600).reshape(300, 2) % 3
    path = op.path_from_vertices(points, [1.0, 1.5, 0.2 + 3j], ids=ids, events="RR")
    light = op.Composer(engine=engine).compose(path).run()
    dark = np.any(ids == 0, axis=-1)  # A surface between equal media reflects nothing.
    assert np.all(light.stokes[dark] == 0.0)
    assert np.all(light.intensity[~dark] > 0.0)
    for chain in (1, 2, 4):
        media = [[1.0, 1.5, 0.2 + 3j][which] for which in ids[chain]]
        alone = op.path_from_vertices(points[chain], media, events="RR").trace()
        np.testing.assert_allclose(light.stokes[chain], alone.stokes, rtol=0, atol=1e-15)
