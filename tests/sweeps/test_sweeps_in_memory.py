"""A sweep in memory against a loop over single runs."""

import csv
import json
import tracemalloc
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import optipath as op
from chains import ENGINES
from optipath.cli import main
from optipath.plan.answers import Answers
from optipath.sweeps import grid as memory_of
from optipath.values.text import IdleValues
from random_paths import Draw
from tables import rows, slow, slow_except

xr = pytest.importorskip("xarray")
DERIVED = {"DoP": "dop", "DoLP": "dolp", "AoP": "aop", "ellipticity": "ellipticity"}
NPGR, MALUS = op.load_preset("npgr026"), op.load_preset("malus")


def with_two_detectors():
    path = op.PathGraph()
    sheet = path.add("filter", op.Polarizer(op.Parameter("angle")))
    glass = path.add("glass", op.Interface(1.5, op.Parameter("theta")))
    path.add("lamp", op.Source(2.0)) >> sheet >> glass
    for name, port in (("above", "reflected"), ("below", "transmitted")):
        path[f"glass.{port}"] >> path.add(name, op.Detector())
    return path


def assert_equals_the_loop(path, axes, **fixed):
    """Every variable has the bits that a run for one point alone has."""
    found = path.sweep(**axes, **fixed)
    ends = found["detector"].values if "detector" in found.dims else [None]
    angles = ("Psi", "Delta") if "Psi" in found else ("psi", "delta")
    attributes = {
        **DERIVED,
        **{f"S{i}": f"S{i}" for i in range(4)},
        **{n: n.lower() for n in angles},
    }
    for point in product(*[range(len(values)) for values in axes.values()]):
        at = dict(zip(axes, point, strict=True))
        lights = path.trace_all(**{name: axes[name][i] for name, i in at.items()}, **fixed)
        for end in ends:
            part = found.isel(at) if end is None else found.isel(at).sel(detector=end)
            light = next(iter(lights.values())) if end is None else lights[end]
            for name, attribute in attributes.items():
                np.testing.assert_array_equal(part[name].values, getattr(light, attribute))


@settings(max_examples=5, deadline=None)
@given(seed=st.integers(0, 10_000))
def test_a_sweep_of_a_random_path_is_the_loop_over_single_runs(seed):
    draw = Draw(seed, arrays=False)
    path = draw.path()
    opened = [name for name, value in draw.values.items() if isinstance(value, float)][:3]
    axes = {name: np.array([1.0, 0.999]) * draw.values[name] for name in opened}
    fixed = {name: value for name, value in draw.values.items() if name not in axes}
    assert_equals_the_loop(path, axes, **fixed)


def test_any_sweep_is_the_loop_over_single_runs_and_axes_may_vary_together():
    axes = {"theta": np.linspace(0.0, 1.5, 4), "angle": np.linspace(-1.0, 1.0, 3)}
    assert_equals_the_loop(with_two_detectors(), axes)
    axes = {"wavelength": np.array([450e-9, 516e-9, 640e-9]), "phi": np.array([0.2, 0.9])}
    assert_equals_the_loop(op.load_preset("copper-gold-spectrum"), axes)
    # What is dark but for rounding has no polarisation.
    angles = np.array([0.0, np.pi / 4, np.pi / 2])
    path = op.Source() >> op.Polarizer(0.0) >> op.Polarizer(op.Parameter("angle")) >> op.Detector()
    assert np.isnan(path.sweep(angle=angles).DoP.values).tolist() == [False, False, True]
    assert_equals_the_loop(path, {"angle": angles})
    deltas, phis = np.linspace(0.1, 1.0, 5), np.linspace(0.3, 1.2, 5)
    found = NPGR.sweep(delta=deltas, phi=phis, rho=[0.1, 0.2], zip=("delta", "phi"))
    (together,) = set(found.S0.dims) - {"rho"}
    for place, (delta, phi) in enumerate(zip(deltas, phis, strict=True)):
        alone = NPGR.trace(delta=delta, phi=phi, rho=0.2)
        there = found.isel({together: place, "rho": 1})
        assert (there.S1, there.DoP) == (alone.S1, alone.dop)
    found = NPGR.sweep(filter=["none", "horizontal"], delta=[0.2, 0.9])
    alone = NPGR.trace(filter="horizontal", delta=0.9)
    assert found.S0.sel(filter="horizontal", delta=0.9) == alone.S0
    assert found["filter"].values.tolist() == ["none", "horizontal"]
    found = MALUS.sweep(angle=0.3)
    assert (found.S0.shape, found.S0, found.DoP) == ((), MALUS.trace(angle=0.3).S0, 1.0)


