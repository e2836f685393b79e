"""Sweeps that are kept in a Zarr store or a file of NetCDF, and go on where they stopped."""

import os
import pickle
import shutil
import subprocess
import sys

import numpy as np
import pytest
import xarray as xr

import optipath as op
from optipath.errors import JobError
from optipath.sweeps.axes.read_axes import grid_of
from optipath.sweeps.chunked.in_chunks import swept_in_chunks
from optipath.sweeps.kept.sweep_block import SweepBlock
from optipath.sweeps.kept.sweep_job import SweepJob
from tables import rows

pytest.importorskip("zarr")
pytest.importorskip("h5netcdf")
pytest.importorskip("dask")
ANGLES = np.linspace(0.0, 1.5, 11)
DELTAS = np.linspace(0.1, 1.4, 4)


def path():
    return (
        op.Source(3.0)
        >> op.Interface(op.Parameter("n"), op.Parameter("delta"))
        >> op.Polarizer(op.Parameter("angle"))
        >> op.Detector()
    )


def swept(**given):
    return path().sweep(**{"delta": DELTAS, "angle": ANGLES, "n": 1.5, **given})


def kept(store, **given):
    return swept(**{"store": store, "chunks": {"delta": 2, "angle": 5}, **given})


@pytest.fixture(params=["sweep.zarr", "sweep.nc"])
def store(request, tmp_path):
    return tmp_path / request.param


@pytest.fixture
def computed(monkeypatch):
    """The numbers of the blocks that are computed."""
    numbers, compute = [], SweepBlock.compute

    def counted(job, number):
        numbers.append(number)
        return compute(job, number)

    monkeypatch.setattr(SweepBlock, "compute", counted)
    return numbers


def assert_same_bits(found, expected):
    assert {*found.variables} == {*expected.variables}
    assert found.attrs == expected.attrs
    for name, each in expected.variables.items():
        assert (found[name].dims, found[name].attrs) == (each.dims, each.attrs)
        assert found[name].to_numpy().tobytes() == each.to_numpy().tobytes()


def test_what_is_kept_is_the_sweep_in_memory_and_opened_when_it_is_there(store, computed):
    found = kept(str(store))
    assert_same_bits(found, swept())
    assert found.S0.chunks == ((2, 2), (5, 5, 1))
    assert sorted(computed) == list(range(6))
    assert_same_bits(kept(store), swept())
    assert len(computed) == 6


@pytest.mark.slow
@pytest.mark.parametrize("scheduler", ["synchronous", "threads"])
def test_what_any_scheduler_keeps_is_the_sweep_in_memory(store, scheduler):
    assert_same_bits(kept(store, scheduler=scheduler), swept())


@pytest.mark.skipif(np.longdouble == np.float64, reason="longdouble is float64 here")
def test_a_precision_that_stores_do_not_have_is_refused(store):
    with pytest.raises(op.ParameterError, match="stores have no numbers of dtype 'longdouble'"):
        kept(store, composer=op.Composer(dtype="longdouble"))
    assert not store.exists()


def test_what_was_interrupted_goes_on_where_it_stopped(store, monkeypatch, computed):
    compute = SweepBlock.compute

    def interrupted(job, number):
        if number == 4:
            raise KeyboardInterrupt
        return compute(job, number)

    with monkeypatch.context() as patch:
        patch.setattr(SweepBlock, "compute", interrupted)
        with pytest.raises(KeyboardInterrupt):
            kept(store, scheduler="synchronous")
    assert sorted(computed) == [0, 1, 2, 3]
    assert_same_bits(kept(store), swept())
    assert sorted(computed) == list(range(6))


def test_another_sweep_at_the_same_place_is_refused_and_nothing_is_changed(store):
    kept(store)
    others = [{"n": 1.6}, {"delta": DELTAS + 1e-15}, {"chunks": 3}]
    for other in (*others, {"composer": op.Composer(dtype="float32")}):
        with pytest.raises((JobError, op.ParameterError), match=store.name):
            kept(store, **other)
    assert_same_bits(kept(store), swept())


def test_what_is_no_sweep_is_refused_and_left_alone(store, tmp_path):
    store.write_text("mine")
    with pytest.raises((JobError, op.ParameterError), match="is there"):
        kept(store)
    assert store.read_text() == "mine"
    os.mkfifo(tmp_path / "pipe.nc")
    (tmp_path / "device.nc").symlink_to("/dev/zero")
    for name in ("pipe.nc", "device.nc"):
        with pytest.raises(op.ParameterError, match=rf"{name}' is there already, and is no file"):
            kept(tmp_path / name)


