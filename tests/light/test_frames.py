"""Frames of light, its incidence, and products that are refused."""

import copy
import pickle

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import optipath as op
from tables import rows

ANGLES = st.floats(-2.0 * np.pi, 2.0 * np.pi)
VECTORS = hnp.arrays(float, 3, elements=st.floats(-1.0, 1.0)).filter(
    lambda v: np.linalg.norm(v) > 0.1
)


@st.composite
def rotations(draw):
    """A proper rotation matrix, from a quaternion."""
    quaternion = draw(hnp.arrays(float, 4, elements=st.floats(-1.0, 1.0)))
    if np.linalg.norm(quaternion) < 0.1:
        quaternion = np.array([1.0, 0.0, 0.0, 0.0])
    w, x, y, z = quaternion / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def test_a_frame_turns_x_to_y_and_is_that_of_the_world_by_default():
    frame = op.Frame()
    assert np.array_equal([frame.x, frame.y, frame.z], np.eye(3))
    turned = op.Frame().turned(np.pi / 2)
    np.testing.assert_allclose(turned.x, [0, 1, 0], rtol=1e-15, atol=1e-16)
    np.testing.assert_allclose(turned.y, [-1, 0, 0], rtol=1e-15, atol=1e-16)


@given(angle=ANGLES, rotation=rotations())
def test_turning_a_frame_by_a_gives_cos_2a_and_sin_2a(angle, rotation):
    frame = op.Frame().rotated(rotation)
    c, s = frame.turn_to(frame.turned(angle))
    assert abs(c - np.cos(2 * angle)) <= 1e-14
    assert abs(s - np.sin(2 * angle)) <= 1e-14


@given(rotation=rotations(), common=rotations(), angle=ANGLES)
def test_the_turn_between_frames_does_not_depend_on_the_world(rotation, common, angle):
    first = op.Frame().rotated(rotation)
    second = first.turned(angle)
    before = first.turn_to(second)
    after = first.rotated(common).turn_to(second.rotated(common))
    np.testing.assert_allclose(after, before, rtol=0, atol=1e-14)


def test_frames_of_other_directions_are_refused_but_for_rounding():
    tilted = op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))
    with pytest.raises(op.FrameError, match=r"\(0, 0, 1\).*\(0, 1, 0\)"):
        op.Frame().turn_to(tilted)
    nearly = op.Frame.from_direction(z=(0, 5e-9, 1), x=(1, 0, 0))
    op.Frame().turn_to(nearly)
    off = op.Frame.from_direction(z=(0, 2e-8, 1), x=(1, 0, 0))
    with pytest.raises(op.FrameError, match="one direction"):
        op.Frame().turn_to(off)
    back = op.Frame.from_direction(z=(0, 0, -1), x=(1, 0, 0))
    with pytest.raises(op.FrameError, match="one direction"):
        op.Frame().turn_to(back)


@rows("angle", ["2e-08", "1e-05"])
def test_directions_that_differ_by_little_are_told_with_their_angle(angle):
    off = op.Frame.from_direction(z=(0, float(angle), 1), x=(1, 0, 0))
    with pytest.raises(op.FrameError, match=f", {angle} rad beside it; only frames"):
        op.Light([1, 0, 0, 0]) + op.Light([1, 0, 0, 0], off)


def rounded(frame, dtype=np.float32):
    return op.Frame(*(axis.astype(dtype) for axis in (frame.x, frame.y, frame.z)))


@given(rotation=rotations(), angle=ANGLES, dtype=st.sampled_from([np.float32, np.float16]))
def test_frames_rounded_to_less_precision_are_aligned_with_others(rotation, angle, dtype):
    frame = op.Frame().rotated(rotation)
    turned = frame.turned(angle)
    several = rounded(frame.turned([0.0, 1.0]), dtype)
    (one,) = op.Light([[1, 1, 0, 0]] * 2, several)[:1]
    wanted = [1, np.cos(2 * angle), -np.sin(2 * angle), 0]
    tolerance = 8 * np.finfo(dtype).eps
    for off in (rounded(frame, dtype), pickle.loads(pickle.dumps(rounded(frame, dtype)))):
        for start, end in (
            (off, turned),
            (frame, rounded(turned, dtype)),
            (off, off.turned(angle)),
        ):
            light = op.Light([1, 1, 0, 0], start).in_frame(end)
            np.testing.assert_allclose(light.stokes, wanted, rtol=0, atol=tolerance)
    direction = frame.z.astype(dtype)
    frame.turn_to(op.Frame.from_direction(direction, frame.x))
    frame.turn_to(op.plane_of_incidence(direction, frame.x + frame.z).arriving)
    frame.turn_to(one.frame)


