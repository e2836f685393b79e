"""What depends on names, shapes and types is prepared once; what is given is read each time."""

import numpy as np
import pytest

import optipath as op
from optipath.plan import batches, runner
from optipath.plan import runner as shared
from paths import chain
from tables import rows
from wired import wired

FACTOR = {"now": 0.5}


def path():
    pane = op.Interface(1.5, op.Parameter("theta"))
    metal = op.Interface(0.2 + 3j, op.Parameter("phi", default=0.5), azimuth=0.6)
    return chain([pane, metal], [1.0, 0.3, 0.2, 0.1])


@pytest.fixture
def prepared(monkeypatch):
    """Count the formulas and the layouts that are made, nothing having been prepared."""
    shared._RUNNERS.clear()
    counts = {"formulas": 0, "layouts": 0}

    def counted(name, function):
        def calling(*given):
            counts[name] += 1
            return function(*given)

        return calling

    maker = runner.Runner
    monkeypatch.setattr(maker, "attempt", counted("formulas", maker.attempt))
    monkeypatch.setattr(runner, "Layout", counted("layouts", runner.Layout))
    return counts


@pytest.mark.parametrize("shape", [(3000,), (60, 70)])
def test_a_second_run_of_a_shape_makes_nothing_anew(prepared, shape):
    plan, theta = path().compose(), np.linspace(0.1, 1.2, np.prod(shape)).reshape(shape)
    first = plan.run(theta=theta)
    assert prepared == {"formulas": 1, "layouts": 1}
    second = plan.run(theta=theta[::-1])
    assert prepared == {"formulas": 1, "layouts": 1}
    np.testing.assert_array_equal(second.stokes[::-1], first.stokes)


def test_a_handful_makes_no_formula_at_first_and_one_of_floats_when_asked_for_again(prepared):
    plan, theta = path().compose(), np.linspace(0.1, 1.2, 5)
    first = plan.run(theta=theta).stokes
    assert prepared["formulas"] == 0
    for _ in range(7):
        np.testing.assert_allclose(plan.run(theta=theta).stokes, first, rtol=1e-12, atol=1e-15)
    assert prepared == {"formulas": 1, "layouts": 1}


def test_equal_paths_built_anew_and_other_shapes_of_one_sort_share_a_formula(prepared):
    theta = np.linspace(0.1, 1.2, 3000)
    first, again = (path().compose().run(theta=theta).stokes for _ in range(2))
    np.testing.assert_array_equal(first, again)
    assert prepared["formulas"] == 1
    for count in (2000, 3000, 4000):
        path().compose().run(theta=np.linspace(0.1, 1.2, count))
    assert prepared == {"formulas": 1, "layouts": 3}


def test_zero_is_a_number_like_others(prepared):
    plan, theta = path().compose(), np.linspace(0.1, 1.2, 2000)
    for phi in (0.3, 0.4, 0.0, 0.0):
        together = plan.run(theta=theta, phi=phi).stokes
        alone = plan.run(theta=theta, phi=np.full(2000, phi)).stokes
        np.testing.assert_array_equal(together, alone)
    assert prepared["formulas"] == 2


def test_no_more_sorts_and_runners_are_kept_than_there_is_room_for(monkeypatch):
    monkeypatch.setattr(runner, "MOST_CACHED", 2)
    plan = path().compose()
    for count in (2, 3, 4, 5, 6):
        plan.run(theta=np.linspace(0.1, 1.2, count))
        plan.run(theta=0.2, phi=np.linspace(0.1, 1.2, count))
    assert len(plan.answers.light._recipes) <= 2
    assert len(plan.answers.light._kinds) <= 2
    monkeypatch.setattr(shared, "_MOST_RUNNERS", 3)
    for t in np.linspace(0.1, 0.9, 7):
        chain([op.Attenuator(float(t))]).trace()
    assert len(shared._RUNNERS) <= 3


def test_a_long_batch_is_looked_at_in_pieces(monkeypatch):
    monkeypatch.setattr(batches, "_AT_ONCE", 1000)
    plan, theta = path().compose(), np.linspace(0.1, 1.2, 3500)
    whole = plan.run(theta=theta).stokes
    repeated = plan.run(theta=theta[1700:1701].repeat(2000)).stokes
    np.testing.assert_array_equal(repeated[7], whole[1700])


