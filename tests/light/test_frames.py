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
from random_matrices import turn, unit_vectors
from tables import rows

ANGLES = st.floats(-2.0 * np.pi, 2.0 * np.pi)
VECTORS = hnp.arrays(float, 3, elements=st.floats(-1.0, 1.0)).filter(
    lambda v: np.linalg.norm(v) > 0.1
)
ROTATIONS = st.builds(turn, VECTORS.map(lambda v: v / np.linalg.norm(v)), ANGLES)
UP = (0.0, 0.0, 1.0)


def test_a_frame_turns_x_to_y_and_is_that_of_the_world_by_default():
    frame = op.Frame()
    assert np.array_equal([frame.x, frame.y, frame.z], np.eye(3))
    turned = op.Frame().turned(np.pi / 2)
    np.testing.assert_allclose([turned.x, turned.y], [[0, 1, 0], [-1, 0, 0]], rtol=0, atol=1e-16)
    with pytest.raises(
        op.errors.ValueFault, match=r"'a bit' is not a quantity; .* such as '30 deg'"
    ):
        op.Frame().turned("a bit")


@given(rotation=ROTATIONS, common=ROTATIONS, angle=ANGLES)
def test_turning_a_frame_by_a_gives_cos_2a_and_sin_2a_wherever_it_stands(rotation, common, angle):
    first = op.Frame().rotated(rotation)
    second = first.turned(angle)
    before = first.turn_to(second)
    np.testing.assert_allclose(before, [np.cos(2 * angle), np.sin(2 * angle)], rtol=0, atol=1e-14)
    after = first.rotated(common).turn_to(second.rotated(common))
    np.testing.assert_allclose(after, before, rtol=0, atol=1e-14)


@rows(
    "z, told",
    [
        ((0, 1, 0), r"\(0, 0, 1\).*\(0, 1, 0\)"),
        ((0, 0, -1), "one direction"),
        ((0, 2e-8, 1), ", 2e-08 beside it; only frames"),
        ((0, 1e-5, 1), ", 1e-05 beside it; only frames"),
    ],
)
def test_frames_of_other_directions_are_refused_but_for_rounding(z, told):
    off = op.Frame.from_direction(z=z, x=(1, 0, 0))
    for align in (op.Frame().turn_to, lambda off: op.Light([1, 0, 0, 0], off) + STATE):
        with pytest.raises(op.errors.FrameError, match=told):
            align(off)
    op.Frame().turn_to(op.Frame.from_direction(z=(0, 5e-9, 1), x=(1, 0, 0)))


def rounded(frame):
    return op.Frame(*(axis.astype(np.float32) for axis in (frame.x, frame.y, frame.z)))


@given(rotation=ROTATIONS, angle=ANGLES)
def test_frames_rounded_to_less_precision_are_aligned_with_others(rotation, angle):
    frame = op.Frame().rotated(rotation)
    turned, off = frame.turned(angle), rounded(frame)
    (one,) = op.Light([[1, 1, 0, 0]] * 2, rounded(frame.turned([0.0, 1.0])))[:1]
    wanted = [1, np.cos(2 * angle), -np.sin(2 * angle), 0]
    for start, end in (
        *[(off, turned), (frame, rounded(turned)), (off, off.turned(angle))],
        (pickle.loads(pickle.dumps(off)), turned),
    ):
        light = op.Light([1, 1, 0, 0], start).in_frame(end)
        np.testing.assert_allclose(light.stokes, wanted, rtol=0, atol=8 * np.finfo("f4").eps)
    direction = frame.z.astype(np.float32)
    frame.turn_to(op.Frame.from_direction(direction, frame.x))
    frame.turn_to(op.plane_of_incidence(direction, frame.x + frame.z).arriving)
    frame.turn_to(one.frame)


def test_axes_of_doubles_may_say_what_they_were_rounded_to():
    x, y, z = np.float32([[0.6, 0.8, 0], [-0.8, 0.6, 0], [0, 0, 1]]).astype(float)
    with pytest.raises(op.errors.FrameError, match="off by"):
        op.Frame(x, y, z)
    frame = op.Frame(x, y, z, rounding=np.finfo(np.float32).eps)
    assert abs(np.linalg.norm(frame.x) - 1) <= 1e-15
    assert copy.copy(frame) == frame
    for wrong in (-1, 0.1, np.nan, "1e-7"):
        with pytest.raises(op.errors.FrameError, match=r"give one within 0 .. 0.0009765625"):
            op.Frame(rounding=wrong)


@rows(
    "axes, message",
    [
        ({"x": (2, 0, 0)}, "unit vectors, and are off by 3"),
        ({"x": (2.1, 0, 0)}, "unit vectors; use"),
        ({"x": (1 + 1e-7, 0, 0)}, "off by 2e-07"),
        ({"x": (1 - 1e-7, 0, 0)}, "off by 2e-07"),
        ({"y": (0, -1, 0)}, "right-handed"),
        ({"x": (np.nan, 0, 0)}, "finite"),
        ({"x": (1, 0)}, r"shape \(\.\.\., 3\)"),
        ({"x": "abc"}, "numbers"),
        ({"x": [10**400, 0, 0]}, "numbers"),
        ({"x": np.ones((2, 3)), "z": np.ones((4, 3))}, r"x \(2,\).*z \(4,\)"),
    ],
)
def test_axes_that_are_no_frame_are_refused(axes, message):
    op.Frame(x=(1 + 1e-9, 0, 0))
    with pytest.raises(op.errors.FrameError, match=message):
        op.Frame(**axes)


