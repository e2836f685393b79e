"""The store of a job: what stands in its place is left alone, and what cannot be is told."""

import json
import os
import shutil
from contextlib import suppress
from unittest.mock import Mock

import numpy as np
import pytest

pytest.importorskip("zarr")

import zarr

import optipath as op
from large_jobs import Powers, computed, marked, powers
from optipath.errors import JobError, StoreWarning
from optipath.sweeps import store as block_store
from optipath.sweeps.blocks import keep_blocks
from optipath.sweeps.jobs import clear, put_file
from tables import rows, slow

HUGE = 1 << 40


@pytest.fixture
def store(tmp_path):
    return tmp_path / "powers.zarr"


def content_of(place):
    """Every file beneath a place, or at it, with what is in it."""
    files = [place] if place.is_file() else sorted(place.rglob("*"))
    small = {file for file in files if file.is_file() and file.stat().st_size < HUGE}
    return {file: file.read_bytes() if file in small else None for file in files}


def refused(store, told):
    """Nothing of what is there is changed."""
    before = content_of(store)
    with pytest.raises(JobError, match=told):
        keep_blocks(Powers(2), store)
    assert content_of(store) == before


def record_with(store, **changed):
    """Have a job kept, and something else said of it in its store."""
    file = keep_blocks(Powers(2), store) / "blocks" / ".zattrs"
    file.write_text(json.dumps(json.loads(file.read_text()) | changed))


@rows(
    "put, told",
    [
        (lambda store: keep_blocks(Powers(2, title="other"), store), "it has 'other', where this"),
        (lambda store: record_with(store, blocks=3), "it has blocks 3, where this one has 2; take"),
        (lambda store: record_with(store, format=1), "format 1, and this .* knows 2"),
        (lambda store: record_with(store, format=3), "has format 3, and .* use the version"),
        (lambda store: record_with(store, identity=3), r"the record '.*\.zattrs' is damaged; take"),
        (lambda store: (store / "thesis").mkdir(parents=True), "is there, and is no store of blo"),
        (lambda store: store.write_text("x"), "is there, and is no folder; take another name"),
    ],
)
def test_what_stands_in_the_place_is_told_and_left_as_it_is(store, put, told):
    put(store)
    refused(store, told)
    clear(store)


def other_beside(file):
    """What lies beside it: each chunk, and each mark, is whole, and in a wrong place."""
    content = file.read_bytes()
    return next(each for each in sorted(file.parent.iterdir()) if each.read_bytes() != content)


def link_to_another(file):
    other = other_beside(file)
    file.unlink()
    file.symlink_to(other)


def lay(make):
    """Have something else made in the place of a file."""
    return lambda file: (file.unlink(), make(file))


DAMAGES = [
    lambda file: file.write_bytes(b""),
    lambda file: file.write_bytes(bytes([file.read_bytes()[0] ^ 16, *file.read_bytes()[1:]])),
    lambda file: file.write_bytes(file.read_bytes()[:-1]),
    lambda file: file.write_bytes(file.read_bytes() + b"x"),
    lambda file: file.write_bytes(other_beside(file).read_bytes()),
    link_to_another,
    lay(os.mkfifo),
    lay(lambda file: (file / "with" / "files").mkdir(parents=True)),
    lay(lambda file: file.symlink_to("/dev/zero")),
    lay(lambda file: file.symlink_to(file.parent)),
    lay(lambda file: file.symlink_to(file)),
    lay(lambda file: (file.touch(), os.truncate(file, HUGE))),  # It takes no disk.
    lay(lambda file: file.write_bytes(b"[" * 100_000)),
]


