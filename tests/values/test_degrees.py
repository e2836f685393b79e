"""Degrees given for radians are told: by a warning, or where they are refused."""

import warnings

import numpy as np
import pytest

import optipath as op
from optipath.cli.command import main
from paths import chain
from tables import rows


def warned(action):
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        action()
    return [str(one.message) for one in told]


WARNED = (
    "is a plain number beyond 2 pi, in radians; write degrees as '48 deg', and radians as '48 rad'"
)


def test_a_plain_number_beyond_a_whole_turn_is_warned_of():
    rows = [
        (lambda: op.Polarizer(45), "Polarizer angle"),
        (lambda: op.Retarder(90.0), "Retarder retardance"),
        (lambda: op.Rotator(4.0 * np.pi), "Rotator angle"),
        (lambda: op.Rotator(np.linspace(0, 180, 7)), "Rotator angle"),
        (lambda: op.Rotator([30.0, "1 deg"]), "Rotator angle"),
        (lambda: op.Rotator(np.float32(-45)), "Rotator angle"),
        (lambda: op.Interface(1.5, 0.1, azimuth=30), "Interface azimuth"),
        (lambda: op.Medium(1.0, angle=45), "Medium angle"),
        (lambda: op.VerticesByAngles((0.1, 0.2), (45,)), "turns[0]"),
        (lambda: op.Parameter("t", 45, unit="deg"), "parameter 't'"),
        (lambda: op.Parameter("t", unit="deg", maximum=180), "the maximum of parameter 't'"),
        (lambda: op.Rotator(op.Parameter("t", 45)), "Rotator angle"),
        (lambda: op.Parameter("f", words={"up": 90}, unit="deg"), "the word 'up' of parameter 'f'"),
        (
            lambda: op.Polarizer(op.Parameter("f", words={"up": 90})),
            "the word 'up' of parameter 'f'",
        ),
        (lambda: op.Polarizer(op.Parameter("d", maximum=90)), "the maximum of parameter 'd'"),
        (
            lambda: op.Interface(1.5, op.Parameter("d", 0.5, maximum=90)),
            "the maximum of parameter 'd'",
        ),
        (lambda: op.Frame().turned(90), "the angle of a turn"),
    ]
    for action, what in rows:
        (sentence,) = warned(action)
        assert sentence.endswith(f"{what} {WARNED}")


def test_a_warning_is_of_the_line_of_who_wrote_it():
    path = chain([op.Rotator(op.Parameter("turn"))])
    for action in (lambda: op.Polarizer(45), lambda: path.trace(turn=45)):
        with pytest.warns(op.AngleWarning) as told:
            action()
        assert told[0].filename == __file__


def test_other_numbers_at_one_line_are_warned_of_once():
    """By the rule of Python's own, which merges what is the same at a place."""
    path = chain([op.Rotator(op.Parameter("turn"))])
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("default")
        for angle in np.linspace(10.0, 90.0, 500):
            path.trace(turn=angle)
    assert len(told) == 1
    of_turns = [key for key in __warningregistry__ if "parameter 'turn' is" in str(key)]
    assert len(of_turns) == 1


@rows(
    "action",
    [
        lambda: op.Polarizer("720 deg"),
        lambda: op.Rotator(["720 deg", "45 rad"]),
        lambda: op.Rotator(2.0 * np.pi),
        lambda: op.Rotator(np.linspace(-2.0 * np.pi, 2.0 * np.pi, 9, dtype=np.float32)),
        lambda: op.Medium(1.0, rotation="500 rad/m"),
        lambda: op.Medium(op.Parameter("length"), rotation=500.0),
        lambda: chain([op.Medium(op.Parameter("l"), rotation="500 rad/m")]).bind(l=1.0).trace(),
        lambda: op.Polarizer(op.Parameter("f", words={"up": "400 deg"}, maximum="720 deg")),
        lambda: chain([op.Polarizer(op.Parameter("f", words={"up": "400 deg"}))]).bind(f="up"),
        lambda: op.Parameter("t", "720 deg"),
        lambda: op.Parameter("t", 45.0),
        lambda: chain([op.Rotator(op.Parameter("t"))]).trace(t="720 deg"),
        lambda: chain([op.Rotator(op.Parameter("t"))]).trace(t=["720 deg", 0.5]),
        lambda: chain([op.Rotator(op.Parameter("t"))]).trace(t=op.CosSin(0.6, 0.8)),
        lambda: op.load_preset("malus", angle="340 deg").trace(),
        lambda: op.Polarizer(azimuth="45 rad") @ op.Light([1.0, 1.0, 0.0, 0.0]),
    ],
)
def test_what_is_said_to_be_in_degrees_or_is_in_radians_is_no_reason_to_warn(action):
    assert warned(action) == []


