import pickle

import numpy as np
import pytest

import optipath as op
from chains import COMPILED, ENGINES, MATERIALS, interfaces_in_space, random_chains, random_rotation
from optipath.paths.drawing import draw
from optipath.values.made import checked_later

FLIP = np.diag([1.0, 1.0, -1.0, 1.0])
CORNER = [[0.0, 0.0, 3.0], [0.0, 0.0, 0.0], [0.0, 4.0, 0.0]]


# The rounding of a point turns a plane by so much over the sine of twice the incidence.
@pytest.mark.parametrize(("extreme", "slack"), [(False, 2e-14), (True, 1e-9)])
@pytest.mark.parametrize("reflections", [1, 2, 3, 4, 5])
def test_a_chain_is_the_same_as_interfaces_that_are_placed_by_hand(reflections, extreme, slack):
    points = random_chains(reflections, reflections, (200,), extreme=extreme)
    found = op.path_from_vertices(points, MATERIALS[:reflections], intensity=100.0)
    by_hand = interfaces_in_space(points, MATERIALS[:reflections], intensity=100.0)
    light, expected = found.trace(), by_hand.trace()
    scale = expected.intensity[:, np.newaxis]
    turned = light.in_frame(expected.frame).stokes
    np.testing.assert_allclose(turned / scale, expected.stokes / scale, rtol=0, atol=slack)
    for one, other in zip(frames_of(found), frames_of(by_hand), strict=True):
        np.testing.assert_allclose(one, other, rtol=0, atol=slack)
    matrices = found.mueller().matrix, by_hand.mueller().matrix
    np.testing.assert_allclose(*matrices, rtol=0, atol=slack)


def frames_of(path):
    matrix = path.mueller()
    return matrix.frame_in.x, matrix.frame_in.z, matrix.frame_out.x, matrix.frame_out.z


@pytest.mark.parametrize("reflections", [1, 2, 3, 4, 5])
def test_light_that_goes_back_is_changed_by_the_transposed_matrix(reflections):
    points = random_chains(10 + reflections, reflections, (50,))
    materials = MATERIALS[:reflections]
    there = op.path_from_vertices(points, materials).mueller()
    back = op.path_from_vertices(points[:, ::-1], materials[::-1]).mueller()
    # Going back, x = k_out cross k_in and z are both reversed, and y stays.
    for one, other in ((there.frame_in, back.frame_out), (there.frame_out, back.frame_in)):
        np.testing.assert_allclose(one.z, -other.z, rtol=0, atol=1e-15)
        np.testing.assert_allclose(one.x, -other.x, rtol=0, atol=1e-15)
    expected = FLIP @ np.swapaxes(there.matrix, -1, -2) @ FLIP
    np.testing.assert_allclose(back.matrix, expected, rtol=0, atol=1e-13)
    intensity = op.path_from_vertices(points, materials).trace().intensity
    reversed_too = op.path_from_vertices(points[:, ::-1], materials[::-1]).trace().intensity
    np.testing.assert_allclose(intensity, reversed_too, rtol=1e-12)


def test_a_rotation_of_the_whole_world_changes_nothing_but_the_frame():
    points, rng = random_chains(3, 3, (100,)), np.random.default_rng(3)
    rotation = random_rotation(rng)
    light = op.path_from_vertices(points, MATERIALS[:3]).trace()
    turned = op.path_from_vertices(points @ rotation.T, MATERIALS[:3]).trace()
    np.testing.assert_allclose(turned.intensity, light.intensity, rtol=1e-12)
    moved = light.frame.rotated(rotation)
    np.testing.assert_allclose(turned.in_frame(moved).stokes, light.stokes, rtol=0, atol=1e-9)


def test_the_size_of_the_world_and_its_origin_do_not_matter():
    points = random_chains(4, 3, (100,))
    light = op.path_from_vertices(points, MATERIALS[:3]).trace().stokes
    for scale in (2.0**-200, 2.0**200):
        scaled = op.path_from_vertices(scale * points, MATERIALS[:3]).trace().stokes
        np.testing.assert_array_equal(scaled, light)