def test_a_damaged_block_is_named_and_computed_anew_and_no_other(store, tmp_path):
    job, count = Powers(3, log=str(tmp_path / "log")), 0
    keep_blocks(job, store, "synchronous")
    before = content_of(store)
    for name in ("power/3.0", "total/1", "blocks/done/1.0"):
        for harm in DAMAGES:
            harm(store / name)
            count += 1
            with pytest.warns(StoreWarning, match=r"of '.*' are damaged and computed anew: 1$"):
                keep_blocks(job, store, "synchronous")
            assert computed(tmp_path / "log") == [0, 1, 2, *[1] * count]
            assert content_of(store) == before
            assert not [each for each in store.rglob("*") if each.is_symlink()]
    (store / "power" / "3.0").unlink()
    with pytest.warns(StoreWarning, match=r"computed anew: 1$"):
        keep_blocks(job, store, "synchronous")
    # A lost mark is a block that is not done, and no damage.
    (store / "blocks" / "done" / "1.0").unlink()
    keep_blocks(job, store, "synchronous")
    assert computed(tmp_path / "log") == [0, 1, 2, *[1] * (count + 2)]
    assert content_of(store) == before


@pytest.mark.filterwarnings("ignore::optipath.errors.StoreWarning")
@pytest.mark.parametrize("step", [slow(25), 401])
def test_every_bit_of_a_store_is_looked_at(store, step):
    job = Powers(1)
    keep_blocks(job, store)
    accepted, done = [], store / "blocks" / "done" / "0.0"
    mark = done.read_bytes()
    for file in sorted(each for each in store.rglob("*") if each.is_file()):
        content = file.read_bytes()
        for place in range(0, 8 * len(content), step):  # It has no factor in common with 8.
            damaged = bytearray(content)
            damaged[place // 8] ^= 1 << place % 8
            file.write_bytes(damaged)
            with suppress(JobError):
                if block_store.BlockStore.of(job, store).done(job):
                    accepted.append((file, place))
            file.write_bytes(content)
            done.write_bytes(mark)
    assert not accepted


def test_a_block_of_another_job_is_none_and_twenty_damaged_ones_are_named(store, tmp_path):
    keep_blocks(Powers(25), store)
    other = keep_blocks(Powers(2, title="others"), tmp_path / "others.zarr")
    (other / "power" / "3.0").write_bytes(b"whatever they have")
    mark = json.loads((other / "blocks" / "done" / "1.0").read_bytes().partition(b"\n")[2])
    assert {*mark} == {"power/2.0", "power/3.0", "total/1"}
    shutil.copy(other / "blocks" / "done" / "1.0", store / "blocks" / "done")
    with pytest.warns(StoreWarning, match="anew: 1$"):
        keep_blocks(Powers(25), store)
    for file in (store / "total").glob("[0-9]*"):
        file.write_bytes(b"")
    with pytest.warns(StoreWarning, match=r"anew: 0, 1, .*, 18, 19 and 5 more$"):
        keep_blocks(Powers(25), store)


IN_GROUP = [".zgroup", ".zmetadata", ".zattrs", "blocks/.zgroup", "blocks/files"]
IN_GROUP += ["called/.zattrs", "power/.zarray", "number/.zarray", "number/0"]


def test_a_damaged_file_of_the_group_or_record_is_told_and_attributes_may_be_added(store):
    keep_blocks(Powers(2), store)
    for name in (*IN_GROUP, "blocks/.zattrs"):
        content = (store / name).read_bytes()
        told = rf"the file '.*{name}' is damaged or gone; " if name in IN_GROUP else ""
        for harm in [os.unlink, lambda file: file.write_bytes(b"[]"), *DAMAGES]:
            harm(store / name)
            refused(store, f"{told}take another name, or delete it")
            clear(store / name)
            (store / name).write_bytes(content)
    # A tabulator for a space is the same to JSON.
    (store / name).write_bytes(content.replace(b" ", b"\t", 1))
    refused(store, r"blocks/\.zattrs' is damaged or gone")
    (store / name).write_bytes(content)
    keep_blocks(Powers(2), store)
    zarr.open_group(store, mode="r+").attrs["note"] = "mine"
    keep_blocks(Powers(2), store)
    whole = (store / ".zmetadata").read_bytes()
    told = json.loads(whole)
    told["metadata"]["power/.zarray"]["shape"] = [4, 3]
    (store / ".zmetadata").write_text(json.dumps(told))
    refused(store, "is damaged or gone")
    (store / ".zmetadata").write_bytes(whole)
    shutil.rmtree(store / "blocks" / "done")
    refused(store, r"done' cannot be read: .*; take another name, or delete")


def test_a_store_goes_into_an_empty_folder_and_stays_where_a_block_is_done(tmp_path, store):
    refused(tmp_path / "nowhere" / "a.zarr", "there is no folder '.*nowhere' for a store; make it")
    assert not [*tmp_path.iterdir()]
    for name in (3, "", None):
        with pytest.raises(JobError, match="name"):
            keep_blocks(Powers(2), name)
    (tmp_path / "empty").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "empty")
    assert keep_blocks(Powers(2), tmp_path / "link") == tmp_path / "empty"
    assert marked(tmp_path / "empty") == {0, 1}

    def fails_at(number):
        with pytest.raises(op.ValueFault):
            keep_blocks(Powers(3, fails_at=number), store, "synchronous")

    for stood in (True, False):
        if stood:
            store.mkdir()
        fails_at(0)
        assert store.exists() == stood
        keep_blocks(Powers(2, title="mended"), store, "synchronous")
        assert marked(store) == {0, 1}
        clear(store)
    fails_at(1)
    assert marked(store) == {0}
    for mark in (store / "blocks" / "done").glob("0*"):
        mark.unlink()
    fails_at(0)
    assert store.exists()