def test_the_store_beside_a_file_is_gone_when_the_file_is_there_and_the_users_own_stays(tmp_path):
    kept(tmp_path / "sweep.nc.zarr")
    kept(tmp_path / "sweep.nc")
    assert {each.name for each in tmp_path.iterdir()} == {"sweep.nc", "sweep.nc.zarr"}
    assert_same_bits(kept(tmp_path / "sweep.nc.zarr"), swept())


def test_a_file_that_cannot_be_written_whole_is_not_there(tmp_path, monkeypatch):
    def fails(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(xr.Dataset, "to_netcdf", fails)
    with pytest.raises(OSError, match="No space"):
        kept(tmp_path / "sweep.nc")
    assert [each.name for each in tmp_path.iterdir()] == [".sweep.nc.blocks"]


def test_a_file_that_came_to_be_there_meanwhile_is_left_alone(tmp_path, monkeypatch):
    file, compute = tmp_path / "sweep.nc", SweepBlock.compute

    def beside(job, number):
        file.write_text("mine")
        return compute(job, number)

    monkeypatch.setattr(SweepBlock, "compute", beside)
    with pytest.raises(op.ParameterError, match="is there already"):
        kept(file)
    assert file.read_text() == "mine"
    assert {each.name for each in tmp_path.iterdir()} == {"sweep.nc", ".sweep.nc.blocks"}


def test_two_runs_of_one_sweep_come_to_one_file(tmp_path, monkeypatch):
    file, compute = tmp_path / "sweep.nc", SweepBlock.compute

    def faster(job, number):
        with monkeypatch.context() as patch:
            patch.setattr(SweepBlock, "compute", compute)
            assert_same_bits(kept(file), swept())
        return compute(job, number)

    monkeypatch.setattr(SweepBlock, "compute", faster)
    assert_same_bits(kept(file, scheduler="synchronous"), swept())
    assert [each.name for each in tmp_path.iterdir()] == ["sweep.nc"]


@pytest.mark.parametrize(
    "place", [0.01, *(pytest.param(place, marks=pytest.mark.slow) for place in (0, 0.05, 0.3))]
)
def test_a_file_with_other_bytes_within_is_told_and_left_alone(tmp_path, place):
    file, angles = tmp_path / "sweep.nc", np.linspace(0.0, 1.5, 1000)
    op.load_preset("malus").sweep(angle=angles, store=file).close()
    content = bytearray(file.read_bytes())
    start = int(place * len(content))
    content[start : start + 2000] = b"x" * 2000
    file.write_bytes(content)
    program = (
        "import numpy as np; import optipath as op; angles = np.linspace(0.0, 1.5, 1000); "
        "op.load_preset('malus').sweep(angle=angles, store='sweep.nc').close()"
    )
    ended = subprocess.run(  # Since HDF5 itself may abort at such a file, and its process with it.
        [sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert ended.returncode <= 0 or "\noptipath.errors." in ended.stderr
    assert file.read_bytes() == content


def test_a_store_of_no_known_form_is_refused_with_one_that_is():
    for store in ("sweep.csv", "sweep", "", 3, True):
        with pytest.raises(op.ParameterError, match=r"ends in \.zarr or \.nc, such as '.+\.zarr'"):
            kept(store)
    for store in (".zarr", ".nc"):
        with pytest.raises(op.ParameterError, match=r"such as 'sweep\.zarr'"):
            kept(store)


def test_what_was_kept_lends_its_axes_in_their_order(store):
    kept(store)
    opened = xr.open_zarr(store) if store.suffix == ".zarr" else xr.open_dataset(store)
    with opened:
        for given in (opened, opened.S0):
            assert path().sweep(coords=given).S0.dims == ("delta", "angle")


@pytest.mark.filterwarnings("ignore:Consolidated metadata")
def test_what_was_kept_can_be_written_elsewhere_in_any_version(tmp_path):
    found = kept(tmp_path / "a.zarr")
    for version in (2, 3):
        copy = tmp_path / f"{version}.zarr"
        found.to_zarr(copy, zarr_format=version)
        assert_same_bits(xr.open_zarr(copy), swept())


@rows(
    "given, told",
    [
        ({"scheduler": "threads"}, "scheduler= is for"),
        ({"progress": True}, "progress= is for"),
        ({"scheduler": "threads", "progress": True, "chunks": 2}, "scheduler= and progress= are"),
    ],
)
def test_what_is_for_stores_is_not_ignored_without_one(given, told):
    with pytest.raises(op.ParameterError, match=told):
        swept(**given)


def test_a_bar_ends_with_all_blocks(store, capsys):
    kept(store, progress=True, scheduler="synchronous")
    shown = capsys.readouterr().err
    assert shown.startswith(f"[{' ' * 40}] 0 of 6 blocks\r")
    assert shown.endswith(f"[{'#' * 40}] 6 of 6 blocks\n")


def test_a_store_that_was_moved_is_still_the_sweep_of_numbers_of_numpy_and_of_python(
    tmp_path, computed
):
    kept(tmp_path / "a.zarr")
    kept(tmp_path / "a.zarr", n=np.float64(1.5), delta=DELTAS.tolist())
    shutil.move(tmp_path / "a.zarr", tmp_path / "b.zarr")
    assert_same_bits(kept(tmp_path / "b.zarr"), swept())
    assert len(computed) == 6


def test_several_detectors_are_kept(store):
    path = op.PathGraph()
    path.add("lamp", op.Source(2.0)) >> path.add("half", op.BeamSplitter(op.Parameter("share")))
    for port in ("reflected", "transmitted"):
        path.add(port, op.Detector())
        path.connect(f"half.{port}", f"{port}.in")
    found = path.sweep(share=[0.1, 0.2, 0.3], store=store, chunks=2)
    assert found.detector.values.tolist() == ["reflected", "transmitted"]
    assert found.S0.dims == ("detector", "share")
    assert np.array_equal(found.S0, path.sweep(share=[0.1, 0.2, 0.3]).S0)


def job_of(chunks=4, **given):
    path = op.load_preset("npgr026")
    plan = path.compose()
    axes = {"delta": np.linspace(0.0, 1.0, 10), "phi": np.linspace(0.0, 1.0, 6)}
    grid = grid_of(plan.inputs, {**axes, **given})
    return SweepJob.of(swept_in_chunks(path, plan, grid, chunks))


def test_blocks_are_disjoint_and_cover_the_grid():
    job, seen = job_of(), np.zeros((10, 6), int)
    for number in range(job.blocks):
        seen[job.region(number)] += 1
    assert job.blocks == 6
    assert np.all(seen == 1)


def test_a_block_has_every_variable_in_its_part():
    job = job_of()
    found = job.compute(5)
    assert found.keys() == job.arrays.keys()
    for region, values in found.values():
        assert region == (slice(8, 10), slice(4, 6))
        assert values.shape == (2, 2)


def test_a_job_that_was_pickled_is_the_same():
    job = job_of()
    there = pickle.loads(pickle.dumps(job))
    assert there.identity == job.identity
    assert there.compute(2)["S1"][1].tobytes() == job.compute(2)["S1"][1].tobytes()


def test_the_same_values_have_one_identity():
    assert job_of(n1=0.2).identity == job_of(n1=np.float64(0.2)).identity


@rows(
    "other",
    [
        {"n1": 0.2 + 1e-15},
        {"phi": np.nextafter(np.linspace(0.0, 1.0, 6), 2.0)},
        {"phi": np.degrees(np.linspace(0.0, 1.0, 6)).tolist()},
        {"chunks": 5},
        {"filter": "vertical"},
    ],
)
@pytest.mark.filterwarnings("ignore::optipath.AngleWarning")
def test_whatever_changes_the_bits_is_another_identity(other):
    if isinstance(other.get("phi"), list):
        other = {"phi": [f"{value} deg" for value in other["phi"]]}
    assert job_of(**{"n1": 0.2, **other}).identity != job_of(n1=0.2).identity


def test_one_value_in_two_units_is_two_sweeps():
    assert job_of(rho="10 deg").identity != job_of(rho=np.radians(10.0)).identity
    assert job_of(rho=0.5).identity == job_of(rho=np.array(0.5)).identity


def test_the_first_line_that_differs_says_what_is_another():
    lines = zip(*(job_of(n1=n).identity.splitlines() for n in (0.2, 0.3)), strict=True)
    assert [pair for pair in lines if pair[0] != pair[1]] == [("fixed n1: 0.2", "fixed n1: 0.3")]


def test_a_block_is_sent_without_the_axes_of_the_others():
    angle = np.linspace(0.0, 1.0, 20_000)
    path = op.load_preset("malus")
    plan = path.compose()
    grid = grid_of(plan.inputs, {"angle": angle})
    job = SweepJob.of(swept_in_chunks(path, plan, grid, 100))
    whole, part = (len(pickle.dumps(each)) for each in (job, job.part(7)))
    assert whole > angle.nbytes
    assert part < angle.nbytes / 10
    (region,), numbers = job.part(7).compute(7)["S0"]
    assert region == slice(700, 800)
    assert numbers.tolist() == path.sweep(angle=angle[region]).S0.values.tolist()
