"""Batches of chains that differ: against a reference without frames, and each chain alone."""

import os

import numpy as np
import pytest

import optipath as op
from batches_of_chains import FEWER, quickly, random_batch
from chains import ENGINES, MATERIALS, random_chains
from histories import coherency, stokes_in
from optipath.lab.accuracy.path_reference import exact_batch

# What is compiled for eight events takes some seconds; three have all that there is.
MOST = {"numpy": 8, "numba": 8 if "OPTIPATH_SETS" in os.environ else 3, "jax": 3}
DOWN = [[0.0, 0, 3], [0, 0, 2], [0, 0, 1], [0, 0, 0]]


def path_of(batch, points=None, **others):
    points = batch.points if points is None else points
    others = {"events": batch.texts, **others}
    return op.path_from_vertices(points, batch.palette, ids=batch.ids, **others)


@pytest.mark.parametrize("engine", ENGINES)
def test_histories_that_differ_equal_a_reference_without_frames(engine):
    batch = random_batch(1, MOST[engine])
    with quickly(engine):
        light = op.Composer(engine=engine).compose(path_of(batch)).run()
    expected = stokes_in(batch.expected, light.frame)
    np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=1e-13)
    np.testing.assert_allclose(light.intensity, expected[..., 0], rtol=1e-11)


@pytest.mark.parametrize("engine", FEWER)
def test_each_chain_of_a_batch_is_what_it_is_alone(engine):
    batch = random_batch(2, MOST[engine], several=8, each=2)
    with quickly(engine):
        light = op.Composer(engine=engine).compose(path_of(batch)).run()
    for chain in range(len(batch.texts)):
        points, media, text = batch.alone(chain)
        alone = op.path_from_vertices(points, media, events=text).trace()
        np.testing.assert_allclose(light.stokes[chain], alone.stokes, rtol=0, atol=1e-14)
        np.testing.assert_allclose(light.frame.x[chain], alone.frame.x, rtol=0, atol=1e-14)
        np.testing.assert_array_equal(light.frame.z[chain], alone.frame.z)


@pytest.mark.parametrize("engine", FEWER)
def test_points_that_are_given_later_say_the_same(engine):
    batch = random_batch(3, 2)
    known = path_of(batch).trace()
    plan = op.Composer(engine=engine).compose(path_of(batch, op.Parameter("points")))
    with quickly(engine):
        given = plan.run(points=batch.points)
    np.testing.assert_allclose(given.stokes, known.stokes, rtol=0, atol=1e-14)
    np.testing.assert_array_equal(given.frame.x, known.frame.x)


def test_texts_and_letters_with_lengths_say_the_same():
    batch = random_batch(4, 3, several=6, each=2)
    expected = path_of(batch).trace().stokes
    for events in (np.array(batch.texts), tuple(batch.texts)):
        np.testing.assert_array_equal(path_of(batch, events=events).trace().stokes, expected)
    by_letters = path_of(batch, events=batch.letters, lengths=batch.lengths)
    np.testing.assert_array_equal(by_letters.trace().stokes, expected)


def test_a_chain_that_ends_early_is_right_to_50_digits():
    batch = random_batch(5, 3, several=3, each=1)
    path = path_of(batch)
    light = path.trace()
    for chain, exact in enumerate(exact_batch(path.graph)):
        numbers = [float(number) for number in exact["eye"].stokes]
        np.testing.assert_allclose(light.stokes[chain], numbers, rtol=0, atol=2e-15)


def test_reflections_of_unequal_number_need_no_events():
    points = random_chains(1, 4, (40,))
    lengths = 1 + np.arange(40) % 4
    padded = points.copy()
    for chain, length in enumerate(lengths):
        padded[chain, length + 2 :] = [np.nan, 0.0, np.inf]
    light = op.path_from_vertices(padded, MATERIALS[:4], lengths=lengths).trace()
    for length in range(1, 5):
        some = lengths == length
        alone = op.path_from_vertices(points[some, : length + 2], MATERIALS[:length]).trace()
        np.testing.assert_allclose(light.stokes[some], alone.stokes, rtol=0, atol=1e-14)
        np.testing.assert_allclose(light.frame.x[some], alone.frame.x, rtol=0, atol=1e-14)
        np.testing.assert_array_equal(light.frame.z[some], alone.frame.z)


