"""The store of a job: what stands in its place is left alone, and what cannot be is told."""

import os
import shutil
from unittest.mock import Mock

import numpy as np
import pytest

pytest.importorskip("zarr")

import xarray as xr
import zarr

import optipath as op
from large_jobs import Powers, computed, marked, powers
from optipath.errors import JobError, StoreWarning
from optipath.sweeps import store as block_store
from optipath.sweeps.blocks import keep_blocks
from tables import rows, slow


@pytest.fixture
def store(tmp_path):
    return tmp_path / "powers.zarr"


def content_of(place):
    """Every file beneath a place, or at it, with what is in it."""
    files = [place] if place.is_file() else sorted(place.rglob("*"))
    return {file: file.read_bytes() for file in files if file.is_file()}


def refused(store, told):
    """Nothing of what is there is changed."""
    before = content_of(store)
    with pytest.raises(JobError, match=told):
        keep_blocks(Powers(2), store)
    assert content_of(store) == before


def record_with(store, **changed):
    """Have a job kept, and something else said of it in its store."""
    keep_blocks(Powers(2), store).group["blocks"].attrs.update(changed)


@rows(
    "put, told",
    [
        (lambda store: keep_blocks(Powers(2, title="other"), store), "it has 'other', where this"),
        (lambda store: keep_blocks(Powers(3), store), "'blocks = 3', where this one has 'blocks ="),
        (
            lambda store: record_with(store, format=1),
            "it has 'format 1', where this one has 'format 3'",
        ),
        (
            lambda store: record_with(store, format=4),
            "it has 'format 4', where this one has 'format 3'",
        ),
        (lambda store: record_with(store, lines=3), r"the record of '.*' is damaged; take"),
        (lambda store: (store / "thesis").mkdir(parents=True), "is there, and is no store of blo"),
        (lambda store: store.write_text("x"), "is there, and is no folder; take another name"),
    ],
)
def test_what_stands_in_the_place_is_told_and_left_as_it_is(store, put, told):
    put(store)
    refused(store, told)
    store.unlink() if store.is_file() else shutil.rmtree(store)


def other_beside(file):
    """What lies beside it: each chunk, and each mark, is whole, and in a wrong place."""
    content = file.read_bytes()
    others = (each for each in sorted(file.parent.iterdir()) if each.name[0] != ".")
    return next(each for each in others if each.read_bytes() != content)


def flip(file):
    content = file.read_bytes()
    middle = len(content) // 2
    file.write_bytes(content[:middle] + bytes([content[middle] ^ 16]) + content[middle + 1 :])


