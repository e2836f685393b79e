"""Chains of vertices in space: against interfaces by hand, and a reference without frames."""

import pickle
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import optipath as op
from batches_of_chains import quickly
from chains import (
    ENGINES,
    MATERIALS,
    by_engine,
    interfaces_in_space,
    random_chains,
    random_rotation,
)
from histories import (
    coherency,
    exact_coherency,
    exact_stokes_in,
    random_histories,
    random_history,
    stokes_in,
)
from optipath.lab.path_reference import exact_lights
from optipath.paths.drawing import draw
from optipath.values.use import checked_later
from tables import rows, slow
from wired import read_back

FLIP = np.diag([1.0, 1.0, -1.0, 1.0])
CORNER = [[0.0, 0.0, 3.0], [0.0, 0.0, 0.0], [0.0, 4.0, 0.0]]
INTO_GLASS = [[0.0, -1.0, 1.0], [0.0, 0.0, 0.0], [0.0, 1.0, -np.sqrt(3.5)]]  # 45 degrees, 1.5
EVENTS = ["T", "RT", "TTR", "TRRT", "RTTRT", "TTTTTT", "TRTRRTT", "RTRTRTRT", "RRRRRRRR"]
KINDS = [("numpy", "float64"), ("numpy", "float32"), *(slow((e, "float64")) for e in ENGINES[1:])]
SEVERAL = [("numpy", EVENTS), slow(("numba", ["TR"])), *(slow((e, ["TRT"])) for e in ENGINES[1:])]


@pytest.fixture(autouse=True)
def _double(request):
    if "jax" in ENGINES:
        request.getfixturevalue("jax")


# The rounding of a point turns a plane by so much over the sine of twice the incidence.
@rows("extreme, slack", [(False, 2e-14), (True, 1e-9)])
@rows("reflections", [1, 2, 3, 4, 5])
def test_a_chain_is_the_same_as_interfaces_that_are_placed_by_hand(reflections, extreme, slack):
    points = random_chains(reflections, reflections, (200,), extreme=extreme)
    found = op.path_from_vertices(points, MATERIALS[:reflections], intensity=100.0)
    by_hand = interfaces_in_space(points, MATERIALS[:reflections], intensity=100.0)
    light, expected = found.trace(), by_hand.trace()
    scale = expected.intensity[:, np.newaxis]
    turned = light.in_frame(expected.frame).stokes
    np.testing.assert_allclose(turned / scale, expected.stokes / scale, rtol=0, atol=slack)
    matrices = found.mueller(), by_hand.mueller()
    np.testing.assert_allclose(*(each.matrix for each in matrices), rtol=0, atol=slack)
    for end, axis in product(("frame_in", "frame_out"), "xz"):
        one, other = (getattr(getattr(each, end), axis) for each in matrices)
        np.testing.assert_allclose(one, other, rtol=0, atol=slack)


@rows("reflections", [1, 2, 3, 4, 5])
def test_light_that_goes_back_is_changed_by_the_transposed_matrix(reflections):
    points, materials = random_chains(10 + reflections, reflections, (50,)), MATERIALS[:reflections]
    there = op.path_from_vertices(points, materials).mueller()
    back = op.path_from_vertices(points[:, ::-1], materials[::-1]).mueller()
    # Going back, x = k_out cross k_in and z are both reversed, and y stays.
    for one, other in ((there.frame_in, back.frame_out), (there.frame_out, back.frame_in)):
        np.testing.assert_allclose([one.z, one.x], [-other.z, -other.x], rtol=0, atol=1e-15)
    expected = FLIP @ np.swapaxes(there.matrix, -1, -2) @ FLIP
    np.testing.assert_allclose(back.matrix, expected, rtol=0, atol=1e-13)
    np.testing.assert_allclose(there.matrix[:, 0, 0], back.matrix[:, 0, 0], rtol=1e-12)


