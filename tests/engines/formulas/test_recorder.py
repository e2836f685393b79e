"""What recorders keep of operations on numbers that are not known yet."""

import numpy as np
import pytest

from optipath.engines.formulas.recorder import Recorder
from optipath.engines.formulas.symbol import Symbol
from optipath.engines.formulas.symbolic import SYMBOLIC


@pytest.fixture
def recorder():
    return Recorder(np.dtype("float64"))


def test_an_operation_is_kept_once_and_what_changes_nothing_left_out(recorder):
    x, y = recorder.input("x"), recorder.input("y")
    assert x * y is y * x
    assert (x - y) is not (y - x)
    assert len(recorder.symbols) == 5
    x = recorder.input("x")
    assert x + 0.0 is x
    assert 1.0 * x is x
    negative = -x
    assert -negative is x
    assert SYMBOLIC.where(True, x, 3.0) is x  # noqa: FBT003 - a condition that is known
    product = recorder.input("x") * 0.0
    assert not isinstance(product, Symbol)
    assert product == 0.0


def test_known_numbers_are_computed_in_the_precision_of_the_record():
    recorder = Recorder(np.dtype("float32"))
    x = recorder.input("x")
    third = (x * (np.float32(1.0) / np.float32(3.0))).operands[1]
    assert third.dtype == np.float32
    assert (x + 0.1).operands[1].dtype == np.float32


def test_whole_numbers_beside_others_are_numbers_like_them(recorder):
    x = recorder.input("x")
    assert (4 * x).operands[0].dtype == np.float64
    exponent = SYMBOLIC.scaling(x)
    assert (exponent + 1).kind == "int"
    assert SYMBOLIC.ldexp(x, exponent).kind == "float"


def test_what_is_known_of_numbers_is_not_asked_and_what_is_not_is_no_truth(recorder):
    square = recorder.input("x") * recorder.input("x")
    assert abs(square) is square
    assert SYMBOLIC.maximum(square, 0.0) is square
    assert SYMBOLIC.minimum(square, 0.0) == 0.0
    assert not (square < 0.0)
    with pytest.raises(TypeError, match=r"xp\.where"):
        bool(recorder.input("x") > 0.0)
