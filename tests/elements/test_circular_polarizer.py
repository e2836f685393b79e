import numpy as np
import pytest

import optipath as op
from chains import ENGINES
from paths import chain
from tables import rows

STATE = (1.0, 0.3, 0.5, 0.6)
T, L = op.Parameter("t"), op.Parameter("l")


def homogeneous(sign, t, leakage):
    """The matrix that is diag(t, leakage) between the two circular states."""
    mean, half, across = (t + leakage) / 2, sign * (t - leakage) / 2, np.sqrt(t * leakage)
    return np.array([[mean, 0, 0, half], [0, across, 0, 0], [0, 0, across, 0], [half, 0, 0, mean]])


@rows("word, sign", [("right", 1), ("left", -1)])
def test_an_ideal_one_is_exact(word, sign):
    found = op.CircularPolarizer(word).mueller().matrix
    np.testing.assert_array_equal(found, homogeneous(sign, 1.0, 0.0))


@rows("word, sign", [("right", 1), ("left", -1)])
@rows("engine", ENGINES)
def test_a_partial_one_has_its_two_transmittances(engine, word, sign):
    rng = np.random.default_rng(2)
    t, leakage = rng.uniform(0, 1, (2, 400))
    path = chain([op.CircularPolarizer(word, T, L)], STATE)
    found = op.Composer(engine=engine).compose(path).run(t=t, l=leakage).stokes
    expected = [homogeneous(sign, a, b) @ STATE for a, b in zip(t, leakage, strict=True)]
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-15)


@rows("word", ["right", "left"])
def test_its_handedness_is_the_one_that_light_says(word):
    light = chain([op.CircularPolarizer(word)]).trace()
    assert light.handedness == (1 if word == "right" else -1)
    assert light.intensity == 0.5
    assert chain([op.CircularPolarizer(word)], light.normalized).trace().intensity == 1.0


def test_two_of_other_handedness_are_dark():
    pair = [op.CircularPolarizer("right"), op.CircularPolarizer("left")]
    assert chain(pair, STATE).trace().intensity == 0.0


def test_a_turn_of_the_light_before_it_is_the_turn_behind_it():
    circular = op.CircularPolarizer("left", 0.9, 0.2)
    before, behind = (
        chain(two, STATE).trace().stokes
        for two in ([op.Rotator(0.4), circular], [circular, op.Rotator(0.4)])
    )
    np.testing.assert_allclose(before, behind, rtol=0, atol=3e-16)


def test_it_has_jones_matrices():
    path = chain([op.CircularPolarizer("left", 0.9, T)], STATE)
    found = op.Composer(composing="jones").compose(path).run(t=0.3).stokes
    np.testing.assert_allclose(found, homogeneous(-1, 0.9, 0.3) @ STATE, rtol=0, atol=3e-16)


def test_a_laminated_sheet_is_another_thing():
    sheet = [op.Polarizer(0.0), op.Retarder(np.pi / 2, np.pi / 4)]
    light = chain(sheet, (1.0, 0.0, 0.0, -1.0)).trace()
    np.testing.assert_allclose(light.stokes, [0.5, 0.0, 0.0, -0.5], rtol=0, atol=1e-16)


def test_a_word_that_is_no_handedness_is_refused():
    with pytest.raises(op.ValueFault, match="handedness is 'rigth'; did you mean 'right'"):
        op.CircularPolarizer("rigth")
    with pytest.raises(op.ValueFault, match="handedness cannot be a parameter"):
        op.CircularPolarizer(op.Parameter("h"))