def test_light_goes_back_through_surfaces_as_it_came_in_a_world_of_any_size():
    points, _, materials = random_histories(5, "TTT", 200)
    # Between equal media the frames of the two ways differ by choice.
    others = (materials[0] != 1.0) & np.all(np.diff(materials, axis=0), axis=0)
    points, materials = points[others], [n[others] for n in materials]
    there = op.path_from_vertices(points, materials, events="TTT")
    media = [*materials[:-1][::-1], 1.0]
    back = op.path_from_vertices(points[:, ::-1], media, events="TTT", outside=materials[-1])
    expected = FLIP @ np.swapaxes(there.mueller().matrix, -1, -2) @ FLIP
    np.testing.assert_allclose(back.mueller().matrix, expected, rtol=0, atol=1e-13)
    points = random_chains(4, 3, (100,))
    light = op.path_from_vertices(points, MATERIALS[:3]).trace().stokes
    for scale in (2.0**-200, 2.0**200):
        scaled = op.path_from_vertices(scale * points, MATERIALS[:3]).trace().stokes
        np.testing.assert_array_equal(scaled, light)


@pytest.mark.parametrize(("engine", "several"), SEVERAL)
def test_random_histories_are_those_of_a_reference_without_frames(engine, several):
    for events in several:
        points, normals, materials = random_histories(len(events), events, 500)
        path = op.path_from_vertices(points, materials, normals, events=events)
        light = op.Composer(engine=engine).compose(path).run()
        expected = stokes_in(coherency(points, events, materials), light.frame)
        off = np.abs(light.stokes - expected) / np.maximum(expected[:, :1], 0.01)
        assert np.max(off) <= 1e-13, events
    # A batch is the same as one history after the other, by an engine that compiles as well.
    for at in (0, 77, 499):
        one = op.path_from_vertices(points[at], [m[at] for m in materials], events=events).trace()
        np.testing.assert_allclose(light.stokes[at], one.stokes, rtol=0, atol=1e-15)


@pytest.mark.parametrize("count", [3, slow(100)])
def test_a_history_is_that_of_50_digits(count):
    for seed in range(count):
        points, materials, events = random_history(seed)
        path = op.path_from_vertices(points, materials, events=events)
        light = path.trace()
        exact = exact_stokes_in(exact_coherency(points, events, materials), light.frame)
        np.testing.assert_allclose(light.stokes, exact, rtol=0, atol=1e-13 * exact[0])
        known = [float(part) for part in exact_lights(path)["eye"].stokes]
        np.testing.assert_allclose(known, exact, rtol=0, atol=1e-13 * exact[0])
    # Light that is hardly turned keeps its digits beside other planes.
    for bent in (1e-15, 1e-12, 1e-9, 1e-7, 1e-4):
        points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [1 + bent, 2, 0.7 * bent], [0.3, 2, 1]])
        materials = [0.2 + 3.4j, 1.2, 1.1 + 2j]
        light = op.path_from_vertices(points, materials, events="RTR").trace()
        exact = exact_stokes_in(exact_coherency(points, "RTR", materials), light.frame)
        np.testing.assert_allclose(light.stokes, exact, rtol=0, atol=1e-14)


@settings(max_examples=12, deadline=None)
@given(st.integers(0, 10**6), st.text("RT", min_size=1, max_size=8))
def test_no_history_makes_light_brighter_or_more_polarised_or_knows_its_world(seed, events):
    points, _, materials = random_histories(seed, events, 20)
    light = op.path_from_vertices(points, materials, events=events).trace()
    assert np.all(light.intensity <= 1.0 + 1e-14)
    assert np.all(light.dop[light.intensity > 1e-9] <= 1.0 + 1e-9)
    rotation = random_rotation(np.random.default_rng(seed))
    turned = op.path_from_vertices(points @ rotation.T, materials, events=events).trace()
    np.testing.assert_allclose(turned.intensity, light.intensity, rtol=1e-9, atol=1e-13)
    moved = turned.in_frame(light.frame.rotated(rotation))
    np.testing.assert_allclose(moved.stokes, light.stokes, rtol=0, atol=1e-10)


