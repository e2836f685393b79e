import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from tables import rows

ANGLES = st.floats(-4.0, 4.0)


def test_matrices_multiply_from_the_left_and_broadcast():
    polarizer = op.Polarizer().mueller()
    rotator = op.Rotator(np.pi / 2).mueller()
    light = op.Light([1.0, 0.0, 0.0, 0.0])
    np.testing.assert_allclose(
        (rotator @ polarizer @ light).stokes, [0.5, -0.5, 0, 0], rtol=1e-15, atol=1e-16
    )
    np.testing.assert_allclose(
        (polarizer @ rotator @ light).stokes, [0.5, 0.5, 0, 0], rtol=1e-15, atol=1e-16
    )
    reflection = op.Interface(1.5, np.linspace(0.1, 1.0, 5)).mueller()
    polarizers = op.Polarizer(np.zeros((3, 1))).mueller()
    assert (reflection @ polarizers).matrix.shape == (3, 5, 4, 4)
    assert (reflection @ polarizers @ op.Light([1.0, 0, 0, 0])).stokes.shape == (3, 5, 4)
    tilted = op.Frame.from_direction(z=(1, 0, 0), x=(0, 1, 0))
    with pytest.raises(op.FrameError, match="one direction"):
        op.Mueller(np.eye(4), frame_in=tilted) @ op.Light([1.0, 0, 0, 0])
    with pytest.raises(op.FrameError, match="one direction"):
        op.Mueller(np.eye(4), frame_in=tilted) @ op.Mueller(np.eye(4))


@given(turn=ANGLES)
def test_matrices_realign_frames_that_differ_by_a_turn(turn):
    frame = op.Frame().turned(turn)
    analyzer = op.Polarizer().mueller(frame_in=frame, frame_out=frame)
    light = analyzer @ op.Polarizer().mueller() @ op.Light([2.0, 0.0, 0.0, 0.0])
    assert light.intensity == pytest.approx(np.cos(turn) ** 2, abs=1e-14), "Malus's law"
    assert light.frame == frame


@given(turn=ANGLES)
def test_concatenating_first_or_attenuating_first_is_the_same(turn):
    frame = op.Frame().turned(turn)
    second = op.Retarder(1.0, angle=0.3).mueller(frame_in=frame, frame_out=frame)
    first = op.Interface(1.5 + 0.2j, 0.8).mueller()
    light = op.Light([1.0, 0.2, 0.3, 0.4])
    one = ((second @ first) @ light).stokes
    np.testing.assert_allclose(one, (second @ (first @ light)).stokes, rtol=0, atol=1e-15)


@rows("matrix", [np.eye(3), np.zeros(4), np.eye(4) * 1j])
def test_what_is_no_mueller_matrix_is_refused(matrix):
    with pytest.raises(op.ShapeError, match=r"\(\.\.\., 4, 4\)"):
        op.Mueller(matrix)
