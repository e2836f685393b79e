"""Variables that are computed when somebody asks: what xarray does with them."""

import pickle

import numpy as np
import pytest

import optipath as op
from optipath.light.light import Light
from tables import rows

xr = pytest.importorskip("xarray")

AXES = {"delta": np.linspace(0.1, 1.0, 5), "phi": np.linspace(0.2, 1.1, 4)}


def a_sweep():
    return op.load_preset("npgr026").sweep(**AXES)


@pytest.fixture
def light():
    return op.load_preset("npgr026").trace(delta=AXES["delta"][:, None], phi=AXES["phi"])


@pytest.fixture
def asked(monkeypatch):
    """The shapes of light of which a degree of polarisation has been computed."""
    shapes = []
    dop = Light.dop.fget
    counted = property(lambda self: shapes.append(self.shape) or dop(self))
    monkeypatch.setattr(Light, "dop", counted)
    return shapes


def test_nothing_is_computed_before_somebody_asks(asked):
    found = a_sweep()
    str(found)
    found._repr_html_()
    assert asked == []


def test_a_part_is_computed_of_that_part_alone(asked, light):
    found = a_sweep().DoP[1:3, ::2].values
    assert [int(np.prod(shape)) for shape in asked] == [4]
    np.testing.assert_array_equal(found, light[1:3, ::2].dop)


def test_what_was_computed_is_kept(asked):
    found = a_sweep()
    np.testing.assert_array_equal(found.DoP.values, found.DoP.values)
    assert len(asked) == 1


@rows(
    "key",
    [
        np.s_[2],
        np.s_[-1, -1],
        np.s_[::-1, 1:],
        np.s_[[3, 0, 0]],
        np.s_[[4, 1], [True, False, False, True]],
        np.s_[1:1],
        np.s_[..., 2],
    ],
)
def test_every_index_takes_its_part(key):
    whole = a_sweep().DoP.load()
    np.testing.assert_array_equal(a_sweep().DoP[key].values, whole[key].values)


def test_points_along_a_new_dimension_are_taken_one_by_one(light):
    places = {name: xr.DataArray([0, 2, 3], dims="point") for name in ("delta", "phi")}
    found = a_sweep().AoP.isel(places)
    np.testing.assert_array_equal(found.values, light.aop[[0, 2, 3], [0, 2, 3]])


def test_several_detectors_are_the_first_axis():
    path = op.load_preset("npgr026")
    path.add("after", op.Detector())
    path.connect("X1.transmitted", "after.in")
    found = path.sweep(**AXES)
    lights = path.trace_all(delta=AXES["delta"][:, None], phi=AXES["phi"])
    assert found.DoP.dims == ("detector", "delta", "phi")
    for name in ("E", "after"):
        np.testing.assert_array_equal(found.DoP.sel(detector=name).values, lights[name].dop)
    both = np.stack([lights["E"].dop, lights["after"].dop])
    np.testing.assert_array_equal(path.sweep(**AXES).DoP.values, both)
    np.testing.assert_array_equal(path.sweep(**AXES).DoP[::-1, 2].values, both[::-1, 2])


def test_a_large_part_is_computed_piece_by_piece(monkeypatch, asked, light):
    monkeypatch.setattr("optipath.sweeps.whole.swept_light._AT_ONCE", 6)
    found = a_sweep()
    np.testing.assert_array_equal(found.DoP.values, light.dop)
    np.testing.assert_array_equal(a_sweep().AoP[::-2, 1:].values, light.aop[::-2, 1:])
    assert len(asked) > 2


def test_labels_choose_a_part(light):
    found = a_sweep().sel(delta=0.55, method="nearest").isel(phi=[0, 2])
    np.testing.assert_array_equal(found.DoP.values, light[2, [0, 2]].dop)


def test_arithmetic_and_means_are_those_of_the_values(light):
    found = a_sweep()
    np.testing.assert_array_equal((2 * found.DoP - found.S0).values, 2 * light.dop - light.S0)
    np.testing.assert_allclose(found.mean().DoP, light.dop.mean(), rtol=1e-15)
    np.testing.assert_array_equal(found.where(found.DoP > 0.9).DoP.count(), (light.dop > 0.9).sum())


def test_a_table_has_a_row_for_each_point(light):
    table = a_sweep().to_dataframe()
    np.testing.assert_array_equal(table["DoP"], light.dop.ravel())


def test_a_copy_can_be_written_to_and_leaves_the_sweep_as_it_was(light):
    found = a_sweep()
    copied = found.copy(deep=True)
    copied.S0[:] = 0.0
    copied.DoP[:] = 0.5
    np.testing.assert_array_equal(found.S0.values, light.S0)
    np.testing.assert_array_equal(found.DoP.values, light.dop)
    assert (copied.DoP == 0.5).all()


def test_a_pickle_comes_back_as_it_was():
    there = pickle.loads(pickle.dumps(a_sweep()))
    xr.testing.assert_identical(there, a_sweep())


def test_dask_takes_it_in_chunks():
    pytest.importorskip("dask")
    chunked = a_sweep().chunk({"delta": 2})
    assert chunked.DoP.chunks == ((2, 2, 1), (4,))
    xr.testing.assert_identical(chunked.compute(), a_sweep())


def test_netcdf_has_all_values_and_attributes(tmp_path):
    pytest.importorskip("h5netcdf")
    a_sweep().to_netcdf(tmp_path / "sweep.nc", engine="h5netcdf")
    with xr.open_dataset(tmp_path / "sweep.nc", engine="h5netcdf") as there:
        xr.testing.assert_identical(there.load(), a_sweep().load())
        assert op.load_preset("npgr026").to_toml() == there.attrs["path"]


# What Zarr says of texts in its third format as long as that is not part of the specification.
@pytest.mark.filterwarnings("ignore:The (codec|dtype) `")
def test_zarr_has_all_values_and_attributes(tmp_path):
    pytest.importorskip("zarr")
    a_sweep().to_zarr(tmp_path / "sweep.zarr", consolidated=False)
    there = xr.open_zarr(tmp_path / "sweep.zarr", consolidated=False)
    xr.testing.assert_identical(there.load(), a_sweep().load())
    assert there.attrs == a_sweep().attrs
    assert there.phi.attrs == a_sweep().phi.attrs