def owner(array):
    """Return the array that has the memory of a view."""
    return array if array.base is None else owner(array.base)


# The first times step by step, and later by a formula, which lays components otherwise.
@rows("path, names", 5 * [(MALUS, ["angle"])])
def test_components_are_views_of_one_array_that_cannot_be_written_to_and_a_deep_copy_can(
    path, names
):
    found = path.sweep(**dict.fromkeys(names, np.linspace(0.1, 1.0, 300)))
    assert owner(found.S0.values) is owner(found.S1.values)
    assert not found.S0.values.flags.writeable
    copied = found.copy(deep=True)
    for name in copied.data_vars:
        copied[name].values[0] = 0.0
        assert not copied[name].values[0].any()
    assert (found.S0.values > 0.0).all()


def test_an_axis_on_which_an_element_or_nothing_depends_costs_no_evaluation(monkeypatch):
    path, ran, lights = op.load_preset("npgr026"), {}, Answers.lights
    monkeypatch.setattr(Answers, "lights", lambda self, p: ran.update(p) or lights(self, p))
    path.sweep(delta=np.linspace(0.1, 1.0, 20), phi=np.linspace(0.1, 1.0, 30))
    counts = path.compose().evaluations(**ran)
    assert (counts["X1.reflected"], counts["X2.reflected"]) == (20, 30)
    ran.clear()
    NPGR.sweep(delta=DELTA, wavelength=IDLE)  # It is run at one value.
    assert np.broadcast_shapes(*map(np.shape, ran.values())) == (5, 1)


@pytest.mark.parametrize(
    ("engine", "dtype"),
    [
        *((engine, "float64") for engine in ENGINES if engine != "numba"),
        *(slow((engine, "float32")) for engine in ENGINES if engine != "numpy"),
        *(slow((engine, "float64")) for engine in ENGINES if engine == "numba"),
        ("numpy", "float32"),
        ("numpy", "longdouble"),
    ],
)
def test_every_engine_and_precision_gives_variables_of_that_precision(engine, dtype):
    composer = op.Composer(engine=engine, dtype=dtype)
    path = op.load_preset("npgr026")
    axes = {"delta": np.linspace(0.1, 1.0, 4), "phi": np.linspace(0.2, 1.1, 3)}
    found = path.sweep(**axes, composer=composer)
    light = composer.compose(path).run(delta=axes["delta"][:, None], phi=axes["phi"])
    assert {found[name].dtype.type for name in found.data_vars} == {np.dtype(dtype).type}
    np.testing.assert_array_equal(found.S1.values, light.S1)
    np.testing.assert_array_equal(found.DoP.values, light.dop)
    assert (found.attrs["engine"], found.attrs["dtype"]) == (engine, dtype)


def test_tolerances_what_is_not_read_and_faint_light_are_as_the_plan_has_them():
    composer, path = op.Composer(tolerance=0.01), NPGR.reading("intensity")
    deltas = np.linspace(0.0, 0.2, 5)
    found = path.sweep(delta=deltas, composer=composer)
    np.testing.assert_array_equal(found.S0.values, composer.compose(path).run(delta=deltas).S0)
    assert found.tolerance == 0.01
    found = path.sweep(delta=[0.1, 0.2], phi=[0.3, 0.4, 0.5])
    nan = [np.isnan(found[name].values).all() for name in ("S1", "DoP")]
    assert (nan, np.isnan(found.S0.values).any()) == ([True, True], False)
    assert found.unread == "NaN: S1, S2 and S3 at E, which reads S0"
    path = op.Source(1.0, [1, 0.5, 0, 0])
    for _ in range(3):
        path = path >> op.Attenuator(op.Parameter("t"))
    found = (path >> op.Detector()).sweep(t=[1e-200, 1e-100, 0.5])
    np.testing.assert_allclose(found.S0.values, [0.0, 1e-300, 0.125], rtol=1e-13)
    np.testing.assert_allclose(found.DoP.values, [np.nan, 0.5, 0.5], rtol=1e-15)


