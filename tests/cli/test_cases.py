"""Several cases at once, as a table and as JSON."""

import json

import pytest

from optipath.cli import main


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


@pytest.mark.parametrize("command", ["explain", "bench", "chart", "show"])
@pytest.mark.parametrize("cases", [["all"], ["1", "3"]])
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
