"""Values that nothing needs: each is held to its range all the same."""

import numpy as np
import pytest

import optipath as op
from paths import chain
from tables import rows

ASKED = {
    "an intensity": lambda plan, **given: plan.run(**given),
    "a certificate": lambda plan, **given: plan.certificate(**given),
}


@rows("size", [(), (5,), (3000,)])
@rows("asked", ASKED)
@rows("bad", [np.nan, np.inf, -0.5, 1.5])
def test_a_value_that_nothing_needs_is_held_to_its_range_however_often_the_plan_has_run(
    asked, size, bad
):
    # A depolariser changes no intensity that leaves at once.
    elements = [op.Attenuator(op.Parameter("t")), op.Depolarizer(op.Parameter("d"))]
    plan = op.Composer(engine="numpy").compose(chain(elements, reads="intensity"))
    for _ in range(6):
        given = {"t": np.full(size, 0.3) if size else 0.3, "d": np.full(size, 0.5) if size else 0.5}
        ASKED[asked](plan, **given)
        for name in "td":
            wrong = np.full(size, 0.5)
            wrong[(-1,) * len(size)] = bad
            value = wrong if size else float(wrong)
            with pytest.raises(op.ParameterError, match=f"'{name}' .*; give a "):
                ASKED[asked](plan, **{**given, name: value})
