"""The Dataset of a sweep: labels, attributes, and variables computed when somebody asks."""

import pickle
from importlib.metadata import version

import numpy as np
import pytest
from numpy.testing import assert_array_equal

import optipath as op
from optipath.light.light import Light
from optipath.sweeps.whole.quick_dataset import quick_dataset
from optipath.sweeps.whole.stacked_views import stacked
from tables import rows

xr, pd = pytest.importorskip("xarray"), pytest.importorskip("pandas")
NPGR, MALUS = op.load_preset("npgr026"), op.load_preset("malus")
DELTAS = [0.1, 0.2]


def test_axes_have_the_unit_in_which_they_were_given_and_the_help_of_parameters():
    found = op.load_preset("glass-slab").sweep(
        theta=["10 deg", "20 deg"], length=[0.001, 0.002], n=np.array([1.4, 1.5])
    )
    units = {name: found[name].attrs["units"] for name in found.dims}
    assert units == {"theta": "deg", "length": "m", "n": "1"}
    assert found.theta.values.tolist() == [10.0, 20.0]
    found = NPGR.sweep(delta=DELTAS)
    told = {name: found[name].attrs["long_name"] for name in found.coords}
    assert told == {name: parameter.help for name, parameter in NPGR.parameters.items()}


def test_what_is_fixed_is_a_coordinate_as_it_was_given_or_is_by_default():
    found = NPGR.sweep(delta=DELTAS, phi="30 deg", rho=0.5)
    assert found.phi.shape == ()
    assert found.phi == 30.0
    assert {name: found[name].units for name in ("phi", "rho")} == {"phi": "deg", "rho": "rad"}
    assert found.n2 == 1.5
    assert found["filter"] == "none"
    both = MALUS.sweep(angle="30 deg"), MALUS.sweep(angle=np.radians(30.0))
    assert [each.angle.units for each in both] == ["deg", "rad"]
    assert both[0].S0.values == both[1].S0.values
    path = op.Source() >> op.Interface(op.Parameter("m"), op.Parameter("theta")) >> op.Detector()
    # A complex value is a text that files take.
    assert path.sweep(theta=DELTAS, m=0.2 + 3.4j).m.item() == "(0.2+3.4j)"


@rows("word", ["horizontal", "none", "30 deg", 0.3])
def test_a_single_value_is_labelled_as_an_axis_of_that_value(word):
    given = {"delta": ["10 deg", "20 deg"], "n1": 1}
    fixed, axis = NPGR.sweep(**given, filter=word), NPGR.sweep(**given, filter=[word])
    assert axis.isel(filter=0).identical(fixed)
    assert NPGR.sweep(coords=fixed).identical(fixed)


def test_variables_have_units_but_those_of_the_source():
    found = NPGR.sweep(rho=DELTAS)
    units = {name: each.attrs.get("units") for name, each in found.data_vars.items()}
    assert units == {
        **dict.fromkeys(["S0", "S1", "S2", "S3"]),
        **dict.fromkeys(["DoP", "DoLP", "ellipticity"], "1"),
        **dict.fromkeys(["AoP", "Psi", "Delta"], "rad"),
    }
    assert all(each.attrs["long_name"] for each in found.data_vars.values())


def test_the_path_its_explanation_the_options_and_the_version_are_there(tmp_path):
    (tmp_path / "path.toml").write_text(NPGR.sweep(delta=DELTAS).attrs["path"], "utf-8")
    assert op.load_preset(tmp_path / "path.toml") == NPGR
    path = op.load_preset("malus")
    attrs = path.sweep(angle=DELTAS).attrs
    assert attrs["explanation"] == path.compose().explain()
    assert attrs["optipath_version"] == version("optipath")
    composer = op.Composer(method="textbook", engine="numpy", model="full")
    attrs = path.sweep(angle=[0.1], composer=composer).attrs
    told = {name: attrs[name] for name in ("method", "engine", "model", "dtype")}
    assert told == {"method": "textbook", "engine": "numpy", "model": "full", "dtype": "float64"}
    path.description = "another one"
    assert 'description = "another one"' in path.sweep(angle=[0.1]).attrs["path"]


def test_a_path_without_a_form_in_toml_is_swept_and_says_why():
    class Grey(op.Element):
        @staticmethod
        def mueller_rows(xp):
            return np.eye(4).tolist()

    path = op.Source() >> Grey() >> op.Attenuator(op.Parameter("t")) >> op.Detector()
    found = path.sweep(t=[0.25, 0.5])
    assert found.S0.values.tolist() == [0.25, 0.5]
    assert found.attrs["path"].startswith("the path cannot be written here, since it has no form")