def test_axes_of_doubles_may_say_what_they_were_rounded_to():
    x, y, z = np.float32([[0.6, 0.8, 0], [-0.8, 0.6, 0], [0, 0, 1]]).astype(float)
    with pytest.raises(op.FrameError, match="off by"):
        op.Frame(x, y, z)
    frame = op.Frame(x, y, z, rounding=np.finfo(np.float32).eps)
    assert abs(np.linalg.norm(frame.x) - 1) <= 1e-15
    assert copy.copy(frame) == frame
    for wrong in (-1, 0.1, np.nan, "1e-7"):
        with pytest.raises(op.FrameError, match=r"from 0 to 0.0009765625, not .*; leave it out"):
            op.Frame(rounding=wrong)


@rows("stretch", [1e-7, -1e-7])
def test_axes_are_unit_vectors_to_1e_8(stretch):
    op.Frame(x=(1 + 1e-9, 0, 0))
    with pytest.raises(op.FrameError, match="unit vectors"):
        op.Frame(x=(1 + stretch, 0, 0))


@rows(
    "axes, message",
    [
        ({"x": (2, 0, 0)}, "unit vectors"),
        ({"y": (0, -1, 0)}, "right-handed"),
        ({"x": (np.nan, 0, 0)}, "finite"),
        ({"x": (1, 0)}, r"shape \(\.\.\., 3\)"),
        ({"x": "abc"}, "numbers"),
        ({"x": np.ones((2, 3)), "z": np.ones((4, 3))}, r"x \(2,\).*z \(4,\)"),
    ],
)
def test_axes_that_are_no_frame_are_refused(axes, message):
    with pytest.raises(op.FrameError, match=message):
        op.Frame(**axes)


@given(z=VECTORS, x=VECTORS)
def test_from_direction_keeps_z_and_puts_x_on_the_side_asked_for(z, x):
    assume(np.linalg.norm(np.cross(z, x)) >= 1e-3)
    frame = op.Frame.from_direction(z, x)
    np.testing.assert_allclose(frame.z, z / np.linalg.norm(z), rtol=0, atol=1e-15)
    assert frame.x @ x > 0


def test_an_axis_along_the_direction_is_refused_and_one_very_near_to_it_is_taken():
    with pytest.raises(op.FrameError, match="perpendicular"):
        op.Frame.from_direction(z=(1, 0, 0), x=(2, 0, 0))
    z = np.array([0.3, 0.5, 0.81]) / np.linalg.norm([0.3, 0.5, 0.81])
    frame = op.Frame.from_direction(z, z + np.array([1e-8, 0, 0]))
    assert abs(frame.x @ frame.z) <= 1e-15


def test_frames_broadcast_over_batches_and_do_not_change():
    frame = op.Frame().turned(np.linspace(0, 1, 5))
    c, s = op.Frame().turn_to(frame)
    assert c.shape == s.shape == (5,)
    with pytest.raises(AttributeError, match="new one"):
        op.Frame().x = np.zeros(3)
    with pytest.raises(ValueError, match="read-only"):
        op.Frame().x[0] = 2.0


@rows("length", [1e-300, 1e-13, 1e300])
def test_a_direction_may_have_any_length(length):
    assert np.array_equal(op.Frame.from_direction((0, 0, length), (length, 0, 0)).z, [0, 0, 1])


@given(ANGLES)
def test_a_frame_of_light_that_goes_back_is_turned_the_other_way(angle):
    there = op.Frame().turned(angle)
    np.testing.assert_allclose(there.reversed().x, there.x)
    np.testing.assert_array_equal(there.reversed().z, -there.z)
    assert there.reversed().reversed() == there
    back = op.Frame().reversed().turned(-angle)
    np.testing.assert_allclose(there.reversed().y, back.y, atol=1e-15)


UP = (0.0, 0.0, 1.0)


def unit(rng, shape):
    vector = rng.normal(size=shape)
    return vector / np.linalg.norm(vector, axis=-1, keepdims=True)


def exact_axis(normal, direction):
    n, k = ([mpmath.mpf(x) for x in v] for v in (normal.tolist(), direction.tolist()))
    across = [n[i - 2] * k[i - 1] - n[i - 1] * k[i - 2] for i in range(3)]
    length = mpmath.sqrt(sum(x * x for x in across))
    return np.array([float(x / length) for x in across])


