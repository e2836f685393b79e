"""What a matrix makes of light is light, or is refused."""

import pickle

import numpy as np
import pytest

import optipath as op
from tables import rows

BRIGHT = op.Light([1.0, 0.0, 0.0, 1.0])
TOO_MUCH = op.Mueller(np.diag([3.0, 0.0, 0.0, 5.0]))


@rows(
    "matrix, light, problem",
    [
        (TOO_MUCH, BRIGHT, r"\[1.0, 0.0, 0.0, 1.0\] becomes \[3.0, .* 166.667 %"),
        (op.Mueller([[0.1, 0, 0, 0], [3, 0, 0, 0], [0] * 4, [0] * 4]), BRIGHT, "3000 %"),
        (op.Mueller(-np.eye(4)), BRIGHT, "intensity -1.0 is negative"),
        (op.Mueller(np.diag([0.0, 1, 1, 1])), BRIGHT, "polarised, and dark"),
        (TOO_MUCH, 1e-300 * (1e-300 * BRIGHT), r"like \[1.0, .* 166.667 %"),
        (TOO_MUCH @ op.Rotator(0.3).mueller(), BRIGHT, "166.667 %"),
        (op.Rotator(0.3) @ TOO_MUCH, BRIGHT, "166.667 %"),
        (pickle.loads(pickle.dumps(TOO_MUCH)).reshape(1)[0], BRIGHT, "166.667 %"),
        (op.Mueller(TOO_MUCH.matrix.astype("f4")), BRIGHT, "166.667 %"),
        (TOO_MUCH, op.Light([[1.0, 0, 0, 0], [1.0, 0, 0, 1], [1.0, 0, 0, -1]]), "one of 2 such"),
    ],
)
def test_a_matrix_that_makes_no_light_of_light_is_refused(matrix, light, problem):
    with pytest.raises(op.LightError, match=problem) as told:
        matrix @ light
    assert "matrix.nearest_physical()" in str(told.value)
    assert "Light(..., physical=False)" in str(told.value)


def test_the_cures_of_a_matrix_that_makes_no_light_work():
    assert (TOO_MUCH.nearest_physical() @ BRIGHT).dop <= 1.0
    free = op.Light(BRIGHT.stokes, physical=False)
    for light in (free, 2 * free, free[None][0], free.in_frame(op.Frame().turned(0.1))):
        assert (TOO_MUCH @ (TOO_MUCH @ light)).dop == pytest.approx(25 / 9)


def test_light_of_unphysical_matrices_is_taken_where_it_is_light():
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


@rows("dtype", [np.float32, np.float64])
def test_what_roundings_have_left_of_crossed_polarisers_is_not_refused(dtype):
    angles = np.linspace(0.0, 3.0, 50)
    behind, before = (op.Polarizer(angles + a).mueller().matrix for a in (np.pi / 2, 0.0))
    light = op.Light([[1.0, 0.6, 0.0, 0.8], [1.0, 0.0, -1.0, 0.0]])[:, None]
    left = op.Mueller(behind.astype(dtype) @ before.astype(dtype)) @ light
    assert np.abs(left.S0).max() < 2 * np.finfo(dtype).eps
