"""The Dataset of a sweep: labels, attributes, variables computed when asked for, pictures."""

import pickle
from importlib import reload
from importlib.metadata import version

import numpy as np
import pytest
from numpy.testing import assert_array_equal

import optipath as op
import optipath.sweeps.sweep
from optipath.errors import OptipathError
from optipath.light.light import Light

xr, pd = pytest.importorskip("xarray"), pytest.importorskip("pandas")
NPGR, MALUS = op.load_preset("npgr026"), op.load_preset("malus")
DELTAS = [0.1, 0.2]


def test_axes_and_what_is_fixed_have_the_unit_in_which_they_were_given_and_help():
    given = {"theta": ["10 deg", "20 deg"], "length": [0.001, 0.002], "n": np.array([1.4, 1.5])}
    found = op.load_preset("glass-slab").sweep(**given)
    units = {name: found[name].units for name in found.dims}
    assert units == {"theta": "deg", "length": "m", "n": "1"}
    assert found.theta.values.tolist() == [10.0, 20.0]
    found = NPGR.sweep(delta=DELTAS)
    told = {name: found[name].long_name for name in found.coords}
    assert told == {name: parameter.help for name, parameter in NPGR.parameters.items()}
    assert {name: each.attrs.get("units") for name, each in found.data_vars.items()} == {
        **dict.fromkeys(["S0", "S1", "S2", "S3"]),
        **dict.fromkeys(["DoP", "DoLP", "ellipticity"], "1"),
        **dict.fromkeys(["AoP", "Psi", "Delta"], "rad"),
    }
    assert all(each.long_name for each in found.data_vars.values())
    found = NPGR.sweep(delta=DELTAS, phi="30 deg", rho=0.5)
    assert (found.phi.shape, found.phi, found.n2, found["filter"]) == ((), 30.0, 1.5, "none")
    assert (found.phi.units, found.rho.units) == ("deg", "rad")
    both = MALUS.sweep(angle="30 deg"), MALUS.sweep(angle=np.radians(30.0))
    assert [each.angle.units for each in both] == ["deg", "rad"]
    assert both[0].S0.values == both[1].S0.values
    path = op.Source() >> op.Interface(op.Parameter("m"), op.Parameter("theta")) >> op.Detector()
    # A complex value is a text that files take.
    assert path.sweep(theta=DELTAS, m=0.2 + 3.4j).m.item() == "(0.2+3.4j)"
    # It is labelled as an axis of that value alone.
    given = {"delta": ["10 deg", "20 deg"], "n1": 1}
    for word in ("horizontal", "none", "30 deg", 0.3):
        fixed, axis = NPGR.sweep(**given, filter=word), NPGR.sweep(**given, filter=[word])
        assert axis.isel(filter=0).identical(fixed)
        assert NPGR.sweep(coords=fixed).identical(fixed)


def test_the_path_its_explanation_the_frame_the_options_and_the_version_are_there(tmp_path):
    (tmp_path / "path.toml").write_text(NPGR.sweep(delta=DELTAS).attrs["path"], "utf-8")
    assert op.load_preset(tmp_path / "path.toml") == NPGR
    path = op.load_preset("malus")
    found = path.sweep(angle=DELTAS)
    assert found.explanation == path.compose().explain()
    assert found.optipath_version == version("optipath")
    assert found.frame == "eye: x = 1, 0, 0; y = 0, 1, 0; z = 0, 0, 1"
    assert op.load_preset("npgr026-3d").sweep(delta=DELTAS).frame == "E: depends on the values"
    composer = op.Composer(method="textbook", engine="numpy", model="full")
    found = path.sweep(angle=[0.1], composer=composer)
    told = found.method, found.engine, found.model, found.dtype
    assert told == ("textbook", "numpy", "full", "float64")
    path.description = "another one"
    assert 'description = "another one"' in path.sweep(angle=[0.1]).attrs["path"]


def test_paths_without_a_form_are_swept_and_names_of_variables_are_no_parameters():
    class Grey(op.Element):
        @staticmethod
        def mueller_rows(xp):
            return np.eye(4).tolist()

    path = op.Source() >> Grey() >> op.Attenuator(op.Parameter("t")) >> op.Detector()
    found = path.sweep(t=[0.25, 0.5])
    assert found.S0.values.tolist() == [0.25, 0.5]
    assert found.attrs["path"].startswith("the path cannot be written here, since it has no form")
    for name in ("psi", "delta"):
        assert {"Psi", "Delta", "psi", "delta"} & {*swept_by(name).data_vars} == {"Psi", "Delta"}
    assert {"psi", "delta"} <= {*swept_by("share").data_vars}
    for name in ("S0", "DoP"):
        with pytest.raises(
            op.errors.ParameterError, match=f"'{name}' is what a sweep calls a variable"
        ):
            swept_by(name)
    assert swept_by("detector").S0.dims == ("detector",)
    with pytest.raises(op.errors.ParameterError, match="calls a dimension of its own"):
        swept_by("detector", "transmitted")