DAMAGES = [
    lambda file: file.write_bytes(b""),
    flip,
    lambda file: file.write_bytes(file.read_bytes()[: file.stat().st_size // 2]),
    lambda file: file.write_bytes(other_beside(file).read_bytes()),
    lambda file: file.write_bytes(b"[" * 100_000),
]


def test_a_damaged_block_is_computed_anew_and_no_other(store, tmp_path):
    job, count = Powers(3, log=str(tmp_path / "log")), 0
    keep_blocks(job, store, "synchronous")
    before = content_of(store)
    for name in ("power/3.0", "total/1"):
        for harm in DAMAGES:
            harm(store / name)
            count += 1
            with pytest.warns(StoreWarning, match=r"1 of 3 blocks of '.*' are damaged and comp"):
                keep_blocks(job, store, "synchronous")
            assert computed(tmp_path / "log") == [0, 1, 2, *[1] * count]
            assert content_of(store) == before
    (store / "power" / "3.0").unlink()
    with pytest.warns(StoreWarning, match=r"1 of 3 blocks of '.*' are damaged"):
        keep_blocks(job, store, "synchronous")
    assert content_of(store) == before
    keep_blocks(job, store, "synchronous")
    assert computed(tmp_path / "log") == [0, 1, 2, *[1] * count, 1]


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("step", [slow(3), 41])
def test_whatever_bit_of_a_block_is_lost_no_wrong_number_is_taken(store, step):
    job = Powers(2)
    keep_blocks(job, store)
    # A lost mark is a block that is not done, and no damage.
    (store / "blocks" / "done" / "0.0").unlink()
    whole = xr.open_zarr(store).load()
    done = store / "blocks" / "done" / "1.0"
    mark = done.read_bytes()
    for file in (done, store / "power" / "2.0", store / "power" / "3.0", store / "total" / "1"):
        content = file.read_bytes()
        for place in range(0, 8 * len(content), step):  # It has no factor in common with 8.
            damaged = bytearray(content)
            damaged[place // 8] ^= 1 << place % 8
            file.write_bytes(damaged)
            if block_store.BlockStore.of(job, str(store)).done(job):
                with xr.open_zarr(store) as found:
                    assert found.identical(whole), (file, place)
            file.write_bytes(content)
            done.write_bytes(mark)


def test_a_block_of_another_job_is_none(store, tmp_path):
    keep_blocks(Powers(3), store)
    other = tmp_path / "others.zarr"
    keep_blocks(Powers(2, title="others"), other)
    shutil.copy(other / "blocks" / "done" / "1.0", store / "blocks" / "done")
    with pytest.warns(StoreWarning, match="1 of 3 blocks"):
        keep_blocks(Powers(3), store)


def test_metadata_that_cannot_be_read_are_told_and_attributes_may_be_added(store):
    keep_blocks(Powers(2), store)
    for name in (".zmetadata", "blocks/.zattrs"):
        content = (store / name).read_bytes()
        (store / name).write_bytes(b"[")
        refused(store, r"metadata.* of the store '.*' are damaged; take another name, or del")
        (store / name).write_bytes(content)
    zarr.open_group(store, mode="r+", use_consolidated=False).attrs["note"] = "mine"
    keep_blocks(Powers(2), store)


@rows("name", ["power/0.0", "power/.zarray", "blocks/done/1.0", "number/0", ".zattrs"])
def test_a_pipe_or_a_device_in_a_store_is_not_waited_for(store, name):
    keep_blocks(Powers(2), store)
    for make in (os.mkfifo, lambda file: file.symlink_to("/dev/zero")):
        (store / name).unlink()
        make(store / name)
        refused(store, f"{name}' is there, and is no file; take another name, or delete it")
    shutil.rmtree(store)


def test_damaged_coordinates_are_told(store):
    keep_blocks(Powers(2), store)
    for name in ("number/0", "called/0"):
        content = (store / name).read_bytes()
        (store / name).unlink()
        refused(store, f"'{name[:-2]}' of the store '.*' is damaged; take another name, or delete")
        (store / name).write_bytes(content)
    zarr.open_group(store, mode="r+", use_consolidated=False)["number"][1] = 7.0
    refused(store, "'number' of the store '.*' is damaged")


def test_a_store_goes_into_an_empty_folder_and_stays_where_a_block_is_done(tmp_path, store):
    with pytest.raises(JobError, match=r"there is no folder '.*nowhere' for a store; make it"):
        keep_blocks(Powers(2), tmp_path / "nowhere" / "a.zarr")
    assert not [*tmp_path.iterdir()]
    (tmp_path / "empty").mkdir()
    keep_blocks(Powers(2), tmp_path / "empty")
    assert marked(tmp_path / "empty") == {0, 1}

    def fails_at(number):
        with pytest.raises(op.errors.ValueFault):
            keep_blocks(Powers(3, fails_at=number), store, "synchronous")

    fails_at(0)
    assert not store.exists()
    fails_at(1)
    assert marked(store) == {0}
    for mark in (store / "blocks" / "done").glob("0*"):
        mark.unlink()
    fails_at(0)
    assert store.exists()


def test_a_store_may_be_at_a_url_and_a_place_that_cannot_be_is_told():
    place = "memory://stores/powers.zarr"
    for _ in range(2):
        found = keep_blocks(Powers(3), place).arrays
        assert np.array_equal(found["power"][:], powers(3))
    with pytest.raises(JobError, match="another job: it has 'powers'"):
        keep_blocks(Powers(3, title="others"), place)
    with pytest.raises(op.errors.ValueFault):
        keep_blocks(Powers(3, fails_at=0), "memory://stores/dark.zarr", "synchronous")
    keep_blocks(Powers(2, title="mended"), "memory://stores/dark.zarr")
    for url, told in (
        ("s3b://bucket/a.zarr", "Protocol not known: s3b"),
        ("abfs://bucket/a.zarr", "nstall adlfs"),
    ):
        with pytest.raises(JobError, match=rf"'{url}' cannot be used as a store: .*{told}"):
            keep_blocks(Powers(2), url)


def test_who_is_interrupted_in_making_a_store_goes_on_and_others_share_it(store, monkeypatch):
    url = "memory://stores/interrupted.zarr"
    with monkeypatch.context() as patch:
        patch.setattr("zarr.consolidate_metadata", Mock(side_effect=KeyboardInterrupt))
        for place in (store, url):
            with pytest.raises(KeyboardInterrupt):
                keep_blocks(Powers(2), place)
    assert not [*store.parent.iterdir()], "a folder is put in its place when all is in it"
    with pytest.raises(JobError, match="another job: it has 'powers'"):
        keep_blocks(Powers(2, title="others"), url)
    assert np.array_equal(keep_blocks(Powers(2), url).arrays["power"][:], powers(2))
    keep_blocks(Powers(2), store)
    assert marked(store) == {0, 1}
    # Another job that comes to be in the same place at the same time is none of ours.
    mine = block_store.BlockStore.of(Powers(2), str(store))
    zarr.open_group(store, path="blocks", use_consolidated=False).attrs["seal"] = "theirs"
    with pytest.raises(JobError, match="another job has come to be in"):
        mine.keep(0, Powers(2).places(0), Powers(2).compute(0))


@rows("scheduler", ["synchronous", "threads"])
def test_a_disk_that_takes_no_more_is_told_and_finished_blocks_stay(store, monkeypatch, scheduler):
    put = zarr.Array.__setitem__

    def full(array, place, values):
        if array.basename == "power" and place[0] == slice(12, 16):
            raise OSError(28, "No space left on device")
        put(array, place, values)

    with monkeypatch.context() as patch:
        patch.setattr(zarr.Array, "__setitem__", full)
        with pytest.raises(JobError, match="cannot be written: No space left on device; mend that"):
            keep_blocks(Powers(5), store, scheduler)
    before = marked(store)
    assert 3 not in before
    assert before >= ({0, 1, 2} if scheduler == "synchronous" else set())
    keep_blocks(Powers(5), store)
    assert marked(store) == {*range(5)}
    shutil.rmtree(store)


def test_dark_blocks_and_blocks_of_nan_are_kept_too(store, monkeypatch):
    def dark(job, number):
        values = compute(job, number)
        return values | {"power": np.full_like(values["power"], [-np.nan, -0.0][number])}

    compute = Powers.compute
    monkeypatch.setattr(Powers, "compute", dark)
    for _ in range(2):  # Without a warning.
        keep_blocks(Powers(2), store, "synchronous")
    found = zarr.open_group(store, mode="r")["power"][:]
    assert found.shape == powers(2).shape
    assert np.isnan(found[:4]).all()
    assert np.signbit(found[4:]).all()


def test_one_of_two_runs_that_make_a_store_at_once_takes_that_of_the_other(store, monkeypatch):
    consolidate, others = zarr.consolidate_metadata, []

    def first(*args, **options):
        if not others:  # The other run begins and ends while this one is making its own.
            others.append(None)
            others[0] = keep_blocks(Powers(2), store).arrays["power"][:]
        return consolidate(*args, **options)

    monkeypatch.setattr("zarr.consolidate_metadata", first)
    mine = keep_blocks(Powers(2), store)
    assert np.array_equal(mine.arrays["power"][:], powers(2))
    assert np.array_equal(others[0], powers(2))
    assert [each.name for each in store.parent.iterdir()] == [store.name]