@rows("angle", [1e-8, 1e-4, 0.7, np.pi / 2 - 1e-9])
def test_the_azimuth_of_the_plane_is_exact_at_any_incidence(angle):
    rng = np.random.default_rng(1)
    normal = unit(rng, (200, 3))
    tangent = np.cross(normal, unit(rng, (200, 3)))
    tangent /= np.linalg.norm(tangent, axis=-1, keepdims=True)
    direction = np.sin(angle) * tangent - np.cos(angle) * normal
    found = op.plane_of_incidence(direction, normal)
    with mpmath.workdps(50):
        exact = np.array([exact_axis(n, k) for n, k in zip(normal, direction, strict=True)])
    # The azimuth is off by the length of the difference of two unit vectors.
    assert np.max(np.linalg.norm(found.arriving.x - exact, axis=-1)) <= 1e-15
    np.testing.assert_allclose(found.incidence, angle, rtol=1e-7)


def test_planes_of_incidence_stand_as_the_conventions_say_and_fit_an_interface():
    meets = op.plane_of_incidence((1.0, 0.0, -1.0), UP)
    np.testing.assert_allclose(meets.arriving.x, np.cross(UP, (1, 0, 0)), rtol=0, atol=1e-15)
    np.testing.assert_array_equal(meets.arriving.x, meets.reflected.x)
    np.testing.assert_allclose(
        meets.reflected.z, np.array([1, 0, 1]) / np.sqrt(2), rtol=0, atol=1e-15
    )
    assert meets.incidence == pytest.approx(np.pi / 4, abs=1e-15)
    meets = op.plane_of_incidence((0.3, -0.2, -1.0), (0.1, 0.2, 1.0))
    path = op.PathGraph()
    frames = {"in": meets.arriving, "reflected": meets.reflected}
    path.add("lamp", op.Source(), frames={"out": meets.arriving})
    path.add("glass", op.Interface(1.5, float(meets.incidence)), frames=frames)
    path["lamp"] >> path["glass"] >> path.add("eye", op.Detector())
    A, B, _, _ = op.fresnel_reflection(1.5, meets.cos, meets.sin)
    np.testing.assert_allclose(path.trace().stokes, [A, B, 0, 0], rtol=0, atol=1e-15)
    one = op.plane_of_incidence((1.0, 2.0, -3.0), (0.2, 0.1, 1.0))
    other = op.plane_of_incidence((4e200, 8e200, -12e200), (-0.2e-200, -0.1e-200, -1e-200))
    np.testing.assert_allclose(one.arriving.x, other.arriving.x, rtol=0, atol=1e-15)
    np.testing.assert_allclose(one.reflected.z, other.reflected.z, rtol=0, atol=1e-15)
    assert one.incidence == pytest.approx(other.incidence, abs=1e-15)


def test_a_degenerate_plane_keeps_the_axis_that_the_light_came_with():
    keep = op.Frame.from_direction((0, 0, -1), (1.0, 2.0, 0.0))
    meets = op.plane_of_incidence((0, 0, -1), UP, keep=keep)
    np.testing.assert_array_equal(meets.arriving.x, keep.x)
    np.testing.assert_array_equal(meets.reflected.x, keep.x)
    np.testing.assert_array_equal(meets.reflected.z, UP)
    assert (meets.cos, meets.sin) == (1.0, 0.0)
    directions = np.array([[0.0, 0, -1], [1, 0, -1]])
    keep = op.Frame.from_direction(directions, (0.0, 1.0, 1.0))
    meets = op.plane_of_incidence(directions, UP, keep=keep)
    np.testing.assert_allclose(meets.arriving.x, [[0, 1, 0], [0, 1, 0]], rtol=0, atol=1e-15)
    assert meets.incidence.tolist() == [0.0, np.pi / 4]
    keep = op.Frame.from_direction((0, 0, -1), (1.0, 1.0, 0.0))
    meets = op.plane_of_incidence([[0, 0, -1], [1, 0, -1]], UP, keep=keep)
    np.testing.assert_allclose(meets.arriving.x, [keep.x, [0, 1, 0]], rtol=0, atol=1e-15)
    with pytest.raises(op.FrameError, match="must be the Frame"):
        op.plane_of_incidence((1, 0, -1), UP, keep=(1, 0, 0))


