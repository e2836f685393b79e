"""Blocks that are kept by clusters, of which workers die, and by runs that are killed."""

import os
import signal
import subprocess
import sys
import time
from multiprocessing import resource_tracker
from multiprocessing.resource_tracker import ResourceTracker
from pathlib import Path

import numpy as np
import psutil
import pytest

pytest.importorskip("zarr")
pytest.importorskip("distributed")

import distributed
import xarray as xr

import optipath as op
from large_jobs import Powers, WhoComputes, computed, marked, powers
from optipath.errors import JobError
from optipath.sweeps.blocks.cluster import _interrupts_put_off
from optipath.sweeps.blocks.keep_blocks import keep_blocks

TESTS = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def client():
    """Two processes of one thread, which nannies start again when they die."""
    with (
        distributed.LocalCluster(
            n_workers=2,
            threads_per_worker=1,
            host="127.0.0.1",
            dashboard_address=None,
            silence_logs="CRITICAL",
            scheduler_kwargs={"allowed_failures": 1, "dashboard_address": "127.0.0.1:0"},
        ) as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
    ):
        yield client


@pytest.fixture
def log(tmp_path):
    return tmp_path / "log"


@pytest.fixture
def store(tmp_path):
    return tmp_path / "powers.zarr"


def holds_powers(store, blocks):
    with xr.open_zarr(store) as found:
        return np.array_equal(found.power, powers(blocks)) and marked(store) == {*range(blocks)}


def test_a_cluster_computes_every_block_once(store, log, client):
    told = []
    keep_blocks(Powers(9, str(log)), store, client, lambda *how: told.append(how))
    assert holds_powers(store, 9)
    assert sorted(computed(log)) == list(range(9))
    assert told == [(done, 9) for done in range(10)]


def test_the_address_of_a_cluster_is_enough(store, client):
    keep_blocks(Powers(3), store, client.scheduler.address)
    assert holds_powers(store, 3)


def test_the_client_that_is_active_is_taken(store, client, monkeypatch):
    monkeypatch.setattr(distributed, "default_client", lambda: client)
    keep_blocks(WhoComputes(3), store)
    with xr.open_zarr(store) as found:
        pids = {*found.power.values.ravel().astype(int)}
    assert pids <= {*client.run(os.getpid).values()}


def test_an_error_of_a_block_comes_from_a_cluster_as_it_is(store, client):
    with pytest.raises(op.ValueFault, match="block 1 is dark"):
        keep_blocks(Powers(3, fails_at=1), store, client)
    keep_blocks(Powers(3), store, client)
    assert holds_powers(store, 3)


def test_a_worker_that_dies_loses_nothing(store, log, client):
    def kill(done, _):
        if done == 5:
            pid = next(iter(client.run(os.getpid).values()))
            os.kill(pid, signal.SIGKILL)

    keep_blocks(Powers(20, str(log), slow=0.02), store, client, kill)
    assert holds_powers(store, 20)
    assert 20 <= len(computed(log)) <= 22


def test_a_block_that_kills_its_workers_is_told_and_the_others_stay(store, log, client):
    with pytest.raises(JobError, match=r"block . was lost again and again.* start again"):
        keep_blocks(Powers(12, str(log), kills_at=8), store, client)
    kept = marked(store)
    assert kept
    client.wait_for_workers(2)
    already = len(computed(log))
    keep_blocks(Powers(12, str(log)), store, client)
    assert holds_powers(store, 12)
    # What a worker was at when the job ended may have been finished.
    assert kept.isdisjoint(computed(log)[already:])


def test_a_job_that_a_worker_cannot_load_is_told(store, client):
    # The module of a test, as pytest imports it, is there in its own process alone.
    class Elsewhere(Powers):
        pass

    Elsewhere.__module__, Elsewhere.__qualname__ = "elsewhere", "Elsewhere"
    sys.modules["elsewhere"] = type(sys)("elsewhere")
    sys.modules["elsewhere"].Elsewhere = Elsewhere
    with pytest.raises(JobError, match="a worker cannot load the job: No module named 'elsewhere'"):
        keep_blocks(Elsewhere(2), store, client)
    del sys.modules["elsewhere"]


def test_a_job_with_long_axes_is_sent_without_a_warning(store, client):
    keep_blocks(Powers(2, axis=b"p" * 12_000_000), store, client)
    assert holds_powers(store, 2)


def test_a_cluster_that_is_lost_is_told_and_finished_blocks_stay(store):
    options = {"processes": False, "dashboard_address": None, "silence_logs": "CRITICAL"}
    with (
        distributed.LocalCluster(
            n_workers=1, scheduler_kwargs={"dashboard_address": "127.0.0.1:0"}, **options
        ) as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
        pytest.raises(JobError, match=r"the cluster was lost.*; start again when it is back"),
    ):
        keep_blocks(
            Powers(40, slow=0.02), store, client, lambda *how: how[0] == 5 and cluster.close()
        )
    assert 5 <= len(marked(store)) < 40


def test_a_closed_client_is_told(store, client):
    closed = distributed.Client(client.scheduler.address, set_as_default=False)
    closed.close()
    with pytest.raises(JobError, match="client of the cluster is closed; give one that is conn"):
        keep_blocks(Powers(3), store, closed)


def test_a_cluster_itself_is_no_scheduler(store, client):
    with pytest.raises(JobError, match=r"give cluster.get_client\(\)"):
        keep_blocks(Powers(3), store, client.cluster)


def test_processes_are_of_this_machine_and_gone_afterwards(store, log):
    seen = set()

    def look(*_):
        own = [psutil.Process(), *psutil.Process().children(recursive=True)]
        ports = [each for process in own for each in process.net_connections("inet")]
        seen.update(each.laddr.ip for each in ports if each.status == "LISTEN")

    before = {each.pid for each in psutil.Process().children(recursive=True)}
    keep_blocks(Powers(5, str(log)), store, "processes", look)
    assert holds_powers(store, 5)
    assert seen == {"127.0.0.1"}
    left = [each for each in psutil.Process().children(recursive=True) if each.pid not in before]
    assert [each for each in left if "resource_tracker" not in " ".join(each.cmdline())] == []


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no masks of signals")
def test_processes_that_are_started_never_hear_ctrl_c(monkeypatch):
    tracker = ResourceTracker()  # As if none had been started, which lets signals through.
    monkeypatch.setattr(resource_tracker, "ensure_running", tracker.ensure_running)
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [])
    with _interrupts_put_off():
        tracker.ensure_running()
        assert signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, [])
    assert signal.pthread_sigmask(signal.SIG_BLOCK, []) == before
    tracker._stop()


RUN = """
import sys
from large_jobs import Powers
from optipath.sweeps.blocks.keep_blocks import keep_blocks
if __name__ == "__main__":
    keep_blocks(Powers(30, sys.argv[1], slow=0.05), sys.argv[2], sys.argv[3])
"""


@pytest.mark.parametrize("scheduler", ["threads", "processes"])
def test_a_run_that_is_killed_goes_on_where_it_was(tmp_path, store, log, scheduler):
    script = tmp_path / "run.py"
    script.write_text(RUN)
    places = os.pathsep.join([str(TESTS), os.environ.get("PYTHONPATH", "")])
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
