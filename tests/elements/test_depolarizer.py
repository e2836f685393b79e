import numpy as np
import pytest

import optipath as op
from paths import chain
from tables import rows

STATE = [1.0, 0.5, 0.6, 0.4]


def test_what_is_left_of_the_polarisation_is_what_is_not_taken():
    light = chain([op.Depolarizer(np.array([0.0, 0.25, 1.0]))], STATE).trace()
    left = np.linalg.norm(STATE[1:]) * np.array([1.0, 0.75, 0.0])
    np.testing.assert_allclose(light.dop, left, rtol=0, atol=1e-15)


def test_no_light_is_lost():
    light = chain([op.Depolarizer(op.Parameter("d"))], STATE).trace(d=np.linspace(0, 1, 50))
    np.testing.assert_array_equal(light.intensity, 1.0)


def test_jones_columns_cannot_pass():
    with pytest.raises(op.ComposerError, match=r"'e0\.out' has a whole Mueller matrix"):
        op.Composer(composing="jones").compose(chain([op.Depolarizer(0.5)]))


def test_behind_an_ideal_depolarizer_polarisation_is_not_carried():
    plan = chain([op.Depolarizer(), op.Rotator(op.Parameter("a"))], STATE).compose()
    assert plan.program.counts[-1] == 1
    assert "left out, since it changes nothing alive: turn back at 'e1.out'" in plan.explain()


def test_a_depolarizer_keeps_components_apart():
    path = chain([op.Depolarizer(op.Parameter("d"))], [1.0, 0.5, 0.0, 0.0])
    assert path.compose().model == "sp"


def test_a_depolarizer_that_takes_nothing_is_left_out():
    assert len(chain([op.Depolarizer(0.0)], STATE).compose().program.steps) == 1


@rows("depolarization", [-0.1, 1.1])
def test_shares_outside_0_to_1_are_refused(depolarization):
    with pytest.raises(op.ValueFault, match=r"^Depolarizer depolarization is"):
        op.Depolarizer(depolarization)
