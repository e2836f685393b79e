"""Sweeps that are kept in a Zarr store or a file of NetCDF, and go on where they stopped."""

import os
import pickle
import shutil
import subprocess
import sys
from unittest.mock import Mock

import numpy as np
import pytest
import xarray as xr

import optipath as op
from optipath.errors import JobError
from optipath.sweeps import stored
from optipath.sweeps.axes import grid_of
from optipath.sweeps.stored import SweepJob
from tables import slow

pytest.importorskip("zarr")
pytest.importorskip("h5netcdf")
pytest.importorskip("dask")
ENGINES = {".zarr": "zarr", ".nc": "h5netcdf"}
ANGLES = np.linspace(0.0, 1.5, 11)
DELTAS = np.linspace(0.1, 1.4, 4)


LIT = op.Source(3.0) >> op.Interface(op.Parameter("n"), op.Parameter("delta"))
PATH = LIT >> op.Polarizer(op.Parameter("angle")) >> op.Detector()
COMPUTE = stored.compute_block


def swept(**given):
    return PATH.sweep(**{"delta": DELTAS, "angle": ANGLES, "n": 1.5, **given})


def kept(store, **given):
    return swept(**{"store": store, "chunks": {"delta": 2, "angle": 5}, **given})


@pytest.fixture(params=["sweep.zarr", "sweep.nc"])
def store(request, tmp_path):
    return tmp_path / request.param


@pytest.fixture
def computed(monkeypatch):
    """The numbers of the blocks that are computed."""
    numbers = []
    monkeypatch.setattr(stored, "compute_block", lambda *a: numbers.append(a[0]) or COMPUTE(*a))
    return numbers


def assert_same_bits(found, expected):
    assert {*found.variables} == {*expected.variables}
    assert found.attrs == expected.attrs
    for name, each in expected.variables.items():
        assert (found[name].dims, found[name].attrs) == (each.dims, each.attrs)
        assert found[name].to_numpy().tobytes() == each.to_numpy().tobytes()


def test_what_is_kept_is_the_sweep_in_memory_and_opened_when_it_is_there(store, computed, capsys):
    found = kept(str(store), progress=True, scheduler="synchronous")
    shown = capsys.readouterr().err
    assert shown.startswith(f"[{' ' * 40}] 0 of 6 blocks\r")
    assert shown.endswith(f"[{'#' * 40}] 6 of 6 blocks\n")
    assert_same_bits(found, swept())
    assert found.S0.chunks == ((2, 2), (5, 5, 1))
    assert sorted(computed) == list(range(6))
    assert_same_bits(kept(store), swept())
    assert len(computed) == 6
    # It lends its axes in their order.
    with xr.open_dataset(store, engine=ENGINES[store.suffix]) as opened:
        for given in (opened, opened.S0):
            assert PATH.sweep(coords=given).S0.dims == ("delta", "angle")
    path = op.PathGraph()
    path.add("lamp", op.Source(2.0)) >> path.add("half", op.BeamSplitter(op.Parameter("share")))
    for port in ("reflected", "transmitted"):
        path[f"half.{port}"] >> path.add(port, op.Detector())
    found = path.sweep(share=[0.1, 0.2, 0.3], store=store.with_stem("several"), chunks=2)
    assert found.detector.values.tolist() == ["reflected", "transmitted"]
    assert found.S0.dims == ("detector", "share")
    assert np.array_equal(found.S0, path.sweep(share=[0.1, 0.2, 0.3]).S0)


@pytest.mark.parametrize("store", [slow("sweep.zarr"), "sweep.nc"], indirect=True)
def test_what_was_interrupted_goes_on_where_it_stopped(store, computed):
    def interrupted(done, _):
        if done == 4:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        kept(store, scheduler="synchronous", progress=interrupted)
    assert sorted(computed) == [0, 1, 2, 3]
    assert_same_bits(kept(store), swept())
    assert sorted(computed) == list(range(6))