def swept_by(name, *ways):
    path = op.PathGraph()
    path.add("lamp", op.Source()) >> path.add("splitter", op.BeamSplitter(op.Parameter(name)))
    for way in ("reflected", *ways):
        path[f"splitter.{way}"] >> path.add(way, op.Detector())
    return path.sweep(**{name: [0.2, 0.4]})


AXES = {"delta": np.linspace(0.1, 1.0, 5), "phi": np.linspace(0.2, 1.1, 4)}
GIVEN = {"delta": AXES["delta"][:, None], "phi": AXES["phi"]}
LIGHT = NPGR.trace(**GIVEN)


def a_sweep():
    return NPGR.sweep(**AXES)


def test_nothing_is_computed_before_somebody_asks_and_then_that_part_alone_and_once(monkeypatch):
    asked, dop = [], Light.dop.fget  # The shapes of light of which a degree has been computed.
    monkeypatch.setattr(Light, "dop", property(lambda self: asked.append(self.shape) or dop(self)))
    found = a_sweep()
    str(found)
    found._repr_html_()
    assert asked == []
    part = found.DoP[1:3, ::2].values
    assert [int(np.prod(shape)) for shape in asked] == [4]
    assert_array_equal(part, LIGHT[1:3, ::2].dop)
    asked.clear()
    found = a_sweep()
    assert_array_equal(found.DoP.values, found.DoP.values)
    assert len(asked) == 1
    # A large part is computed piece by piece.
    monkeypatch.setattr("optipath.sweeps.memory._AT_ONCE", 6)
    assert_array_equal(a_sweep().DoP.values, LIGHT.dop)
    assert_array_equal(a_sweep().AoP[::-2, 1:].values, LIGHT.aop[::-2, 1:])
    assert len(asked) > 3


def test_every_index_takes_its_part_and_several_detectors_are_the_first_axis():
    for key in (
        *(np.s_[2], np.s_[-1, -1], np.s_[::-1, 1:], np.s_[[3, 0, 0]]),
        *(np.s_[[4, 1], [True, False, False, True]], np.s_[1:1], np.s_[..., 2]),
    ):
        assert_array_equal(a_sweep().DoP[key].values, a_sweep().DoP.load()[key].values)
    places = {name: xr.DataArray([0, 2, 3], dims="point") for name in ("delta", "phi")}
    assert_array_equal(a_sweep().AoP.isel(places).values, LIGHT.aop[[0, 2, 3], [0, 2, 3]])
    found = a_sweep().sel(delta=0.55, method="nearest").isel(phi=[0, 2])
    assert_array_equal(found.DoP.values, LIGHT[2, [0, 2]].dop)
    found = a_sweep()
    assert_array_equal((2 * found.DoP - found.S0).values, 2 * LIGHT.dop - LIGHT.S0)
    np.testing.assert_allclose(found.mean().DoP, LIGHT.dop.mean(), rtol=1e-15)
    assert_array_equal(found.where(found.DoP > 0.9).DoP.count(), (LIGHT.dop > 0.9).sum())
    assert_array_equal(a_sweep().to_dataframe()["DoP"], LIGHT.dop.ravel())
    path = op.load_preset("npgr026")
    path.add("after", op.Detector())
    path.connect("X1.transmitted", "after.in")
    found, lights = path.sweep(**AXES), path.trace_all(**GIVEN)
    assert found.DoP.dims == ("detector", "delta", "phi")
    both = np.stack([lights["E"].dop, lights["after"].dop])
    for place, name in enumerate(("E", "after")):
        assert_array_equal(found.DoP.sel(detector=name).values, both[place])
    assert_array_equal(path.sweep(**AXES).DoP.values, both)
    assert_array_equal(path.sweep(**AXES).DoP[::-1, 2].values, both[::-1, 2])


def test_copies_pickles_and_chunks_of_dask_come_back_and_leave_the_sweep_as_it_was():
    found = a_sweep()
    copied = found.copy(deep=True)
    copied.S0[:] = 0.0
    copied.DoP[:] = 0.5
    assert_array_equal([found.S0.values, found.DoP.values], [LIGHT.S0, LIGHT.dop])
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
    file, options = tmp_path / "sweep", {"consolidated": False} if form == "zarr" else {}
    if form == "zarr":
        a_sweep().to_zarr(file, **options)
    else:
        a_sweep().to_netcdf(file, engine=form)
    with xr.open_dataset(file, engine=form, **options) as there:
        xr.testing.assert_identical(there.load(), a_sweep().load())
        assert NPGR.to_toml() == there.attrs["path"]


