"""optipath sweep: tables, files of every form, and how names and endings are written."""

import os

import numpy as np
import pytest

import optipath as op
from optipath.cli.block_bar import block_bar
from optipath.sweeps.labels.table_texts import regions
from tables import rows

ZARR = "sweep malus --angle 0:90:10 --out a.zarr --scheduler synchronous --chunks"


def test_one_axis_is_a_table_two_are_a_plane_and_large_grids_are_summed_up(told, run):
    out = told("sweep malus --angle 0:90:3")
    lines = [line.split() for line in out.splitlines()]
    header = ["angle", "(deg)", "S0", "S1", "S2", "S3", "DoP", "DoLP", "AoP", "(deg)"]
    assert any(line[: len(header)] == header for line in lines)
    assert any(line[:8] == ["45", "0.25", "0", "0.25", "0", "1", "1", "45"] for line in lines)
    assert any(line[:7] == ["90", "0", "0", "0", "0", "-", "-"] for line in lines)
    assert all(len(line) <= 80 for line in out.splitlines())
    out = run("sweep malus --angle 0:90:3 --intensity 1:2:2")[1]
    lines = [line.split() for line in out.splitlines()]
    assert ["angle", "(deg)", "\\", "intensity", "1", "2"] in lines
    assert ["45", "0.25", "0.5"] in lines
    assert "--out FILE" in out
    out = run("sweep malus --angle 0:90:31 --intensity 1:4:31")[1]
    assert out.split("light at eye")[1].split()[:2] == ["0", "2"]


def test_json_has_axes_units_and_all_values(found):
    grid = found("sweep malus --angle 0:60:3 --intensity '1, 2'")
    assert grid["axes"]["angle"] == {"unit": "deg", "values": [0.0, 30.0, 60.0]}
    stokes = np.array(grid["detectors"]["eye"]["stokes"])
    np.testing.assert_allclose(stokes[..., 0], [[0.5, 1], [0.375, 0.75], [0.125, 0.25]], atol=1e-15)
    row = found("sweep malus --angle 0:60:3 --intensity 1:3:3 --zip angle,intensity")
    intensities = [stokes[0] for stokes in row["detectors"]["eye"]["stokes"]]
    assert intensities == pytest.approx([0.5, 0.75, 0.375], abs=1e-15)
    assert row["axes"]["angle"]["dimension"] == row["axes"]["intensity"]["dimension"]


def test_a_table_has_a_line_for_each_point_and_units_in_its_headings(told, tmp_path):
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


def test_a_table_is_read_as_an_axis_or_as_points_whose_columns_vary_together(run, found, tmp_path):
    run("sweep malus --angle 0:60:3 --out result.csv")
    axes = found("sweep malus --angle @result.csv")["axes"]
    assert axes["angle"] == {"unit": "deg", "values": [0.0, 30.0, 60.0]}
    run("sweep npgr026 --delta 10:20:2 --rho 5:10:2 --out points.csv")
    axes = found("sweep npgr026 --coords points.csv")["axes"]
    assert axes["delta"]["values"] == [10.0, 10.0, 20.0, 20.0]
    assert axes["rho"] == {"dimension": "point", "unit": "deg", "values": [5, 10, 5, 10]}
    (tmp_path / "points.csv").write_text("delta (deg),rho (deg)\n10,0\n20,5\n", "utf-8")
    stokes = found("sweep npgr026 --coords points.csv --case 8")["detectors"]["E"]["stokes"]
    path = op.load_preset("npgr026", case="8")
    points = (("10 deg", "0 deg"), ("20 deg", "5 deg"))
    alone = [path.trace(delta=delta, rho=rho).stokes for delta, rho in points]
    np.testing.assert_allclose(stokes, alone, rtol=1e-13, atol=1e-15)


@rows("name", ["result.zarr", "result.nc"])
def test_stores_have_the_axes_in_the_units_given(name, run):
    xarray = pytest.importorskip("xarray")
    given = f"--delta 0:90:4 --filter 0:90:3 --out {name} --scheduler synchronous"
    status, out, _ = run(f"sweep npgr026 {given}")
    assert (status, out) == (0, f"wrote {name}: 12 points (delta 4, filter 3)\n")
    opened = xarray.open_zarr(name) if name.endswith(".zarr") else xarray.open_dataset(name)
    with opened as dataset:
        assert dict(dataset.sizes) == {"delta": 4, "filter": 3}
        assert dataset.delta.attrs["units"] == "deg"
        assert dataset.delta.values.tolist() == [0.0, 30.0, 60.0, 90.0]
        alone = op.load_preset("npgr026").trace(delta="30 deg", filter="45 deg").stokes
        found = [float(dataset[f"S{place}"][1, 1]) for place in range(4)]
    np.testing.assert_allclose(found, alone, rtol=1e-13, atol=1e-16)