@rows("one, other", [(1.5, 1.6), (0.0, -0.0)])
def test_equal_paths_share_a_runner_and_those_that_differ_in_a_default_or_number_do_not(one, other):
    def runner_of(default):
        turn = op.Retarder(op.Parameter("delta", default=default), 0.3)
        return chain([turn]).compose().answers.light

    assert runner_of(one) is runner_of(one)
    assert runner_of(one) is not runner_of(other)
    plans = [chain([op.Attenuator(t)]).compose() for t in (0.5, 0.25)]
    assert [plan.run().intensity for plan in plans] == [0.5, 0.25]


class ReadsOutside(op.Element):
    """An element whose kernel reads what stands outside of it, as cells of a notebook do."""

    angle: op.fields.Angle = 0.0

    @staticmethod
    def mueller_rows(xp, angle):
        factor = FACTOR["now"] + 0.0 * xp.cos(angle)
        return [[factor * entry for entry in row] for row in np.eye(4, dtype=int).tolist()]


@pytest.mark.parametrize("angle", [0.2, np.array([0.2, 0.3])])
def test_a_path_built_anew_is_what_its_elements_say_now(angle, monkeypatch):
    for _ in range(6):
        chain([ReadsOutside(op.Parameter("a"))]).trace(a=angle)
    monkeypatch.setitem(FACTOR, "now", 0.25)
    found = chain([ReadsOutside(op.Parameter("a"))]).trace(a=angle).intensity
    np.testing.assert_array_equal(found, np.full(np.shape(angle), 0.25))


@rows("turned_first", [True, False])
def test_what_must_agree_is_not_taken_from_a_path_of_equal_steps(turned_first):
    for parallel in (not turned_first, turned_first, not turned_first):
        front = op.Interface(1.5, op.Parameter("t"))
        back = op.Interface(1.0, 0.3, outside=1.5, parallel=parallel)
        nodes = {"lamp": op.Source(), "front": front, "back": back, "eye": op.Detector()}
        links = "lamp -> front, front.transmitted -> back, back.transmitted -> eye"
        path = wired(nodes, links)
        if parallel:
            with pytest.raises(op.errors.ParameterError, match="parallel=False"):
                path.trace(t=0.8)
        else:
            assert path.trace(t=0.8).S0 > 0.9


def refracted_in_space(degrees):
    made, theta = op.PathGraph(), np.radians(degrees)
    plane = op.plane_of_incidence((np.sin(theta), 0, -np.cos(theta)), (0, 0, 1))
    inside = np.arcsin(np.sin(theta) / 1.5)
    behind = op.Frame.from_direction((np.sin(inside), 0, -np.cos(inside)), plane.arriving.x)
    made.add("lamp", op.Source(), frames={"out": plane.arriving})
    glass = op.Interface(op.Parameter("n"), op.Parameter("t"))
    made.add("glass", glass, frames={"in": plane.arriving, "transmitted": behind})
    made.add("eye", op.Detector())
    made.connect("lamp", "glass")
    made.connect("glass.transmitted", "eye")
    return made


def test_world_frames_are_held_to_by_each_path_for_itself():
    for degrees in (45.0, 30.0, 45.0):
        path = refracted_in_space(degrees)
        assert path.trace(n=1.5, t=f"{degrees} deg").S0 > 0.9
        with pytest.raises(op.errors.ParameterError, match=r"turn light by .*, but by"):
            path.trace(n=1.5, t="20 deg")


STATE = [1.0, 0.5, 0.3, 0.2]


def dimmed():
    lamp = op.Source(intensity=op.Parameter("power", default=2.0))
    turn = op.Parameter("turn", optional=True, default=0.0)
    return lamp >> op.Interface(1.5, op.Parameter("theta")) >> op.Polarizer(turn) >> op.Detector()


def faults(**given):
    with pytest.raises(op.errors.ParameterError) as raised:
        dimmed().trace(**given)
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