@pytest.mark.parametrize("engine", COMPILED)
def test_a_batch_is_the_same_as_one_chain_after_the_other(engine):
    points = random_chains(5, 3, (2, 1500))
    plan = op.Composer(engine=engine).compose(op.path_from_vertices(points, MATERIALS[:3]))
    light = plan.run()
    assert light.stokes.shape == (2, 1500, 4)
    assert light.frame.x.shape == (2, 1500, 3)
    for at in [(0, 0), (1, 700), (1, 1499)]:
        one = op.path_from_vertices(points[at], MATERIALS[:3], events="RRR").trace()
        np.testing.assert_allclose(light.stokes[at], one.stokes, rtol=1e-12, atol=1e-15)
        np.testing.assert_array_equal(light.frame.x[at], one.frame.x)


@pytest.mark.parametrize(
    ("engine", "dtype"), [*((engine, "float64") for engine in ENGINES), ("numpy", "float32")]
)
def test_vertices_that_are_given_later_are_the_same_as_those_that_are_known(engine, dtype):
    points = random_chains(6, 3, (2000,))
    composer = op.Composer(engine=engine, dtype=dtype)
    known = composer.compose(op.path_from_vertices(points, MATERIALS[:3])).run()
    plan = composer.compose(op.path_from_vertices(op.Parameter("points"), MATERIALS[:3]))
    given = plan.run(points=points)
    slack = 1e-12 if dtype == "float64" else 1e-4
    np.testing.assert_allclose(given.stokes, known.stokes, rtol=0, atol=slack)
    np.testing.assert_array_equal(given.frame.x, known.frame.x)
    one = plan.run(points=points[7])
    np.testing.assert_allclose(one.stokes, known.stokes[7], rtol=0, atol=slack)
    assert one.frame.x.shape == (3,)


def test_the_parts_of_a_stream_have_the_frames_of_their_chains():
    points = random_chains(7, 2, (5, 1))
    index = np.linspace(1.2, 1.8, 3)
    plan = op.path_from_vertices(op.Parameter("points"), [1.5, op.Parameter("n")]).compose()
    whole = plan.run(points=points, n=index)
    for where, light in plan.stream(4, points=points, n=index):
        np.testing.assert_array_equal(light.stokes, whole.stokes[where])
        expected = np.broadcast_to(whole.frame.z, (5, 3, 3))[where]
        np.testing.assert_array_equal(np.broadcast_to(light.frame.z, expected.shape), expected)


def test_a_frame_is_of_the_vertices_that_were_given_though_they_change_afterwards():
    points = random_chains(8, 2)
    expected = op.path_from_vertices(points.copy(), MATERIALS[:2]).trace().frame
    light = op.path_from_vertices(op.Parameter("points"), MATERIALS[:2]).trace(points=points)
    points[:] = 0.0
    assert light.frame == expected


def test_the_frame_of_the_last_leg_is_right_handed_and_lies_along_it():
    points = random_chains(9, 4, (300,))
    frame = op.path_from_vertices(points, MATERIALS[:4]).trace().frame
    assert op.Frame(frame.x, frame.y, frame.z) == frame, "orthogonal, and right-handed"
    leg = points[:, -1] - points[:, -2]
    np.testing.assert_allclose(np.cross(frame.z, leg), 0.0, rtol=0, atol=1e-12)


@pytest.mark.parametrize("engine", ENGINES)
def test_light_straight_through_keeps_all_it_has(engine):
    # At grazing incidence everything is reflected, r_s = r_p.
    points = [[0.0, 0, 0], [0, 0, 1], [0, 1, 1], [0, 3, 1], [1, 3, 1]]
    bent = [[0.0, 0, 0], [0, 0, 1], [0, 3, 1], [1, 3, 1]]
    composer = op.Composer(engine=engine)
    light = composer.compose(op.path_from_vertices(points, [1.5, 1.12 + 2j, 1.5])).run()
    expected = composer.compose(op.path_from_vertices(bent, [1.5, 1.5])).run()
    np.testing.assert_allclose(light.stokes, expected.stokes, rtol=0, atol=1e-15)
    assert light.frame == expected.frame


