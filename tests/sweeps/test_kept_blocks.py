"""Blocks that are kept, by threads, processes and clusters, of which workers die."""

import os
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from unittest.mock import Mock

import distributed
import numpy as np
import psutil
import pytest
import xarray as xr
from dask.local import SynchronousExecutor

import optipath as op
from large_jobs import Powers, WhoComputes, computed, marked, powers
from optipath.errors import JobError
from optipath.sweeps import stored
from optipath.sweeps.blocks import Workers, _handed_out, _keep_block, keep_blocks
from optipath.sweeps.store import BlockStore
from tables import slow

pytest.importorskip("zarr")
pytest.importorskip("distributed")


@pytest.fixture
def log(tmp_path):
    return tmp_path / "log"


@pytest.fixture
def store(tmp_path):
    return tmp_path / "powers.zarr"


def when(count, act):
    """Progress that has something done at a number of blocks."""
    return lambda done, _: act() if done == count else None


def holds_powers(store, blocks):
    with xr.open_zarr(store) as found:
        whole = powers(blocks)
        assert np.array_equal(found.power, whole)
        assert np.array_equal(found.total, whole.reshape(blocks, -1).sum(axis=1))
    return marked(store) == {*range(blocks)}


def test_all_blocks_are_computed_once_and_kept_as_a_dataset_without_the_record(tmp_path):
    for scheduler in (None, "synchronous", "threads"):
        log, store = tmp_path / f"{scheduler} log", tmp_path / f"{scheduler}.zarr"
        keep_blocks(Powers(7, str(log)), store, scheduler)
        assert sorted(computed(log)) == list(range(7))
        assert holds_powers(store, 7)
    with xr.open_zarr(store) as found:
        assert ({*found.data_vars}, {*found.coords}) == ({"power", "total"}, {"number", "called"})
        assert found.power.dims == ("number", "exponent")
        assert found.power.attrs == {"units": "1", "long_name": "power"}
        assert found.number.attrs == {"units": "m"}
        assert found.called.values.tolist() == ["itself", "square", "cube"]
        assert found.attrs == {"path": "[vertices]\n", "title": "powers"}
        assert (found.power.dtype, found.total.dtype) == ("float64", "int64")


def test_an_error_of_a_block_comes_out_as_it_is_and_finished_blocks_stay(tmp_path, store, log):
    with pytest.raises(op.errors.ValueFault, match="block 4 is dark"):
        keep_blocks(Powers(7, str(log), fails_at=4), store, "synchronous")
    assert marked(store) == {0, 1, 2, 3}
    with xr.open_zarr(store) as found:
        assert np.isnan(found.power).values.sum() == 3 * powers(1).size
    keep_blocks(Powers(7, str(log)), store, "synchronous")
    assert computed(log) == [0, 1, 2, 3, 4, 4, 5, 6]
    # It travels as a value, since clusters log what is raised.
    job = Powers(2, fails_at=1)
    other = BlockStore.of(job, str(tmp_path / "other.zarr"))
    fault = _keep_block(job.task(1), other, 1, job.places(1))
    assert repr(fault) == repr(op.errors.ValueFault("block 1 is dark"))
    # In a thread it ends the job.
    log, store = tmp_path / "log of threads", tmp_path / "threads.zarr"
    with pytest.raises(op.errors.ValueFault, match="block 4 is dark"):
        keep_blocks(Powers(500, str(log), fails_at=4), store, "threads")
    assert len(computed(log)) < 50


def test_progress_is_told_to_the_end_and_who_interrupts_keeps_what_is_done(store, tmp_path):
    told = []
    for job in (Powers(4, fails_at=2), Powers(4), Powers(4)):
        with suppress(op.errors.ValueFault):
            keep_blocks(job, store, "synchronous", lambda *how: told.append(how))
    assert told == [(0, 4), (1, 4), (2, 4), (2, 4), (3, 4), (4, 4), (4, 4)]
    for scheduler in ("synchronous", "threads"):
        log, store, told = tmp_path / f"{scheduler} log", tmp_path / f"{scheduler}.zarr", []

        def progress(done, _, told=told):
            told.append(done)
            if len(told) == 4:
                raise KeyboardInterrupt

        with pytest.raises(KeyboardInterrupt):
            keep_blocks(Powers(40, str(log), slow=0.02), store, scheduler, progress)
        before = marked(store)
        assert 3 <= len(before) == told[-1] < 40
        assert told[-1] > told[-2] or scheduler == "synchronous"
        already = len(computed(log))
        keep_blocks(Powers(40, str(log)), store, scheduler)
        assert sorted(computed(log)[already:]) == sorted({*range(40)} - before)


