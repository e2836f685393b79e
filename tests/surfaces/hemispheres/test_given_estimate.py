import numpy as np
import pytest

import optipath as op

pytest.importorskip("numba")
pytest.importorskip("xarray")


@pytest.fixture(scope="module")
def seen():
    return op.measure(op.Sample([(1.5, 0.1)]), "56 deg", photons=16_384, sensor=15)


def test_what_follows_comes_of_a_function(seen):
    for estimate in (lambda: seen.estimate_toward(3, "56 deg"), lambda: seen.own.estimate(3)):
        with pytest.raises(op.SurfaceError, match="found is 3; give a function"):
            estimate()


@pytest.mark.parametrize("value", [None, "0.5", [[1.0], [1.0, 2.0]], 1j, True])
def test_what_follows_is_real_numbers(seen, value):
    with pytest.raises(op.SurfaceError, match="let the function return real numbers"):
        seen.estimate_toward(lambda _: value, "56 deg")
    with pytest.raises(op.SurfaceError, match="let the function return real numbers"):
        seen.own.estimate(lambda _: value)


def test_whole_numbers_follow_too(seen):
    value, error = seen.estimate_toward(lambda _: 2, "56 deg")
    assert (value, error) == (2, 0.0)


def test_no_directions_are_refused(seen):
    with pytest.raises(op.SurfaceError, match=r"the shape \(0, 3\); give one direction or more"):
        seen.toward(np.zeros((0, 3)))


def test_progress_of_a_measurement_is_a_function():
    with pytest.raises(op.SurfaceError, match="progress is 3; give a function of two numbers"):
        op.measure(op.Sample([(1.5, 0.1)]), "56 deg", progress=3)
