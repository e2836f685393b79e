"""Matrices act on light and on each other, in frames, with noise, and on the way back."""

import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.light.decompositions import reciprocal
from tables import rows

TURNS = st.floats(-4.0, 4.0)


def test_matrices_multiply_from_the_left_and_broadcast():
    polarizer, rotator = op.Polarizer().mueller(), op.Rotator(np.pi / 2).mueller()
    light = op.Light([1.0, 0.0, 0.0, 0.0])
    found = [rotator @ polarizer @ light, polarizer @ rotator @ light]
    np.testing.assert_allclose(found, [[0.5, -0.5, 0, 0], [0.5, 0.5, 0, 0]], rtol=0, atol=1e-16)
    reflection = op.Interface(1.5, np.linspace(0.1, 1.0, 5)).mueller()
    polarizers = op.Polarizer(np.zeros((3, 1))).mueller()
    assert (reflection @ polarizers).matrix.shape == (3, 5, 4, 4)
    assert (reflection @ polarizers @ light).stokes.shape == (3, 5, 4)
    tilted = op.Frame.from_direction(z=(1, 0, 0), x=(0, 1, 0))
    for met in (light, op.Mueller(np.eye(4))):
        with pytest.raises(op.errors.FrameError, match="one direction"):
            op.Mueller(np.eye(4), frame_in=tilted) @ met
    for wrong in (np.eye(3), np.zeros(4), np.eye(4) * 1j):
        with pytest.raises(op.errors.ShapeError, match=r"\(\.\.\., 4, 4\)"):
            op.Mueller(wrong)


@given(turn=TURNS)
def test_matrices_realign_frames_that_differ_by_a_turn_and_concatenate(turn):
    frame = op.Frame().turned(turn)
    analyzer = op.Polarizer().mueller(frame_in=frame, frame_out=frame)
    light = analyzer @ op.Polarizer().mueller() @ op.Light([2.0, 0.0, 0.0, 0.0])
    assert light.intensity == pytest.approx(np.cos(turn) ** 2, abs=1e-14), "Malus's law"
    assert light.frame == frame
    second = op.Retarder(1.0, angle=0.3).mueller(frame_in=frame, frame_out=frame)
    first = op.Interface(1.5 + 0.2j, 0.8).mueller()
    light = op.Light([1.0, 0.2, 0.3, 0.4])
    one = ((second @ first) @ light).stokes
    np.testing.assert_allclose(one, (second @ (first @ light)).stokes, rtol=0, atol=1e-15)


BRIGHT = op.Light([1.0, 0.0, 0.0, 1.0])
TOO_MUCH = op.Mueller(np.diag([3.0, 0.0, 0.0, 5.0]))


@rows(
    "matrix, light, problem",
    [
        (TOO_MUCH, BRIGHT, r"\[1.0, 0.0, 0.0, 1.0\] becomes \[3.0, .* 166.667 %"),
        (op.Mueller([[0.1, 0, 0, 0], [3, 0, 0, 0], [0] * 4, [0] * 4]), BRIGHT, "3000 %"),
        (op.Mueller(-np.eye(4)), BRIGHT, "intensity -1.0 is negative"),
        (op.Mueller(np.diag([0.0, 1, 1, 1])), BRIGHT, "polarised, and dark"),
        (TOO_MUCH, 1e-300 * BRIGHT, r"like \[1.0, .* 166.667 %"),
        (TOO_MUCH @ op.Rotator(0.3).mueller(), BRIGHT, "166.667 %"),
        (op.Rotator(0.3) @ TOO_MUCH, BRIGHT, "166.667 %"),
        (pickle.loads(pickle.dumps(TOO_MUCH)).reshape(1)[0], BRIGHT, "166.667 %"),
        (op.Mueller(TOO_MUCH.matrix.astype("f4")), BRIGHT, "166.667 %"),
        (TOO_MUCH, op.Light([[1.0, 0, 0, 0], [1.0, 0, 0, 1], [1.0, 0, 0, -1]]), "one of 2 such"),
    ],
)
def test_a_matrix_that_makes_no_light_of_light_is_refused(matrix, light, problem):
    with pytest.raises(op.errors.LightError, match=problem) as told:
        matrix @ light
    for cure in ("matrix.nearest_physical()", "Light(..., physical=False)"):
        assert cure in str(told.value)


