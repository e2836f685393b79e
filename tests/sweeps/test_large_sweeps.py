"""A sweep on a real cluster: the same bits, and no block lost with a worker."""

import os
import signal

import numpy as np
import psutil
import pytest

pytest.importorskip("zarr")
pytest.importorskip("distributed")

import distributed

import optipath as op
from optipath.sweeps.kept.sweep_block import SweepBlock

GOLD = {"n1": 0.18, "k1": 3.4, "n2": 0.18, "k2": 3.4, "filter": "horizontal"}
AXES = {
    "delta": np.linspace(0.01, 1.5, 40),
    "rho": np.linspace(0.0, 3.1, 50),
    "phi": np.linspace(0.01, 1.5, 50),
}
CHUNKS = {"delta": 4, "rho": -1, "phi": -1}


@pytest.fixture(scope="module")
def client():
    with (
        distributed.LocalCluster(
            n_workers=2,
            threads_per_worker=1,
            memory_limit="2GiB",
            host="127.0.0.1",
            dashboard_address=None,
            silence_logs="CRITICAL",
            scheduler_kwargs={"dashboard_address": "127.0.0.1:0"},
        ) as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
    ):
        yield client


@pytest.fixture(scope="module")
def alone():
    return swept().compute()


def swept(**options):
    return op.load_preset("npgr026").sweep(**AXES, **GOLD, **options)


def assert_same_bits(found, expected):
    for name, each in expected.data_vars.items():
        assert found[name].to_numpy().tobytes() == each.to_numpy().tobytes()


def test_a_cluster_keeps_the_bits_of_one_process(tmp_path, client, alone):
    found = swept(store=tmp_path / "sweep.zarr", chunks=CHUNKS, scheduler=client)
    assert_same_bits(found, alone)


def test_a_cluster_computes_dask_arrays_without_a_change(client, alone):
    with client.as_current():
        found = swept(chunks=CHUNKS)[["S0", "Delta"]].compute()
    assert_same_bits(found, alone[["S0", "Delta"]])


def test_a_worker_that_dies_takes_no_block_with_it(tmp_path, client, alone):
    victims = [*client.run(os.getpid).values()]

    def tell(done, _):
        if done == 3:
            os.kill(victims[0], signal.SIGKILL)

    found = swept(store=tmp_path / "sweep.zarr", chunks=CHUNKS, scheduler=client, progress=tell)
    assert not psutil.pid_exists(victims[0])
    assert_same_bits(found, alone)


def test_what_cluster_began_another_scheduler_goes_on_with(tmp_path, client, alone, monkeypatch):
    store, computed, compute = tmp_path / "sweep.zarr", [], SweepBlock.compute

    def stopped(done, _):
        if done == 4:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        swept(store=store, chunks=CHUNKS, scheduler=client, progress=stopped)
    there = {each.stem for each in (store / "blocks" / "done").glob("*.0")}

    def counted(job, number):
        computed.append(str(number))
        return compute(job, number)

    monkeypatch.setattr(SweepBlock, "compute", counted)
    found = swept(store=store, chunks=CHUNKS, scheduler="synchronous")
    assert len(there) >= 4
    assert not there & {*computed}
    assert_same_bits(found, alone)
