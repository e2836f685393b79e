import copy
import pickle

import numpy as np
import pytest

import optipath as op

COPIES = [copy.copy, copy.deepcopy, lambda made: pickle.loads(pickle.dumps(made))]


def found(angle=0.3, seed=0):
    path = op.Source() >> op.Polarizer(op.Parameter("a")) >> op.Detector()
    return path.propagate(a=(angle, 0.1), method="monte-carlo", samples=100, seed=seed)


def arrays_of(made):
    (value,) = made.uncertain
    own = [made.mean, made.covariance, made.uncertainties, made.shares, made.left]
    return [*own, made.uncertainty, value.value, value.sigma]


@pytest.mark.parametrize("angle", [0.3, 0.0, [0.1, 0.2]], ids=["one", "with NaN", "several"])
def test_an_uncertainty_equals_that_of_the_same_and_its_copies(angle):
    made = found(angle)
    assert made == found(angle)
    for copied in COPIES:
        again = copied(made)
        assert again == made
        assert not any(array.flags.writeable for array in arrays_of(again))


def test_an_uncertainty_is_not_that_of_another_value_or_seed():
    assert found() != found(seed=1)
    assert found() != found(0.4)
    assert found() != found([0.3])
    assert found() != "light"


def test_an_uncertainty_has_no_hash():
    with pytest.raises(TypeError, match="unhashable"):
        hash(found())


def test_nobody_can_change_an_uncertainty():
    angles = np.array([0.1, 0.2])
    made = found(angles)
    angles[0] = 9.0
    assert made.uncertain[0].value[0] == 0.1
    assert not any(array.flags.writeable for array in arrays_of(made))
    with pytest.raises(AttributeError):
        made.mean = 0.0
