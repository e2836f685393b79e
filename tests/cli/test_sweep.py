"""Sweeps, several cases at once, and several values for an option: ranges, lists, columns."""

from pathlib import Path
from unittest.mock import Mock

import numpy as np
import pytest

import optipath as op
from optipath.sweeps.datasets import regions

ZARR = "sweep malus --angle 0:90:10 --out a.zarr --scheduler synchronous --chunks"
KEEPABLE = "2 of 4 blocks are in a.zarr"


def test_one_axis_is_a_table_two_are_a_plane_and_regions_cover_a_grid(told, run):
    def lines_of(line):
        return [" ".join(words.split()) for words in run(line)[1].splitlines()]

    out, lines = told("sweep malus --angle 0:90:3"), lines_of("sweep malus --angle 0:90:3")
    for row in (
        "angle (deg) S0 S1 S2 S3 DoP DoLP AoP (deg)",
        "45 0.25 0 0.25 0 1 1 45",
        "90 0 0 0 0 - -",
    ):
        assert any(line.startswith(row) for line in lines)
    assert max(map(len, out.splitlines())) <= 80
    lines = lines_of("sweep malus --angle 0:90:3 --intensity 1:2:2")
    assert {"angle (deg) \\ intensity 1 2", "45 0.25 0.5"} <= {*lines}
    assert "--out FILE" in " ".join(lines)
    lines = lines_of("sweep malus --angle 0:90:31 --intensity 1:4:31")
    assert " ".join(lines).split("light at eye")[1].split()[:2] == ["0", "2"]
    points = np.arange(2 * 3 * 4).reshape(2, 3, 4)
    for most in (1, 2, 5, 6, 7, 100):
        parts = [points[region].ravel() for region in regions(points.shape, most)]
        assert all(len(part) <= most for part in parts)
        np.testing.assert_array_equal(np.concatenate(parts), points.ravel())


def test_json_has_axes_units_and_all_values_and_names_are_taken_as_written(found, run, tmp_path):
    grid = found("sweep malus --angle 0:60:3 --intensity '1, 2'")
    assert grid["axes"]["angle"] == {"unit": "deg", "values": [0.0, 30.0, 60.0]}
    stokes = np.array(grid["detectors"]["eye"]["stokes"])
    np.testing.assert_allclose(stokes[..., 0], [[0.5, 1], [0.375, 0.75], [0.125, 0.25]], atol=1e-15)
    row = found("sweep malus --angle 0:60:3 --intensity 1:3:3 --zip angle,intensity")
    intensities = [stokes[0] for stokes in row["detectors"]["eye"]["stokes"]]
    assert intensities == pytest.approx([0.5, 0.75, 0.375], abs=1e-15)
    assert row["axes"]["angle"]["dimension"] == row["axes"]["intensity"]["dimension"]
    assert run("sweep malus --angle 0:90:3 --out a.csv/")[0] == 0
    assert (tmp_path / "a.csv").read_text("utf-8").startswith("angle (deg),S0,")
    for names in ("sky-angle,theta", "sky_angle,theta", "--sky-angle, --theta"):
        given = "--sky-angle 0:30:3 --theta 0:60:3 --zip"
        axes = found(f"sweep sky-and-window {given}", names)["axes"]
        assert {axis["dimension"] for axis in axes.values()} == {"sky_angle_theta"}


def test_a_table_has_a_line_a_point_and_is_read_as_an_axis_or_as_points(told, found, tmp_path):
    out = told("sweep malus --angle 0:60:3 --intensity 1:2:2 --out result.csv")
    assert out == "wrote result.csv: 6 points (angle 3, intensity 2)\n"
    lines = (tmp_path / "result.csv").read_text("utf-8").splitlines()
    header, *points = [line.split(",") for line in lines]
    assert header[:4] == ["angle (deg)", "intensity", "S0", "S1"]
    table = dict(zip(header, np.array(points, float).T, strict=True))
    np.testing.assert_allclose(table["angle (deg)"], [0, 0, 30, 30, 60, 60])
    cosines = np.cos(np.radians(table["angle (deg)"])) ** 2
    np.testing.assert_allclose(table["S0"], table["intensity"] * cosines / 2, rtol=1e-14)
    np.testing.assert_allclose(table["AoP (deg)"], table["angle (deg)"], atol=1e-12)
    told("sweep malus --angle 0:60:3 --out axis.csv")
    axes = found("sweep malus --angle @axis.csv")["axes"]
    assert axes["angle"] == {"unit": "deg", "values": [0.0, 30.0, 60.0]}
    told("sweep npgr026 --delta 10:20:2 --rho 5:10:2 --out points.csv")
    axes = found("sweep npgr026 --coords points.csv")["axes"]
    assert axes["delta"]["values"] == [10.0, 10.0, 20.0, 20.0]
    assert axes["rho"] == {"dimension": "point", "unit": "deg", "values": [5, 10, 5, 10]}
    (tmp_path / "points.csv").write_text("delta (deg),rho (deg)\n10,0\n20,5\n", "utf-8")
    stokes = found("sweep npgr026 --coords points.csv --case 8")["detectors"]["E"]["stokes"]
    path = op.load_preset("npgr026", case="8")
    points = (("10 deg", "0 deg"), ("20 deg", "5 deg"))
    alone = [path.trace(delta=delta, rho=rho).stokes for delta, rho in points]
    np.testing.assert_allclose(stokes, alone, rtol=1e-13, atol=1e-15)


