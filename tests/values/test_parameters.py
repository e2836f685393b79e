import numpy as np
import pytest

import optipath as op


def test_a_text_with_a_unit_is_a_value():
    assert op.Parameter("a", unit="deg").resolve("180 deg").value == np.pi


def test_words_stand_for_values_and_none_for_absence():
    parameter = op.Parameter("a", words={"up": 1.0}, optional=True)
    resolved = parameter.resolve(["up", "none", 0.5])
    np.testing.assert_array_equal(resolved.value, [1.0, 0.0, 0.5])
    np.testing.assert_array_equal(resolved.present, [True, False, True])


@pytest.mark.parametrize(
    ("keywords", "message"),
    [
        ({"name": "not a name"}, "letters, digits"),
        ({"name": "a", "unit": "dge"}, "did you mean 'deg'"),
        ({"name": "a", "default": 2.0, "maximum": 1.0}, "outside its range"),
        ({"name": "a", "default": "up"}, "no word 'up'"),
        ({"name": "a", "bound": True}, "bound but has no value"),
        ({"name": "a", "minimum": 2.0, "maximum": 1.0}, "lower end"),
        ({"name": "a", "minimum": np.nan}, "lower end"),
        ({"name": "a", "minimum": "x"}, "must be numbers"),
        ({"name": "a", "maximum": 1.0, "words": {"up": 2.0}}, "outside its range"),
        ({"name": "a", "words": {"up": np.nan}}, "finite"),
        ({"name": "a", "words": {"up": [1.0]}}, "must be a number"),
        ({"name": "a", "words": {"none": 1.0}}, "cannot have the word 'none'"),
        ({"name": "a", "words": 3}, "dict from word"),
        ({"name": "a", "default": 1 + 1j, "minimum": 0.0}, "complex but has a range"),
        ({"name": "a", "unit": None}, "'None' is unknown"),
        ({"name": "a", "help": 3}, "must be a text"),
        ({"name": "a", "optional": "yes"}, "True or False"),
        ({"name": "a", "default": 10**400}, "must be a number"),
    ],
)
def test_a_parameter_that_cannot_be_is_refused(keywords, message):
    with pytest.raises(op.OptipathError, match=message):
        op.Parameter(**keywords)


def test_a_default_may_be_a_text_with_a_unit():
    assert op.Parameter("a", "180 deg", unit="deg") == op.Parameter("a", np.pi, unit="deg")


def test_twice_negative_is_the_parameter_itself():
    parameter = op.Parameter("a", default=1.0)
    negative = -parameter
    assert -negative == parameter
    assert -parameter != parameter


def test_a_complex_default_is_shown_as_it_is_read():
    parameter = op.Parameter("r", "-0.3+0.2j")
    assert parameter.default_text() == "-0.3+0.2j"
    assert parameter.parse(parameter.default_text()) == -0.3 + 0.2j
