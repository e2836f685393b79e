"""Measurements that are kept chunk by chunk: the same bits whoever walks, and nothing lost."""

import os
import signal
import sys
import warnings
from functools import cache

import numpy as np
import pytest

pytest.importorskip("numba")
pytest.importorskip("zarr")
pytest.importorskip("distributed")

import distributed
import psutil
import xarray as xr

import optipath as op
from large_jobs import marked
from optipath import surfaces
from optipath.errors import JobError, MissingExtraError, StoreWarning
from optipath.surfaces.energy_shares import processors
from optipath.surfaces.hemisphere import chunks as of_job
from optipath.surfaces.hemisphere.beam import SensedBeam
from optipath.surfaces.hemisphere.chunks import ChunkJob
from small_chunks import CHUNK, PLACES, SmallChunks
from tables import rows, slow

SAMPLE = op.Sample([(1.5, 0.3)], cells=200, surfaces=2)
SENSOR = surfaces.Sensor(16, parts=3)
PHOTONS = 3 * CHUNK + 700


@pytest.fixture(autouse=True)
def small_chunks(monkeypatch):
    for place in PLACES:
        monkeypatch.setattr(place, CHUNK)


@pytest.fixture
def store(tmp_path):
    return tmp_path / "hemisphere.zarr"


@pytest.fixture
def walked(monkeypatch):
    """The numbers of the chunks that are walked."""
    found, compute = [], ChunkJob.compute

    def told(job, number):
        found.append(number)
        return compute(job, number)

    monkeypatch.setattr(ChunkJob, "compute", told)
    return found


def measured(sample=SAMPLE, photons=PHOTONS, **options):
    return op.measure(sample, "50 deg", photons, sensor=SENSOR, **options)


@cache
def alone(polarized="both"):
    """What a measurement is that is not kept."""
    return measured(polarized=polarized)


def assert_same_bits(found, expected):
    for here, there in zip(found.parts, expected.parts, strict=True):
        assert here.tobytes() == there.tobytes()


@rows(
    "number, polarized, options, threads",
    [
        (0, "both", {}, processors()),
        (1, "scalar", {"scheduler": "synchronous"}, processors()),
        (2, "scalar", {"scheduler": "threads"}, 1),
        (3, "both", {"scheduler": "threads", "threads": 3}, 3),
        (4, "both", {"threads": 3}, 3),
    ],
)
def test_what_is_kept_has_the_bits_of_what_is_not_and_a_chunk_has_all_threads_if_walked_alone(
    tmp_path, number, polarized, options, threads
):
    seen, chunk = [], SensedBeam.chunk

    def told(beam, number, photons, threads):
        seen.append(threads)
        return chunk(beam, number, photons, threads)

    expected = alone(polarized)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(SensedBeam, "chunk", told)
        found = measured(store=tmp_path / f"{number}.zarr", polarized=polarized, **options)
    assert seen == [threads] * 4
    assert_same_bits(found, expected)


def test_heights_that_are_given_travel_along_and_a_coarse_mesh_is_told_where_it_is_asked_for(
    store, rng
):
    heights = surfaces.HeightField.from_heights(rng.normal(size=(40, 40)), 20.0, periodic=True)
    sample = op.Sample([(1j, heights)])
    assert_same_bits(measured(sample, store=store, scheduler="threads"), measured(sample))
    coarse = op.Sample([(1.5, 0.3)], cells=100, surfaces=1)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("default")
        op.measure(
            coarse,
            "50 deg",
            100,
            sensor=4,
            store=store.with_name("coarse.zarr"),
            scheduler="threads",
        )
    assert told[0].filename == __file__


def test_an_interrupted_run_goes_on_from_there_and_what_is_there_is_not_walked_again(store, walked):
    def stopped(done, _):
        if done == 2 * CHUNK:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        measured(store=store, progress=stopped)
    assert walked == [0, 1]
    for symmetric in (None, False):
        assert_same_bits(measured(store=store, symmetric=symmetric), alone())
        assert walked == [0, 1, 2, 3]


