"""Hemispheres in files, with samples that are in none, and as pictures."""

import json
import sys

import numpy as np
import pytest

import optipath as op
from optipath.surfaces import HeightField
from tables import rows, slow_except

pytest.importorskip("numba")
pytest.importorskip("zarr")
pytest.importorskip("h5netcdf")

xr = pytest.importorskip("xarray")
FORMS, PHOTONS = [".zarr", ".nc"], 8192


def measured(layers, incidence="40 deg", sensor=12, **more):
    sample = op.Sample(layers, cells=200, surfaces=2)
    return op.measure(sample, incidence, PHOTONS, sensor=sensor, **more)


def kept(hemisphere, file):
    hemisphere.save(file)
    return op.load_hemisphere(file)


def same_bits(first, second):
    """Whether two hemispheres are one, to the last bit of all that follows from them."""
    one, other = first.seen.beam, second.seen.beam
    return (
        [(each.dtype, each.tobytes()) for each in first.parts]
        == [(each.dtype, each.tobytes()) for each in second.parts]
        and np.array_equal(first.wavelengths, second.wavelengths, equal_nan=True)
        and first.dataset.identical(second.dataset)
        and first.sensor == second.sensor
        and (one.states, one.cos, one.sin) == (other.states, other.cos, other.sin)
    )


@pytest.fixture(scope="module")
def glass():
    return measured([(1.5, 0.2), (2.0, (0.1, 0.2))], events=2, seed=2**70, azimuth="20 deg")


@pytest.fixture(scope="module")
def metal():
    layers = [(op.Material.tabulated(["400 nm", "700 nm"], [0.2, 1.5], [2.0, 3.0]), 0.3)]
    return measured(layers, wavelengths=["400 nm", "550.25 nm"])


@rows("form", FORMS)
def test_what_is_loaded_is_what_was_measured_to_the_last_bit(form, glass, metal, tmp_path):
    for name, hemisphere in {"glass": glass, "metal": metal}.items():
        again = kept(hemisphere, tmp_path / f"{name}{form}")
        assert same_bits(again, hemisphere)
        beams = again.seen.beam, hemisphere.seen.beam
        for each in ("sample", "azimuth", "seed", "most_events"):
            assert getattr(beams[0], each) == getattr(beams[1], each)
        assert again.seen.events == hemisphere.seen.events
        for one, other in zip(*(beam.indices for beam in beams), strict=True):
            assert np.array_equal(one, other)
            assert np.shape(one) == np.shape(other)
        for quantity in ("mueller", "scalar", "difference"):
            pairs = zip(getattr(again, quantity), getattr(hemisphere, quantity), strict=True)
            assert all(np.array_equal(*pair, equal_nan=True) for pair in pairs)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:direction:optipath.errors.PhotonWarning")
def test_what_follows_from_it_is_the_same_with_its_errors(metal, tmp_path):
    again = kept(metal, tmp_path / "a.nc")
    for name in ("aop", "dolp", "brdf", "adm", "mdm", "single_scattering"):
        assert getattr(again, name)().identical(getattr(metal, name)())
    first, second = (each.toward("40 deg", wavelength="400 nm").matrix for each in (metal, again))
    assert np.array_equal(first, second)
    # What was not measured is not there after loading either.
    for polarized in ("polarized", "scalar"):
        found = measured([(1j, 0.3)], polarized=polarized)
        assert same_bits(kept(found, tmp_path / "a.nc"), found)


@rows("form", FORMS)
def test_others_open_it_as_the_dataset_with_names_and_units(form, metal, tmp_path):
    metal.save(tmp_path / f"a{form}")
    with xr.open_dataset(tmp_path / f"a{form}", chunks=None) as found:
        for name, each in metal.dataset.data_vars.items():
            assert (found[name].dims, found[name].attrs) == (each.dims, each.attrs)
            assert np.array_equal(found[name], each, equal_nan=True)
        assert [*found.side.values] == ["reflected"]
        assert found.wavelength.attrs["units"] == "m"
        assert found.attrs["frame"] == metal.dataset.attrs["frame"]
        # The sums over the parts are those over all photons.
        whole = found.sums.sum("part") / found.part_photons.sum()
        assert np.array_equal(whole.sel(number="scalar"), metal.parts.sums.sum(0)[..., -1] / 8192)


@pytest.mark.parametrize("form", slow_except([".zarr"], FORMS))
def test_a_hemisphere_takes_the_place_of_another_unless_writing_fails(
    form, glass, metal, tmp_path, monkeypatch
):
    glass.save(tmp_path / f"a{form}")
    assert same_bits(kept(metal, tmp_path / f"a{form}"), metal)
    way = {".zarr": "to_zarr", ".nc": "to_netcdf"}[form]
    write = getattr(xr.Dataset, way)

    def full(*given, **more):
        write(*given, **more)
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(xr.Dataset, way, full)
    with pytest.raises(op.errors.SurfaceError, match=rf"a{form}' cannot be written: No space left"):
        glass.save(tmp_path / f"a{form}")
    assert same_bits(op.load_hemisphere(tmp_path / f"a{form}"), metal)
    assert len([*tmp_path.iterdir()]) == 1