def test_media_and_frames_follow_along_the_chain():
    points, normals, materials = random_histories(3, "RTT", 100)
    frame = op.path_from_vertices(points, materials, events="RTT").trace().frame
    assert op.Frame(frame.x, frame.y, frame.z) == frame, "orthogonal, and right-handed"
    legs = np.diff(points, axis=1)
    last = legs[:, -1] / np.linalg.norm(legs[:, -1], axis=-1, keepdims=True)
    np.testing.assert_allclose(frame.z, last, rtol=0, atol=1e-15)
    # x is along k_out cross k_in, for light into the denser medium as well as out of it.
    across = np.cross(legs[:, -1], legs[:, -2])
    turned = np.linalg.norm(across, axis=-1) > 1e-3
    assert 50 < np.sum(turned) < 100
    assert np.all(np.sum(frame.x * across, axis=-1)[turned] > 0.0)
    off = np.sum(frame.x * normals[:, -1], axis=-1)[turned]
    np.testing.assert_allclose(off, 0.0, rtol=0, atol=1e-12)
    down = [[0, 0, z] for z in (3, 2, 1, 2, 1, 0)]
    path = op.path_from_vertices(down, [1.5, 1.2, 1.2, 1.2], events="TRRT", outside=1.1)
    assert [path.element(f"vertex{n}").outside for n in (1, 2, 3, 4)] == [1.1, 1.5, 1.5, 1.5]
    into, echo = ((0.4 / 2.6) ** 2, (0.3 / 2.7) ** 2)
    expected = (1.0 - into) * echo * echo * (1.0 - echo)
    np.testing.assert_allclose(path.trace().intensity, expected, rtol=1e-14)
    # One refraction is that of an interface at its angle.
    light = op.path_from_vertices(INTO_GLASS, [1.5], events="T").trace()
    matrix = op.Interface(1.5, np.pi / 4).mueller("in", "transmitted").matrix
    np.testing.assert_allclose(light.stokes, matrix[:, 0], rtol=0, atol=1e-15)


@by_engine
def test_between_equal_media_light_goes_straight_on_and_nothing_changes(engine):
    points, _, materials = random_histories(7, "R", 50)
    straight = np.concatenate([points, 2.0 * points[:, 2:] - points[:, 1:2]], axis=1)
    composer = op.Composer(engine=engine)
    expected = composer.compose(op.path_from_vertices(points, materials, events="R")).run()
    path = op.path_from_vertices(straight, [*materials, 1.0], events="RT")
    light = composer.compose(path).run().in_frame(expected.frame)
    np.testing.assert_allclose(light.stokes, expected.stokes, rtol=0, atol=1e-15)
    line = [[0, 0, 3], [0, 0, 2], [0, 0, 1]]
    alone = op.path_from_vertices(line, [1.33], events="T", outside=1.33)
    np.testing.assert_array_equal(alone.mueller().matrix, np.eye(4))


def test_between_equal_media_light_goes_straight_on_in_any_precision():
    source, start, along = np.random.default_rng(5).normal(size=(3, 50, 3))
    points = np.stack([source, start, start + along, start + 2.3 * along], axis=1)
    for dtype in ("float32", "float64"):
        composer = op.Composer(dtype=dtype)
        light = composer.compose(op.path_from_vertices(points[:, 1:], [1.0], events="T")).run()
        np.testing.assert_array_equal(light.intensity, 1.0)
    # x is kept there as the frame has it.
    expected = op.path_from_vertices(points[:, :3], [1.5], events="R").trace()
    path = op.path_from_vertices(points, [1.5, 1.0], events="RT")
    light = op.Composer(dtype="float32").compose(path).run().in_frame(expected.frame)
    np.testing.assert_allclose(light.stokes, expected.stokes, rtol=0, atol=1e-6)


