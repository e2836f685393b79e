"""What depends on names, shapes and types alone is prepared once."""

import numpy as np
import pytest

import optipath as op
from optipath.plan.running import batch_runner, formula_maker, runner, shared
from optipath.plan.running import prepared as preparing
from tables import rows


def path(index=1.5):
    """Return a path that is no other test's, so that nothing has been prepared for it."""
    shared._RUNNERS.clear()
    made = op.PathGraph()
    lamp = made.add("lamp", op.Source(stokes=[1.0, 0.3, 0.2, 0.1]))
    pane = made.add("pane", op.Interface(index, op.Parameter("theta")))
    metal = made.add("metal", op.Interface(0.2 + 3j, op.Parameter("phi", default=0.5), azimuth=0.6))
    lamp >> pane >> metal >> made.add("eye", op.Detector())
    return made


@pytest.fixture
def prepared(monkeypatch):
    """Count the formulas and the layouts that are made."""
    counts = {"formulas": 0, "layouts": 0}
    make, layout = formula_maker.FormulaMaker.attempt, runner.Layout

    def counted(self, *given):
        counts["formulas"] += 1
        return make(self, *given)

    def laid(*given):
        counts["layouts"] += 1
        return layout(*given)

    monkeypatch.setattr(formula_maker.FormulaMaker, "attempt", counted)
    monkeypatch.setattr(runner, "Layout", laid)
    return counts


@pytest.mark.parametrize("shape", [(3000,), (60, 70)])
def test_a_second_run_of_a_shape_makes_nothing_anew(prepared, shape):
    plan, theta = path().compose(), np.linspace(0.1, 1.2, np.prod(shape)).reshape(shape)
    first = plan.run(theta=theta)
    done = dict(prepared)
    assert done == {"formulas": 1, "layouts": 1}
    second = plan.run(theta=theta[::-1])
    assert prepared == done
    np.testing.assert_array_equal(second.stokes[::-1], first.stokes)


def test_a_first_run_of_a_few_paths_makes_no_formula(prepared):
    path().compose().run(theta=np.linspace(0.1, 1.2, 5))
    assert prepared["formulas"] == 0


def test_a_handful_that_is_asked_for_again_makes_one_formula_of_floats(prepared):
    plan, theta = path().compose(), np.linspace(0.1, 1.2, 5)
    found = [plan.run(theta=theta).stokes for _ in range(8)]
    assert prepared == {"formulas": 1, "layouts": 1}
    for stokes in found[1:]:
        np.testing.assert_allclose(stokes, found[0], rtol=1e-12, atol=1e-15)


def test_an_equal_path_built_anew_is_not_prepared_anew(prepared):
    theta = np.linspace(0.1, 1.2, 3000)
    first = path().compose().run(theta=theta)
    made = op.PathGraph()
    lamp = made.add("lamp", op.Source(stokes=[1.0, 0.3, 0.2, 0.1]))
    pane = made.add("pane", op.Interface(1.5, op.Parameter("theta")))
    metal = made.add("metal", op.Interface(0.2 + 3j, op.Parameter("phi", default=0.5), azimuth=0.6))
    lamp >> pane >> metal >> made.add("eye", op.Detector())
    np.testing.assert_array_equal(made.compose().run(theta=theta).stokes, first.stokes)
    assert prepared["formulas"] == 1


@rows("one, other", [(1.5, 1.6), (0.0, -0.0)])
def test_paths_that_differ_in_a_default_share_nothing(one, other):
    def runner_of(default):
        made = op.PathGraph()
        lamp = made.add("lamp", op.Source())
        turn = made.add("turn", op.Retarder(op.Parameter("delta", default=default), 0.3))
        lamp >> turn >> made.add("eye", op.Detector())
        return made.compose().answers.light

    assert runner_of(one) is runner_of(one)
    assert runner_of(one) is not runner_of(other)


def test_batches_of_one_sort_and_other_shapes_share_a_formula(prepared):
    plan = path().compose()
    for count in (2000, 3000, 4000):
        plan.run(theta=np.linspace(0.1, 1.2, count))
    assert prepared == {"formulas": 1, "layouts": 3}


def test_zero_is_a_number_like_others(prepared):
    plan, theta = path().compose(), np.linspace(0.1, 1.2, 2000)
    for phi in (0.3, 0.4, 0.0, 0.0):
        together = plan.run(theta=theta, phi=phi).stokes
        alone = plan.run(theta=theta, phi=np.full(2000, phi)).stokes
        np.testing.assert_array_equal(together, alone)
    assert prepared["formulas"] == 2


def test_no_more_sorts_are_kept_than_there_is_room_for(monkeypatch):
    monkeypatch.setattr(preparing, "MOST_KEPT", 2)
    plan = path().compose()
    for count in (2, 3, 4, 5, 6):
        plan.run(theta=np.linspace(0.1, 1.2, count))
        plan.run(theta=0.2, phi=np.linspace(0.1, 1.2, count))
    assert len(plan.answers.light._recipes) <= 2
    assert len(plan.answers.light._kinds) <= 2


def test_a_long_batch_is_looked_at_in_pieces(monkeypatch):
    monkeypatch.setattr(batch_runner, "_AT_ONCE", 1000)
    plan, theta = path().compose(), np.linspace(0.1, 1.2, 3500)
    whole = plan.run(theta=theta).stokes
    np.testing.assert_array_equal(
        plan.run(theta=theta[1700:1701].repeat(2000)).stokes[7], whole[1700]
    )