SEVEN = "0 deg:90 deg:7"
SWEEP = MALUS.sweep(angle=SEVEN, intensity=[1.0, 2.0])
ALONE = SWEEP.isel(intensity=0)
TOGETHER = MALUS.sweep(
    angle="0 deg:90 deg:3", intensity=[1.0, 2.0, 3.0], zip=("angle", "intensity")
)
SHARES = swept_by("share", "transmitted")


def drawn(ax):
    return ax.get_lines()[0].get_xydata().T


def test_curves_go_over_one_dimension_maps_over_two_and_spheres_are_coloured(tmp_path, monkeypatch):
    ax = SWEEP.sel(intensity=2.0).optipath.curve("s0")
    x, y = drawn(ax)
    np.testing.assert_allclose(x, np.linspace(0.0, 90.0, 7))
    np.testing.assert_allclose(y, np.cos(np.radians(x)) ** 2, atol=1e-12)
    assert ax.get_xlabel() == "angle: turn of the analyser against the polariser (°)"
    reload(optipath.sweeps.sweep)  # To register twice is no warning.
    assert ALONE.optipath.curve().get_xlabel() == ax.get_xlabel()
    assert drawn(TOGETHER.optipath.curve("S0", "intensity"))[0].tolist() == [1.0, 2.0, 3.0]
    through = SHARES.optipath.curve(detector="transmitted")
    assert drawn(through)[1].tolist() == pytest.approx([0.8, 0.6])
    # Radians are shown in degrees, and metres in nanometres.
    x, _ = drawn(MALUS.sweep(angle=np.linspace(0, np.pi, 3)).optipath.curve())
    np.testing.assert_allclose(x, [0.0, 90.0, 180.0])
    path = op.load_preset("quartz-quarter-wave")
    ax = path.sweep(wavelength=np.array([500e-9, 600e-9])).optipath.curve()
    np.testing.assert_allclose(drawn(ax)[0], [500.0, 600.0])
    assert ax.get_xlabel() == "wavelength in vacuum (nm)"
    # It may be in chunks, or read from a file.
    sweeps = MALUS.sweep(angle=SEVEN, chunks=3), MALUS.sweep(angle=SEVEN)
    np.testing.assert_array_equal(*[drawn(sweep.optipath.curve("DoLP")) for sweep in sweeps])
    SWEEP.to_netcdf(tmp_path / "sweep.nc", engine="h5netcdf")
    with xr.open_dataset(tmp_path / "sweep.nc", engine="h5netcdf") as read:
        _, y = drawn(read.isel(intensity=0).optipath.curve())
    assert y[0] == pytest.approx(0.5)
    ax = SWEEP.optipath.map("S0")
    assert ax.get_xlabel().startswith("angle")
    values = ax.collections[0].get_array()
    assert values.shape == (2, 7)
    turned = SWEEP.optipath.map("S0", "intensity", "angle").collections[0].get_array()
    np.testing.assert_array_equal(turned, values.T)
    assert ALONE.optipath.poincare().name == "3d"
    told = {}
    monkeypatch.setattr(op.plots, "poincare", lambda *given, **by: told.update(by, given=given))
    ALONE.optipath.poincare()
    light, ax = told["given"]
    assert (ax, told["label"]) == (None, "angle (°)")
    np.testing.assert_allclose(light.intensity[:2], [0.5, 0.5 * np.cos(np.radians(15)) ** 2])
    np.testing.assert_allclose(told["by"], np.linspace(0.0, 90.0, 7))


LINEAR = MALUS.reading("linear").sweep(angle="0 deg:90 deg:3")
WORDS = op.load_preset("npgr026").sweep(filter=["none", "30 deg"])


def test_what_is_wrong_is_told():
    for draw, told in (
        (SWEEP.optipath.curve, r"has 'angle' and 'intensity'; choose a value"),
        (lambda: SWEEP.optipath.curve("S0", "angel"), "coordinate 'angel' is unknown"),
        (SWEEP.isel(angle=0, intensity=0).optipath.curve, "no dimension with several values"),
        (lambda: ALONE[["S0"]].optipath.curve("DoP"), "variable 'DoP' is unknown"),
        (WORDS.optipath.curve, "has words; choose one"),
        (TOGETHER.optipath.curve, "has the coordinates angle and intensity; say which"),
        (lambda: TOGETHER.optipath.map("S0", "angle"), "a picture goes over 2 dimensions"),
        (SHARES.optipath.curve, "the detectors reflected and transmitted; say detector"),
        (lambda: SHARES.optipath.curve(detector="three"), "detector 'three' is unknown"),
        (LINEAR.optipath.poincare, "components that are not read"),
    ):
        with pytest.raises(OptipathError, match=told):
            draw()
