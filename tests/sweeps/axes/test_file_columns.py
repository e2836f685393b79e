"""Cells of a file that something is wrong with, told by file and line."""

import pytest

import optipath as op

pytest.importorskip("xarray")

PATH = op.load_preset("npgr026")


def refused(folder, text):
    file = folder / "points.csv"
    file.write_text(text, "utf-8")
    with pytest.raises(op.OptipathError) as told:
        PATH.sweep(coords=file)
    about = f"{told.value.about}: " if told.value.about else ""
    return [f"{about}{each}".replace(f"{file}: ", "") for each in told.value.faults]


def test_decimal_commas_beside_semicolons_are_told(tmp_path):
    found = refused(tmp_path, "delta (deg);rho (deg)\n10,5;5\n11;1.000,5\n")
    assert found == [
        "line 2: '10,5' has a comma; write '10.5'",
        "line 3: '1.000,5' has a comma; write a point alone",
    ]


def test_decimal_commas_among_commas_are_told(tmp_path):
    (found,) = refused(tmp_path, "delta (deg),rho (deg)\n10,5,20,5\n")
    assert found.endswith("; write one for each, and points where commas are decimal: '10.5,20.5'")


def test_the_unit_of_pure_numbers_is_read(tmp_path):
    file = tmp_path / "points.csv"
    file.write_text("n1 (1),delta (deg)\n1.5,20\n1.6,30\n", "utf-8")
    found = PATH.sweep(coords=file)
    assert found.n1.values.tolist() == [1.5, 1.6]
    assert found.n1.units == "1"


def test_all_cells_out_of_range_have_their_lines(tmp_path):
    assert refused(tmp_path, "n1,delta (deg)\n1.5,20\nnan,120\n-1,130\n") == [
        "line 3: parameter 'n1' is 'nan', which is not finite; write a number",
        "line 4: parameter 'n1' is -1, outside its range; give 0 or more",
        "line 3: parameter 'delta' is 120 deg, outside its range; give 0 deg .. 90 deg",
        "line 4: parameter 'delta' is 130 deg, outside its range; give 0 deg .. 90 deg",
    ]


def test_of_many_cells_the_first_are_told_and_how_many_more(tmp_path):
    found = refused(tmp_path, "delta (deg)\n" + "100\n" * 50)
    assert [found[0][:7], found[-1]] == ["line 2:", "and 38 more"]