def test_vertices_and_normals_may_come_in_batches_of_any_length_and_side():
    points = random_chains(5, 3, (2, 1500))
    light = op.path_from_vertices(points, MATERIALS[:3]).trace()
    assert light.stokes.shape == (2, 1500, 4)
    assert light.frame.x.shape == (2, 1500, 3)
    for at in [(0, 0), (1, 700), (1, 1499)]:
        one = op.path_from_vertices(points[at], MATERIALS[:3], events="RRR").trace()
        np.testing.assert_allclose(light.stokes[at], one.stokes, rtol=1e-12, atol=1e-15)
        np.testing.assert_array_equal(light.frame.x[at], one.frame.x)
    points = random_chains(16, 2, (4,))
    expected = op.path_from_vertices(points, MATERIALS[:2]).trace()
    path = op.path_from_vertices(op.Parameter("points"), MATERIALS[:2])
    by_default = op.path_from_vertices(op.Parameter("points", default=points), MATERIALS[:2])
    assert path.bind(points=points).trace() == by_default.trace() == expected
    one = by_default.trace(points=points[1])
    np.testing.assert_allclose(one.stokes, expected.stokes[1], rtol=0, atol=1e-15)
    points = random_chains(12, 2, (4,))
    path = op.path_from_vertices(points, [op.Material(op.Parameter("n"), 0.5), np.array([1.5] * 4)])
    light = path.trace(n=1.2)
    expected = op.path_from_vertices(points, [1.2 + 0.5j, 1.5]).trace()
    np.testing.assert_allclose(light.stokes, expected.stokes, rtol=1e-15, atol=1e-16)
    op.path_from_vertices([[0, 0, 0], [0, 0, 1], [0, 0, 2]], [1.5], [[1, 1, 0]])
    points, normals, materials = random_histories(13, "TRTT", 500)
    materials[3] = materials[2]
    points[:, 5] = 2.0 * points[:, 4] - points[:, 3]
    normals[:, 3] = np.random.default_rng(0).normal(size=(500, 3))
    op.path_from_vertices(points, materials, -7.0 * normals, events="TRTT")
    for vertex, word in ((1, "the one that refracts"), (2, "the bisector")):
        wrong = normals.copy()
        wrong[321, vertex - 1] += 1e-5 * points[0, 0]
        with pytest.raises(
            op.errors.PathError, match=rf"vertex {vertex} of chain 321 is off {word}"
        ):
            op.path_from_vertices(points, materials, wrong, events="TRTT")


@pytest.mark.parametrize(("engine", "dtype"), KINDS)
def test_points_and_indices_given_later_are_the_same_as_those_that_are_known(engine, dtype):
    composer, slack = op.Composer(engine=engine, dtype=dtype), 1e-13 if dtype == "float64" else 1e-4
    points, _, (first, _) = random_histories(11, "TR", 500)
    known = op.path_from_vertices(points, [first, 1.9], events="TR").trace()
    path = op.path_from_vertices(op.Parameter("points"), [first, op.Parameter("n")], events="TR")
    plan = composer.compose(path)
    found = plan.run(points=points, n=1.9)
    np.testing.assert_allclose(found.stokes, known.stokes, rtol=0, atol=slack)
    np.testing.assert_array_equal(found.frame.x, known.frame.x)
    if engine == "numpy":
        points = random_chains(6, 3, (2000,))
        known = composer.compose(op.path_from_vertices(points, MATERIALS[:3])).run()
        plan = composer.compose(op.path_from_vertices(op.Parameter("points"), MATERIALS[:3]))
        found, one = plan.run(points=points), plan.run(points=points[7])
        np.testing.assert_allclose(found.stokes, known.stokes, rtol=0, atol=slack)
        np.testing.assert_array_equal(found.frame.x, known.frame.x)
        np.testing.assert_allclose(one.stokes, known.stokes[7], rtol=0, atol=slack)
        assert one.frame.x.shape == (3,)