def test_frames_are_told_where_they_are_constant():
    assert MALUS.sweep(angle=[0.1]).frame == "eye: x = 1, 0, 0; y = 0, 1, 0; z = 0, 0, 1"
    assert op.load_preset("npgr026-3d").sweep(delta=DELTAS).frame == "E: depends on the values"


def swept_by(name, detectors=1):
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source())
    lamp >> path.add("splitter", op.BeamSplitter(op.Parameter(name)))
    for way in ["reflected", "transmitted"][:detectors]:
        path.add(way, op.Detector())
        path.connect(f"splitter.{way}", f"{way}.in")
    return path.sweep(**{name: [0.2, 0.4]})


def test_names_of_variables_and_dimensions_are_not_those_of_parameters():
    for name in ("psi", "delta"):
        variables = {*swept_by(name).data_vars}
        assert {"Psi", "Delta"} <= variables
        assert not {"psi", "delta"} & variables
    assert {"psi", "delta"} <= {*swept_by("share").data_vars}
    for name in ("S0", "DoP", "log10_intensity"):
        with pytest.raises(op.ParameterError, match=f"'{name}' is what a sweep calls a variable"):
            swept_by(name)
    assert swept_by("detector").S0.dims == ("detector",)
    with pytest.raises(op.ParameterError, match="calls a dimension of its own"):
        swept_by("detector", 2)


AXES = {"delta": np.linspace(0.1, 1.0, 5), "phi": np.linspace(0.2, 1.1, 4)}
GIVEN = {"delta": AXES["delta"][:, None], "phi": AXES["phi"]}


def a_sweep():
    return NPGR.sweep(**AXES)


@pytest.fixture
def light():
    return NPGR.trace(**GIVEN)


@pytest.fixture
def asked(monkeypatch):
    """The shapes of light of which a degree of polarisation has been computed."""
    shapes = []
    dop = Light.dop.fget
    counted = property(lambda self: shapes.append(self.shape) or dop(self))
    monkeypatch.setattr(Light, "dop", counted)
    return shapes


def test_nothing_is_computed_before_somebody_asks_and_then_that_part_alone_and_once(asked, light):
    found = a_sweep()
    str(found)
    found._repr_html_()
    assert asked == []
    part = found.DoP[1:3, ::2].values
    assert [int(np.prod(shape)) for shape in asked] == [4]
    assert_array_equal(part, light[1:3, ::2].dop)
    asked.clear()
    found = a_sweep()
    assert_array_equal(found.DoP.values, found.DoP.values)
    assert len(asked) == 1


def test_a_large_part_is_computed_piece_by_piece(monkeypatch, asked, light):
    monkeypatch.setattr("optipath.sweeps.whole.swept_light._AT_ONCE", 6)
    assert_array_equal(a_sweep().DoP.values, light.dop)
    assert_array_equal(a_sweep().AoP[::-2, 1:].values, light.aop[::-2, 1:])
    assert len(asked) > 2


@rows(
    "key",
    [
        *(np.s_[2], np.s_[-1, -1], np.s_[::-1, 1:], np.s_[[3, 0, 0]]),
        *(np.s_[[4, 1], [True, False, False, True]], np.s_[1:1], np.s_[..., 2]),
    ],
)
def test_every_index_takes_its_part(key):
    assert_array_equal(a_sweep().DoP[key].values, a_sweep().DoP.load()[key].values)


def test_labels_choose_a_part_and_arithmetic_and_tables_are_those_of_the_values(light):
    places = {name: xr.DataArray([0, 2, 3], dims="point") for name in ("delta", "phi")}
    assert_array_equal(a_sweep().AoP.isel(places).values, light.aop[[0, 2, 3], [0, 2, 3]])
    found = a_sweep().sel(delta=0.55, method="nearest").isel(phi=[0, 2])
    assert_array_equal(found.DoP.values, light[2, [0, 2]].dop)
    found = a_sweep()
    assert_array_equal((2 * found.DoP - found.S0).values, 2 * light.dop - light.S0)
    np.testing.assert_allclose(found.mean().DoP, light.dop.mean(), rtol=1e-15)
    assert_array_equal(found.where(found.DoP > 0.9).DoP.count(), (light.dop > 0.9).sum())
    assert_array_equal(a_sweep().to_dataframe()["DoP"], light.dop.ravel())


