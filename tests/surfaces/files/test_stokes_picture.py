import numpy as np
import pytest

import optipath as op
from hemispheres import measured

OpenEXR = pytest.importorskip("OpenEXR")


@pytest.fixture(scope="module")
def metal():
    layers = [(op.Material.tabulated(["400 nm", "700 nm"], [0.2, 1.5], [2.0, 3.0]), 0.3)]
    return measured(layers, wavelengths=["400 nm", "550.25 nm"])


def read(file):
    found = OpenEXR.File(str(file), separate_channels=True)
    return {name: each.pixels for name, each in found.channels().items()}, found.header()


def radiances(hemisphere, source, side=0):
    """Of an irradiance of 1: the share of the light, per steradian and over the cosine."""
    light = hemisphere.mueller[0][side] @ source
    sensor = hemisphere.sensor
    area = sensor.solid_angle * np.cos(sensor.theta)
    return np.nan_to_num(light / area[..., np.newaxis, np.newaxis])


def test_a_channel_is_a_stokes_component_of_a_wavelength(metal, tmp_path):
    metal.save(tmp_path / "a.exr", source=[2.0, 1.0, 0.0, 1.0])
    channels, _ = read(tmp_path / "a.exr")
    expected = radiances(metal, [1.0, 0.5, 0.0, 0.5])
    for place, name in enumerate(["400,000000nm", "550,250000nm"]):
        for each in range(4):
            found = channels[f"S{each}.{name}"]
            assert found.dtype == np.float32
            # The first row of a picture is its uppermost.
            assert np.array_equal(found, expected[::-1, :, place, each].astype(np.float32))
    assert channels["Y"] == pytest.approx(expected[::-1, :, :, 0].mean(-1), rel=1e-6)
    assert len(channels) == 9


def test_the_header_has_what_the_spectral_layout_asks_for_and_the_frames(metal, tmp_path):
    metal.save(tmp_path / "a.exr")
    _, header = read(tmp_path / "a.exr")
    assert header["spectralLayoutVersion"] == "1.0"
    assert header["emissiveUnits"] == "W.m^-2.sr^-1"
    assert header["polarisationHandedness"] == "right"
    assert "counter-clockwise to who looks at the source" in header["handedness"]
    assert header["source"] == "1.0 0.0 0.0 0.0"
    assert header["frame"] == metal.dataset.attrs["frame"]
    assert float(header["incidence"]) == metal.dataset.attrs["incidence"]
    assert header["sample"] == metal.dataset.attrs["sample"]


def test_without_wavelengths_channels_are_grey_and_one_side_is_asked_for(tmp_path):
    glass = measured([(1.5, 0.2)])
    with pytest.raises(op.SurfaceError, match=r"give side='reflected' or side='transmitted'"):
        glass.save(tmp_path / "a.exr")
    glass.save(tmp_path / "a.exr", side="transmitted")
    channels, header = read(tmp_path / "a.exr")
    assert sorted(channels) == ["S0.Y", "S1.Y", "S2.Y", "S3.Y", "Y"]
    expected = radiances(glass, [1.0, 0.0, 0.0, 0.0], side=1)[::-1, :, 0]
    assert np.array_equal(channels["S1.Y"], expected[..., 1].astype(np.float32))
    assert header["side"] == "transmitted"


def test_a_picture_of_the_whole_hemisphere_adds_up_to_what_is_reflected(tmp_path):
    mirror = measured([(1j, 0.3)], sensor=32)
    mirror.save(tmp_path / "a.exr")
    channels, _ = read(tmp_path / "a.exr")
    sensor = mirror.sensor
    area = (sensor.solid_angle * np.cos(sensor.theta))[::-1]
    inside = mirror.parts.sums[..., -1].sum(0)[0, ..., 0][~np.isnan(sensor.theta)].sum() / 8192
    assert np.nansum(channels["Y"] * area) == pytest.approx(inside, rel=1e-5)
    assert inside > 0.99


def test_a_source_that_is_no_light_and_a_side_that_is_none_are_told(metal):
    with pytest.raises(op.SurfaceError, match=r"source is .* polarised by more than 100 %"):
        metal.save("a.exr", source=[1, 1, 1, 0])
    with pytest.raises(op.SurfaceError, match=r"nothing goes through an opaque sample"):
        metal.save("a.exr", side="transmitted")


def test_a_picture_takes_the_place_of_another_whole(metal, tmp_path, monkeypatch):
    metal.save(tmp_path / "a.exr")
    before = (tmp_path / "a.exr").read_bytes()

    class Failing:
        ZIP_COMPRESSION, scanlineimage, File = 1, 1, None

    monkeypatch.setitem(__import__("sys").modules, "OpenEXR", Failing)
    with pytest.raises(TypeError):
        metal.save(tmp_path / "a.exr", source=[1, 1, 0, 0])
    assert (tmp_path / "a.exr").read_bytes() == before
    assert len([*tmp_path.iterdir()]) == 1