def test_frames_of_a_stream_are_of_the_vertices_that_were_given():
    points, index = random_chains(7, 2, (5, 1)), np.linspace(1.2, 1.8, 3)
    plan = op.path_from_vertices(op.Parameter("points"), [1.5, op.Parameter("n")]).compose()
    whole = plan.run(points=points, n=index)
    for where, light in plan.stream(4, points=points, n=index):
        np.testing.assert_array_equal(light.stokes, whole.stokes[where])
        expected = np.broadcast_to(whole.frame.z, (5, 3, 3))[where]
        np.testing.assert_array_equal(np.broadcast_to(light.frame.z, expected.shape), expected)
    points = random_chains(8, 2)
    expected = op.path_from_vertices(points.copy(), MATERIALS[:2]).trace().frame
    light = op.path_from_vertices(op.Parameter("points"), MATERIALS[:2]).trace(points=points)
    points[:] = 0.0
    assert light.frame == expected


@pytest.mark.parametrize("engine", ENGINES)
def test_light_straight_through_and_along_the_normal_keeps_what_it_came_with(engine):
    # At grazing incidence everything is reflected, r_s = r_p.
    points = [[0.0, 0, 0], [0, 0, 1], [0, 1, 1], [0, 3, 1], [1, 3, 1]]
    bent = [[0.0, 0, 0], [0, 0, 1], [0, 3, 1], [1, 3, 1]]
    composer = op.Composer(engine=engine)
    light = composer.compose(op.path_from_vertices(points, [1.5, 1.12 + 2j, 1.5])).run()
    expected = composer.compose(op.path_from_vertices(bent, [1.5, 1.5])).run()
    np.testing.assert_allclose(light.stokes, expected.stokes, rtol=0, atol=1e-15)
    assert light.frame == expected.frame
    points = [[0.0, 0, 0], [0, 0, 1], [0, 1, 1], [0, 0, 1]]
    light = composer.compose(op.path_from_vertices(points, [1.5, 1.5])).run()
    first = op.path_from_vertices(points[:3], [1.5]).trace()
    np.testing.assert_array_equal(light.frame.x, first.frame.x)
    # Fresnel at the normal: ((n - 1) / (n + 1))^2 = 0.04, and y turns with the light.
    expected = 0.04 * first.stokes * [1, 1, -1, -1]
    np.testing.assert_allclose(light.stokes, expected, rtol=1e-15, atol=1e-16)
    # A chain without any plane takes the world's x or y.
    for end, x in (([0, 0, 0], [1, 0, 0]), ([0, 0, 5], [1, 0, 0]), ([2, 0, 0], [0, 1, 0])):
        middle = [1, 0, 0] if end[0] else [0, 0, 1]
        frame = op.path_from_vertices([[0, 0, 0], middle, end], [1.5]).trace().frame
        np.testing.assert_array_equal(frame.x, x)


def test_slopes_along_vertices_are_those_of_differences_and_frames_have_none(jax, jacobian):
    points = random_chains(11, 1)
    plan = op.path_from_vertices(op.Parameter("points"), MATERIALS[:1]).compose()
    # Where vertices have no plane, too.
    both = jax.numpy.asarray([points, [[0.0, 0, 0], [0, 0, 1], [0, 0, 2]]])
    read = np.array([[1, 0, 0, 0], [1, 1, 1, 1]])
    slopes, straight = jacobian(lambda p: (plan.run(points=p).stokes * read).sum())(both)
    assert np.all(np.isfinite(straight))
    for at in [(0, 1), (1, 0), (2, 2)]:
        step = np.zeros_like(points)
        step[at] = 1e-6
        ends = [float(plan.run(points=points + sign * step).intensity) for sign in (1, -1)]
        assert float(slopes[at]) == pytest.approx((ends[0] - ends[1]) / 2e-6, abs=1e-8)
    path = op.path_from_vertices(op.Parameter("points"), [1.5])
    with pytest.raises(op.errors.FrameError, match="JAX traces"), quickly("jax"):
        jax.grad(lambda p: path.trace(points=p).frame.x[0])(jax.numpy.asarray(CORNER))


