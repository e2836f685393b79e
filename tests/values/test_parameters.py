import numpy as np
import pytest

import optipath as op
from tables import rows


def test_a_text_with_a_unit_is_a_value():
    assert op.Parameter("a", unit="deg").resolve("180 deg").value == np.pi


def test_words_stand_for_values_and_none_for_absence():
    parameter = op.Parameter("a", words={"up": 1.0}, optional=True)
    resolved = parameter.resolve(["up", "none", 0.5])
    np.testing.assert_array_equal(resolved.value, [1.0, 0.0, 0.5])
    np.testing.assert_array_equal(resolved.present, [True, False, True])


@rows(
    "keywords, message",
    [
        ({"name": "not a name"}, "letters, digits"),
        ({"name": "a", "offset": "D65", "offset_dimension": ["length"]}, "must be a text, not"),
        ({"name": "a", "unit": "dge"}, "did you mean 'deg'"),
        ({"name": "a", "default": 2.0, "maximum": 1.0}, "outside its range"),
        ({"name": "a", "default": "up"}, "no word 'up'"),
        ({"name": "a", "bound": True}, "bound but has no value"),
        ({"name": "a", "minimum": 2.0, "maximum": 1.0}, "lower end"),
        ({"name": "a", "minimum": np.nan}, "lower end"),
        ({"name": "a", "minimum": "x"}, "is not a quantity"),
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


@rows("number", [-1.0, 0.0, 1.0, 1.0 + 2**-52, np.nan, np.inf, -np.inf])
@rows("limits", [(-1.0, 1.0), (-np.inf, 0.0), (-np.inf, np.inf)])
def test_a_float_is_judged_as_an_array_of_it_is(number, limits):
    parameter = op.Parameter("a", minimum=limits[0], maximum=limits[1])
    if limits[0] <= number <= limits[1] and np.isfinite(number):
        resolved = parameter.resolve(number)
        assert resolved.value == parameter.resolve(np.array(number)).value == number
        assert (resolved.value.shape, resolved.present.shape) == ((), ())
        return
    sentences = []
    for given in (number, np.array(number)):
        with pytest.raises(op.ParameterError) as error:
            parameter.resolve(given)
        sentences.append(str(error.value))
    assert sentences[0] == sentences[1]


def test_a_negative_parameter_differs_in_its_sign_alone():
    words = {"up": 1.0}
    parameter = op.Parameter("a", 0.5, "deg", -1.0, 1.0, help="a turn", words=words, optional=True)
    assert (-parameter).is_negative
    assert not parameter.is_negative
    assert (-parameter).same_specification(parameter)
    assert -parameter != parameter