@pytest.mark.slow
def test_not_too_much_is_handed_out_and_two_runs_come_to_the_same_bits(tmp_path, store):
    executor, job = Mock(wraps=SynchronousExecutor()), Powers(20)
    found = _handed_out(
        job, BlockStore.of(job, str(store)), [*range(20)], Workers(executor, lambda: 6)
    )
    ahead = [executor.submit.call_count - place for place, _ in enumerate(found)]
    assert (ahead[0], max(ahead), executor.submit.call_count) == (6, 6, 20)
    job, store = Powers(30, slow=0.002), tmp_path / "both.zarr"
    with ThreadPoolExecutor(2) as executor:
        assert len([*executor.map(keep_blocks, [job] * 2, [store] * 2)]) == 2
    assert holds_powers(store, 30)


def test_what_is_no_scheduler_or_does_not_answer_is_told(store, monkeypatch):
    monkeypatch.setattr("optipath.sweeps.blocks._PATIENCE", 0.2)
    for scheduler, told in {
        "thread": "scheduler 'thread' is unknown; did you mean 'threads'",
        "10.0.0.1:8786": "the address of a cluster begins with 'tcp://'",
        4: "not 4; of a cluster, give cluster.get_client",
        "tcpp://127.0.0.1:1": "no cluster answers at 'tcpp://127.0.0.1:1'",
        "tcp://127.0.0.1:1": r"no cluster answers at 'tcp://127.0.0.1:1'.*runs",
        "tls://127.0.0.1:9": r"tls://.* certificates, give a distributed.Client",
    }.items():
        with pytest.raises(JobError, match=told):
            keep_blocks(Powers(2), store, scheduler)
    assert not store.exists()


QUIET = {"dashboard_address": None, "silence_logs": "CRITICAL"}


@pytest.fixture(scope="module")
def cluster_client():
    """Two processes of one thread, which nannies start again when they die."""
    scheduler = {"allowed_failures": 1, "dashboard_address": "127.0.0.1:0"}
    options = {"n_workers": 2, "threads_per_worker": 1, "host": "127.0.0.1"}
    with (
        distributed.LocalCluster(**options, **QUIET, scheduler_kwargs=scheduler) as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
    ):
        yield client


@pytest.fixture
def client(cluster_client):
    """The cluster with both its workers, whoever died in the test before."""
    cluster_client.wait_for_workers(2, timeout=120)
    return cluster_client


def killing_one(client):
    """Progress that ends a worker at five blocks; its process."""
    victim = next(iter(client.run(os.getpid).values()))
    return when(5, lambda: os.kill(victim, signal.SIGKILL)), victim


def test_a_cluster_computes_every_block_once_and_tells_an_error(tmp_path, store, log, client):
    told = []
    keep_blocks(Powers(9, str(log)), store, client, lambda *how: told.append(how))
    assert holds_powers(store, 9)
    assert sorted(computed(log)) == list(range(9))
    assert told == [(done, 9) for done in range(10)]
    store = tmp_path / "dark.zarr"
    with pytest.raises(op.errors.ValueFault, match="block 1 is dark"):
        keep_blocks(Powers(3, fails_at=1), store, client)
    # Its address is enough.
    keep_blocks(Powers(3), store, client.scheduler.address)
    assert holds_powers(store, 3)


def test_the_active_client_is_taken_and_who_dies_loses_nothing(store, log, client, monkeypatch):
    keep_blocks(Powers(20, str(log), slow=0.02), store, client, killing_one(client)[0])
    assert holds_powers(store, 20)
    assert 20 <= len(computed(log)) <= 22
    client.wait_for_workers(2, timeout=120)
    monkeypatch.setattr(distributed, "default_client", lambda: client)
    found = keep_blocks(WhoComputes(3), store.with_name("who.zarr")).arrays
    pids = {*found["power"][...].ravel().astype(int)}
    assert pids <= {*client.run(os.getpid).values()}


def test_a_block_that_kills_its_workers_is_told_and_the_others_stay(store, log, client):
    with pytest.raises(
        JobError, match=r"a process was lost while block \d+ was computed.* start again"
    ):
        keep_blocks(Powers(12, str(log), kills_at=8), store, client)
    kept = marked(store)
    assert kept
    client.wait_for_workers(2, timeout=120)
    already = len(computed(log))
    keep_blocks(Powers(12, str(log)), store, client)
    assert holds_powers(store, 12)
    # What a worker was at when the job ended may have been finished.
    assert kept.isdisjoint(computed(log)[already:])


def test_a_job_that_no_worker_can_load_is_told_and_a_long_one_sent(store, client, monkeypatch):
    # The module of a test, as pytest imports it, is there in its own process alone.
    class Elsewhere(Powers):
        pass

    Elsewhere.__module__, Elsewhere.__qualname__ = "elsewhere", "Elsewhere"
    monkeypatch.setitem(sys.modules, "elsewhere", type(sys)("elsewhere"))
    sys.modules["elsewhere"].Elsewhere = Elsewhere
    with pytest.raises(JobError, match="a worker cannot load the job: No module named 'elsewhere'"):
        keep_blocks(Elsewhere(2), store, client)
    # One with long axes is sent without a warning.
    keep_blocks(Powers(2, axis=b"p" * 12_000_000), store, client)
    assert holds_powers(store, 2)


