"""How often the numbers of each step are computed."""

import numpy as np

import optipath as op
from paths import chain
from tables import rows

ELEMENTS = [
    op.Retarder(op.Parameter("a"), 0.1),
    op.Interface(1.5, op.Parameter("b")),
    op.Attenuator(op.Parameter("t", 0.5)),
    op.Depolarizer(np.linspace(0.0, 1.0, 5).reshape(5, 1, 1)),
    op.Medium(op.Parameter("l"), 2.0, rotation=op.Parameter("w")),
]
COUNTS = {"e0.out": 40, "e1.reflected": 50, "e2.out": 1, "e3.out": 5, "e4.out": 40 * 50}


@rows("b", [np.full(50, 0.4), op.CosSin(np.full(50, 0.6), 0.8)])
def test_a_step_is_evaluated_along_the_axes_of_its_own_values(b):
    values = {"a": np.full((40, 1), 0.3), "b": b, "l": np.full((40, 1), 0.1), "w": np.ones(50)}
    path = chain(ELEMENTS, [1.0, 0.3, 0.2, 0.1])
    counts = path.compose().evaluations(**values)
    assert {name: counts[name] for name in COUNTS} == COUNTS
    full = op.Composer(model="full").compose(path).evaluations(**values)
    assert {full[name] for name in COUNTS} == {5 * 40 * 50}


def test_links_that_turn_nothing_are_not_evaluated():
    counts = chain([op.Polarizer(op.Parameter("a"))]).compose().evaluations(a=np.ones(7))
    assert "eye.in" not in counts
    assert counts["e0.out"] == 7
