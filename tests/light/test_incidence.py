import mpmath
import numpy as np
import pytest

import optipath as op
from tables import rows

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


def test_frames_stand_as_the_conventions_say():
    meets = op.plane_of_incidence((1.0, 0.0, -1.0), UP)
    np.testing.assert_allclose(meets.arriving.x, np.cross(UP, (1, 0, 0)), rtol=0, atol=1e-15)
    np.testing.assert_array_equal(meets.arriving.x, meets.reflected.x)
    np.testing.assert_allclose(
        meets.reflected.z, np.array([1, 0, 1]) / np.sqrt(2), rtol=0, atol=1e-15
    )
    assert meets.incidence == pytest.approx(np.pi / 4, abs=1e-15)


def test_they_fit_an_interface():
    meets = op.plane_of_incidence((0.3, -0.2, -1.0), (0.1, 0.2, 1.0))
    path = op.PathGraph()
    frames = {"in": meets.arriving, "reflected": meets.reflected}
    path.add("lamp", op.Source(), frames={"out": meets.arriving})
    path.add("glass", op.Interface(1.5, float(meets.incidence)), frames=frames)
    path["lamp"] >> path["glass"] >> path.add("eye", op.Detector())
    A, B, _, _ = op.fresnel_reflection(1.5, meets.cos, meets.sin)
    np.testing.assert_allclose(path.trace().stokes, [A, B, 0, 0], rtol=0, atol=1e-15)


def test_the_side_and_the_length_of_the_vectors_do_not_matter():
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


def test_only_the_degenerate_ones_of_a_batch_keep_it():
    directions = np.array([[0.0, 0, -1], [1, 0, -1]])
    keep = op.Frame.from_direction(directions, (0.0, 1.0, 1.0))
    meets = op.plane_of_incidence(directions, UP, keep=keep)
    np.testing.assert_allclose(meets.arriving.x, [[0, 1, 0], [0, 1, 0]], rtol=0, atol=1e-15)
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


def test_one_frame_is_kept_by_the_degenerate_ones_of_a_batch():
    keep = op.Frame.from_direction((0, 0, -1), (1.0, 1.0, 0.0))
    meets = op.plane_of_incidence([[0, 0, -1], [1, 0, -1]], UP, keep=keep)
    np.testing.assert_allclose(meets.arriving.x, [keep.x, [0, 1, 0]], rtol=0, atol=1e-15)


def test_what_is_kept_is_a_frame():
    with pytest.raises(op.FrameError, match="must be the Frame"):
        op.plane_of_incidence((1, 0, -1), UP, keep=(1, 0, 0))