def test_a_word_that_takes_an_element_out_is_another_batch_than_one_that_does_not():
    plan, theta = dimmed().compose(), np.linspace(0.0, 1.0, 2000)
    for _ in range(2):
        crossed = plan.run(theta=theta, turn=np.pi / 2)
        there, absent = plan.run(theta=theta, turn=0.0), plan.run(theta=theta, turn="none")
        total = crossed.intensity + there.intensity
        np.testing.assert_allclose(absent.intensity, total, rtol=1e-12)


FEW, MANY = np.full(5, 0.5), np.full(3000, 0.5)


@rows(
    "given, words",
    [
        ({"typo": 0.3}, "'typo' is unknown"),
        ({"t": FEW, "typo": FEW}, "'typo' is unknown"),
        *(({"t": 1.5} | beside, "'t' .* is 1.5") for beside in ({}, {"d": FEW}, {"d": MANY})),
        ({"t": np.nan, "d": MANY}, "'t' is nan"),
        ({"t": None}, "'t' has no value"),
        ({"t": "half"}, "'t' .*'half'"),
        ({"t": 0.5 + 0.5j}, "parameter 't'.* real"),
        ({"t": np.ones(3), "d": np.ones(4)}, "do not broadcast|shape"),
    ],
)
def test_what_cannot_be_is_refused_however_often_the_plan_has_run(given, words):
    elements = [op.Attenuator(op.Parameter("t")), op.Depolarizer(op.Parameter("d", 0.5))]
    plan = op.Composer(engine="numpy").compose(chain(elements, STATE))
    for _ in range(6):
        for right in (
            {"t": 0.4},
            {"t": 0.4, "d": FEW},
            {"t": FEW, "d": FEW},
            {"t": 0.4, "d": MANY},
        ):
            plan.run(**right)
        with pytest.raises(op.errors.ParameterError, match=words):
            plan.run(**given)


@rows("value", [1, np.float64(1.0), np.float32(1.0), np.array(1.0), "whole"])
def test_numbers_of_any_sort_are_numbers_however_often_the_plan_has_run(value):
    plan = chain([op.Attenuator(op.Parameter("t", 0.5, words={"whole": 1.0}))], STATE)
    for _ in range(6):
        for given, expected in (({"t": 0.25}, 0.25), ({"t": value}, 1.0), ({}, 0.5)):
            assert plan.trace(**given).intensity == expected


@rows("amplitude", [0.5, -0.5, 0.3 + 0.4j, FEW, np.full(5, 0.3 - 0.4j), -MANY])
def test_an_amplitude_is_read_with_both_its_parts(amplitude):
    mirror = op.Mirror(op.Parameter("r"), op.Parameter("r"))
    plan = op.Composer(engine="numpy").compose(chain([mirror], STATE))
    for _ in range(6):
        found = plan.run(r=amplitude).stokes
        # |r|^2 is 1/4 of all of them, and r_s conj(r_p) is it as well.
        expected = np.broadcast_to(0.25 * np.array(STATE), found.shape)
        np.testing.assert_allclose(found, expected, rtol=1e-14)


@rows("size", [(), (5,), (3000,)])
@rows("asked", ["run", "certificate"])
@rows("bad", [np.nan, np.inf, -0.5, 1.5])
def test_a_value_that_nothing_needs_is_held_to_its_range_however_often_the_plan_has_run(
    asked, size, bad
):
    # A depolariser changes no intensity that leaves at once.
    elements = [op.Attenuator(op.Parameter("t")), op.Depolarizer(op.Parameter("d"))]
    plan = op.Composer(engine="numpy").compose(chain(elements, reads="intensity"))
    ask = getattr(plan, asked)
    for _ in range(6):
        given = {"t": np.full(size, 0.3) if size else 0.3, "d": np.full(size, 0.5) if size else 0.5}
        ask(**given)
        for name in "td":
            wrong = np.full(size, 0.5)
            wrong[(-1,) * len(size)] = bad
            with pytest.raises(op.errors.ParameterError, match=f"'{name}' .*; give a "):
                ask(**{**given, name: wrong if size else float(wrong)})
