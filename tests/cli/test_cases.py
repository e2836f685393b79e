"""Several cases at once, as a table and as JSON."""

import json

import pytest

import optipath as op
from optipath.cli import main
from tables import rows


def run(capsys, *arguments):
    status = main(list(arguments))
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def rows_of(table):
    """The rows of a printed table, a list of words each."""
    return [
        [word.strip() for word in line.strip("│").split("│")]
        for line in table.splitlines()
        if line.startswith("│")
    ]


def test_all_cases_are_a_table_with_what_was_published_below(capsys):
    status, out, err = run(capsys, "run", "npgr026", "--case", "all")
    assert (status, err) == (0, "")
    rows = rows_of(out)
    assert [row[0] for row in rows] == [
        word for case in range(1, 10) for word in (str(case), f"{case}, published")
    ]
    assert ["8", "E", "19.1245", "10.9873", "-13.0076", "-8.70795"] in rows
    assert "note on cases 4, 5 and 6: The published table prints" in out


def test_several_cases_are_the_rows_that_were_asked_for(capsys):
    _, out, _ = run(capsys, "run", "npgr026", "--case", "7", "--case", "1", "--case", "7")
    assert [row[0] for row in rows_of(out)] == ["7", "7, published", "1", "1, published"]


def test_every_detector_has_its_row(capsys):
    _, out, _ = run(capsys, "run", "glass-slab", "--case", "all")
    assert {row[1] for row in rows_of(out)} == {"transmitted", "reflected"}


def test_cases_as_json_are_the_objects_of_each(capsys):
    found = json.loads(run(capsys, "run", "npgr026", "--case", "all", "--json")[1])
    assert list(found) == ["preset", "cases"]
    assert list(found["cases"]) == [str(case) for case in range(1, 10)]
    for case in ("1", "7"):
        alone = json.loads(run(capsys, "run", "npgr026", "--case", case, "--json")[1])
        assert found["cases"][case] == alone


def test_values_that_are_given_hold_in_every_case(capsys):
    arguments = ["run", "npgr026", "--case", "1", "--case", "7", "--delta", "20"]
    _, out, _ = run(capsys, *arguments)
    assert "delta 20 deg" in out
    assert [row[0] for row in rows_of(out)] == ["1", "7"]
    found = json.loads(run(capsys, *arguments, "--json")[1])["cases"]
    assert {case: each["parameters"]["delta"] for case, each in found.items()} == {"1": 20, "7": 20}


def test_polarisation_is_told_of_several_cases(capsys):
    found = json.loads(run(capsys, "polarization", "npgr026", "--case", "all", "--json")[1])
    assert found["cases"]["7"]["detectors"]["E"]["exact"] == pytest.approx(33.9959, abs=1e-4)
    _, out, _ = run(capsys, "polarization", "npgr026", "--case", "1", "--case", "7")
    assert "npgr026, case 1:" in out
    assert "npgr026, case 7:" in out


@rows("command", ["explain", "bench", "chart", "show"])
@rows("cases", [["all"], ["1", "3"]])
def test_commands_about_one_case_say_so(command, cases, capsys):
    asked = [word for case in cases for word in ("--case", case)]
    status, out, err = run(capsys, command, "npgr026", *asked)
    assert (status, out) == (2, "")
    assert err == f"optipath: {command} takes one case; there are: 1, 2, 3, 4, 5, 6, 7, 8, 9\n"


def test_all_cases_of_a_preset_without_any_are_refused(capsys, tmp_path):
    file = tmp_path / "bare.toml"
    file.write_text(
        'format = 1\n[elements.lamp]\nkind = "source"\n[elements.eye]\nkind = "detector"\n'
        '[[links]]\nfrom = "lamp.out"\nto = "eye.in"\n',
        "utf-8",
    )
    _, _, err = run(capsys, "run", str(file), "--case", "all")
    assert err == f"optipath: preset '{file}' has no cases; leave --case out\n"


def test_every_unknown_case_is_told(capsys):
    _, _, err = run(capsys, "run", "npgr026", "--case", "10", "--case", "1", "--case", "11")
    assert err.splitlines()[0] == "optipath: 2 faults:"
    assert "case '10' is unknown" in err
    assert "case '11' is unknown" in err


def test_a_parameter_is_given_once(capsys):
    _, _, err = run(capsys, "run", "npgr026", "--delta", "3", "--delta", "4")
    assert err == "optipath: --delta is given 2 times; give it once\n"


def test_the_note_of_a_case_is_of_its_own_values_as_what_was_published(capsys):
    for given in (["--n1", "1.2", "--n2", "1.3"], ["--filter", "diagonal"]):
        for form in ([], ["--json"], ["--case", "5"]):
            status, out, _ = run(capsys, "run", "npgr026", "--case", "4", *given, *form)
            assert status == 0
            assert "published" not in out
            assert "note" not in out
    assert "note: " in run(capsys, "run", "npgr026", "--case", "4")[1]


def written(folder, text):
    file = folder / "own.toml"
    file.write_text(text, "utf-8")
    return str(file)


def test_a_fault_of_some_cases_names_them_and_all_are_told(capsys, tmp_path):
    path = op.Source() >> op.Interface(1.5, 3 * op.Parameter("theta")) >> op.Detector()
    for case, degrees in {"flat": 10, "steep": 40, "back": 40, "other": 50}.items():
        path.cases[case] = op.Case({"theta": f"{degrees} deg"})
    file = written(tmp_path, path.to_toml())
    for command in ("run", "polarization"):
        _, out, err = run(capsys, command, file, "--case", "all")
        assert out == ""
        first, *faults = err.splitlines()
        assert first == "optipath: 2 faults:"
        assert [fault.partition(": parameter 'theta'")[0] for fault in faults] == [
            "- cases steep and back",
            "- case other",
        ]
        assert "120 deg" in faults[0]
        assert "150 deg" in faults[1]


def test_a_fault_of_every_case_is_told_once_without_them(capsys):
    _, _, several = run(capsys, "run", "npgr026", "--case", "all", "--delta", "100")
    _, _, one = run(capsys, "run", "npgr026", "--case", "1", "--delta", "100")
    assert several == one
    assert "100 deg" in one


def test_a_case_is_shown_as_defaults_which_stay_open(capsys):
    _, out, _ = run(capsys, "show", "npgr026", "--case", "7")
    assert "bound" not in out
    assert next(line for line in out.splitlines() if "delta" in line).split()[:3] == [
        "delta",
        "48",
        "deg",
    ]


def test_one_case_of_all_is_counted_as_one(capsys, tmp_path):
    path = op.load_preset("malus")
    path.cases = {"only": op.Case({"angle": "60 deg"})}
    text = path.to_toml()
    _, out, _ = run(capsys, "run", written(tmp_path, text), "--case", "all")
    assert ", 1 case:" in out


def test_what_was_published_stands_below_the_lights_of_a_batch(capsys, tmp_path):
    text = op.load_preset("malus").to_toml() + (
        '[cases.several]\nvalues = { angle = ["30 deg", "60 deg"] }\n'
        "published = { eye = [0.25, 0.125, 0, 0] }\n"
    )
    _, out, _ = run(capsys, "run", written(tmp_path, text), "--case", "several")
    assert ["published", "0.25", "0.125", "0", "0"] in rows_of(out)