def test_several_detectors_are_the_first_axis():
    path = op.load_preset("npgr026")
    path.add("after", op.Detector())
    path.connect("X1.transmitted", "after.in")
    found = path.sweep(**AXES)
    lights = path.trace_all(**GIVEN)
    assert found.DoP.dims == ("detector", "delta", "phi")
    for name in ("E", "after"):
        assert_array_equal(found.DoP.sel(detector=name).values, lights[name].dop)
    both = np.stack([lights["E"].dop, lights["after"].dop])
    assert_array_equal(path.sweep(**AXES).DoP.values, both)
    assert_array_equal(path.sweep(**AXES).DoP[::-1, 2].values, both[::-1, 2])


def test_copies_pickles_and_chunks_of_dask_come_back_and_leave_the_sweep_as_it_was(light):
    found = a_sweep()
    copied = found.copy(deep=True)
    copied.S0[:] = 0.0
    copied.DoP[:] = 0.5
    assert_array_equal(found.S0.values, light.S0)
    assert_array_equal(found.DoP.values, light.dop)
    assert (copied.DoP == 0.5).all()
    xr.testing.assert_identical(pickle.loads(pickle.dumps(a_sweep())), a_sweep())
    pytest.importorskip("dask")
    chunked = a_sweep().chunk({"delta": 2})
    assert chunked.DoP.chunks == ((2, 2, 1), (4,))
    xr.testing.assert_identical(chunked.compute(), a_sweep())


# What Zarr says of texts in its third format as long as that is not part of the specification.
@pytest.mark.filterwarnings("ignore:The (codec|dtype) `")
@pytest.mark.parametrize("form", ["h5netcdf", "zarr"])
def test_files_have_all_values_and_attributes(tmp_path, form):
    pytest.importorskip(form)
    file = tmp_path / "sweep"
    if form == "zarr":
        a_sweep().to_zarr(file, consolidated=False)
    else:
        a_sweep().to_netcdf(file, engine=form)
    options = {"consolidated": False} if form == "zarr" else {}
    with xr.open_dataset(file, engine=form, **options) as there:
        xr.testing.assert_identical(there.load(), a_sweep().load())
        assert there.attrs == a_sweep().attrs
        assert there.phi.attrs == a_sweep().phi.attrs
        assert NPGR.to_toml() == there.attrs["path"]


X = np.linspace(0.0, 1.0, 4)
PARTS = (
    {"S0": (("x", "word"), np.ones((4, 2)), {"units": "1"}), "one": ((), np.array(2.0), {})},
    {
        "x": ("x", pd.Index(X, copy=False), {"units": "rad"}),
        "word": ("word", np.array(["none", "horizontal"], object), {}),
        "single": ("single", np.array([1.0, 2.0], np.float32), {}),
        "beside": ("x", np.arange(4.0), {"units": "nm"}),
        "n": ((), np.array(1.5), {"units": "1"}),
        "filter": ((), np.array("none", object), {}),
    },
    {"method": "stable"},
)


def test_a_quick_dataset_is_what_xarray_makes_without_a_copy_of_long_axes(monkeypatch):
    quick, usual = quick_dataset(*PARTS), xr.Dataset(*PARTS)
    assert quick.identical(usual)
    assert list(quick.variables) == list(usual.variables)
    assert dict(quick.sizes) == dict(usual.sizes)
    one, other = ({n: i.dtype for n, i in each.indexes.items()} for each in (quick, usual))
    assert one == other
    assert quick.sel(word="horizontal", x=X[2]).identical(usual.sel(word="horizontal", x=X[2]))
    assert np.shares_memory(quick.x.values, X)
    # An xarray without the short way goes the long one.
    monkeypatch.setattr("optipath.sweeps.whole.quick_dataset._DIRECT", "_none")
    assert quick_dataset(*PARTS).identical(usual)


@rows("places", [[0], [0, 1], [1, 3, 5], [4, 2]])
def test_rows_at_equal_distances_are_a_view(places):
    values = np.random.default_rng(1).normal(size=(6, 4, 3))
    found = stacked([values[place] for place in places])
    assert_array_equal(found, values[places])
    assert np.may_share_memory(found, values) or len(places) == 1


@rows(
    "parts",
    [
        [np.arange(3.0), np.arange(3.0)],
        [*np.arange(12.0).reshape(4, 3)[[0, 1]], np.arange(3.0)],
        [np.arange(9.0)[:3], np.arange(9.0)[:6:2]],
        [np.arange(12.0).reshape(4, 3)[place] for place in (0, 1, 3)],
    ],
)
def test_others_are_copied(parts):
    found = stacked(parts)
    assert_array_equal(found, np.stack(parts))
    assert not found.flags.writeable
    assert not np.may_share_memory(found, parts[0])