@pytest.mark.parametrize("store", ["sweep.zarr", slow("sweep.nc")], indirect=True)
def test_another_sweep_at_the_same_place_is_refused_and_nothing_is_changed(store):
    kept(store, scheduler="threads")
    others = [{"n": 1.6}, {"delta": DELTAS + 1e-15}, {"chunks": 3}]
    for other in (*others, {"composer": op.Composer(dtype="float32")}):
        with pytest.raises((JobError, op.errors.ParameterError), match=store.name):
            kept(store, **other)
    assert_same_bits(kept(store), swept())


@pytest.mark.parametrize("store", [slow("sweep.zarr"), "sweep.nc"], indirect=True)
def test_what_is_no_sweep_is_refused_and_left_alone(store, tmp_path, monkeypatch):
    def mine(*given):
        file.write_text("mine")
        return COMPUTE(*given)

    store.write_text("mine")
    with pytest.raises((JobError, op.errors.ParameterError), match="is there"):
        kept(store)
    os.mkfifo(tmp_path / "pipe.nc")
    (tmp_path / "device.nc").symlink_to("/dev/zero")
    for name in ("pipe.nc", "device.nc"):
        with pytest.raises(
            op.errors.ParameterError, match=rf"{name}' is there already, and is no file"
        ):
            kept(tmp_path / name)
    # What came to be there meanwhile, too.
    file = tmp_path / "folder" / "sweep.nc"
    file.parent.mkdir()
    monkeypatch.setattr(stored, "compute_block", mine)
    with pytest.raises(op.errors.ParameterError, match="is there already"):
        kept(file)
    assert file.read_text() == store.read_text() == "mine"
    assert {each.name for each in file.parent.iterdir()} == {"sweep.nc", ".sweep.nc.blocks"}


def test_a_file_is_there_whole_or_not_at_all_and_two_runs_come_to_one(tmp_path, monkeypatch):
    def faster(*given):
        with monkeypatch.context() as patch:
            patch.setattr(stored, "compute_block", COMPUTE)
            assert_same_bits(kept(tmp_path / "sweep.nc"), swept())
        return COMPUTE(*given)

    kept(tmp_path / "sweep.nc.zarr")
    with monkeypatch.context() as patch:
        patch.setattr(stored, "compute_block", faster)
        assert_same_bits(kept(tmp_path / "sweep.nc", scheduler="synchronous"), swept())
    assert {each.name for each in tmp_path.iterdir()} == {"sweep.nc", "sweep.nc.zarr"}
    assert_same_bits(kept(tmp_path / "sweep.nc.zarr"), swept())  # The user's own store stays.
    (tmp_path / "full").mkdir()
    full = Mock(side_effect=OSError(28, "No space left on device"))
    monkeypatch.setattr(xr.Dataset, "to_netcdf", full)
    with pytest.raises(OSError, match="No space"):
        kept(tmp_path / "full" / "sweep.nc")
    assert [each.name for each in (tmp_path / "full").iterdir()] == [".sweep.nc.blocks"]


PROGRAM = """
import numpy as np; import optipath as op
op.load_preset('malus').sweep(angle=np.linspace(0.0, 1.5, 1000), store='sweep.nc').close()
"""


@pytest.mark.parametrize("place", [0.01, *map(slow, (0, 0.05, 0.3))])
def test_a_file_with_other_bytes_within_is_told_and_left_alone(tmp_path, place, monkeypatch):
    monkeypatch.chdir(tmp_path)
    exec(PROGRAM)  # noqa: S102 - of this file
    content = bytearray((tmp_path / "sweep.nc").read_bytes())
    start = int(place * len(content))
    content[start : start + 2000] = b"x" * 2000
    (tmp_path / "sweep.nc").write_bytes(content)
    # HDF5 itself may abort at such a file, and its process with it.
    program, pipes = [sys.executable, "-c", PROGRAM], {"capture_output": True, "text": True}
    again = subprocess.run(program, check=False, **pipes)
    assert again.returncode <= 0 or "\noptipath.errors." in again.stderr
    assert (tmp_path / "sweep.nc").read_bytes() == content


