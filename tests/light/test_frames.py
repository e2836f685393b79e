import copy
import pickle

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


def test_the_default_frame_is_the_world():
    frame = op.Frame()
    assert np.array_equal([frame.x, frame.y, frame.z], np.eye(3))


def test_a_quarter_turn_takes_x_to_y():
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


def test_frames_of_other_directions_are_refused_with_both_named():
    tilted = op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))
    with pytest.raises(op.FrameError, match=r"\(0, 0, 1\).*\(0, 1, 0\)"):
        op.Frame().turn_to(tilted)


def test_directions_may_differ_by_rounding_and_no_more():
    nearly = op.Frame.from_direction(z=(0, 5e-9, 1), x=(1, 0, 0))
    op.Frame().turn_to(nearly)
    off = op.Frame.from_direction(z=(0, 2e-8, 1), x=(1, 0, 0))
    with pytest.raises(op.FrameError, match="one direction"):
        op.Frame().turn_to(off)


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


def test_opposite_directions_are_refused():
    back = op.Frame.from_direction(z=(0, 0, -1), x=(1, 0, 0))
    with pytest.raises(op.FrameError, match="one direction"):
        op.Frame().turn_to(back)


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


def test_a_direction_along_x_is_refused():
    with pytest.raises(op.FrameError, match="perpendicular"):
        op.Frame.from_direction(z=(1, 0, 0), x=(2, 0, 0))


def test_frames_broadcast_over_batches():
    frame = op.Frame().turned(np.linspace(0, 1, 5))
    c, s = op.Frame().turn_to(frame)
    assert c.shape == s.shape == (5,)


def test_a_frame_does_not_change():
    with pytest.raises(AttributeError, match="new one"):
        op.Frame().x = np.zeros(3)
    with pytest.raises(ValueError, match="read-only"):
        op.Frame().x[0] = 2.0


@rows("length", [1e-300, 1e-13, 1e300])
def test_a_direction_may_have_any_length(length):
    assert np.array_equal(op.Frame.from_direction((0, 0, length), (length, 0, 0)).z, [0, 0, 1])


def test_an_x_very_near_to_z_still_makes_a_frame():
    z = np.array([0.3, 0.5, 0.81]) / np.linalg.norm([0.3, 0.5, 0.81])
    frame = op.Frame.from_direction(z, z + np.array([1e-8, 0, 0]))
    assert abs(frame.x @ frame.z) <= 1e-15


@given(ANGLES)
def test_a_frame_of_light_that_goes_back_is_turned_the_other_way(angle):
    there = op.Frame().turned(angle)
    np.testing.assert_allclose(there.reversed().x, there.x)
    np.testing.assert_array_equal(there.reversed().z, -there.z)
    assert there.reversed().reversed() == there
    back = op.Frame().reversed().turned(-angle)
    np.testing.assert_allclose(there.reversed().y, back.y, atol=1e-15)