def test_blocks_of_a_store_that_are_whole_are_kept_and_damaged_ones_computed_anew(run, tmp_path):
    pytest.importorskip("xarray")
    assert run(f"{ZARR} 2")[2] == ""
    assert run(f"{ZARR} 2")[::2] == (0, "optipath: 5 of 5 blocks are in a.zarr already\n")
    chunk = tmp_path / "a.zarr" / "S0" / "3"
    content = chunk.read_bytes()
    chunk.write_bytes(content[:-1] + bytes([content[-1] ^ 1]))
    (tmp_path / "a.zarr" / "DoP" / "1").unlink()
    status, _, err = run(f"{ZARR} 2")
    damaged, kept = err.splitlines()
    assert (status, kept) == (0, "optipath: 3 of 5 blocks are in a.zarr already")
    assert damaged.startswith("optipath: 2 of 5 blocks of '")
    assert damaged.endswith("a.zarr' are damaged and computed anew")
    assert chunk.read_bytes() == content
    (tmp_path / "a.zarr" / "blocks" / ".zattrs").write_text("[")
    status, _, err = run(f"{ZARR} 2")
    assert (status, len(err.splitlines())) == (2, 1)
    assert "the metadata of the store" in err


def test_an_interrupt_keeps_what_is_done_and_the_same_command_goes_on(run, monkeypatch):
    pytest.importorskip("xarray")
    from optipath.sweeps import stored  # noqa: PLC0415 - an extra

    def interrupted_at(count):
        def computed(number, *given):
            if number == count:
                raise KeyboardInterrupt
            return compute(number, *given)

        return computed

    compute, numbers = stored.compute_block, []
    for form, count, kept in (("nc", 1, "1 of 4 blocks is in .a.nc.blocks"), ("zarr", 2, KEEPABLE)):
        monkeypatch.setattr(stored, "compute_block", interrupted_at(count))
        status, _, err = run(f"{ZARR} 3".replace("zarr", form))
        told = f"optipath: {kept}; the same command goes on from there\n"
        assert (status, err) == (130, f"{told}optipath: interrupted\n")
    monkeypatch.setattr(stored, "compute_block", lambda *a: numbers.append(a[0]) or compute(*a))
    assert run(f"{ZARR} 3")[2] == f"optipath: {KEEPABLE} already\n"
    assert numbers == [2, 3]


def test_nothing_is_overwritten_and_no_table_there_in_part(run, refused, tmp_path, monkeypatch):
    pytest.importorskip("xarray")
    for name in ("a.csv", "a.json", "a.nc", "a.zarr"):
        (tmp_path / name).write_text("mine", "utf-8")
        assert name in refused(f"sweep malus --angle 0:90:3 --out {name}")
        assert (tmp_path / name).read_text("utf-8") == "mine"
        (tmp_path / name).unlink()
        assert not [*tmp_path.iterdir()]
    broken = Mock(side_effect=KeyboardInterrupt)
    monkeypatch.setattr("optipath.light.quantities.LightQuantity.shown_of", broken)
    assert run("sweep malus --angle 0:90:3 --out a.csv")[0] == 130
    assert not [*tmp_path.iterdir()]


def test_all_that_is_wrong_with_options_values_and_cells_is_told(refused, run, tmp_path):
    wrong = "--out a.txt --chunks 0 --zip delta"
    sentences = refused(f"sweep npgr026 {wrong} --delta 0:95:3 --phi 95", lines=6)
    for part in (
        "'a.txt' has no ending of a sweep; write 'a.csv', .json, .nc or .zarr",
        "--chunks belongs to a sweep that is written by blocks",
        "--zip 'delta' names fewer than two",
        "'delta' is 95 deg at 2",
        "'phi' is 95 deg,",
    ):
        assert part in sentences
    for word in ("light,between,eye", "@places.csv", "light:eye:2"):
        fault = refused("sweep npgr026 --delta 0:90:3 --place", word)
        assert f"place '{word}' is unknown" in fault
    for text in ("nan", "10, nan, 30"):
        err = run("sweep npgr026 --delta", text)[2]
        assert "cannot be 'nan', which is not finite; give an angle such as '45 deg'" in err
        assert "word" not in err
    (tmp_path / "a.csv").write_text("delta (deg)\n10\nnan\n30\n", "utf-8")
    err = run("sweep npgr026 --delta @a.csv")[2]
    assert err.startswith("optipath: a.csv: parameter 'delta' cannot be 'nan'")