def test_what_is_no_frame_or_rotation_is_refused():
    for make in (
        lambda: op.Light([1.0, 0, 0, 0], "frame"),
        lambda: op.Light([1.0, 0, 0, 0]).in_frame("frame"),
        lambda: op.Mueller(np.eye(4), frame_in="frame"),
        lambda: op.Frame().rotated(np.eye(2)),
    ):
        with pytest.raises(op.errors.FrameError, match=r"'frame'|must be Frames|3, 3\)"):
            make()


@given(z=VECTORS, x=VECTORS)
def test_from_direction_keeps_z_and_puts_x_on_the_side_asked_for(z, x):
    assume(np.linalg.norm(np.cross(z, x)) >= 1e-3)
    frame = op.Frame.from_direction(z, x)
    np.testing.assert_allclose(frame.z, z / np.linalg.norm(z), rtol=0, atol=1e-15)
    assert frame.x @ x > 0


def test_a_direction_of_any_length_will_do_and_an_axis_very_near_to_it_but_none_along_it():
    for length in (1e-300, 1e-13, 1e300):
        assert np.array_equal(op.Frame.from_direction((0, 0, length), (length, 0, 0)).z, UP)
    with pytest.raises(op.errors.FrameError, match="perpendicular"):
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


@given(ANGLES)
def test_a_frame_of_light_that_goes_back_is_turned_the_other_way(angle):
    there = op.Frame().turned(angle)
    np.testing.assert_allclose(there.reversed().x, there.x)
    np.testing.assert_array_equal(there.reversed().z, -there.z)
    assert there.reversed().reversed() == there
    back = op.Frame().reversed().turned(-angle)
    np.testing.assert_allclose(there.reversed().y, back.y, atol=1e-15)


def exact_cross(a, b):
    (a, b) = ([mpmath.mpf(x) for x in v.tolist()] for v in (a, b))
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


@rows("angle", [1e-8, 1e-4, 0.7, np.pi / 2 - 1e-9])
def test_the_azimuth_of_the_plane_is_exact_at_any_incidence(angle):
    rng = np.random.default_rng(1)
    normal = unit_vectors(rng, 200)
    tangent = np.cross(normal, unit_vectors(rng, 200))
    tangent /= np.linalg.norm(tangent, axis=-1, keepdims=True)
    direction = np.sin(angle) * tangent - np.cos(angle) * normal
    found = op.plane_of_incidence(direction, normal)
    with mpmath.workdps(50):
        across = [exact_cross(n, k) for n, k in zip(normal, direction, strict=True)]
        exact = [[float(x / mpmath.norm(each)) for x in each] for each in across]
    # The azimuth is off by the length of the difference of two unit vectors.
    assert np.max(np.linalg.norm(found.arriving.x - exact, axis=-1)) <= 1e-15
    np.testing.assert_allclose(found.incidence, angle, rtol=1e-7)


def test_planes_of_incidence_stand_as_the_conventions_say_and_fit_an_interface():
    meets = op.plane_of_incidence((1.0, 0.0, -1.0), UP)
    np.testing.assert_allclose(meets.arriving.x, np.cross(UP, (1, 0, 0)), rtol=0, atol=1e-15)
    np.testing.assert_array_equal(meets.arriving.x, meets.reflected.x)
    np.testing.assert_allclose(meets.reflected.z, np.sqrt([0.5, 0, 0.5]), rtol=0, atol=1e-15)
    assert meets.incidence == pytest.approx(np.pi / 4, abs=1e-15)
    meets = op.plane_of_incidence((0.3, -0.2, -1.0), (0.1, 0.2, 1.0))
    path = op.PathGraph()
    frames = {"in": meets.arriving, "reflected": meets.reflected}
    lamp = path.add("lamp", op.Source(), frames={"out": meets.arriving})
    glass = op.Interface(1.5, float(meets.incidence))
    lamp >> path.add("glass", glass, frames=frames) >> op.Detector()
    A, B, _, _ = op.fresnel_reflection(1.5, meets.cos, meets.sin)
    np.testing.assert_allclose(path.trace().stokes, [A, B, 0, 0], rtol=0, atol=1e-15)
    one = op.plane_of_incidence((1.0, 2.0, -3.0), (0.2, 0.1, 1.0))
    other = op.plane_of_incidence((4e200, 8e200, -12e200), (-0.2e-200, -0.1e-200, -1e-200))
    for mine, theirs in (
        (one.arriving.x, other.arriving.x),
        (one.reflected.z, other.reflected.z),
        (one.incidence, other.incidence),
    ):
        np.testing.assert_allclose(mine, theirs, rtol=0, atol=1e-15)


