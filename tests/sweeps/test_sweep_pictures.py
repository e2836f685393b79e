"""Pictures of the Dataset of a sweep."""

from importlib import reload

import numpy as np
import pytest
import xarray as xr

import optipath as op
import optipath.sweeps.sweep_pictures
from optipath.errors import OptipathError
from tables import rows

SWEEP = op.load_preset("malus").sweep(angle="0 deg:90 deg:7", intensity=[1.0, 2.0])
SPLIT = op.PathGraph()
SPLIT.add("lamp", op.Source(op.Parameter("power", 1.0))) >> SPLIT.add("split", op.BeamSplitter())
SPLIT.add("one", op.Detector())
SPLIT.add("two", op.Detector())
SPLIT.connect("split.reflected", "one")
SPLIT.connect("split.transmitted", "two")


def drawn(ax):
    return ax.get_lines()[0].get_xydata().T


def test_a_curve_goes_over_the_only_dimension():
    ax = SWEEP.sel(intensity=2.0).optipath.curve("s0")
    x, y = drawn(ax)
    np.testing.assert_allclose(x, np.linspace(0.0, 90.0, 7))
    np.testing.assert_allclose(y, np.cos(np.radians(x)) ** 2, atol=1e-12)
    assert ax.get_xlabel() == "angle: turn of the analyser against the polariser (°)"


def test_radians_are_shown_in_degrees_and_metres_in_nanometres():
    x, _ = drawn(op.load_preset("malus").sweep(angle=np.linspace(0, np.pi, 3)).optipath.curve())
    np.testing.assert_allclose(x, [0.0, 90.0, 180.0])
    path = op.load_preset("quartz-quarter-wave")
    ax = path.sweep(wavelength=np.array([500e-9, 600e-9])).optipath.curve()
    np.testing.assert_allclose(drawn(ax)[0], [500.0, 600.0])
    assert ax.get_xlabel() == "wavelength in vacuum (nm)"


def test_a_map_goes_over_two_dimensions_in_their_order():
    ax = SWEEP.optipath.map("S0")
    assert ax.get_xlabel().startswith("angle")
    assert ax.collections[0].get_array().shape == (2, 7)
    turned = SWEEP.optipath.map("S0", "intensity", "angle")
    np.testing.assert_array_equal(
        turned.collections[0].get_array(), ax.collections[0].get_array().T
    )


def test_what_is_in_chunks_is_computed():
    path = op.load_preset("malus")
    chunked = path.sweep(angle="0 deg:90 deg:7", chunks=3)
    whole = path.sweep(angle="0 deg:90 deg:7")
    for one, other in zip(
        drawn(chunked.optipath.curve("DoLP")), drawn(whole.optipath.curve("DoLP")), strict=True
    ):
        np.testing.assert_array_equal(one, other)


def test_a_dataset_that_is_read_from_a_file_has_pictures(tmp_path):
    SWEEP.to_netcdf(tmp_path / "sweep.nc", engine="h5netcdf")
    with xr.open_dataset(tmp_path / "sweep.nc", engine="h5netcdf") as read:
        _, y = drawn(read.isel(intensity=0).optipath.curve())
    assert y[0] == pytest.approx(0.5)


def test_parameters_that_vary_together_are_asked_for_by_name():
    zipped = op.load_preset("malus").sweep(
        angle="0 deg:90 deg:3", intensity=[1.0, 2.0, 3.0], zip=("angle", "intensity")
    )
    with pytest.raises(OptipathError, match="has the coordinates angle and intensity; say which"):
        zipped.optipath.curve()
    assert drawn(zipped.optipath.curve("S0", "intensity"))[0].tolist() == [1.0, 2.0, 3.0]
    with pytest.raises(OptipathError, match="a picture goes over 2 dimensions"):
        zipped.optipath.map("S0", "angle")


def test_which_of_several_detectors_is_asked():
    sweep = SPLIT.sweep(power=[1.0, 2.0])
    with pytest.raises(OptipathError, match="the detectors one and two; say which"):
        sweep.optipath.curve()
    assert drawn(sweep.optipath.curve(detector="two"))[1].tolist() == pytest.approx([0.5, 1.0])
    with pytest.raises(OptipathError, match="detector 'three' is unknown"):
        sweep.optipath.curve(detector="three")


def test_the_sphere_is_coloured_by_the_coordinate(monkeypatch):
    assert SWEEP.isel(intensity=0).optipath.poincare().name == "3d"
    told = {}
    monkeypatch.setattr(op.plots, "poincare", lambda *given, **by: told.update(by, given=given))
    SWEEP.isel(intensity=0).optipath.poincare()
    light, ax = told["given"]
    assert ax is None
    np.testing.assert_allclose(light.intensity[:2], [0.5, 0.5 * np.cos(np.radians(15)) ** 2])
    np.testing.assert_allclose(told["by"], np.linspace(0.0, 90.0, 7))
    assert told["label"] == "angle (°)"
    sweep = op.load_preset("malus").reading("linear").sweep(angle="0 deg:90 deg:3")
    with pytest.raises(OptipathError, match="components that are not read"):
        sweep.optipath.poincare()


@rows(
    "draw, told",
    [
        (SWEEP.optipath.curve, r"has 'angle' and 'intensity'; choose a value"),
        (lambda: SWEEP.optipath.curve("S0", "angel"), "coordinate 'angel' is unknown"),
        (
            SWEEP.isel(angle=0, intensity=0).optipath.curve,
            "no dimension with several values",
        ),
        (
            lambda: SWEEP[["S0"]].isel(intensity=0).optipath.curve("DoP"),
            "variable 'DoP' is unknown",
        ),
        (
            op.load_preset("npgr026").sweep(filter=["none", "30 deg"]).optipath.curve,
            "has words among its values",
        ),
    ],
)
def test_what_is_wrong_is_told(draw, told):
    with pytest.raises(OptipathError, match=told):
        draw()


def test_to_register_twice_is_no_warning():
    reload(optipath.sweeps.sweep_pictures)
    assert SWEEP.isel(intensity=0).optipath.curve().get_xlabel()
