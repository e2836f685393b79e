"""Pictures of the Dataset of a sweep."""

from importlib import reload

import numpy as np
import pytest
import xarray as xr

import optipath as op
import optipath.sweeps.sweep_pictures
from optipath.errors import OptipathError
from tables import rows

MALUS = op.load_preset("malus")
SEVEN = "0 deg:90 deg:7"
SWEEP = MALUS.sweep(angle=SEVEN, intensity=[1.0, 2.0])
ALONE = SWEEP.isel(intensity=0)
TOGETHER = MALUS.sweep(
    angle="0 deg:90 deg:3", intensity=[1.0, 2.0, 3.0], zip=("angle", "intensity")
)
SPLIT = op.PathGraph()
SPLIT.add("lamp", op.Source(op.Parameter("power", 1.0))) >> SPLIT.add("split", op.BeamSplitter())
for end, port in (("one", "reflected"), ("two", "transmitted")):
    SPLIT.add(end, op.Detector())
    SPLIT.connect(f"split.{port}", end)
POWERS = SPLIT.sweep(power=[1.0, 2.0])


def drawn(ax):
    return ax.get_lines()[0].get_xydata().T


def test_a_curve_goes_over_the_only_dimension():
    ax = SWEEP.sel(intensity=2.0).optipath.curve("s0")
    x, y = drawn(ax)
    np.testing.assert_allclose(x, np.linspace(0.0, 90.0, 7))
    np.testing.assert_allclose(y, np.cos(np.radians(x)) ** 2, atol=1e-12)
    assert ax.get_xlabel() == "angle: turn of the analyser against the polariser (°)"
    reload(optipath.sweeps.sweep_pictures)  # To register twice is no warning.
    assert ALONE.optipath.curve().get_xlabel() == ax.get_xlabel()


def test_radians_are_shown_in_degrees_and_metres_in_nanometres():
    x, _ = drawn(MALUS.sweep(angle=np.linspace(0, np.pi, 3)).optipath.curve())
    np.testing.assert_allclose(x, [0.0, 90.0, 180.0])
    path = op.load_preset("quartz-quarter-wave")
    ax = path.sweep(wavelength=np.array([500e-9, 600e-9])).optipath.curve()
    np.testing.assert_allclose(drawn(ax)[0], [500.0, 600.0])
    assert ax.get_xlabel() == "wavelength in vacuum (nm)"


def test_a_map_goes_over_two_dimensions_in_their_order():
    ax = SWEEP.optipath.map("S0")
    assert ax.get_xlabel().startswith("angle")
    values = ax.collections[0].get_array()
    assert values.shape == (2, 7)
    turned = SWEEP.optipath.map("S0", "intensity", "angle").collections[0].get_array()
    np.testing.assert_array_equal(turned, values.T)


def test_what_is_in_chunks_or_read_from_a_file_has_pictures(tmp_path):
    sweeps = MALUS.sweep(angle=SEVEN, chunks=3), MALUS.sweep(angle=SEVEN)
    one, other = (drawn(sweep.optipath.curve("DoLP")) for sweep in sweeps)
    np.testing.assert_array_equal(one, other)
    SWEEP.to_netcdf(tmp_path / "sweep.nc", engine="h5netcdf")
    with xr.open_dataset(tmp_path / "sweep.nc", engine="h5netcdf") as read:
        _, y = drawn(read.isel(intensity=0).optipath.curve())
    assert y[0] == pytest.approx(0.5)


def test_parameters_that_vary_together_and_detectors_are_asked_for_by_name():
    assert drawn(TOGETHER.optipath.curve("S0", "intensity"))[0].tolist() == [1.0, 2.0, 3.0]
    assert drawn(POWERS.optipath.curve(detector="two"))[1].tolist() == pytest.approx([0.5, 1.0])


def test_the_sphere_is_coloured_by_the_coordinate(monkeypatch):
    assert ALONE.optipath.poincare().name == "3d"
    told = {}
    monkeypatch.setattr(op.plots, "poincare", lambda *given, **by: told.update(by, given=given))
    ALONE.optipath.poincare()
    light, ax = told["given"]
    assert ax is None
    np.testing.assert_allclose(light.intensity[:2], [0.5, 0.5 * np.cos(np.radians(15)) ** 2])
    np.testing.assert_allclose(told["by"], np.linspace(0.0, 90.0, 7))
    assert told["label"] == "angle (°)"


LINEAR = MALUS.reading("linear").sweep(angle="0 deg:90 deg:3")
WORDS = op.load_preset("npgr026").sweep(filter=["none", "30 deg"])


@rows(
    "draw, told",
    [
        (SWEEP.optipath.curve, r"has 'angle' and 'intensity'; choose a value"),
        (lambda: SWEEP.optipath.curve("S0", "angel"), "coordinate 'angel' is unknown"),
        (SWEEP.isel(angle=0, intensity=0).optipath.curve, "no dimension with several values"),
        (lambda: ALONE[["S0"]].optipath.curve("DoP"), "variable 'DoP' is unknown"),
        (WORDS.optipath.curve, "has words among its values"),
        (TOGETHER.optipath.curve, "has the coordinates angle and intensity; say which"),
        (lambda: TOGETHER.optipath.map("S0", "angle"), "a picture goes over 2 dimensions"),
        (POWERS.optipath.curve, "the detectors one and two; say which"),
        (lambda: POWERS.optipath.curve(detector="three"), "detector 'three' is unknown"),
        (LINEAR.optipath.poincare, "components that are not read"),
    ],
)
def test_what_is_wrong_is_told(draw, told):
    with pytest.raises(OptipathError, match=told):
        draw()