def test_who_is_interrupted_in_making_a_store_leaves_none_and_others_share_it(store, monkeypatch):
    make = block_store.make_group

    def together_with(title):
        def slower(job, *given):
            make(job, *given)
            monkeypatch.setattr(block_store, "make_group", make)
            block_store.BlockStore.of(Powers(2, title=title), store)

        monkeypatch.setattr(block_store, "make_group", slower)
        keep_blocks(Powers(2), store)

    interrupted, killed = Mock(side_effect=KeyboardInterrupt), Mock(side_effect=ZeroDivisionError)
    with monkeypatch.context() as patch:
        patch.setattr("zarr.consolidate_metadata", interrupted)
        with pytest.raises(KeyboardInterrupt):
            keep_blocks(Powers(2), store)
        assert not [*store.parent.iterdir()]
        patch.setattr("zarr.consolidate_metadata", killed)
        patch.setattr(shutil, "rmtree", Mock())
        with pytest.raises(ZeroDivisionError):
            keep_blocks(Powers(2), store)
    (draft,) = store.parent.iterdir()
    assert draft.name.split(".")[1] == "powers"  # Half a store is in nobody's way.
    together_with("powers")
    assert marked(store) == {0, 1}
    clear(store)
    with pytest.raises(JobError, match="another job"):
        together_with("other powers")
    assert {*store.parent.iterdir()} == {draft, store}


@rows("scheduler", ["synchronous", "threads"])
def test_a_disk_that_takes_no_more_is_told_and_finished_blocks_stay(store, monkeypatch, scheduler):
    def full(file, content):
        if file.name == "6.0":
            raise OSError(28, "No space left on device")
        put_file(file, content)

    with monkeypatch.context() as patch:
        patch.setattr(block_store, "put_file", full)
        with pytest.raises(JobError, match="cannot be written: No space left on device; mend that"):
            keep_blocks(Powers(5), store, scheduler)
    before = marked(store)
    assert 3 not in before
    assert before >= ({0, 1, 2} if scheduler == "synchronous" else set())
    keep_blocks(Powers(5), store)
    assert marked(store) == {*range(5)}
    clear(store)


def test_dark_blocks_and_blocks_of_nan_are_kept_too(store, monkeypatch):
    def dark(job, number):
        region, values = compute(job, number)["power"]
        return {"power": (region, np.full_like(values, [np.nan, -0.0][number]))}

    compute = Powers.compute
    monkeypatch.setattr(Powers, "compute", dark)
    keep_blocks(Powers(2), store, "synchronous")
    found = zarr.open_group(store, mode="r")["power"][:]
    assert found.shape == powers(2).shape
    assert np.isnan(found[:4]).all()
    assert np.signbit(found[4:]).all()
