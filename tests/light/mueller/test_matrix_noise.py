"""What of a Mueller matrix is rounding: of what the same path has as light it is, too."""

import pickle

import numpy as np
import pytest

import optipath as op

ANGLES = np.random.default_rng(5).uniform(-3.0, 3.0, 200)
WHITE = op.Light([100.0, 0.0, 0.0, 0.0])
FIGURES = ("psi", "delta", "diattenuation", "polarizance", "depolarization_index")


def crossed():
    return op.Polarizer(ANGLES + np.pi / 2).mueller(), op.Polarizer(ANGLES).mueller()


def path():
    angle = op.Parameter("angle")
    return (
        op.Source(100)
        >> op.Polarizer(angle)
        >> op.Retarder(0.3, 0.2, azimuth=0.1)
        >> op.Polarizer(op.Parameter("second"), azimuth=0.1)
        >> op.Detector()
    )


def test_crossed_polarisers_leave_no_light_and_no_figures_but_rounding():
    second, first = crossed()
    for light in (second @ first @ WHITE, second @ (first @ WHITE)):
        assert np.all(light.intensity <= light.noise)
        for figure in ("dop", "aop", "psi", "delta", "ellipticity"):
            assert np.isnan(getattr(light, figure)).all(), figure
    second, first = crossed()
    dark = (second @ first).matrix[..., 0, 0] == 0.0
    for figure in FIGURES:
        found = getattr(second @ first, figure)
        assert np.isnan(found[~dark]).all(), figure
    second, first = crossed()
    plate = op.Retarder(0.3, 1.1).mueller()
    assert np.isnan((plate @ second @ first @ plate @ WHITE).dop).all()


def test_the_matrix_of_a_path_knows_its_rounding():
    crossed_path = (
        op.Source(100)
        >> op.Polarizer(op.Parameter("a"))
        >> op.Polarizer(op.Parameter("b"))
        >> op.Detector()
    )
    for a in ANGLES[:20].tolist():
        matrix = crossed_path.mueller(a=a, b=a + np.pi / 2)
        assert np.isnan((matrix @ WHITE).dop)
        assert matrix.matrix[0, 0] == 0.0 or np.isnan(matrix.diattenuation)
    batch = crossed_path.mueller(a=ANGLES, b=ANGLES + np.pi / 2)
    assert np.isnan((batch @ WHITE).dop).all()
    matrix = path().mueller(angle=0.2, second=1.0)
    second, first = crossed()
    for kept in (matrix, second @ first):
        again = pickle.loads(pickle.dumps(kept))
        np.testing.assert_array_equal(again.noise, kept.noise)


def test_what_is_let_through_keeps_its_figures():
    given = path().trace(angle=0.2, second=1.0)
    matrix = path().mueller(angle=0.2, second=1.0)
    np.testing.assert_allclose((matrix @ WHITE).aop, given.aop, rtol=1e-12)
    assert matrix.diattenuation == pytest.approx(1.0, abs=1e-12)
    filters = op.Attenuator(1e-12).mueller()
    weak = filters @ filters @ op.Polarizer(0.3).mueller()
    np.testing.assert_allclose((weak @ WHITE).aop, 0.3, rtol=1e-12)
    np.testing.assert_allclose(weak.diattenuation, 1.0, rtol=1e-12)