def test_chains_of_one_text_and_one_length_are_the_path_of_plain_elements():
    points = np.array([DOWN, DOWN])
    plain = op.path_from_vertices(points, [1.5, 1.0], events="TT")
    assert op.path_from_vertices(points, [1.5, 1.0], events=["TT", "TT"]) == plain
    assert op.path_from_vertices(points, [1.5, 1.0], events="TT", lengths=[2, 2]) == plain


def test_ids_choose_the_material_of_each_vertex_of_each_chain():
    points = random_chains(2, 2, (5,))
    ids = np.array([[0, 1], [1, 2], [2, 2], [2, 0], [0, 0]])
    palette = [1.5, op.Material(0.2, 3.4), 1.12 + 2j]
    path = op.path_from_vertices(points, palette, ids=ids)
    kinds = [path.graph.nodes[f"vertex{place}"]["element"].kind for place in (1, 2)]
    assert kinds == ["specular-vertex"] * 2
    light = path.trace()
    for chain, several in enumerate(ids):
        alone = op.path_from_vertices(points[chain], [palette[i] for i in several]).trace()
        np.testing.assert_allclose(light.stokes[chain], alone.stokes, rtol=0, atol=1e-15)


def test_the_medium_that_light_is_in_follows_each_chain():
    # Into glass and back in it, against reflected at once: the second surface has another front.
    points = (
        [[0.0, 0, 3], [0, 0, 2], [0, 0, 1], [0, 0, 5]],
        [[0.0, 0, 3], [0, 0, 2], [0, 0, 5], [0, 0, 0]],
    )
    path = op.path_from_vertices(points, [1.5, 1.2], events=["TR", "RR"])
    into, once = 4 * 1.5 / 2.5**2, (0.5 / 2.5) ** 2
    expected = [into * (0.3 / 2.7) ** 2, once * (0.2 / 2.2) ** 2]
    np.testing.assert_allclose(path.trace().intensity, expected, rtol=1e-14)


def slopes_of_intensity(points, text, media, step=1e-4):
    """Of a chain alone, by differences of the frame-free reference to sixth order."""
    moved = np.eye(points.size).reshape(-1, *points.shape) * step

    def intensity(far):
        return coherency(points + far * moved, text, media).trace(axis1=-2, axis2=-1).real

    near = [intensity(far) - intensity(-far) for far in (1, 2, 3)]
    return ((45 * near[0] - 9 * near[1] + near[2]) / (60 * step)).reshape(points.shape)


def test_slopes_do_not_see_what_is_behind_the_end_of_a_chain(jax):
    batch = random_batch(5, 3, several=6, each=1)
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


def test_slopes_in_an_index_are_those_of_the_event_of_each_chain(jax):
    points = [DOWN[:3], [*DOWN[:2], DOWN[0]], [*DOWN[:2], [np.nan] * 3]]
    vertex = op.Vertex(op.Parameter("n"), points, place=1, events=[[1.0], [0.0], [2.0]])
    path = op.PathGraph()
    path.add("light", op.Source()) >> path.add("vertex1", vertex) >> path.add("eye", op.Detector())
    plan = path.compose()
    with quickly("jax"):
        slopes = jax.jacobian(lambda n: plan.run(n=n).intensity)(1.5)
    through, back = 4 * (1 - 1.5**2) / 2.5**4, 4 * 0.5 / 2.5**3
    np.testing.assert_allclose(slopes, [through, back, 0.0], rtol=1e-12)


def test_histories_can_be_written_to_a_file_and_read_again(tmp_path):
    batch = random_batch(8, 3, several=3, each=2)
    for path in (path_of(batch), path_of(batch, bad="mask")):
        file = tmp_path / "histories.toml"
        file.write_text(path.to_toml(), "utf-8")
        again = op.load_preset(file)
        np.testing.assert_array_equal(again.trace().stokes, path.trace().stokes)
