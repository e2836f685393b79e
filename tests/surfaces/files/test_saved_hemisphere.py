import builtins
import json

import numpy as np
import pytest

import optipath as op
from hemispheres import measured, same_bits

xr = pytest.importorskip("xarray")
pytest.importorskip("zarr")
pytest.importorskip("h5netcdf")

FORMS = [".zarr", ".nc"]


@pytest.fixture(scope="module")
def glass():
    return measured([(1.5, 0.2), (2.0, (0.1, 0.2))], events=2, seed=2**70, azimuth="20 deg")


@pytest.fixture(scope="module")
def metal():
    layers = [(op.Material.tabulated(["400 nm", "700 nm"], [0.2, 1.5], [2.0, 3.0]), 0.3)]
    return measured(layers, wavelengths=["400 nm", "550.25 nm"])


def same_indices(first, second):
    pairs = [*zip(first, second, strict=True)]
    return all(np.array_equal(*pair) and np.shape(pair[0]) == np.shape(pair[1]) for pair in pairs)


@pytest.mark.parametrize("form", FORMS)
def test_what_is_loaded_is_what_was_measured_to_the_last_bit(form, glass, metal, tmp_path):
    for name, hemisphere in {"glass": glass, "metal": metal}.items():
        hemisphere.save(tmp_path / f"{name}{form}")
        again = op.load_hemisphere(tmp_path / f"{name}{form}")
        assert same_bits(again, hemisphere)
        beams = again.seen.beam, hemisphere.seen.beam
        for each in ("sample", "azimuth", "seed", "most_events"):
            assert getattr(beams[0], each) == getattr(beams[1], each)
        assert again.seen.events == hemisphere.seen.events
        assert same_indices(*(beam.indices for beam in beams))
        for quantity in ("mueller", "scalar", "difference"):
            pairs = zip(getattr(again, quantity), getattr(hemisphere, quantity), strict=True)
            assert all(np.array_equal(*pair, equal_nan=True) for pair in pairs)


@pytest.mark.filterwarnings("ignore:direction:optipath.errors.PhotonWarning")
def test_what_follows_from_it_is_the_same_with_its_errors(metal, tmp_path):
    metal.save(tmp_path / "a.nc")
    again = op.load_hemisphere(tmp_path / "a.nc")
    for name in ("aop", "dolp", "brdf", "adm", "mdm", "single_scattering"):
        assert getattr(again, name)().identical(getattr(metal, name)())
    first, second = (
        op.Source() >> each.toward("40 deg", wavelength="400 nm") >> op.Detector()
        for each in (metal, again)
    )
    assert np.array_equal(first.trace().stokes, second.trace().stokes)


@pytest.mark.parametrize("polarized", ["polarized", "scalar"])
def test_what_was_not_measured_is_not_there_after_loading_either(polarized, tmp_path):
    found = measured([(1j, 0.3)], polarized=polarized)
    found.save(tmp_path / "a.nc")
    assert same_bits(op.load_hemisphere(tmp_path / "a.nc"), found)


@pytest.mark.parametrize("form", FORMS)
def test_others_open_it_as_the_dataset_with_names_and_units(form, metal, tmp_path):
    metal.save(tmp_path / f"a{form}")
    with xr.open_dataset(tmp_path / f"a{form}", chunks=None) as found:
        for name, each in metal.dataset.data_vars.items():
            assert found[name].dims == each.dims
            assert found[name].attrs == each.attrs
            assert np.array_equal(found[name], each, equal_nan=True)
        assert [*found.side.values] == ["reflected"]
        assert found.wavelength.attrs["units"] == "m"
        assert found.attrs["frame"] == metal.dataset.attrs["frame"]
        # The sums over the parts are those over all photons.
        whole = found.sums.sum("part") / found.part_photons.sum()
        assert np.array_equal(whole.sel(number="scalar"), metal.parts.sums.sum(0)[..., -1] / 8192)


@pytest.mark.parametrize("form", FORMS)
def test_a_hemisphere_takes_the_place_of_another(form, glass, metal, tmp_path):
    glass.save(tmp_path / f"a{form}")
    metal.save(tmp_path / f"a{form}")
    assert same_bits(op.load_hemisphere(tmp_path / f"a{form}"), metal)
    assert len([*tmp_path.iterdir()]) == 1


def test_a_folder_that_is_no_hemisphere_stays(glass, tmp_path):
    folder = tmp_path / "a.zarr"
    folder.mkdir()
    (folder / "letters.txt").write_text("dear")
    with pytest.raises(op.SurfaceError, match=r"a.zarr' is there already, and is no hemisphere"):
        glass.save(folder)
    assert (folder / "letters.txt").read_text() == "dear"