def test_blocks_of_a_store_that_are_whole_are_kept_and_damaged_ones_computed_anew(run, tmp_path):
    pytest.importorskip("xarray")
    assert run(f"{ZARR} 2")[2] == ""
    assert run(f"{ZARR} 2")[::2] == (0, "optipath: 5 of 5 blocks are in a.zarr already\n")
    chunk = tmp_path / "a.zarr" / "S0" / "3"
    content = chunk.read_bytes()
    chunk.write_bytes(content[:-1] + bytes([content[-1] ^ 1]))
    (tmp_path / "a.zarr" / "DoP" / "1").unlink()
    os.mkfifo(tmp_path / "a.zarr" / "DoP" / "1")
    status, _, err = run(f"{ZARR} 2")
    damaged, kept = err.splitlines()
    assert status == 0
    assert damaged.startswith("optipath: blocks of '")
    assert damaged.endswith("a.zarr' are damaged and computed anew: 1, 3")
    assert kept == "optipath: 3 of 5 blocks are in a.zarr already"
    assert chunk.read_bytes() == content
    (tmp_path / "a.zarr" / ".zattrs").write_text("[" * 100_000)
    status, _, err = run(f"{ZARR} 2")
    assert (status, len(err.splitlines())) == (2, 1)
    assert ".zattrs' is damaged or gone" in err


def test_an_interrupt_keeps_what_is_done_and_the_same_command_goes_on(run, monkeypatch):
    pytest.importorskip("xarray")
    from optipath.sweeps.kept.sweep_block import SweepBlock  # noqa: PLC0415 - an extra

    compute = SweepBlock.compute

    def interrupted(job, number):
        if number == 2:
            raise KeyboardInterrupt
        return compute(job, number)

    with monkeypatch.context() as patch:
        patch.setattr(SweepBlock, "compute", interrupted)
        status, _, err = run(f"{ZARR} 3")
    told = "optipath: 2 of 4 blocks are in a.zarr; the same command goes on from there\n"
    assert (status, err) == (130, f"{told}optipath: interrupted\n")
    numbers = []
    monkeypatch.setattr(SweepBlock, "compute", lambda *a: numbers.append(a[1]) or compute(*a))
    assert run(f"{ZARR} 3")[2] == "optipath: 2 of 4 blocks are in a.zarr already\n"
    assert numbers == [2, 3]


def test_nothing_that_is_there_is_overwritten_and_no_table_is_there_in_part(
    run, refused, tmp_path, monkeypatch
):
    pytest.importorskip("xarray")
    for name in ("a.csv", "a.json", "a.nc", "a.zarr"):
        (tmp_path / name).write_text("mine", "utf-8")
        assert name in refused(f"sweep malus --angle 0:90:3 --out {name}")
        assert (tmp_path / name).read_text("utf-8") == "mine"
        (tmp_path / name).unlink()
        assert not [*tmp_path.iterdir()]

    def broken(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("optipath.cli.sweep_files.table_columns", broken)
    assert run("sweep malus --angle 0:90:3 --out a.csv")[0] == 130
    assert not [*tmp_path.iterdir()]


def test_all_that_is_wrong_with_options_and_values_is_told_at_once(refused):
    wrong = "--out a.txt --chunks 0 --scheduler hreads --zip delta --coords none.csv"
    sentences = refused(f"sweep npgr026 {wrong} --delta 0:95:3 --phi 95", lines=9)
    for part in (
        "'a.txt' has no ending of a sweep; write 'a.csv', .json, .nc or .zarr",
        "--chunks '0' is no size",
        "--scheduler 'hreads' is unknown",
        "--zip 'delta' names fewer than two",
        "none.csv: there is no such file",
        "'delta' is 95 deg at 2",
        "'phi' is 95 deg,",
    ):
        assert part in sentences


@rows("most", [1, 2, 5, 6, 7, 100])
def test_regions_cover_a_grid_in_the_order_of_its_points(most):
    points = np.arange(2 * 3 * 4).reshape(2, 3, 4)
    parts = [points[region].ravel() for region in regions(points.shape, most)]
    assert all(len(part) <= most for part in parts)
    np.testing.assert_array_equal(np.concatenate(parts), points.ravel())


def test_endings_and_names_are_taken_as_they_are_written(run, found, tmp_path):
    assert run("sweep malus --angle 0:90:3 --out a.csv/")[0] == 0
    assert (tmp_path / "a.csv").read_text("utf-8").startswith("angle (deg),S0,")
    for names in ("sky-angle,theta", "sky_angle,theta", "--sky-angle, --theta"):
        given = "--sky-angle 0:30:3 --theta 0:60:3 --zip"
        axes = found(f"sweep sky-and-window {given}", names)["axes"]
        assert {axis["dimension"] for axis in axes.values()} == {"sky_angle_theta"}


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


def test_faults_of_values_and_of_cells_are_told_as_what_they_are(run, refused, tmp_path):
    for word in ("light,between,eye", "@places.csv", "light:eye:2"):
        several = f"--place takes one word of light, between and eye, and '{word}' is several"
        fault = refused("sweep npgr026 --delta 0:90:3 --place", word)
        assert fault == f"{several}; give one, and write a command for each"
    for text in ("nan", "NaN", "10, nan, 30"):
        err = run("sweep npgr026 --delta", text)[2]
        cures = err.count("cannot be 'nan', which is not finite; give an angle such as '45 deg'")
        assert cures + err.count("cannot be 'NaN', which is not finite")
        assert "word" not in err
    (tmp_path / "a.csv").write_text("delta (deg)\n10\nnan\n30\n", "utf-8")
    err = run("sweep npgr026 --delta @a.csv")[2]
    assert err.startswith("optipath: a.csv: parameter 'delta' cannot be 'nan'")
    (tmp_path / "a.csv").write_text("delta\n10\n20\n30\n", "utf-8")
    unit = "column 'delta' has no unit; write its name as 'delta (deg)' if that is its unit"
    assert refused("sweep npgr026 --delta @a.csv") == f"a.csv: {unit}"
