import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from chains import ENGINES
from paths import chain
from tables import rows

STATE = [1.0, 0.5, 0.6, 0.4]


def by_hand(right, left):
    """The matrix in the books: Chipman, Lam & Young (2018), ch. 6, for S3 > 0 right."""
    a, b, c = (right + left) / 2, (right - left) / 2, np.sqrt(right * left)
    return np.array([[a, 0, 0, b], [0, c, 0, 0], [0, 0, c, 0], [b, 0, 0, a]])


@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_the_matrix_is_that_of_the_books(right, left):
    found = op.CircularDiattenuator(right, left).mueller().matrix
    np.testing.assert_allclose(found, by_hand(right, left), rtol=0, atol=3e-16)


def test_right_handed_light_passes_one_that_is_ideal():
    ideal = op.CircularDiattenuator()
    right, left = (op.Light([1.0, 0.0, 0.0, s3]) for s3 in (1.0, -1.0))
    assert right.handedness == 1
    np.testing.assert_array_equal((ideal @ right).stokes, right.stokes)
    np.testing.assert_array_equal((ideal @ left).stokes, 0.0)


@rows("leak", [1e-3, 1e-12, 1e-300])
def test_what_hardly_passes_keeps_its_digits(leak):
    light = chain([op.CircularDiattenuator(1.0, leak)], [1.0, 0.0, 0.0, -1.0]).trace()
    assert pytest.approx(leak, rel=1e-15) == light.S0


@rows("engine", ENGINES)
def test_every_engine_agrees(engine):
    right, left = np.random.default_rng(1).uniform(0.0, 1.0, (2, 3000))
    path = chain([op.CircularDiattenuator(op.Parameter("r"), op.Parameter("l"))], STATE)
    found = op.Composer(engine=engine).compose(path).run(r=right, l=left).stokes
    wanted = np.array([by_hand(*pair) @ STATE for pair in zip(right, left, strict=True)])
    atol = 2e-6 if np.asarray(found).dtype == np.float32 else 1e-15
    np.testing.assert_allclose(np.asarray(found), wanted, rtol=0, atol=atol)


def test_it_is_composed_with_jones_columns():
    path = chain([op.CircularDiattenuator(0.7, 0.2)], STATE)
    found = op.Composer(composing="jones").compose(path).run().stokes
    np.testing.assert_allclose(found, by_hand(0.7, 0.2) @ STATE, rtol=0, atol=3e-16)


def test_shares_beyond_1_are_refused_with_both_names():
    with pytest.raises(op.ValueFault) as error:
        op.CircularDiattenuator(1.5, -0.1)
    assert [fault.split(" is ")[0] for fault in error.value.faults] == [
        "CircularDiattenuator right",
        "CircularDiattenuator left",
    ]