def test_a_lost_cluster_a_closed_client_and_a_cluster_itself_are_told(store, client):
    options = {"n_workers": 1, "processes": False, **QUIET}
    options["scheduler_kwargs"] = {"dashboard_address": "127.0.0.1:0"}
    with (
        distributed.LocalCluster(**options) as cluster,
        distributed.Client(cluster, set_as_default=False) as lost,
        pytest.raises(JobError, match=r"the cluster was lost.*; start again when it is back"),
    ):
        keep_blocks(Powers(40, slow=0.02), store, lost, when(5, cluster.close))
    assert 5 <= len(marked(store)) < 40
    closed = distributed.Client(client.scheduler.address, set_as_default=False)
    closed.close()
    for scheduler, told in ((closed, "cluster is closed; give one"), (client.cluster, r"get_clie")):
        with pytest.raises(JobError, match=told):
            keep_blocks(Powers(40), store, scheduler)


def test_processes_are_of_this_machine_and_gone_afterwards(store, log):
    own = psutil.Process()
    before = {*own.children(recursive=True)}
    keep_blocks(Powers(5, str(log)), store, "processes")
    assert holds_powers(store, 5)
    with pytest.raises(JobError, match="a process was lost while block"):
        keep_blocks(Powers(5, kills_at=3), store.with_name("killed.zarr"), "processes")
    left = {*own.children(recursive=True)} - before
    assert not [each for each in left if "resource_tracker" not in " ".join(each.cmdline())]


RUN = """
import sys
from large_jobs import Powers
from optipath.sweeps.blocks import keep_blocks
if __name__ == "__main__":
    keep_blocks(Powers(30, sys.argv[1], slow=0.05), sys.argv[2], sys.argv[3])
"""


@pytest.mark.parametrize("scheduler", ["threads", slow("processes")])
def test_a_run_that_is_killed_goes_on_where_it_was(tmp_path, store, log, scheduler):
    script = tmp_path / "run.py"
    script.write_text(RUN)
    places = os.pathsep.join([str(Path(__file__).parents[1]), os.environ.get("PYTHONPATH", "")])
    run = subprocess.Popen(
        [sys.executable, script, log, store, scheduler],
        env={**os.environ, "PYTHONPATH": places},
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    while len(computed(log)) < 6:
        time.sleep(0.01)
        assert run.poll() is None
    os.killpg(run.pid, signal.SIGKILL)
    run.wait()
    kept, already = marked(store), len(computed(log))
    assert 0 < len(kept) < 30
    keep_blocks(Powers(30, str(log)), store)
    assert holds_powers(store, 30)
    assert sorted(computed(log)[already:]) == sorted({*range(30)} - kept)


GOLD = {"n1": 0.18, "k1": 3.4, "n2": 0.18, "k2": 3.4, "filter": "horizontal"}
AXES = {"delta": np.linspace(0.01, 1.5, 40), "rho": np.linspace(0.0, 3.1, 20)}
AXES["phi"] = np.linspace(0.01, 1.5, 20)
CHUNKS = {"delta": 4, "rho": -1, "phi": -1}


def swept(**options):
    return op.load_preset("npgr026").sweep(**AXES, **GOLD, **options)


def assert_same_bits(found, expected):
    for name, each in expected.data_vars.items():
        assert found[name].to_numpy().tobytes() == each.to_numpy().tobytes()


@pytest.mark.slow
def test_a_cluster_keeps_the_bits_of_one_process_though_a_worker_dies(tmp_path, client):
    given, alone = {"chunks": CHUNKS, "scheduler": client}, swept()
    assert_same_bits(swept(store=tmp_path / "sweep.zarr", **given), alone)
    kill, victim = killing_one(client)
    found = swept(store=tmp_path / "other.zarr", **given, progress=kill)
    assert not psutil.pid_exists(victim)
    assert_same_bits(found, alone)
    with client.as_current():
        found = swept(chunks=CHUNKS)[["S0", "Delta"]].compute()
    assert_same_bits(found, alone[["S0", "Delta"]])


@pytest.mark.slow
def test_what_cluster_began_another_scheduler_goes_on_with(tmp_path, client, monkeypatch):
    given, computed = {"store": tmp_path / "sweep.zarr", "chunks": CHUNKS}, []
    with pytest.raises(KeyboardInterrupt):
        swept(**given, scheduler=client, progress=when(4, Mock(side_effect=KeyboardInterrupt)))
    there, compute = marked(given["store"]), stored.compute_block
    monkeypatch.setattr(stored, "compute_block", lambda *a: computed.append(a[0]) or compute(*a))
    found = swept(**given, scheduler="synchronous")
    assert len(there) >= 4
    assert not there & {*computed}
    assert_same_bits(found, swept())