def own(text):
    """Write a path of one's own; the name of its file."""
    Path("own.toml").write_text(text, "utf-8")
    return "own.toml"


def rows_of(table):
    """The rows of a printed table, a list of words each."""
    return [
        [word.strip() for word in line.strip("│").split("│")]
        for line in table.splitlines()
        if line.startswith("│")
    ]


def test_cases_are_rows_with_what_was_published_and_objects_of_json(run, found):
    out = run("run npgr026 --case all")[1]
    heads = [word for case in range(1, 10) for word in (str(case), f"{case}, published")]
    assert [row[0] for row in rows_of(out)] == heads
    assert ["8", "E", "19.1245", "10.9873", "-13.0076", "-8.70795"] in rows_of(out)
    assert "note on cases 4, 5 and 6: The published table prints" in out
    out = run("run npgr026 --case 7 --case 1 --case 7")[1]
    assert [row[0] for row in rows_of(out)] == ["7", "7, published", "1", "1, published"]
    out = run("run glass-slab --case all")[1]
    assert {row[1] for row in rows_of(out)} == {"transmitted", "reflected"}
    path = op.load_preset("malus")
    path.cases = {"only": op.Case({"angle": "60 deg"})}
    out = run(f"run {own(path.to_toml())} --case all")[1]
    assert ", 1 case:" in " ".join(out.split())
    # Values that are given hold in every case.
    line = "run npgr026 --case 1 --case 7 --delta 20"
    assert [row[0] for row in rows_of(run(line)[1])] == ["1", "7"]
    cases = found(line)["cases"]
    assert {case: each["parameters"]["delta"] for case, each in cases.items()} == {"1": 20, "7": 20}
    every = found("run npgr026 --case all")
    assert list(every) == ["preset", "cases"]
    assert list(every["cases"]) == [str(case) for case in range(1, 10)]
    for case in ("1", "7"):
        assert every["cases"][case] == found(f"run npgr026 --case {case}")
    light = found("polarization npgr026 --case all")["cases"]["7"]["detectors"]["E"]
    assert light["exact"] == pytest.approx(33.9959, abs=1e-4)


def test_wrong_cases_and_ranges_and_commands_about_one_of_each_are_told(refused):
    first, *faults = refused("run npgr026 --case 10 --case 1 --case 11", lines=3).splitlines()
    assert first == "2 faults:"
    assert "case '10' is unknown" in faults[0]
    assert "case '11' is unknown" in faults[1]
    file = own((op.Source() >> op.Detector()).to_toml())
    assert refused(f"run {file} --case all") == f"preset '{file}' has no cases; leave --case out"
    faults = refused("run npgr026 --delta 0:95:3 --phi 95 --rho 0:9:0 --n1 nan:1:2", lines=5)
    for part in (
        "'delta' is 95 deg at 2",
        "'phi' is 95 deg,",
        "'0' of '0:9:0' is no count",
        "'nan'",
    ):
        assert part in faults
    for command in ("explain", "bench", "chart", "show"):
        for cases in ("--case all", "--case 1 --case 3"):
            told = f"{command} takes one case; there are: 1, 2, 3, 4, 5, 6, 7, 8, 9"
            assert refused(f"{command} npgr026 {cases}") == told
    for command in ("explain", "polarization", "bench", "chart"):
        told = refused(f"{command} malus --angle 0:90:3")
        assert told.startswith("--angle is given several values, '0:90:3'; give one")


def test_what_was_published_and_notes_are_of_the_values_of_a_case_which_stay_open(run):
    out = run("show npgr026 --case 7")[1]
    assert "bound" not in out
    delta = next(line for line in out.splitlines() if "delta" in line)
    assert delta.split()[:3] == ["delta", "48", "deg"]
    for given in ("--n1 1.2 --n2 1.3", "--filter diagonal"):
        for form in ("", "--json", "--case 5"):
            status, out, _ = run(f"run npgr026 --case 4 {given} {form}")
            assert status == 0
            assert "published" not in out
            assert "note" not in out
    text = op.load_preset("malus").to_toml() + (
        '[cases.several]\nvalues = { angle = ["30 deg", "60 deg"] }\n'
        "published = { eye = [0.25, 0.125, 0, 0] }\n"
    )
    out = run(f"run {own(text)} --case several")[1]
    assert ["published", "0.25", "0.125", "0", "0"] in rows_of(out)


