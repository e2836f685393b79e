import numpy as np
import pytest

import optipath as op

pytest.importorskip("numba")
pytest.importorskip("xarray")


@pytest.fixture(scope="module")
def glass():
    sample = op.Sample([(1.5, (0.3, 0.2))], cells=200, surfaces=2, description="ground")
    return op.measure(sample, "30 deg", 5000, sensor=8, azimuth="90 deg", seed=7)


def test_everything_has_a_name_and_a_unit(glass):
    data = glass.dataset
    for name in [*data, "x", "y", "wavelength", "theta", "phi"]:
        assert data[name].attrs["long_name"]
        assert data[name].attrs["units"] in ("1", "sr", "rad", "m")
    assert data.side.values.tolist() == ["reflected", "transmitted"]
    assert data["in"].values.tolist() == data["out"].values.tolist() == ["S0", "S1", "S2", "S3"]
    assert np.isnan(data.wavelength.values).tolist() == [True]


def test_dimensions_are_those_that_are_told(glass):
    pixels = ("side", "y", "x", "wavelength")
    expected = {
        "mueller": (*pixels, "out", "in"),
        "scalar": pixels,
        "difference": pixels,
        "count": pixels[:3],
        "solid_angle": ("y", "x"),
    }
    data = glass.dataset
    for name, dims in expected.items():
        assert data[name].dims == dims
        if f"{name}_se" in data:
            assert data[f"{name}_se"].dims == dims
    assert {*data} == {*expected, "mueller_se", "scalar_se", "difference_se"}
    assert data.theta.dims == data.phi.dims == ("y", "x")


def test_attributes_say_what_was_measured(glass):
    told = glass.dataset.attrs
    assert told["incidence"] == pytest.approx(np.pi / 6.0)
    assert told["azimuth"] == pytest.approx(np.pi / 2.0)
    assert (told["photons"], told["seed"], told["events"]) == (5000, 7, "any number")
    assert 'description = "ground"' in told["sample"]
    assert "perpendicular" in told["frame"]


def test_samples_that_have_no_file_are_told_in_their_place():
    heights = op.surfaces.HeightField(np.eye(4), 4.0, periodic=True)
    data = op.measure(op.Sample([(1j, heights)]), "30 deg", 100, sensor=4).dataset
    assert "no form in TOML" in data.attrs["sample"]


@pytest.mark.parametrize("side", ["below", 0])
def test_a_side_that_there_is_not_is_told(glass, side):
    assert glass.side("transmitted") == 1
    with pytest.raises(op.SurfaceError, match="give reflected or transmitted"):
        glass.side(side)


def test_opaque_samples_have_no_transmitted_side():
    found = op.measure(op.Sample([(1j, 0.0)]), "30 deg", 100, sensor=4)
    with pytest.raises(op.SurfaceError, match="nothing goes through an opaque sample"):
        found.side("transmitted")