def test_light_of_unphysical_matrices_is_taken_where_it_is_light_or_may_be_none():
    assert (TOO_MUCH.nearest_physical() @ BRIGHT).dop <= 1.0
    free = op.Light(BRIGHT.stokes, physical=False)
    for light in (free, 2 * free, free[None][0], free.in_frame(op.Frame().turned(0.1))):
        assert (TOO_MUCH @ (TOO_MUCH @ light)).dop == pytest.approx(25 / 9)
    assert (op.Mueller(2 * np.eye(4)) @ BRIGHT).S0 == 2.0
    for scale in (1e300, 1e-300, 1e-320):
        assert (op.Mueller(scale * np.eye(4)) @ BRIGHT).dop == 1.0
    assert (TOO_MUCH @ op.Light([1.0, 0.0, 0.0, 0.5])).S0 == 3.0
    path = op.Source() >> op.MuellerElement(TOO_MUCH.matrix, physical=False) >> op.Detector()
    assert (path.mueller() @ BRIGHT).dop == pytest.approx(5 / 3)


@rows("dtype", [np.float32, np.float64])
def test_a_physical_matrix_is_never_refused_for_its_rounding(dtype):
    rng = np.random.default_rng(5)
    states = rng.normal(size=(500, 3))
    states /= np.linalg.norm(states, axis=-1, keepdims=True)
    light = op.Light(np.concatenate([np.ones((500, 1)), states], axis=-1)[:, None].astype(dtype))
    angles = rng.uniform(0.0, np.pi, (3, 20))
    pure = op.Polarizer(angles[0], leakage=1e-9) @ op.Retarder(*angles[1:])
    given = op.Mueller(pure.matrix.astype(dtype) * 10.0 ** rng.uniform(-30, 30, (20, 1, 1)))
    crossed = op.Light(op.Polarizer(angles[0] + np.pi / 2).mueller().matrix[:, :, 0].astype(dtype))
    assert (given @ light).shape == (500, 20)
    assert (op.Mueller(op.Polarizer(angles[0]).mueller().matrix.astype(dtype)) @ crossed).size
    assert (given @ op.Light(np.zeros(4))).S0.max() == 0.0
    # Nor is what roundings have left of crossed polarisers.
    angles = np.linspace(0.0, 3.0, 50)
    behind, before = (op.Polarizer(angles + a).mueller().matrix for a in (np.pi / 2, 0.0))
    light = op.Light([[1.0, 0.6, 0.0, 0.8], [1.0, 0.0, -1.0, 0.0]])[:, None]
    left = op.Mueller(behind.astype(dtype) @ before.astype(dtype)) @ light
    assert np.abs(left.S0).max() < 2 * np.finfo(dtype).eps


@rows(
    "matrix, light",
    [  # Their least eigenvalues are -0.75e-9, -0.75e-9 and -0.5e-9 of the largest.
        (np.diag([1.0, 1.0, 1.0, 1.0 + 3e-9]), [1.0, 0.0, 0.0, 1.0]),
        (1e20 * np.diag([1.0, 1.0, 1.0 + 3e-9, 1.0]), [1.0, 0.0, -1.0, 0.0]),
        ([[1, 1 + 1e-9, 0, 0], [1 + 1e-9, 1, 0, 0], [0] * 4, [0] * 4], [1.0, -1.0, 0.0, 0.0]),
    ],
)
def test_a_matrix_that_is_physical_to_its_tolerance_is_not_refused(matrix, light):
    given = op.Mueller(matrix)
    assert given.is_physical()
    assert not given.is_physical(1e-10)
    assert (given @ op.Light(light)).frame == op.Frame()


ANGLES = np.random.default_rng(5).uniform(-3.0, 3.0, 200)
SECOND, FIRST = op.Polarizer(ANGLES + np.pi / 2).mueller(), op.Polarizer(ANGLES).mueller()
WHITE = op.Light([100.0, 0.0, 0.0, 0.0])


def test_crossed_polarisers_leave_no_light_and_no_figures_but_rounding():
    for light in (SECOND @ FIRST @ WHITE, SECOND @ (FIRST @ WHITE)):
        assert np.all(light.intensity <= light.noise)
        for figure in ("dop", "aop", "psi", "delta", "ellipticity"):
            assert np.isnan(getattr(light, figure)).all(), figure
    dark = (SECOND @ FIRST).matrix[..., 0, 0] == 0.0
    for figure in ("psi", "delta", "diattenuation", "polarizance", "depolarization_index"):
        assert np.isnan(getattr(SECOND @ FIRST, figure)[~dark]).all(), figure
    plate = op.Retarder(0.3, 1.1).mueller()
    assert np.isnan((plate @ SECOND @ FIRST @ plate @ WHITE).dop).all()


