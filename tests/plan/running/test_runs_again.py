"""Plans that have run before: what cannot be is refused, and what is given is read, each time."""

import numpy as np
import pytest

import optipath as op
from paths import chain
from tables import rows

FEW, MANY = np.full(5, 0.5), np.full(3000, 0.5)
REFUSED = {
    "an unknown name": ({"typo": 0.3}, "'typo' is unknown"),
    "an unknown name of a batch": ({"t": FEW, "typo": FEW}, "'typo' is unknown"),
    "a float out of range": ({"t": 1.5}, "'t' .* is 1.5"),
    "a float out of range beside few": ({"t": 1.5, "d": FEW}, "'t' .* is 1.5"),
    "a float out of range beside many": ({"t": 1.5, "d": MANY}, "'t' .* is 1.5"),
    "a default out of place": ({"t": None}, "'t' has no value"),
    "a word": ({"t": "half"}, "'t' .*'half'"),
    "a complex number": ({"t": 0.5 + 0.5j}, "parameter 't'.* real"),
    "shapes that differ": ({"t": np.ones(3), "d": np.ones(4)}, "do not broadcast|shape"),
}


@rows("wrong", REFUSED)
def test_what_cannot_be_is_refused_however_often_the_plan_has_run(wrong):
    elements = [op.Attenuator(op.Parameter("t")), op.Depolarizer(op.Parameter("d", 0.5))]
    plan = op.Composer(engine="numpy").compose(chain(elements, [1.0, 0.5, 0.3, 0.2]))
    given, words = REFUSED[wrong]
    for _ in range(6):
        for right in (
            {"t": 0.4},
            {"t": 0.4, "d": FEW},
            {"t": FEW, "d": FEW},
            {"t": 0.4, "d": MANY},
        ):
            plan.run(**right)
        with pytest.raises(op.ParameterError, match=words):
            plan.run(**given)


@rows("value", [1, np.float64(1.0), np.float32(1.0), np.array(1.0), "whole"])
def test_numbers_of_any_sort_are_numbers_however_often_the_plan_has_run(value):
    plan = chain(
        [op.Attenuator(op.Parameter("t", 0.5, words={"whole": 1.0}))], [1.0, 0.5, 0.3, 0.2]
    )
    for _ in range(6):
        assert plan.trace(t=0.25).intensity == 0.25
        assert plan.trace(t=value).intensity == 1.0
        assert plan.trace().intensity == 0.5


@rows(
    "amplitude",
    [0.5, -0.5, 0.3 + 0.4j, np.full(5, 0.5), np.full(5, 0.3 - 0.4j), np.full(3000, -0.5)],
)
def test_an_amplitude_is_read_with_both_its_parts(amplitude):
    mirror = op.Mirror(op.Parameter("r"), op.Parameter("r"))
    plan = op.Composer(engine="numpy").compose(chain([mirror], [1.0, 0.5, 0.3, 0.2]))
    for _ in range(6):
        found = plan.run(r=amplitude).stokes
        # |r|^2 is 1/4 of all of them, and r_s conj(r_p) is it as well.
        expected = np.broadcast_to(0.25 * np.array([1.0, 0.5, 0.3, 0.2]), found.shape)
        np.testing.assert_allclose(found, expected, rtol=1e-14)