@rows(
    "name, options, sentence",
    [
        *((name, {}, "give .zarr or .nc for all .* .exr for a p") for name in ("a.h5", ".zarr")),
        *((f"nowhere/a{form}", {}, "cannot be written: No such f") for form in (*FORMS, ".exr")),
        ("a.nc", {"source": [1, 0, 0, 0], "side": "reflected"}, "leave source= and side= out"),
        ("a.exr", {"source": [1, 1, 1, 0]}, "source is .*; give S0 > 0 and"),
        ("a.exr", {"side": "transmitted"}, "nothing goes through an opaque sample"),
        ("letters.zarr", {}, r"s.zarr' is there already, and is no hemisphere"),
    ],
)
def test_what_cannot_be_saved_is_told(name, options, sentence, metal, tmp_path):
    if name.endswith(".exr"):
        pytest.importorskip("OpenEXR")
    (tmp_path / "letters.zarr").mkdir(exist_ok=True)
    (tmp_path / "letters.zarr/dear.txt").write_text("dear")
    with pytest.raises(op.errors.SurfaceError, match=sentence):
        metal.save(tmp_path / name, **options)
    assert (tmp_path / "letters.zarr/dear.txt").read_text() == "dear"


@pytest.mark.parametrize(
    ("form", "package", "extra"),
    [(".zarr", "zarr", "sweep"), (".nc", "h5netcdf", "sweep"), (".exr", "OpenEXR", "exr")],
)
def test_a_missing_extra_is_told(form, package, extra, metal, tmp_path, monkeypatch):
    told = rf'{package}, .* "optipath\[{extra}\]"'
    if form != ".exr":
        metal.save(tmp_path / f"a{form}")
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(op.OptipathError, match=told):
        metal.save(tmp_path / f"b{form}")
    if form != ".exr":
        with pytest.raises(op.OptipathError, match=told):
            op.load_hemisphere(tmp_path / f"a{form}")


def test_what_is_no_hemisphere_or_a_damaged_one_is_told(metal, tmp_path):
    (tmp_path / "a.nc").write_bytes(b"no NetCDF at all")
    (tmp_path / "a.zarr").mkdir()
    metal.save(tmp_path / "whole.nc")
    with xr.open_dataset(tmp_path / "whole.nc", engine="h5netcdf") as file:
        found = file.load()
    told = json.dumps(json.loads(found.attrs["measurement"]) | {"layout": 7})
    for name, written in (
        ("b.nc", xr.Dataset({"a": ("x", [1.0])})),
        ("cut.nc", found.isel(part=slice(3))),
        ("later.nc", found.assign_attrs(measurement=told)),
    ):
        written.to_netcdf(tmp_path / name, engine="h5netcdf")
    damaged = dict.fromkeys(("a.nc", "a.zarr", "b.nc", "cut.nc"), "is no hemisphere, or a damaged")
    for name, sentence in {
        "none.nc": r"there is no '.*none.nc'",
        "a.csv": r"does not hold all of a hemisphere; save it",
        **{name: f"{name}' {told}" for name, told in damaged.items()},
        # By the version that reads it.
        "later.nc": r"layout 7, .* reads layout 1; load it by optipath 0",
    }.items():
        with pytest.raises(op.errors.SurfaceError, match=sentence):
            op.load_hemisphere(tmp_path / name)


def heights(seed=1):
    return np.random.default_rng(seed).normal(size=(12, 12))


def sample_of_heights(seed=1, description=""):
    field = HeightField.from_heights(heights(seed), 20.0, periodic=True)
    return op.Sample([(1j, field)], description=description)