def test_a_fault_of_some_cases_names_them_and_one_of_all_does_not(run, refused):
    path = op.Source() >> op.Interface(1.5, 3 * op.Parameter("theta")) >> op.Detector()
    for case, degrees in {"flat": 10, "steep": 40, "back": 40, "other": 50}.items():
        path.cases[case] = op.Case({"theta": f"{degrees} deg"})
    file = own(path.to_toml())
    for command in ("run", "polarization"):
        first, steep, other = refused(f"{command} {file} --case all", lines=3).splitlines()
        assert first == "2 faults:"
        assert steep.startswith("- cases steep and back: parameter 'theta'")
        assert other.startswith("- case other: parameter 'theta'")
        assert "120 deg" in steep
        assert "150 deg" in other
    one, several = (run(f"run npgr026 --case {case} --delta 100")[2] for case in ("1", "all"))
    assert several == one
    assert "100 deg" in one


def test_each_way_of_writing_several_values_gives_malus_law(found, tmp_path):
    (tmp_path / "angles.csv").write_text("angle (deg)\n0\n30\n60\n", "utf-8")
    for text in ("0:60:3", "0, 30, 60", "0 deg:60 deg:3", "0,30,60", "@angles.csv"):
        batch = found("run malus --angle", text)
        intensities = [stokes[0] for stokes in batch["detectors"]["eye"]["stokes"]]
        assert intensities == pytest.approx([0.5, 0.375, 0.125], abs=1e-15)
        assert batch["axes"] == {"angle": {"unit": "deg", "values": [0.0, 30.0, 60.0]}}
        assert "angle" not in batch["parameters"]
    # Wavelengths have the unit in which they are given, and words are values.
    spectrum = found("run copper-gold-spectrum --wavelength '400 nm:700 nm:3'")
    assert spectrum["axes"]["wavelength"] == {"unit": "nm", "values": [400.0, 550.0, 700.0]}
    stokes = found("run npgr026 --filter 'none, horizontal'")["detectors"]["E"]["stokes"]
    path = op.load_preset("npgr026")
    alone = [path.trace(filter=word).stokes for word in ("none", "horizontal")]
    np.testing.assert_allclose(stokes, alone, rtol=1e-14, atol=1e-17)


def test_several_ranges_are_an_outer_product_and_arrays_take_none_besides(found, run, refused):
    batch = found("run npgr026 --rho 0:20:2 --delta 10:50:3")
    assert list(batch["axes"]) == ["rho", "delta"]
    stokes = np.array(batch["detectors"]["E"]["stokes"])
    assert stokes.shape == (2, 3, 4)
    alone = op.load_preset("npgr026").trace(rho="20 deg", delta="30 deg").stokes
    np.testing.assert_allclose(stokes[1, 1], alone, rtol=1e-14, atol=1e-17)
    # What a case says of an axis gives way to it.
    batch = found("run npgr026 --case 8 --delta 10:48:2")
    assert batch["parameters"]["rho"] == 34.0
    assert "published" not in batch["detectors"]["E"]
    alone = op.load_preset("npgr026", case="8").trace(delta="10 deg").stokes
    np.testing.assert_allclose(batch["detectors"]["E"]["stokes"][0], alone, rtol=1e-14)
    text = op.load_preset("malus").to_toml()
    file = own(text.replace('default = "30 deg"', 'default = ["0 deg", "30 deg"]'))
    fault = "parameter 'angle' has several values in the file; give one by --angle"
    assert refused(f"run {file} --intensity 1:2:2") == fault
    assert run(f"run {file} --intensity 1:2:2 --angle 0")[0] == 0


def test_the_table_has_the_values_of_the_axes(run):
    status, out, _ = run("run malus --angle 0:90:3 --intensity 1:2:2")
    lines = [line.split() for line in out.splitlines()]
    assert status == 0
    assert ["angle", "(deg)", "intensity", "S0", "S1", "S2", "S3"] in lines
    assert ["45", "2", "0.5", "0", "0.5", "0"] in lines
    assert ["90", "1", "0", "0", "0", "0"] in lines
    out = run("run npgr026 --case 7 --case 8 --delta 10:20:2")[1]
    assert "7 delta 10 deg" in out
    assert "8 delta 20 deg" in out
    assert "published" not in out
    out = run("run malus --angle 0:90:1001")[1]
    assert "801 more" in out
    assert "0 .. 90 deg, 1,001 values" in out
    assert len(out.splitlines()) < 220