@rows(
    "ask",
    [
        lambda path, angle: path.trace(turn=angle),
        lambda path, angle: path.trace_all(turn=angle),
        lambda path, angle: path.trace(keep="all", turn=angle),
        lambda path, angle: path.mueller(turn=angle),
        lambda path, angle: path.paths(turn=angle),
        lambda path, angle: list(path.compose().stream(10, turn=angle)),
        lambda path, angle: path.compose().certificate(turn=angle),
        lambda path, angle: path.bind(turn=angle),
        lambda path, angle: op.Composer(engine="numpy").compose(path).run(turn=angle),
    ],
)
@rows("angle", [45, 45.0, np.linspace(0.0, 180.0, 4)])
def test_what_is_given_to_a_run_is_warned_of_once(ask, angle):
    path = chain([op.Rotator(op.Parameter("turn"))])
    (sentence,) = warned(lambda: ask(path, angle))
    assert sentence.startswith("parameter 'turn' ")


@rows("first", [0.1, np.linspace(0.0, 1.0, 5)])
def test_a_path_that_has_been_run_often_warns_of_degrees_all_the_same(first):
    path = chain([op.Rotator(op.Parameter("turn"))])
    for _ in range(10):
        path.trace(turn=first)
    assert len(warned(lambda: path.trace(turn=first * 100.0 + 50.0))) == 1


@rows("plan", [chain([op.Rotator(op.Parameter("turn"))]).compose()])
@rows("angle", [45, 60.0, [0.1, 45.0], np.arange(180.0)])
def test_each_run_that_is_given_degrees_is_warned_of(plan, angle):
    for _ in range(2):
        assert len(warned(lambda: plan.run(turn=angle))) == 1


A = op.Parameter("a")


@rows("angle", [10 * A, 2 * A - "10 deg", -A])
def test_a_multiple_is_warned_of_where_the_number_is_beyond_a_turn(angle):
    path = chain([op.Rotator(angle)])
    for give in (path.trace, path.bind):
        for given in (45, [0.5, -40.0]):
            assert warned(lambda: give(a=given)) == [f"parameter 'a' {WARNED}"]  # noqa: B023


@rows(
    "angle, given",
    [
        (A * (np.pi / 180), [10.0, 45.0, 720.0]),
        (op.Parameter("a", 45, maximum=360) * (np.pi / 180), 90),
        (A / 100, 270.0),
        (10 * A, 4.5),
        (5 * A, np.linspace(0.0, 3.0, 31)),
        (5 * A, np.float32(2.1)),
        (2 * A, np.linspace(0.0, 2.0 * np.pi, 50, endpoint=False).astype("f4")),
        (A * (2.0 * np.pi * 0.009 / 550e-9), 1e-3),
        (A * (np.pi / 180), np.arange(0.0, 720.0, 0.7)),
        (10 * A, "30 deg"),
        (10 * A, np.radians(90.0)),
    ],
)
def test_a_multiple_of_an_angle_within_a_turn_or_of_a_pure_number_is_no_reason_to_warn(
    angle, given
):
    assert warned(lambda: chain([op.Rotator(angle)]).trace(a=given)) == []