def test_a_sample_that_has_no_form_in_files_is_not_known_unless_it_is_given(tmp_path):
    found, file = op.measure(sample_of_heights(), "40 deg", PHOTONS, sensor=12), tmp_path / "a.nc"
    again = kept(found, file)
    assert same_bits(again, found)
    assert not again.seen.beam.sample.isotropic
    assert repr(again).startswith("Hemisphere of a sample that is not known at 40 deg")
    with pytest.raises(op.errors.SurfaceError, match=r"not known: .*in no file.*sample=\.\.\."):
        again.seen.beam.block(0)
    with pytest.raises(op.errors.SurfaceError, match=r"is not the one measured"):
        op.load_hemisphere(file, sample=sample_of_heights(seed=2))
    with pytest.raises(op.errors.SurfaceError, match=r"sample is 'mirror', which is not the"):
        op.load_hemisphere(file, sample="mirror")
    for _ in range(2):
        again = op.load_hemisphere(file, sample=sample_of_heights(description="the same"))
        assert same_bits(again, found)
        assert again.seen.beam.block(0, 16).photons == 16
        # Saved again without it, it can be given then.
        op.load_hemisphere(file).save(file)
    # Heights of a file may be others now, and are not read.
    np.save(tmp_path / "heights.npy", heights())
    text = 'format = 1\n[[layers]]\nindex = { n = 0.0, k = 1.0 }\nheights = "heights.npy"\n'
    (tmp_path / "mine.toml").write_text(text + "size = [20.0, 20.0]\nperiodic = true\n")
    sample = op.load_sample(tmp_path / "mine.toml")
    found = op.measure(sample, "40 deg", PHOTONS, sensor=12)
    found.save(file)
    np.save(tmp_path / "heights.npy", 2.0 * heights())
    again = op.load_hemisphere(file)
    assert same_bits(again, found)
    with pytest.raises(op.errors.SurfaceError, match=r"its heights are not in this file; give it"):
        _ = again.seen.beam.sample.layers
    assert op.load_hemisphere(file, sample=sample).seen.beam.sample == sample


def read(file):
    found = pytest.importorskip("OpenEXR").File(str(file), separate_channels=True)
    return {name: each.pixels for name, each in found.channels().items()}, found.header()


def radiances(hemisphere, source, side=0):
    """Of an irradiance of 1: the share of the light, per steradian and over the cosine."""
    light = hemisphere.mueller[0][side] @ source
    sensor = hemisphere.sensor
    area = sensor.solid_angle * np.cos(sensor.theta)
    return np.nan_to_num(light / area[..., np.newaxis, np.newaxis])


def test_a_channel_is_a_stokes_component_of_a_wavelength_and_the_header_says_what_is_seen(
    metal, tmp_path, monkeypatch
):
    metal.save(tmp_path / "a.exr", source=[2.0, 1.0, 0.0, 1.0])
    channels, header = read(tmp_path / "a.exr")
    expected = radiances(metal, [1.0, 0.5, 0.0, 0.5])
    for place, name in enumerate(["400,000000nm", "550,250000nm"]):
        for each in range(4):
            found = channels[f"S{each}.{name}"]
            assert found.dtype == np.float32
            # The first row of a picture is its uppermost.
            assert np.array_equal(found, expected[::-1, :, place, each].astype(np.float32))
    assert channels["Y"] == pytest.approx(expected[::-1, :, :, 0].mean(-1), rel=1e-6)
    assert len(channels) == 9
    # As the spectral layout asks for it, with the frames.
    attrs = metal.dataset.attrs
    told = {"spectralLayoutVersion": "1.0", "emissiveUnits": "W.m^-2.sr^-1"}
    told |= {"polarisationHandedness": "right", "source": "1.0 0.5 0.0 0.5"}
    told |= {"frame": attrs["frame"], "sample": attrs["sample"]}
    assert {name: header[name] for name in told} == told
    assert "counter-clockwise to who looks at the source" in header["handedness"]
    assert float(header["incidence"]) == attrs["incidence"]
    # It takes the place of another whole, or not at all.
    before = (tmp_path / "a.exr").read_bytes()
    monkeypatch.setattr("OpenEXR.File", None)
    with pytest.raises(TypeError):
        metal.save(tmp_path / "a.exr")
    assert [each.read_bytes() for each in tmp_path.iterdir()] == [before]


def test_without_wavelengths_channels_are_grey_and_one_side_is_asked_for(tmp_path):
    glass = measured([(1.5, 0.2)])
    with pytest.raises(
        op.errors.SurfaceError, match=r"give side='reflected' or side='transmitted'"
    ):
        glass.save(tmp_path / "a.exr")
    glass.save(tmp_path / "a.exr", side="transmitted")
    channels, header = read(tmp_path / "a.exr")
    assert sorted(channels) == ["S0.Y", "S1.Y", "S2.Y", "S3.Y", "Y"]
    expected = radiances(glass, [1.0, 0.0, 0.0, 0.0], side=1)[::-1, :, 0]
    assert np.array_equal(channels["S1.Y"], expected[..., 1].astype(np.float32))
    assert header["side"] == "transmitted"
    # Over the whole hemisphere a picture adds up to what is reflected.
    mirror = measured([(1j, 0.3)], sensor=32)
    mirror.save(tmp_path / "a.exr")
    channels, _ = read(tmp_path / "a.exr")
    area = (mirror.sensor.solid_angle * np.cos(mirror.sensor.theta))[::-1]
    inside = mirror.scalar[0][0, ..., 0][~np.isnan(mirror.sensor.theta)].sum()
    assert np.nansum(channels["Y"] * area) == pytest.approx(inside, rel=1e-5)
    assert inside > 0.99