def test_a_store_is_what_xarray_opens_and_one_of_another_measurement_is_left_alone(store, walked):
    told = []
    found = measured(store=store, progress=lambda *how: told.append(how))
    assert told == [(min(CHUNK * done, PHOTONS), PHOTONS) for done in range(5)]
    with xr.open_zarr(store) as kept:
        assert np.array_equal(kept.counts.sum("chunk"), found.parts.counts)
        assert np.array_equal(sum(kept.sums.values, np.zeros(())), found.parts.sums)
        assert kept.number.values[[0, 1, 16]].tolist() == ["M00", "M01", "scalar"]
    sample = op.Sample([(1.6, 0.3)], cells=200, surfaces=2)
    for options, line in (
        ({"seed": 1}, "it has 'seed: 0', where this one has 'seed: 1'"),
        ({"photons": PHOTONS + CHUNK}, "it has 'photons: 49852', where this one has"),
        ({"sample": sample}, r"it has 'base n: \[1.5\]'"),
    ):
        with pytest.raises(JobError, match=rf"e.zarr' holds blocks of another job: {line}"):
            measured(store=store, **options)
    del walked[:]
    assert_same_bits(measured(store=store), alone())
    assert walked == []
    # A damaged chunk is named, and walked once more.
    file = store / "sums" / "2.1.0.0.0.0.0"
    content = bytearray(file.read_bytes())
    content[-1] ^= 1
    file.write_bytes(content)
    with pytest.warns(StoreWarning, match=r"^1 of . blocks of '.*hemisphere.zarr' are damaged"):
        assert_same_bits(measured(store=store), alone())
    assert walked == [2]


@rows(
    "options, told",
    [
        ({"store": "a.nc"}, "store 'a.nc' is no Zarr store; give a name that ends in .zarr, such"),
        ({"store": ".zarr"}, "such as 'hemisphere.zarr'"),
        ({"store": 3}, "3 is no name of a file"),
        ({"scheduler": "threads"}, "scheduler= is for a measurement that is kept; give store="),
    ],
)
def test_what_is_no_store_or_scheduler_is_told_with_all_other_faults(options, told):
    with pytest.raises(op.errors.SurfaceError, match="photons") as error:
        measured(photons=0, **options)
    assert told in "\n".join(error.value.faults)


def test_what_a_store_needs_is_named_before_photons_are_walked(store, walked):
    for package in ("zarr", "dask", "distributed"):
        with pytest.MonkeyPatch.context() as patch:
            patch.setitem(sys.modules, package, None)
            with pytest.raises(MissingExtraError, match=rf"need {package}.*optipath\[sweep\]"):
                measured(store=store)
            assert not walked
            measured(photons=CHUNK)


def test_a_worker_of_another_version_is_refused(monkeypatch):
    monkeypatch.setattr(of_job, "measuring_code", lambda: "0.1, old")
    job = ChunkJob(None, None, 1, code="0.2, new")
    with pytest.raises(
        op.errors.SurfaceError, match=r"worker has optipath 0.1, old.* begun by 0.2, new"
    ):
        job.compute(0)


@pytest.mark.slow
def test_chunks_as_large_as_they_are_have_the_same_bits(store, monkeypatch):
    monkeypatch.undo()
    photons = 2 * (1 << 22) + 5
    found = measured(photons=photons, store=store, scheduler="processes")
    assert marked(store) == {0, 1, 2}
    assert_same_bits(found, measured(photons=photons))


@pytest.mark.parametrize("chunks", [slow(6), slow(24)])  # Of sweeps, one is quick.
def test_a_worker_that_is_killed_loses_nothing(store, chunks):
    photons = chunks * CHUNK
    expected = measured(photons=photons)
    here = {"host": "127.0.0.1", "dashboard_address": None, "silence_logs": "CRITICAL"}
    here["scheduler_kwargs"] = {"dashboard_address": "127.0.0.1:0"}
    with (
        distributed.LocalCluster(2, threads_per_worker=1, memory_limit="1GiB", **here) as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
    ):
        client.register_plugin(SmallChunks())
        victim, *_ = client.run(os.getpid).values()

        def kill(done, _):
            if done == chunks // 3 * CHUNK:
                os.kill(victim, signal.SIGKILL)

        found = measured(photons=photons, store=store, scheduler=client, progress=kill)
        assert not psutil.pid_exists(victim)
    assert marked(store) == {*range(chunks)}
    assert_same_bits(found, expected)