def test_a_unit_for_what_the_path_turns_into_radians_is_warned_of():
    path = chain([op.Rotator(A * (np.pi / 180))])
    for given in ("45 deg", ["45 deg", "0.1 rad"]):
        sentence = warned(lambda given=given: path.trace(a=given))[0]
        assert sentence.startswith("parameter 'a' has a unit, and the path multiplies it by pi")
    assert warned(lambda: path.trace(a=[10.0, 45.0, 720.0])) == []


@rows("default", [45, 0.5, None])
def test_a_default_of_plain_degrees_that_become_radians_is_no_reason_to_warn(default):
    path = chain([op.Rotator(op.Parameter("a", default) * (np.pi / 180))])
    assert warned(lambda: path.bind(a=1.0) if default is None else path.trace()) == []


def test_large_arrays_are_looked_at_in_many_places():
    angles = np.zeros(10**6)
    angles[300_000:700_000] = 90.0
    path = chain([op.Rotator(op.Parameter("turn"))])
    assert len(warned(lambda: path.trace(turn=angles))) == 1


@rows(
    "action",
    [
        lambda: op.load_preset("npgr026").trace(delta=48),
        lambda: op.load_preset("npgr026").trace(delta=[0.1, 48.0]),
        lambda: op.load_preset("npgr026", delta=48),
        lambda: op.load_preset("npgr026").bind(delta=48),
        lambda: op.Interface(1.5, 48),
        lambda: op.Parameter("t", 48, "deg", 0.0, 1.5),
        lambda: chain([op.Interface(1.5, op.Parameter("t"))]).trace(t=48),
        lambda: chain([op.Interface(1.5, op.Parameter("t"))]).bind(t=48),
        lambda: op.Interface(1.5, op.Parameter("t", 48)),
        lambda: op.refraction_angle(1.5, 48),
    ],
)
def test_degrees_that_are_refused_are_offered_with_their_unit(action):
    with pytest.raises(op.OptipathError) as error:
        action()
    assert "48 rad, which is 2750.2 deg" in str(error.value)
    assert str(error.value).endswith("; did you mean '48 deg' or np.radians(48)?")


@rows("angle", [2 * A - "20 deg", "90 deg" - A])
@rows("given", [48, [0.3, 48.0]])
def test_degrees_that_are_refused_for_a_multiple_are_offered_as_they_are_given(angle, given):
    path = chain([op.Interface(1.5, angle)])
    for give in (path.trace, path.bind):
        with pytest.raises(op.ParameterError, match=r"; did you mean '48 deg' or np.radians\(48\)"):
            give(a=given)
    path.trace(a="48 deg")


@rows("angle", [A * (np.pi / 180), "90 deg" - A * (np.pi / 180), 2 * (np.pi / 180) * A])
def test_degrees_that_become_radians_in_the_path_are_offered_without_a_unit_to_add(angle):
    path = chain([op.Interface(1.5, angle)])
    for give in (path.trace, path.bind):
        with pytest.raises(op.ParameterError) as error:
            give(a=100)
        assert "did you mean" not in str(error.value)


def test_a_range_of_plain_degrees_is_told_as_it_was_given():
    path = chain([op.Rotator(op.Parameter("d", maximum=80) * (np.pi / 180))])
    for give in (path.trace, path.bind):
        with pytest.raises(op.ParameterError, match=r"'d' is 85, .* range; give 80 or less$"):
            give(d=85)


@rows("delta", ["100 deg", np.radians(100.0), 1.6, 200.0])
def test_a_slip_of_radians_and_what_was_in_degrees_already_are_not(delta):
    with pytest.raises(op.ParameterError) as error:
        op.load_preset("npgr026").trace(delta=delta)
    assert "did you mean" not in str(error.value)


@pytest.mark.parametrize("delta", ["100", "48 rad", "100 deg"])
def test_the_command_line_reads_degrees_and_speaks_of_no_radians(delta, capsys):
    assert main(["run", "npgr026", "--delta", delta]) == 2
    said = capsys.readouterr().err
    assert "outside its range; give 0 deg .. 90 deg" in said
    assert "did you mean" not in said
    assert "np." not in said