@pytest.mark.parametrize("form", FORMS)
def test_what_was_there_stays_where_writing_fails(form, glass, metal, tmp_path, monkeypatch):
    glass.save(tmp_path / f"a{form}")
    way = {".zarr": "to_zarr", ".nc": "to_netcdf"}[form]
    write = getattr(xr.Dataset, way)

    def full(*given, **more):
        write(*given, **more)
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(xr.Dataset, way, full)
    with pytest.raises(op.SurfaceError, match=rf"a{form}' cannot be written: No space left"):
        metal.save(tmp_path / f"a{form}")
    assert same_bits(op.load_hemisphere(tmp_path / f"a{form}"), glass)
    assert len([*tmp_path.iterdir()]) == 1


@pytest.mark.parametrize("name", ["a.h5", "a", "a.EXR", ".zarr"])
def test_another_ending_is_refused_with_those_that_there_are(name, glass):
    with pytest.raises(op.SurfaceError, match=r"give .zarr or .nc for all .* .exr for a picture"):
        glass.save(name)


def test_what_is_of_pictures_is_refused_for_other_forms(glass):
    with pytest.raises(op.SurfaceError, match=r"leave source= and side= out"):
        glass.save("a.nc", source=[1, 0, 0, 0], side="reflected")


@pytest.mark.parametrize("form", [*FORMS, ".exr"])
def test_a_folder_that_is_not_there_is_told(form, metal, tmp_path):
    with pytest.raises(op.SurfaceError, match=r"cannot be written: No such file or directory"):
        metal.save(tmp_path / f"nowhere/a{form}")


@pytest.mark.parametrize(
    ("form", "package", "extra"),
    [(".zarr", "zarr", "sweep"), (".nc", "h5netcdf", "sweep"), (".exr", "OpenEXR", "exr")],
)
def test_a_missing_extra_is_told(form, package, extra, metal, tmp_path, monkeypatch):
    taken = builtins.__import__

    def without(name, *more):
        if name.partition(".")[0] == package:
            raise ModuleNotFoundError(name=package)
        return taken(name, *more)

    if form != ".exr":
        metal.save(tmp_path / f"a{form}")
    monkeypatch.setattr(builtins, "__import__", without)
    monkeypatch.setitem(__import__("sys").modules, package, None)
    with pytest.raises(op.OptipathError, match=rf'{package}, .* "optipath\[{extra}\]"'):
        metal.save(tmp_path / f"b{form}")
    if form != ".exr":
        with pytest.raises(op.OptipathError, match=rf'{package}, .* "optipath\[{extra}\]"'):
            op.load_hemisphere(tmp_path / f"a{form}")


def test_what_is_not_there_or_is_something_else_is_told(tmp_path):
    with pytest.raises(op.SurfaceError, match=r"there is no '.*a.nc'"):
        op.load_hemisphere(tmp_path / "a.nc")
    with pytest.raises(op.SurfaceError, match=r"is no file of a hemisphere; save it"):
        op.load_hemisphere("a.csv")
    (tmp_path / "a.nc").write_bytes(b"no NetCDF at all")
    (tmp_path / "a.zarr").mkdir()
    xr.Dataset({"a": ("x", [1.0])}).to_netcdf(tmp_path / "b.nc", engine="h5netcdf")
    for name in ("a.nc", "a.zarr", "b.nc"):
        with pytest.raises(op.SurfaceError, match=rf"{name}' is no hemisphere, or a damaged one"):
            op.load_hemisphere(tmp_path / name)


def test_a_file_of_another_layout_is_told_with_the_version_that_reads_it(metal, tmp_path):
    metal.save(tmp_path / "a.zarr")
    with xr.open_zarr(tmp_path / "a.zarr") as found:
        told = json.loads(found.attrs["measurement"]) | {"layout": 7}
        changed = found.load().assign_attrs(measurement=json.dumps(told))
    changed.to_netcdf(tmp_path / "b.nc", engine="h5netcdf")
    with pytest.raises(
        op.SurfaceError, match=r"layout 7, .* reads layout 1; load it by optipath 0"
    ):
        op.load_hemisphere(tmp_path / "b.nc")


def test_a_file_whose_sums_are_cut_off_is_a_damaged_one(metal, tmp_path):
    metal.save(tmp_path / "a.nc")
    with xr.open_dataset(tmp_path / "a.nc", engine="h5netcdf") as found:
        found.load().isel(part=slice(3)).to_netcdf(tmp_path / "b.nc", engine="h5netcdf")
    with pytest.raises(op.SurfaceError, match=r"or a damaged one"):
        op.load_hemisphere(tmp_path / "b.nc")