@pytest.mark.parametrize("engine", ENGINES)
def test_light_along_the_normal_keeps_the_x_that_it_came_with(engine):
    points = [[0.0, 0, 0], [0, 0, 1], [0, 1, 1], [0, 0, 1]]
    composer = op.Composer(engine=engine)
    light = composer.compose(op.path_from_vertices(points, [1.5, 1.5])).run()
    first = op.path_from_vertices(points[:3], [1.5]).trace()
    np.testing.assert_array_equal(light.frame.x, first.frame.x)
    # Fresnel at the normal: ((n - 1) / (n + 1))^2 = 0.04, and y turns with the light.
    expected = 0.04 * first.stokes * [1, 1, -1, -1]
    np.testing.assert_allclose(light.stokes, expected, rtol=1e-15, atol=1e-16)


def test_a_chain_without_any_plane_takes_the_worlds_x():
    for points in ([[0, 0, 0], [0, 0, 1], [0, 0, 0]], [[0, 0, 0], [0, 0, 1], [0, 0, 5]]):
        np.testing.assert_array_equal(
            op.path_from_vertices(points, [1.5]).trace().frame.x, [1, 0, 0]
        )
    along_x = op.path_from_vertices([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [1.5]).trace()
    np.testing.assert_array_equal(along_x.frame.x, [0, 1, 0])


def test_gradients_with_respect_to_vertices_are_those_of_differences(jax):
    points = random_chains(11, 2)
    plan = op.path_from_vertices(op.Parameter("points"), MATERIALS[:2]).compose()
    slopes = jax.grad(lambda p: plan.run(points=p).stokes[0])(jax.numpy.asarray(points))
    for at in [(0, 1), (2, 0), (3, 2)]:
        step = np.zeros_like(points)
        step[at] = 1e-6
        ends = [float(plan.run(points=points + sign * step).intensity) for sign in (1, -1)]
        assert float(slopes[at]) == pytest.approx((ends[0] - ends[1]) / 2e-6, abs=1e-8)


def test_gradients_are_finite_where_vertices_have_no_plane(jax):
    points = [[0.0, 0, 0], [0, 0, 1], [0, 0, 2], [0, 0, 0]]
    path = op.path_from_vertices(op.Parameter("points"), MATERIALS[:2])
    slopes = jax.grad(lambda p: path.trace(points=p).stokes.sum())(jax.numpy.asarray(points))
    assert np.all(np.isfinite(slopes))


def test_a_frame_of_traced_vertices_is_refused(jax):
    path = op.path_from_vertices(op.Parameter("points"), [1.5])
    with pytest.raises(op.FrameError, match="JAX traces"):
        jax.grad(lambda p: path.trace(points=p).frame.x[0])(jax.numpy.asarray(CORNER))


def test_materials_may_be_arrays_and_parameters():
    points = random_chains(12, 2, (4,))
    path = op.path_from_vertices(points, [op.Material(op.Parameter("n"), 0.5), np.array([1.5] * 4)])
    light = path.trace(n=1.2)
    expected = op.path_from_vertices(points, [1.2 + 0.5j, 1.5]).trace()
    np.testing.assert_allclose(light.stokes, expected.stokes, rtol=1e-15, atol=1e-16)


def test_vertices_may_be_bound_for_good_or_have_a_default():
    points = random_chains(16, 2, (4,))
    expected = op.path_from_vertices(points, MATERIALS[:2]).trace()
    path = op.path_from_vertices(op.Parameter("points"), MATERIALS[:2])
    assert path.bind(points=points).trace() == expected
    by_default = op.path_from_vertices(op.Parameter("points", default=points), MATERIALS[:2])
    assert by_default.trace() == expected
    one = by_default.trace(points=points[1])
    np.testing.assert_allclose(one.stokes, expected.stokes[1], rtol=0, atol=1e-15)


def test_a_chain_too_long_to_be_compiled_is_run_all_the_same():
    points = random_chains(17, 40, (5,))
    found = op.path_from_vertices(points, [0.2 + 3.4j] * 40).trace()
    expected = interfaces_in_space(points, [0.2 + 3.4j] * 40).trace()
    turned = found.in_frame(expected.frame)
    np.testing.assert_allclose(turned.normalized, expected.normalized, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.intensity, expected.intensity, rtol=1e-11)


def test_normals_along_the_bisectors_are_taken_whatever_their_length_and_side():
    normals = [[0.0, -7.0, -7.0]]
    path = op.path_from_vertices(CORNER, [1.5], normals)
    assert path == op.path_from_vertices(CORNER, [1.5])
    straight = [[0, 0, 0], [0, 0, 1], [0, 0, 2]]
    op.path_from_vertices(straight, [1.5], [[1, 1, 0]])


def test_a_normal_off_the_bisector_is_named_with_its_angle():
    tilted = [0.0, np.sin(np.radians(46.0)), np.cos(np.radians(46.0))]
    with pytest.raises(op.PathError, match=r"vertex 1 is off the bisector .* by 1 deg"):
        op.path_from_vertices(CORNER, [1.5], [tilted])
    with pytest.raises(op.PathError, match=r"vertex 1 of chain 1 is off .* by 45 deg"):
        op.path_from_vertices([CORNER, CORNER], [1.5], [[[0, 1, 1]], [[0, 1, 0]]])


@pytest.mark.parametrize(
    ("arguments", "messages"),
    [
        ((CORNER, []), ["materials must be a sequence"]),
        ((CORNER, 1.5), ["materials must be a sequence", "not 1.5"]),
        ((CORNER, [1.5, 1.5]), ["(..., m + 2, 3), m = 2 for 2 materials, not (3, 3)"]),
        ((CORNER[:2], [-1.5]), ["m = 1 for 1 material, not (2, 3)", "-1.5"]),
        (([[0, 0], [1, 1], [2, 0]], [1.5]), ["not (3, 2)"]),
        (([[0, 0, 0], [1, 1]], [1.5]), ["rows of unequal lengths"]),
        (([[0, 0, np.inf], *CORNER[1:]], [-1.5]), ["finite", "-1.5"]),
        (([CORNER[0], CORNER[0], CORNER[2]], [1.5]), ["vertices 0 and 1", "are one point"]),
        ((CORNER, ["glass"]), ["'glass'"]),
        ((CORNER, [1.5], [[0, 0]]), ["normals must have shape (..., 1, 3), not (1, 2)"]),
        ((CORNER, [-1.5], [[0, 1, 0]]), ["off the bisector", "-1.5"]),
        ((CORNER, [1.5], [[0, 0, 0]]), ["the normal of vertex 1 has no length"]),
        ((CORNER, [1.5], [[0, 0, 1], [0, 0, 1]]), ["normals must have shape (..., 1, 3)"]),
        ((op.Parameter("v"), [1.5], [[0, 0, 1]]), ["points that are known"]),
        ((op.VerticesByAngles((0.3,)), [1.5, 1.5]), ["1 incidence, m = 2 for 2 materials"]),
        ((op.VerticesByAngles((2.0,)), [1.5]), ["vertices.incidences[0] is 2 rad, which is 114"]),
        ((None, [1.5]), ["m = 1 for 1 material, not None"]),
        (("abc", [1.5]), ["not 'abc'"]),
        (({}, [1.5]), ["not {}"]),
        (((point for point in CORNER), [1.5]), ["not <generator"]),
        ((CORNER, [1.5], [[0, 1j, 1]]), ["normals must be real numbers, not"]),
        ((CORNER, [1.5], [[0, 1], [1]]), ["the array of normals has rows of unequal lengths"]),
        ((CORNER, [1.5], [[0, np.nan, 1]]), ["the normal of vertex 1 is not finite"]),
        (([[CORNER] * 3] * 2, [1.5], [[[0, 1, 1]]] * 2), ["vertices (2, 3), normals (2,)"]),
        (
            ([CORNER[0], CORNER[0], [0, 0, np.nan]], [-1.5], [[0, 0, 0]]),
            [
                "3 faults",
                "vertex 2, counted from the light as 0, is [0.0, 0.0, nan]",
                "-1.5",
                "has no length",
            ],
        ),
        (([CORNER[0], CORNER[0], CORNER[2]], [1.5], [[0, 1, 1]]), ["vertices 0 and 1"]),
    ],
)
def test_what_is_wrong_is_told_in_words(arguments, messages):
    with pytest.raises(op.PathError) as error:
        op.path_from_vertices(*arguments)
    for message in messages:
        assert message in str(error.value)


def test_all_normals_of_sound_vertices_are_told_at_once_and_of_faulty_ones_no_angle():
    with pytest.raises(op.PathError) as error:
        op.path_from_vertices(np.array(CORNER) * np.nan, [1.5], [[0, 1, 0]])
    assert "off the bisector" not in str(error.value)


@pytest.mark.parametrize(
    ("batch", "chain", "told"), [((7,), (5,), "chain 5"), ((2, 4), (1, 2), r"chain \(1, 2\)")]
)
def test_the_chain_of_a_batch_that_is_wrong_is_named(batch, chain, told):
    points = np.broadcast_to(np.array(CORNER), (*batch, 3, 3)).copy()
    normals = np.broadcast_to([[0.0, 1.0, 1.0]], (*batch, 1, 3)).copy()
    for wrong, message in (
        (np.nan, rf"vertex 2 of {told}, counted from the light as 0, is \[nan, nan, nan\]"),
        (points[(*chain, 1)], rf"vertices 1 and 2 of {told}"),
        (1e80, rf"vertices 1 and 2 of {told}, .*1e\+80 apart; legs are within 1e-70 .. 1e\+70"),
    ):
        faulty = points.copy()
        faulty[(*chain, 2)] = wrong
        with pytest.raises(op.PathError, match=message):
            op.path_from_vertices(faulty, [1.5], normals)
    normals[chain] = [[0.0, 1.0, 1.001]]
    with pytest.raises(op.PathError, match=rf"the normal of vertex 1 of {told} is off .* 0.0286 d"):
        op.path_from_vertices(points, [1.5], normals)


def test_one_coordinate_of_many_chains_that_is_not_finite_is_named():
    points = random_chains(18, 3, (10_000,))
    points[7777, 3, 2] = np.nan
    with pytest.raises(op.PathError, match=r"vertex 3 of chain 7777, .* nan\]"):
        op.path_from_vertices(points, MATERIALS[:3])
    plan = op.path_from_vertices(op.Parameter("points"), MATERIALS[:3]).compose()
    with pytest.raises(op.ParameterError, match=r"'points' is nan at \(7777, 3, 2\)"):
        plan.run(points=points)


@pytest.mark.parametrize("dtype", ["int16", "int32", "int64", "uint8", "float32", "longdouble"])
def test_points_of_any_kind_of_number_are_the_same_as_floats(dtype):
    points = 40.0 * np.array([[2, 0, 5], [2, 0, 0], [2, 4, 0], [0, 4, 4]])
    expected = op.path_from_vertices(points, MATERIALS[:2]).trace()
    legs = np.diff(points, axis=0)
    legs /= np.linalg.norm(legs, axis=-1, keepdims=True)
    given, normals = points.astype(dtype), np.diff(legs, axis=0)
    light = op.path_from_vertices(given, MATERIALS[:2], normals).trace()
    np.testing.assert_allclose(light.stokes, expected.stokes, rtol=1e-14)
    np.testing.assert_array_equal(light.frame.x, expected.frame.x)
    assert light.frame.x.dtype == np.float64
    later = op.path_from_vertices(op.Parameter("points"), MATERIALS[:2]).trace(points=given)
    np.testing.assert_array_equal(later.frame.x, expected.frame.x)
    matrix = op.SpecularVertex(1.5, given, 1).mueller()
    np.testing.assert_array_equal(
        matrix.frame_out.x, op.SpecularVertex(1.5, points, 1).mueller().frame_out.x
    )
    of_whole_normals = op.path_from_vertices(
        np.array(CORNER, dtype), [1.5], np.array([[0, 7, 7]], dtype)
    )
    assert of_whole_normals == op.path_from_vertices(CORNER, [1.5])


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("count", [1, 3000])
@pytest.mark.parametrize("scale", [1e-160, 1e-75, 1e75, 1e155])
def test_legs_that_are_too_short_or_too_long_are_refused(engine, count, scale):
    points = random_chains(19, 2, (count,))
    points[-1] *= scale
    with pytest.raises(op.PathError, match=r"apart; legs are within 1e-70 .. 1e\+70"):
        op.path_from_vertices(points, MATERIALS[:2])
    path = op.path_from_vertices(op.Parameter("points"), MATERIALS[:2])
    plan = op.Composer(engine=engine).compose(path)
    with pytest.raises(op.ParameterError, match=r"apart; legs are within 1e-70 .. 1e\+70"):
        plan.run(points=points)


@pytest.mark.filterwarnings("error")
def test_a_frame_of_anything_is_looked_at_without_a_warning():
    for scale in (0.0, 1e-200, 1e155, np.inf):
        with np.errstate(all="ignore"), checked_later():
            vertex = op.SpecularVertex(1.5, scale * np.array(CORNER), 1)
        vertex.own_frame("reflected").frame({})


@pytest.mark.parametrize("seed", range(3))
def test_normals_next_to_the_tolerance_are_told_apart_exactly(seed):
    points = random_chains(20 + seed, 3, (5000,))
    legs = np.diff(points, axis=-2)
    legs /= np.linalg.norm(legs, axis=-1, keepdims=True)
    bisectors = np.diff(legs, axis=-2)
    across = np.cross(bisectors, legs[:, 1:])
    across *= np.linalg.norm(bisectors, axis=-1, keepdims=True)
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    size = np.linalg.norm(bisectors, axis=-1, keepdims=True)
    op.path_from_vertices(points, MATERIALS[:3], bisectors + 0.99e-6 * size * across)
    off = np.zeros((5000, 3, 1))
    off[4321, 1] = 1.01e-6
    with pytest.raises(op.PathError, match="vertex 2 of chain 4321 is off"):
        op.path_from_vertices(points, MATERIALS[:3], bisectors + off * size * across)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("count", [1, 3, 3000])
def test_vertices_given_later_are_checked_by_every_engine(engine, count):
    points = random_chains(13, 3, (count,))
    path = op.path_from_vertices(op.Parameter("points"), MATERIALS[:3])
    plan = op.Composer(engine=engine).compose(path)
    together, nan = points.copy(), points.copy()
    together[-1, 2], nan[-1, 4, 1] = together[-1, 1], np.nan
    for wrong, message in (
        (together, r"vertices 1 and 2.* are one point"),
        (nan, "is nan"),
        (points[:, :4], r"must have shape \(\.\.\., 5, 3\)"),
        (0.5, r"must have shape \(\.\.\., 5, 3\)"),
    ):
        with pytest.raises(op.ParameterError, match=message):
            plan.run(points=wrong)


def test_a_plan_of_vertices_goes_through_pickle():
    points = random_chains(14, 2, (3,))
    plan = op.path_from_vertices(op.Parameter("points"), MATERIALS[:2]).compose()
    light = plan.run(points=points)
    copy = pickle.loads(pickle.dumps(plan)).run(points=points)
    assert copy == light
    assert pickle.loads(pickle.dumps(plan.run(points=points))) == light


def test_a_path_goes_to_toml_and_back_with_its_points(tmp_path):
    path = op.path_from_vertices([CORNER, CORNER], [1.5])
    file = tmp_path / "corner.toml"
    file.write_text(path.to_toml(), "utf-8")
    assert op.load_preset(file) == path
    assert "vertices = [[[0.0, 0.0, 3.0]" in path.to_toml()


def test_a_large_array_of_vertices_is_described_by_its_shape():
    path = op.path_from_vertices(random_chains(15, 2, (1000,)), MATERIALS[:2])
    assert "vertices=array of shape (1000, 4, 3)" in draw(path)
    assert len(path.compose().explain()) < 2000


def test_what_is_done_with_bad_vertices_is_a_word_and_no_array():
    with pytest.raises(op.PathError, match=r"bad .* is unknown; there are: refuse, mask"):
        op.path_from_vertices([[0, 0, 1], [0, 0, 0]], [1.5], bad=np.zeros((1, 2)))
