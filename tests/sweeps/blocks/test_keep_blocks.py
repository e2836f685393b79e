"""Blocks that are kept: what is computed, by whom, and what is told of it."""

import threading

import numpy as np
import pytest

pytest.importorskip("zarr")
pytest.importorskip("distributed")

import xarray as xr

import optipath as op
from large_jobs import Powers, computed, marked, powers
from optipath.errors import JobError
from optipath.sweeps.blocks.block_store import BlockStore
from optipath.sweeps.blocks.executors import AtOnce
from optipath.sweeps.blocks.keep_blocks import _handed_out, _keep_block, keep_blocks
from optipath.sweeps.blocks.workers import Workers
from tables import rows


@pytest.fixture
def log(tmp_path):
    return tmp_path / "log"


@pytest.fixture
def store(tmp_path):
    return tmp_path / "powers.zarr"


@rows("scheduler", [None, "synchronous", "threads"])
def test_all_blocks_are_computed_once_and_kept(store, log, scheduler):
    assert keep_blocks(Powers(7, str(log)), store, scheduler) == store
    assert sorted(computed(log)) == list(range(7))
    with xr.open_zarr(store) as found:
        assert np.array_equal(found.power, powers(7))
        assert np.array_equal(found.total, powers(7).reshape(7, -1).sum(axis=1))


def test_a_store_is_a_dataset_with_names_and_units_and_without_the_record(store):
    keep_blocks(Powers(3), store)
    with xr.open_zarr(store) as found:
        assert {*found.data_vars} == {"power", "total"}
        assert {*found.coords} == {"number", "called"}
        assert found.power.dims == ("number", "exponent")
        assert found.power.attrs == {"units": "1", "long_name": "power"}
        assert found.number.attrs == {"units": "m"}
        assert found.called.values.tolist() == ["itself", "square", "cube"]
        assert found.attrs == {"path": "[vertices]\n", "title": "powers"}
        assert found.power.dtype == "float64"
        assert found.total.dtype == "int64"


def test_what_is_not_done_yet_is_nan(store):
    with pytest.raises(op.ValueFault):
        keep_blocks(Powers(3, fails_at=1), store, "synchronous")
    with xr.open_zarr(store) as found:
        assert np.isnan(found.power).values.sum() == 2 * powers(1).size


def test_an_error_of_a_block_comes_out_as_it_is_and_finished_blocks_stay(store, log):
    with pytest.raises(op.ValueFault, match="block 4 is dark"):
        keep_blocks(Powers(7, str(log), fails_at=4), store, "synchronous")
    assert marked(store) == {0, 1, 2, 3}
    keep_blocks(Powers(7, str(log)), store, "synchronous")
    assert computed(log) == [0, 1, 2, 3, 4, 4, 5, 6]


def test_an_error_of_a_block_travels_as_a_value_since_clusters_log_what_is_raised(store):
    job = Powers(2, fails_at=1)
    fault = _keep_block(job, BlockStore.of(job, store), 1)
    assert isinstance(fault, op.ValueFault)
    assert str(fault) == "block 1 is dark"


def test_an_error_in_a_thread_ends_the_job(store, log):
    with pytest.raises(op.ValueFault, match="block 4 is dark"):
        keep_blocks(Powers(500, str(log), fails_at=4), store, "threads")
    assert len(computed(log)) < 50


@rows("scheduler", ["synchronous", "threads"])
def test_who_interrupts_keeps_what_is_done(store, log, scheduler):
    def interrupt(done, _):
        if done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        keep_blocks(Powers(40, str(log)), store, scheduler, interrupt)
    before = marked(store)
    assert 3 <= len(before) < 40
    already = len(computed(log))
    keep_blocks(Powers(40, str(log)), store, scheduler)
    assert sorted(computed(log)[already:]) == sorted({*range(40)} - before)


def test_progress_is_told_from_what_was_done_to_the_end(store):
    told = []
    with pytest.raises(op.ValueFault):
        keep_blocks(Powers(4, fails_at=2), store, "synchronous", lambda *how: told.append(how))
    keep_blocks(Powers(4), store, "synchronous", lambda *how: told.append(how))
    assert told == [(0, 4), (1, 4), (2, 4), (2, 4), (3, 4), (4, 4)]
    keep_blocks(Powers(4), store, "synchronous", lambda *how: told.append(how))
    assert told[6:] == [(4, 4)]


class Counting(AtOnce):
    """Counts what it is given."""

    given = 0

    def submit(self, fn, /, *args, **kwargs):
        self.given += 1
        return super().submit(fn, *args, **kwargs)


def test_no_more_is_handed_out_than_there_may_be_at_a_time(store):
    executor, job = Counting(), Powers(20)
    found = _handed_out(job, BlockStore.of(job, store), [*range(20)], Workers(executor, lambda: 6))
    ahead = [executor.given - place for place, _ in enumerate(found)]
    assert ahead[0] == 6
    assert max(ahead) == 6
    assert executor.given == 20


def test_two_runs_at_a_time_come_to_the_same_bits(store):
    runs = [
        threading.Thread(target=keep_blocks, args=(Powers(30, slow=0.002), store)) for _ in "ab"
    ]
    for run in runs:
        run.start()
    for run in runs:
        run.join()
    assert marked(store) == {*range(30)}
    with xr.open_zarr(store) as found:
        assert np.array_equal(found.power, powers(30))


@rows(
    "scheduler, told",
    [
        ("thread", "scheduler 'thread' is unknown; did you mean 'threads'"),
        ("10.0.0.1:8786", "the address of a cluster begins with 'tcp://'"),
        (4, "not 4; of a cluster, give cluster.get_client"),
        ("tcpp://127.0.0.1:1", "no cluster answers at 'tcpp://127.0.0.1:1'"),
    ],
)
def test_what_is_no_scheduler_is_told(store, scheduler, told):
    with pytest.raises(JobError, match=told):
        keep_blocks(Powers(2), store, scheduler)
    assert not store.exists()


def test_nobody_answers_at_a_dead_address(store, monkeypatch):
    monkeypatch.setattr("optipath.sweeps.blocks.cluster._PATIENCE", 0.2)
    with pytest.raises(JobError, match=r"no cluster answers at 'tcp://127.0.0.1:1'.*runs"):
        keep_blocks(Powers(2), store, "tcp://127.0.0.1:1")


def test_after_an_interrupt_the_blocks_that_came_to_their_end_are_counted(tmp_path):
    told, store = [], tmp_path / "powers.zarr"

    def progress(done, _):
        told.append(done)
        if len(told) == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        keep_blocks(Powers(40, slow=0.05), store, "threads", progress)
    assert told[-1] == len(marked(store)) > told[-2]


def test_an_address_that_wants_certificates_is_told(tmp_path):
    with pytest.raises(JobError, match=r"tls://.* give a client that has the certificates"):
        keep_blocks(Powers(2), tmp_path / "powers.zarr", "tls://127.0.0.1:9")