MANY = dict.fromkeys(("delta", "phi", "rho", "intensity"), np.linspace(0.1, 1.0, 1_000_000))
MANY["n1"] = 1.0 + MANY["delta"]


def test_what_no_sweep_can_be_of_is_refused_and_options_are_those_of_a_composer():
    for ask, told in (
        (lambda: NPGR.sweep(delta=[0.1, 2.5]), "delta"),
        (lambda: MALUS.sweep(angle=[0.1], composer=op.Composer(keep="all")), "leave keep out"),
        (lambda: MALUS.sweep(angle=[0.1], composer="numba"), "takes a Composer, not 'numba'"),
        (lambda: NPGR.sweep(**MANY), r"not 1e\+30 paths.*; give fewer values"),
        (lambda: NPGR.sweep(delta=DELTA, wavelength=WAVELENGTHS), "'wavelength' is unknown"),
        (lambda: MALUS.propagate(angle=(1, 0.1), engine="numpy"), "Composer.engine='numpy'.$"),
    ):
        with pytest.raises(op.errors.ParameterError, match=told):
            ask()
    with pytest.raises(op.errors.ParameterError, match="angel") as told:
        MALUS.sweep(angle=[0.1], engine="numpy", dtype="float32", angel=1)
    assert told.value.faults[1] == (
        "'engine' and 'dtype' are no parameters of the path; give "
        "composer=op.Composer(engine='numpy', dtype='float32')"
    )
    plain = op.Composer(engine="numpy", dtype="float32")
    assert MALUS.sweep(angle=[0.1], composer=plain).S0.dtype == "float32"


def test_more_than_is_free_is_one_sentence_and_a_run_takes_little_more_than_was_told(monkeypatch):
    axis, points = np.linspace(0.1, 1.0, 400), 400**2
    given = {"delta": axis[:, None], "phi": axis}
    for options in ({}, {"dtype": "float32"}, {"composing": "jones"}):
        plan = op.Composer(engine="numpy", **options).compose(op.load_preset("npgr026"))
        plan.run(**given)
        tracemalloc.start()
        plan.run(**given)
        _, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        assert peak / points <= 1.6 * memory_of.bytes_of_a_point(plan, points)
    monkeypatch.setattr(memory_of, "free_memory", lambda: 1_100_000_000)
    with pytest.raises(op.OptipathError) as told:
        NPGR.sweep(delta=np.linspace(0.1, 1.0, 1000), phi=np.linspace(0.1, 1.0, 100_000))
    assert str(told.value) == (
        "a sweep of 1,000 x 100,000 points needs 3.2 GB, and 1.1 GB is free; give chunks='auto' "
        "for Dask arrays, store='sweep.zarr' to keep it on disk, or fewer values"
    )


WAVELENGTHS = np.linspace(400e-9, 700e-9, 4)
DELTA = np.linspace(0.1, 1.4, 5)
GIVEN = ("--wavelength", "400 nm:700 nm:4")


IDLE = IdleValues(WAVELENGTHS * 1e9, "nm", WAVELENGTHS)


def assert_same_along(found, alone):
    assert dict(found.sizes) == {**alone.sizes, "wavelength": 4}
    for name, each in alone.data_vars.items():
        along = found[name].transpose("wavelength", *each.dims)
        assert all(one.to_numpy().tobytes() == each.to_numpy().tobytes() for one in along)


@pytest.mark.parametrize(
    ("chunks", "place"),
    slow_except([(None, 0), (2, -1)], [*product((None, 2, {"wavelength": 1}), (0, -1))]),
)
def test_all_is_the_same_along_an_idle_axis(chunks, place):
    given = {"delta": DELTA, "filter": np.array([0.3, 1.5])}
    axes = {"wavelength": IDLE, **given} if place == 0 else {**given, "wavelength": IDLE}
    found = NPGR.sweep(**axes, chunks=chunks)
    assert list(found.sizes)[place] == "wavelength"
    assert found.wavelength.attrs == {"long_name": "nothing depends on it", "units": "nm"}
    assert_same_along(found, NPGR.sweep(**given))


