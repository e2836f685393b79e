"""Axes on which nothing depends: in a Dataset, in stores, and at the command line."""

import csv
import json

import numpy as np
import pytest

import optipath as op
from optipath.cli import main
from optipath.values.axis_texts import IdleValues
from tables import rows

WAVELENGTHS = np.linspace(400e-9, 700e-9, 4)
DELTA = np.linspace(0.1, 1.4, 5)
GIVEN = ("--wavelength", "400 nm:700 nm:4")


@pytest.fixture
def idle():
    return IdleValues(WAVELENGTHS * 1e9, "nm", WAVELENGTHS)


def assert_same_along(found, alone):
    assert dict(found.sizes) == {**alone.sizes, "wavelength": 4}
    for name, each in alone.data_vars.items():
        along = found[name].transpose("wavelength", *each.dims)
        assert all(one.to_numpy().tobytes() == each.to_numpy().tobytes() for one in along)


@pytest.fixture
def path():
    pytest.importorskip("xarray")
    return op.load_preset("npgr026")


@rows("first", [True, False])
@rows("chunks", [None, 2, {"wavelength": 1}])
def test_all_is_the_same_along_an_idle_axis_to_the_last_bit(first, chunks, path, idle):
    axes = {"wavelength": idle} if first else {}
    axes |= {"delta": DELTA, "filter": np.array([0.3, 1.5]), "wavelength": idle}
    found = path.sweep(**axes, chunks=chunks)
    assert list(found.sizes)[0 if first else -1] == "wavelength"
    assert found.wavelength.attrs == {"long_name": "nothing depends on it", "units": "nm"}
    assert_same_along(found, path.sweep(delta=DELTA, filter=np.array([0.3, 1.5])))


def test_parts_of_variables_are_the_same_along_it(path, idle):
    found = path.sweep(wavelength=idle, delta=DELTA)
    alone = path.sweep(delta=DELTA)
    assert found.DoP[1:3, ::2].to_numpy().tolist() == [alone.DoP[::2].to_numpy().tolist()] * 2
    assert float(found.AoP[3, 4]) == float(alone.AoP[4])
    assert found.DoLP[:0].shape == (0, 5)


def test_light_that_is_noise_is_noise_all_along(idle):
    pytest.importorskip("xarray")
    path = op.load_preset("malus")
    angle = np.radians([30.0, 90.0])
    assert_same_along(path.sweep(wavelength=idle, angle=angle), path.sweep(angle=angle))
    assert np.isnan(path.sweep(wavelength=idle, angle=angle).DoP[:, 1]).all()


def test_an_idle_axis_alone_has_one_light(path, idle):
    assert_same_along(path.sweep(wavelength=idle), path.sweep())
    assert_same_along(path.sweep(wavelength=idle, chunks=3).compute(), path.sweep())


def test_an_idle_axis_varies_together_with_another(path, idle):
    found = path.sweep(delta=DELTA[:4], wavelength=idle, zip=("delta", "wavelength"))
    assert dict(found.sizes) == {"delta_wavelength": 4}
    assert found.S0.to_numpy().tolist() == path.sweep(delta=DELTA[:4]).S0.to_numpy().tolist()


def test_it_is_run_at_one_value(path, idle, monkeypatch):
    plan = path.compose()
    shapes = []
    lights = type(plan.answers).lights

    def seen(answers, given):
        shapes.append(np.broadcast_shapes(*map(np.shape, given.values())))
        return lights(answers, given)

    monkeypatch.setattr(type(plan.answers), "lights", seen)
    path.sweep(delta=DELTA, wavelength=idle)
    assert shapes == [(5, 1)]


def test_values_of_no_axis_stay_refused(path):
    with pytest.raises(op.OptipathError, match="parameter 'wavelength' is unknown"):
        path.sweep(delta=DELTA, wavelength=WAVELENGTHS)


def test_the_command_line_writes_it_in_every_form(tmp_path, monkeypatch, capsys):
    xarray = pytest.importorskip("xarray")
    monkeypatch.chdir(tmp_path)
    given = ["sweep", "npgr026", "--delta", "10:80:3", *GIVEN]
    alone = op.load_preset("npgr026").sweep(delta="10 deg:80 deg:3")
    told = "nothing in 'npgr026' depends on the wavelength; all is the same along it"
    for form in ("json", "csv", "nc", "zarr"):
        by = ["--scheduler", "synchronous"] if form in ("nc", "zarr") else []
        assert main([*given, "--out", f"a.{form}", *by]) == 0
        captured = capsys.readouterr()
        assert captured.err == f"optipath: {told}\n"
        assert captured.out == f"wrote a.{form}: 12 points (delta 3, wavelength 4)\n"
    with xarray.open_zarr("a.zarr") as found:
        assert_same_along(found.load(), alone)
        assert found.wavelength.to_numpy().tolist() == [400.0, 500.0, 600.0, 700.0]
    with xarray.open_dataset("a.nc") as found:
        assert_same_along(found.load(), alone)
    laid_out = np.repeat(alone.S0.to_numpy(), 4).tolist()
    with (tmp_path / "a.csv").open(encoding="utf-8") as file:
        assert [float(row["S0"]) for row in csv.DictReader(file)] == laid_out
    found = json.loads((tmp_path / "a.json").read_bytes())
    assert found["axes"]["wavelength"] == {"unit": "nm", "values": [400.0, 500.0, 600.0, 700.0]}
    stokes = np.array(found["detectors"]["E"]["stokes"])
    assert stokes[..., 0].ravel().tolist() == laid_out


def test_tables_have_it_too(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    assert main(["sweep", "malus", "--angle", "0:90:3", *GIVEN]) == 0
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert ["45", *["0.25"] * 4] in lines
    assert main(["run", "malus", *GIVEN]) == 0
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    light = [line for line in lines if line[:1] and line[0] in ("400", "500", "600", "700")]
    assert len(light) == 4
    assert len({*map(tuple, [line[1:] for line in light])}) == 1


def test_a_single_wavelength_is_no_axis(capsys):
    assert main(["run", "malus", "--wavelength", "500 nm", "--json"]) == 0
    captured = capsys.readouterr()
    assert "axes" not in json.loads(captured.out)
    assert "--wavelength is not used" in captured.err


def test_a_command_that_takes_one_value_says_so(capsys):
    assert main(["explain", "malus", *GIVEN]) == 2
    assert "--wavelength is given several values" in capsys.readouterr().err


def test_a_range_of_no_wavelengths_is_refused(capsys):
    assert main(["sweep", "malus", "--wavelength", "-400 nm:700 nm:4"]) == 2
    assert "wavelength" in capsys.readouterr().err


def test_errors_that_are_allowed_are_the_same_along_it(capsys):
    given = ["npgr026", "--tolerance", "0.1", "--reads", "intensity", "--rho", "0"]
    given += ["--filter", "horizontal", "--json", "--delta"]
    for angles, shape in (("10, 20", (2, 4)), ("10", (4,))):
        assert main(["sweep", *given, angles, *GIVEN]) == 0
        found = json.loads(capsys.readouterr().out)["tolerance"]["error"]
        assert np.shape(found) == shape
        assert np.ptp(found, axis=-1).max() == 0.0