@rows(
    "arguments, message",
    [
        (((0, 0, -1), UP), "give keep="),
        (((0, 0, 0), UP), "direction of light has no length"),
        (((0, 0, -1), (0, 0, 0)), "normal has no length"),
        (((0, 0), UP), r"shape \(\.\.\., 3\)"),
        (((0, 0, np.nan), UP), "finite"),
        (((0, 0, -1), UP, op.Frame()), "cannot be aligned"),
    ],
)
def test_what_makes_no_plane_is_refused(arguments, message):
    with pytest.raises(op.FrameError, match=message):
        op.plane_of_incidence(*arguments)


def test_frames_are_aligned_within_four_roundings():
    rng = np.random.default_rng(2)
    frame = op.Frame.from_direction(unit(rng, (500, 3)), unit(rng, (500, 3)))
    other = frame.turned(rng.uniform(-2 * np.pi, 2 * np.pi, 500))
    c, s = frame.turn_to(other)
    with mpmath.workdps(50):
        for i in range(500):
            x, new, z = (list(map(mpmath.mpf, a[i].tolist())) for a in (frame.x, other.x, frame.z))
            across = [x[j - 2] * new[j - 1] - x[j - 1] * new[j - 2] for j in range(3)]
            along = sum(a * b for a, b in zip(z, across, strict=True))
            twice = 2 * mpmath.atan2(along, sum(a * b for a, b in zip(x, new, strict=True)))
            assert abs(mpmath.cos(twice) - float(c[i])) <= 4 * np.finfo(float).eps
            assert abs(mpmath.sin(twice) - float(s[i])) <= 4 * np.finfo(float).eps


LIGHT = op.Light([1.0, 0.6, 0.0, 0.8])
ELEMENT = op.Polarizer(0.3)
MATRIX = ELEMENT.mueller()
PATH = op.Source() >> ELEMENT >> op.Detector()


def test_matrices_and_splitters_act_on_elements_and_light_by_their_ports():
    plate = op.Retarder("90 deg", 0.2, azimuth=0.1)
    found = (MATRIX @ plate) @ LIGHT
    np.testing.assert_allclose(found.stokes, (MATRIX @ (plate @ LIGHT)).stokes, atol=1e-15)
    found = PATH.mueller() @ LIGHT
    np.testing.assert_allclose(found.stokes, (ELEMENT @ LIGHT).stokes, atol=1e-15)
    light = op.BeamSplitter(0.3).mueller("in", "transmitted") @ LIGHT
    np.testing.assert_allclose(light.stokes, 0.7 * LIGHT.stokes, rtol=1e-15)


@rows(
    "product, expected",
    [
        (lambda: MATRIX @ [1, 0, 0, 0], r"has no frames; .* optipath.Light\(numbers\) for light"),
        (lambda: MATRIX @ np.eye(4), r"has no frames; write .* optipath.Mueller\(matrix\)"),
        (lambda: np.eye(4) @ MATRIX, "has no frames"),
        (lambda: np.eye(4) @ ELEMENT, "has no frames"),
        (lambda: [1, 0] @ ELEMENT, "has no frames"),
        (lambda: np.eye(4) @ LIGHT, "has no frames"),
        (lambda: ELEMENT @ [1, 0, 0, 0], "has no frames"),
        (lambda: op.Polarizer @ LIGHT, r"^Polarizer is a class; write Polarizer\(\.\.\.\)$"),
        (lambda: MATRIX @ op.Polarizer, "is a class"),
        (lambda: ELEMENT @ op.Polarizer, "is a class"),
        (lambda: PATH @ LIGHT, r"PathGraph begins with light of its own; write path.mueller\(\) @"),
        (lambda: PATH.compose() @ LIGHT, "Plan begins with light of its own"),
        (lambda: MATRIX @ PATH, "begins with light of its own"),
        (lambda: PATH @ ELEMENT, "begins with light of its own"),
        (lambda: ELEMENT.named("a") @ LIGHT, "write the element without a name"),
        (lambda: op.Source() @ LIGHT, "source lets no light through, which begins there; ask"),
        (lambda: op.Detector() @ LIGHT, "detector lets no light through, which ends there; ask"),
        (lambda: op.BeamSplitter() @ LIGHT, r'say the ports, such as element.mueller\("in", "refl'),
    ],
)
def test_what_cannot_stand_in_a_product_is_told_what_can(product, expected):
    with pytest.raises(op.OptipathError, match=expected):
        product()
