"""Options of ``optipath sweep``: how names and endings are written."""

import json

import pytest

from optipath.cli import main
from optipath.cli.block_bar import block_bar
from tables import rows

ANGLE = ("--angle", "0:90:3")


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def told(capsys, *arguments):
    status = main([*arguments])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def test_a_slash_behind_a_file_does_not_change_its_form(capsys, tmp_path):
    assert told(capsys, "sweep", "malus", *ANGLE, "--out", "a.csv/")[0] == 0
    assert (tmp_path / "a.csv").read_text("utf-8").startswith("angle (deg),S0,")


@rows("names", ["sky-angle,theta", "sky_angle,theta", "--sky-angle, --theta"])
def test_zip_takes_names_as_options_have_them(names, capsys):
    given = ["--sky-angle", "0:30:3", "--theta", "0:60:3", "--zip", names, "--json"]
    status, out, err = told(capsys, "sweep", "sky-and-window", *given)
    assert (status, err) == (0, "")
    dimensions = {axis["dimension"] for axis in json.loads(out)["axes"].values()}
    assert dimensions == {"sky_angle_theta"}


def test_an_interrupt_says_that_blocks_of_netcdf_are_beside_it(capsys):
    def interrupted():
        with block_bar("x.nc") as tell:
            tell(1, 3)
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    lines = capsys.readouterr().err.splitlines()
    assert lines[0] == "optipath: 1 of 3 blocks is in .x.nc.blocks already"
    assert lines[1].startswith("optipath: 1 of 3 blocks is in .x.nc.blocks; the same command")


@rows("word", ["light,between,eye", "@places.csv", "light:eye:2"])
def test_a_choice_of_places_takes_one_word(word, capsys):
    status, _, err = told(capsys, "sweep", "npgr026", "--delta", "0:90:3", "--place", word)
    assert status == 2
    told_of_it = f"--place takes one word of light, between and eye, and '{word}' is several"
    assert err == f"optipath: {told_of_it}; give one, and write a command for each\n"


@rows("text", ["nan", "NaN", "10, nan, 30"])
def test_nan_is_not_finite_rather_than_a_word(text, capsys):
    _, _, err = told(capsys, "sweep", "npgr026", "--delta", text)
    assert err.count("cannot be 'nan', which is not finite; give an angle such as '45 deg'") + (
        err.count("cannot be 'NaN', which is not finite")
    )
    assert "word" not in err


def test_a_column_without_a_unit_is_told_once_with_its_file(capsys, tmp_path):
    (tmp_path / "a.csv").write_text("delta\n10\n20\n30\n", "utf-8")
    status, _, err = told(capsys, "sweep", "npgr026", "--delta", "@a.csv")
    assert status == 2
    assert err == (
        "optipath: a.csv: column 'delta' has no unit; write its name as 'delta (deg)' if that is "
        "its unit\n"
    )


def test_faults_of_cells_name_their_file(capsys, tmp_path):
    (tmp_path / "a.csv").write_text("delta (deg)\n10\nnan\n30\n", "utf-8")
    _, _, err = told(capsys, "sweep", "npgr026", "--delta", "@a.csv")
    assert err.startswith("optipath: a.csv: parameter 'delta' cannot be 'nan'")
