"""Values that a user gives without a name, and detectors that are not named."""

import pytest

import optipath as op


def two_detectors():
    path = op.PathGraph()
    path.add("lamp", op.Source(op.Parameter("power", 2.0))) >> path.add("plate", op.BeamSplitter())
    for end in ("reflected", "transmitted"):
        path.add(end, op.Detector())
        path.connect(f"plate.{end}", f"{end}.in")
    return path


@pytest.mark.parametrize(
    ("call", "written"),
    [
        (lambda path: path.trace(0.3), r"trace\(angle=0.3\)"),
        (lambda path: path.trace(0.3, 0.4), r"trace\(angle=0.3\)"),
        (lambda path: path.trace([0.1, 0.2]), r"trace\(angle=\[0.1, 0.2\]\)"),
        (lambda path: path.trace({"angle": 0.3}), r"trace\(\*\*{'angle': 0.3}\)"),
        (lambda path: path.trace_all(0.3), r"trace_all\(angle=0.3\)"),
        (lambda path: path.mueller(0.3), r"mueller\(angle=0.3\)"),
        (lambda path: path.mueller("lamp", "eye", 0.3), r"mueller\(angle=0.3\)"),
        (lambda path: path.bind(0.3), r"bind\(angle=0.3\)"),
        (lambda path: path.paths({"angle": 0.3}), r"paths\(\*\*{'angle': 0.3}\)"),
        (lambda path: path.compose().run(0.3), r"run\(angle=0.3\)"),
        (lambda path: path.compose().run_all(0.3), r"run_all\(angle=0.3\)"),
        (lambda path: path.compose().certificate(0.3), r"certificate\(angle=0.3\)"),
        (lambda path: next(path.compose().stream(9, 0.3)), r"stream\(angle=0.3\)"),
    ],
)
def test_a_value_without_a_name_is_shown_with_one(call, written):
    with pytest.raises(op.ParameterError, match=f"given by name: {written}; there are: angle"):
        call(op.load_preset("malus"))


def test_where_no_parameter_is_open_a_value_has_no_name():
    path = op.load_preset("malus", angle=0.1, intensity=1.0)
    with pytest.raises(op.ParameterError, match="no parameter is open"):
        path.trace(0.3)


def test_what_is_kept_is_given_by_name():
    with pytest.raises(op.ParameterError, match=r"trace\(keep='all'\)"):
        op.load_preset("malus").trace("all")


@pytest.mark.parametrize("case", [8, "8"])
def test_a_case_without_a_name_is_shown_with_one(case):
    with pytest.raises(op.ParameterError, match=rf"load_preset\('npgr026', case={case!r}\)"):
        op.load_preset("npgr026", case)


@pytest.mark.parametrize(("value", "written"), [(0.3, "delta=0.3"), ({"n1": 2}, r"\*\*{'n1': 2}")])
def test_a_value_for_a_preset_is_given_by_name(value, written):
    with pytest.raises(op.ParameterError, match=rf"load_preset\('npgr026', {written}\)"):
        op.load_preset("npgr026", value)


def test_several_detectors_name_the_call_that_gives_them_all():
    path = two_detectors()
    with pytest.raises(op.ParameterError, match=r"2 detectors .*; use trace_all\(\)$"):
        path.trace()
    with pytest.raises(op.ParameterError, match=r"2 detectors .*; use trace_all\(\)$"):
        path.trace(power=3.0)
    with pytest.raises(op.ParameterError, match=r"2 detectors .*; use run_all\(\)$"):
        path.compose().run()
    assert set(path.trace_all()) == {"reflected", "transmitted"}