def test_a_degenerate_plane_keeps_the_axis_that_the_light_came_with():
    keep = op.Frame.from_direction((0, 0, -1), (1.0, 2.0, 0.0))
    meets = op.plane_of_incidence((0, 0, -1), UP, keep=keep)
    np.testing.assert_array_equal([meets.arriving.x, meets.reflected.x], [keep.x] * 2)
    np.testing.assert_array_equal(meets.reflected.z, UP)
    assert (meets.cos, meets.sin) == (1.0, 0.0)
    directions = np.array([[0.0, 0, -1], [1, 0, -1]])
    each = op.Frame.from_direction(directions, (0.0, 1.0, 1.0))
    for kept, first in ((each, [0, 1, 0]), (keep, keep.x)):
        meets = op.plane_of_incidence(directions, UP, keep=kept)
        np.testing.assert_allclose(meets.arriving.x, [first, [0, 1, 0]], rtol=0, atol=1e-15)
        assert meets.incidence.tolist() == [0.0, np.pi / 4]


@rows(
    "arguments, message",
    [
        (((0, 0, -1), UP), "give keep="),
        (((0, 0, 0), UP), "direction of light has no length"),
        (((0, 0, -1), (0, 0, 0)), "normal has no length"),
        (((0, 0), UP), r"shape \(\.\.\., 3\)"),
        (((0, 0, np.nan), UP), "finite"),
        (((0, 0, -1), UP, op.Frame()), "cannot be aligned"),
        (((1, 0, -1), UP, (1, 0, 0)), "must be the Frame"),
    ],
)
def test_what_makes_no_plane_is_refused(arguments, message):
    with pytest.raises(op.errors.FrameError, match=message):
        op.plane_of_incidence(*arguments)


def test_frames_are_aligned_within_four_roundings():
    rng = np.random.default_rng(2)
    frame = op.Frame.from_direction(unit_vectors(rng, 500), unit_vectors(rng, 500))
    other = frame.turned(rng.uniform(-2 * np.pi, 2 * np.pi, 500))
    found = np.transpose(frame.turn_to(other))
    with mpmath.workdps(50):
        for (c, s), x, new, z in zip(found, frame.x, other.x, frame.z, strict=True):
            along = mpmath.fdot(z.tolist(), exact_cross(x, new))
            twice = 2 * mpmath.atan2(along, mpmath.fdot(x.tolist(), new.tolist()))
            assert abs(mpmath.cos(twice) - float(c)) <= 4 * np.finfo(float).eps
            assert abs(mpmath.sin(twice) - float(s)) <= 4 * np.finfo(float).eps


STATE = op.Light([1.0, 0.6, 0.0, 0.8])
ELEMENT = op.Polarizer(0.3)
MATRIX = ELEMENT.mueller()
PATH = op.Source() >> ELEMENT >> op.Detector()


def test_matrices_and_splitters_act_on_elements_and_light_by_their_ports():
    plate = op.Retarder("90 deg", 0.2, azimuth=0.1)
    split = op.BeamSplitter(0.3).mueller("in", "transmitted")
    found = [(MATRIX @ plate) @ STATE, PATH.mueller() @ STATE]
    expected = [MATRIX @ (plate @ STATE), ELEMENT @ STATE]
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-15)
    np.testing.assert_allclose((split @ STATE).stokes, 0.7 * STATE.stokes, rtol=1e-15)


NOT_IN_PRODUCTS = {
    r"has no frames; .* optipath.Light\(numbers\) for light": [lambda: MATRIX @ [1, 0, 0, 0]],
    "has no frames": [
        *[lambda: np.eye(4) @ MATRIX, lambda: [1, 0] @ ELEMENT, lambda: ELEMENT @ [1, 0, 0, 0]],
    ],
    r"^Polarizer is a class; write Polarizer\(\.\.\.\)$": [lambda: op.Polarizer @ STATE],
    "is a class": [lambda: MATRIX @ op.Polarizer, lambda: ELEMENT @ op.Polarizer],
    r"PathGraph begins with .* own; write path.mueller\(\) @": [lambda: PATH @ STATE],
    "Plan begins with light of its own": [lambda: PATH.compose() @ STATE],
    "PathGraph begins with light of its own": [lambda: MATRIX @ PATH, lambda: PATH @ ELEMENT],
    "write the element without a name": [lambda: ELEMENT.named("a") @ STATE],
    "source lets no light through; ask": [lambda: op.Source() @ STATE],
    "detector lets no light through; ask": [lambda: op.Detector() @ STATE],
    r'say the ports, such as element.mueller\("in", "refl': [lambda: op.BeamSplitter() @ STATE],
}


@rows("told, product", [(told, each) for told, two in NOT_IN_PRODUCTS.items() for each in two])
def test_what_cannot_stand_in_a_product_is_told_what_can(product, told):
    with pytest.raises(op.OptipathError, match=told):
        product()