def test_long_chains_run_plans_go_through_pickle_and_large_arrays_are_told_by_shape():
    points = random_chains(17, 40, (5,))
    found = op.path_from_vertices(points, [0.2 + 3.4j] * 40).trace()
    expected = interfaces_in_space(points, [0.2 + 3.4j] * 40).trace()
    turned = found.in_frame(expected.frame)
    np.testing.assert_allclose(turned.normalized, expected.normalized, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.intensity, expected.intensity, rtol=1e-11)
    points = random_chains(14, 2, (3,))
    plan = op.path_from_vertices(op.Parameter("points"), MATERIALS[:2]).compose()
    light = plan.run(points=points)
    assert pickle.loads(pickle.dumps(plan)).run(points=points) == light
    assert pickle.loads(pickle.dumps(light)) == light
    path = op.path_from_vertices(random_chains(15, 2, (1000,)), MATERIALS[:2])
    assert "vertices=array of shape (1000, 4, 3)" in draw(path)
    assert len(path.compose().explain()) < 2000


@rows("dtype", ["int16", "uint8", "float32", "longdouble"])
def test_points_of_any_kind_of_number_are_the_same_as_floats(dtype):
    points = 40.0 * np.array([[2, 0, 5], [2, 0, 0], [2, 4, 0], [0, 4, 4]])
    expected = op.path_from_vertices(points, MATERIALS[:2]).trace()
    legs = np.diff(points, axis=0)
    legs /= np.linalg.norm(legs, axis=-1, keepdims=True)
    given, normals = points.astype(dtype), np.diff(legs, axis=0)
    light = op.path_from_vertices(given, MATERIALS[:2], normals).trace()
    np.testing.assert_allclose(light.stokes, expected.stokes, rtol=1e-14)
    later = op.path_from_vertices(op.Parameter("points"), MATERIALS[:2]).trace(points=given)
    for found in (light, later):
        np.testing.assert_array_equal(found.frame.x, expected.frame.x)
        assert found.frame.x.dtype == np.float64
    one, other = (op.SpecularVertex(1.5, each, 1).mueller().frame_out for each in (given, points))
    np.testing.assert_array_equal(one.x, other.x)
    whole = np.array([[0, 7, 7]], dtype)
    of_whole_normals = op.path_from_vertices(np.array(CORNER, dtype), [1.5], whole)
    assert of_whole_normals == op.path_from_vertices(CORNER, [1.5])
    # Media that an array made complex are the real ones that they are.
    points, media = [[0, 0, z] for z in (3, 2, 1, 2, 3)], [1.5, 0.2 + 3.4j, 1.0]
    expected = op.path_from_vertices(points, media, events="TRT").trace()
    for given in (np.array(media), [1.5 + 0j, *media[1:]]):
        assert op.path_from_vertices(points, given, events="TRT").trace() == expected
    # A frame of anything is looked at without a warning.
    for scale in (0.0, 1e-200, 1e155, np.inf):
        with np.errstate(all="ignore"), checked_later():
            vertex = op.SpecularVertex(1.5, scale * np.array(CORNER), 1)
        vertex.own_frame("reflected").frame({})


def test_a_chain_goes_to_toml_and_back_with_its_points(tmp_path):
    refracting = op.path_from_vertices(INTO_GLASS, [op.Parameter("n", default=1.5)], events="T")
    for path, written in (
        (op.path_from_vertices([CORNER, CORNER], [1.5]), "vertices = [[[0.0, 0.0, 3.0]"),
        (refracting, 'kind = "refracting-vertex"'),
    ):
        assert written in path.to_toml()
        assert read_back(path, tmp_path) == path
        assert read_back(path, tmp_path).trace() == path.trace()