def test_all_is_the_same_along_an_idle_axis_to_the_last_bit_also_alone_or_zipped():
    found, alone = NPGR.sweep(wavelength=IDLE, delta=DELTA), NPGR.sweep(delta=DELTA)
    assert found.DoP[1:3, ::2].to_numpy().tolist() == [alone.DoP[::2].to_numpy().tolist()] * 2
    assert float(found.AoP[3, 4]) == float(alone.AoP[4])
    assert found.DoLP[:0].shape == (0, 5)
    angle = np.radians([30.0, 90.0])
    found = MALUS.sweep(wavelength=IDLE, angle=angle)
    assert_same_along(found, MALUS.sweep(angle=angle))
    assert np.isnan(found.DoP[:, 1]).all()
    assert_same_along(NPGR.sweep(wavelength=IDLE), NPGR.sweep())
    assert_same_along(NPGR.sweep(wavelength=IDLE, chunks=3).compute(), NPGR.sweep())
    found = NPGR.sweep(delta=DELTA[:4], wavelength=IDLE, zip=("delta", "wavelength"))
    assert dict(found.sizes) == {"delta_wavelength": 4}
    assert found.S0.to_numpy().tolist() == NPGR.sweep(delta=DELTA[:4]).S0.to_numpy().tolist()


def test_the_command_line_writes_it_in_every_form_and_in_tables(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    given = ["sweep", "npgr026", "--delta", "10:80:3", *GIVEN]
    alone, four = NPGR.sweep(delta="10 deg:80 deg:3"), [400.0, 500.0, 600.0, 700.0]
    told = "nothing in 'npgr026' depends on the wavelength; all is the same along it"
    for form in ("json", "csv", "nc", "zarr"):
        by = ["--scheduler", "synchronous"] if form in ("nc", "zarr") else []
        assert main([*given, "--out", f"a.{form}", *by]) == 0
        wrote = f"wrote a.{form}: 12 points (delta 3, wavelength 4)\n"
        assert capsys.readouterr() == (wrote, f"optipath: {told}\n")
    for opened in (xr.open_zarr("a.zarr"), xr.open_dataset("a.nc")):
        with opened as found:
            assert_same_along(found.load(), alone)
            assert found.wavelength.to_numpy().tolist() == four
            assert (found.delta.units, found.delta.values.tolist()) == ("deg", [10.0, 45.0, 80.0])
    laid_out = np.repeat(alone.S0.to_numpy(), 4).tolist()
    with (tmp_path / "a.csv").open(encoding="utf-8") as file:
        assert [float(row["S0"]) for row in csv.DictReader(file)] == laid_out
    found = json.loads((tmp_path / "a.json").read_bytes())
    assert found["axes"]["wavelength"] == {"unit": "nm", "values": four}
    stokes = np.array(found["detectors"]["E"]["stokes"])
    assert stokes[..., 0].ravel().tolist() == laid_out

    def lines_of(*line):
        assert main([*line, *GIVEN]) == 0
        return [line.split() for line in capsys.readouterr().out.splitlines()]

    monkeypatch.setenv("COLUMNS", "80")
    assert ["45", *["0.25"] * 4] in lines_of("sweep", "malus", "--angle", "0:90:3")
    lines = [
        line for line in lines_of("run", "malus") if {*line[:1]} & {"400", "500", "600", "700"}
    ]
    assert (len(lines), len({tuple(line[1:]) for line in lines})) == (4, 1)
    given = ["npgr026", "--tolerance", "0.1", "--reads", "intensity", "--rho", "0"]
    given += ["--filter", "horizontal", "--json", "--delta"]
    for angles, shape in (("10, 20", (2, 4)), ("10", (4,))):
        assert main(["sweep", *given, angles, *GIVEN]) == 0
        found = json.loads(capsys.readouterr().out)["tolerance"]["error"]
        assert np.shape(found) == shape
        assert np.ptp(found, axis=-1).max() == 0.0
    for line, told in (
        (["explain", "malus", *GIVEN], "--wavelength is given several values"),
        (["sweep", "malus", "--wavelength", "-400 nm:700 nm:4"], "wavelength"),
    ):
        assert main(line) == 2
        assert told in capsys.readouterr().err