def test_the_matrix_of_a_path_knows_its_rounding_and_what_is_let_through_keeps_its_figures():
    two = op.Polarizer(op.Parameter("a")) >> op.Polarizer(op.Parameter("b"))
    crossed = op.Source(100) >> two >> op.Detector()
    for a in ANGLES[:20].tolist():
        matrix = crossed.mueller(a=a, b=a + np.pi / 2)
        assert np.isnan((matrix @ WHITE).dop)
        assert matrix.matrix[0, 0] == 0.0 or np.isnan(matrix.diattenuation)
    batch = crossed.mueller(a=ANGLES, b=ANGLES + np.pi / 2)
    assert np.isnan((batch @ WHITE).dop).all()
    plate = op.Retarder(0.3, 0.2, azimuth=0.1)
    path = op.Source(100) >> op.Polarizer(0.2) >> plate >> op.Polarizer(1.0, azimuth=0.1)
    path >>= op.Detector()
    matrix = path.mueller()
    np.testing.assert_allclose((matrix @ WHITE).aop, path.trace().aop, rtol=1e-12)
    assert matrix.diattenuation == pytest.approx(1.0, abs=1e-12)
    for kept in (matrix, SECOND @ FIRST):
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(kept)).noise, kept.noise)
    filters = op.Attenuator(1e-12).mueller()
    weak = filters @ filters @ op.Polarizer(0.3).mueller()
    np.testing.assert_allclose((weak @ WHITE).aop, 0.3, rtol=1e-12)
    np.testing.assert_allclose(weak.diattenuation, 1.0, rtol=1e-12)


def mueller_of_jones(jones):
    """A (J x J*) A^-1, of the library's signs of S2 and S3; written without it."""
    a = np.array([[1, 0, 0, 1], [1, 0, 0, -1], [0, 1, 1, 0], [0, 1j, -1j, 0]])
    return (a @ np.kron(jones, jones.conj()) @ np.linalg.inv(a)).real


def test_the_jones_matrix_of_what_is_reciprocal_is_transposed_in_space():
    # De Hoop: in axes that stay, J becomes J^T; light that comes back counts Ey the other way.
    rng, over = np.random.default_rng(5), np.diag([1.0, -1.0])
    for _ in range(20):
        jones = rng.normal(size=(2, 2)) + 1j * rng.normal(size=(2, 2))
        jones /= np.linalg.norm(jones, 2)
        back = op.Mueller(mueller_of_jones(jones)).reversed().matrix
        np.testing.assert_allclose(back, mueller_of_jones(over @ jones.T @ over), atol=2e-15)


def test_products_and_batches_are_reversed_matrix_by_matrix():
    q, matrices = np.diag([1.0, 1.0, -1.0, 1.0]), np.random.default_rng(1).normal(size=(3, 2, 4, 4))
    expected = [[q @ matrix.T @ q for matrix in row] for row in matrices]
    np.testing.assert_array_equal(op.Mueller(matrices).reversed().matrix, expected)
    there = op.Interface(0.2 + 3j, 1.0, azimuth=0.3).mueller()
    assert there.reversed().reversed() == there
    first = op.Mueller(op.Retarder(1.0, 0.3).mueller().matrix, frame_out=op.Frame().turned(0.7))
    second = op.Polarizer(0.2, leakage=0.3).mueller()
    both, apart = (second @ first).reversed(), first.reversed() @ second.reversed()
    np.testing.assert_allclose(both.matrix, apart.matrix, atol=1e-15)
    before, behind = op.Frame().turned(0.2), op.Frame().turned(-0.4)
    back = op.Mueller(np.eye(4), before, behind).reversed()
    assert (back.frame_in, back.frame_out) == (behind.reversed(), before.reversed())
    # A turn between frames has the same numbers on the way back.
    turn = behind.reversed().turn_to(before.reversed())
    np.testing.assert_allclose(turn, before.turn_to(behind), atol=1e-15)


def test_noise_precision_slopes_and_pickles_are_reversed_along():
    crossed = op.Polarizer("90 deg").mueller() @ op.Polarizer(0.0).mueller()
    assert crossed.reversed().noise == crossed.noise > crossed.matrix[0, 0]
    back = op.Mueller(np.eye(4, dtype=np.float32)).reversed()
    assert back.matrix.dtype == np.float32
    assert not np.signbit(back.matrix).any()
    back = op.Retarder(1.0, 0.3).mueller().reversed()
    assert pickle.loads(pickle.dumps(back)) == back
    slope = pytest.importorskip("jax").jacfwd(reciprocal)(np.eye(4))
    assert (slope[1, 2, 2, 1], slope[0, 3, 3, 0]) == (-1.0, 1.0)