def test_what_stores_have_not_or_is_for_them_alone_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    long = op.Composer(dtype="longdouble")
    named = ("sweep.csv", "sweep", "", 3, True, ".zarr", ".nc", "s3://b/a.nc")
    for given, told in (
        ({"scheduler": "threads"}, "scheduler= and progress= are"),
        ({"progress": True, "chunks": 2}, "scheduler= and progress= are"),
        *(({"store": store}, r"ends in \.zarr.*, such as 'sweep\.zarr'") for store in named),
        *(
            ({"store": f"sweep.{form}", "composer": long}, "stores have no numbers of dtype 'long")
            for form in ("zarr", "nc")
            if np.longdouble != np.float64
        ),
    ):
        with pytest.raises(op.errors.ParameterError, match=told):
            swept(**given)
    assert not [*tmp_path.iterdir()]


@pytest.mark.filterwarnings("ignore:Consolidated metadata")
def test_a_store_that_was_moved_or_written_elsewhere_is_still_the_sweep(tmp_path, computed):
    found = kept(tmp_path / "a.zarr")
    for version in (2, 3):
        copy = tmp_path / f"{version}.zarr"
        found.to_zarr(copy, zarr_format=version)
        assert_same_bits(xr.open_zarr(copy), swept())
    # Numbers of NumPy and of Python are the same.
    kept(tmp_path / "a.zarr", n=np.float64(1.5), delta=DELTAS.tolist())
    shutil.move(tmp_path / "a.zarr", tmp_path / "b.zarr")
    assert_same_bits(kept(tmp_path / "b.zarr"), swept())
    assert len(computed) == 6


def job_of(chunks=4, preset="npgr026", **given):
    path = op.load_preset(preset)
    plan = path.compose()
    axes = {"delta": np.linspace(0.0, 1.0, 10), "phi": np.linspace(0.0, 1.0, 6)}
    grid = grid_of(plan.inputs, {**(axes if preset == "npgr026" else {}), **given})
    return SweepJob.of(path, plan, grid, chunks)


def test_blocks_cover_the_grid_have_every_variable_and_are_the_same_when_pickled():
    job, seen = job_of(), np.zeros((10, 6), int)
    for number in range(job.blocks):
        seen[job.regions[number]] += 1
    assert job.blocks == 6
    assert np.all(seen == 1)
    found = job.task(5)()
    assert found.keys() == job.chunks.keys() == job.places(5).keys()
    assert [*job.places(5).values()] == [(slice(8, 10), slice(4, 6))] * len(found)
    assert {each.shape for each in found.values()} == {(2, 2)}
    there = pickle.loads(pickle.dumps(job))
    assert there.identity == job.identity
    assert there.task(2)()["S1"].tobytes() == job.task(2)()["S1"].tobytes()
    # One is sent without the axes of the others.
    angle = np.linspace(0.0, 1.0, 20_000)
    job = job_of(100, "malus", angle=angle)
    whole, part = (len(pickle.dumps(each)) for each in (job, job.task(7)))
    assert part < angle.nbytes / 10 < angle.nbytes < whole
    (region,), numbers = job.places(7)["S0"], job.task(7)()["S0"]
    assert region == slice(700, 800)
    assert numbers.tolist() == op.load_preset("malus").sweep(angle=angle[region]).S0.values.tolist()


@pytest.mark.filterwarnings("ignore::optipath.errors.AngleWarning")
def test_whatever_changes_the_bits_or_the_units_is_another_identity_and_its_line_says_what():
    six, given = np.linspace(0.0, 1.0, 6), {"n1": 0.2, "rho": 0.5}
    identity = job_of(**given).identity
    assert identity == job_of(n1=np.float64(0.2), rho=np.array(0.5)).identity
    for other in (
        {"n1": 0.2 + 1e-15},
        {"rho": f"{np.degrees(0.5)} deg"},
        {"phi": np.nextafter(six, 2.0)},
        {"phi": [f"{value} deg" for value in np.degrees(six)]},
        {"chunks": 5},
        {"filter": "vertical"},
    ):
        assert job_of(**given | other).identity != identity
    lines = zip(*(job_of(n1=n).identity.splitlines() for n in (0.2, 0.3)), strict=True)
    assert [pair for pair in lines if pair[0] != pair[1]] == [("fixed n1: 0.2", "fixed n1: 0.3")]
