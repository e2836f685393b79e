"""What is given is read once: numbers, or every fault of it in one error."""

import numpy as np
import pytest

import optipath as op
from tables import rows


def path():
    made = op.PathGraph()
    lamp = made.add("lamp", op.Source(intensity=op.Parameter("power", default=2.0)))
    pane = made.add("pane", op.Interface(1.5, op.Parameter("theta")))
    filtered = made.add("filter", op.Polarizer(op.Parameter("turn", optional=True, default=0.0)))
    lamp >> pane >> filtered >> made.add("eye", op.Detector())
    return made


def faults(**given):
    with pytest.raises(op.ParameterError) as raised:
        path().trace(**given)
    return raised.value.faults


def test_every_fault_of_what_is_given_is_told_at_once():
    found = faults(theta=np.array([0.1, 2.0]), power=-1.0, turn="sideways", thta=0.1)
    assert len(found) == 4
    for name in ("'thta'", "'turn'", "'theta'", "'power'"):
        assert any(name in fault for fault in found), found
    found = faults(theta=np.array([0.1, 2.0]), power=np.ones(3))
    assert any("'theta'" in fault for fault in found)
    (fault,) = faults(theta=np.full(2, 0.1), power=np.ones(3))
    assert "theta (2,)" in fault
    assert "power (3,)" in fault


@rows("bad", [np.nan, np.inf, -0.1, 2.0])
def test_a_float_out_of_range_is_refused_by_prepared_batches_too(bad):
    plan = path().compose()
    power = np.linspace(1.0, 2.0, 2000)
    for _ in range(3):
        plan.run(theta=0.3, power=power)
    with pytest.raises(op.ParameterError, match="'theta'"):
        plan.run(theta=bad, power=power)


@rows("count", [5, 200, 2000])
def test_an_array_out_of_range_is_refused_by_prepared_batches_too(count):
    plan = path().compose()
    for _ in range(6):
        plan.run(theta=np.linspace(0.0, 1.0, count))
    with pytest.raises(op.ParameterError, match=r"'theta'.* give a real angle"):
        plan.run(theta=np.linspace(0.0, 2.0, count))


def test_a_word_that_takes_an_element_out_is_another_batch_than_one_that_does_not():
    plan, theta = path().compose(), np.linspace(0.0, 1.0, 2000)
    for _ in range(2):
        crossed = plan.run(theta=theta, turn=np.pi / 2)
        there, absent = plan.run(theta=theta, turn=0.0), plan.run(theta=theta, turn="none")
        total = crossed.intensity + there.intensity
        np.testing.assert_allclose(absent.intensity, total, rtol=1e-12)
