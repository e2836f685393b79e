"""The store of a job: what stands in its place is left alone, and what cannot be is told."""

import errno
import json
import os
import shutil
from dataclasses import dataclass

import numpy as np
import pytest

pytest.importorskip("zarr")

import zarr

import optipath as op
from large_jobs import Powers, computed, marked, powers
from optipath.errors import JobError
from optipath.sweeps.blocks import block_store
from optipath.sweeps.blocks.keep_blocks import keep_blocks


@pytest.fixture
def store(tmp_path):
    return tmp_path / "powers.zarr"


def content_of(place):
    """Every file beneath a place, or at it, with what is in it."""
    files = [place] if place.is_file() else sorted(place.rglob("*"))
    return {file: file.read_bytes() if file.is_file() else None for file in files}


def other_job(store):
    keep_blocks(Powers(2, title="other powers"), store)


def other_layout(store):
    keep_blocks(Powers(2), store)
    edit_record(store, blocks=3)


def newer_format(store):
    keep_blocks(Powers(2), store)
    edit_record(store, format=2)


def damaged_record(store):
    keep_blocks(Powers(2), store)
    (store / "blocks" / ".zattrs").write_text('{"format": 1')


def edit_record(store, **changed):
    file = store / "blocks" / ".zattrs"
    file.write_text(json.dumps(json.loads(file.read_text()) | changed))


def another_folder(store):
    store.mkdir()
    (store / "thesis.tex").write_text("light")


@pytest.mark.parametrize(
    ("put", "told"),
    [
        (other_job, "holds blocks of another job: it has 'other powers', where this one has 'po"),
        (
            other_layout,
            "another job: it has blocks 3, where this one has 2; take another name",
        ),
        (newer_format, "has format 2, and this version of optipath knows 1; use the version"),
        (damaged_record, r"the record '.*\.zattrs' is damaged; take another name, or delete it"),
        (another_folder, "is there, and is no store of blocks; take another name, or delete it"),
        (lambda store: store.write_text("x"), "is there, and is no folder; take another name"),
    ],
)
def test_what_stands_in_the_place_is_told_and_left_as_it_is(store, put, told):
    put(store)
    before = content_of(store)
    with pytest.raises(JobError, match=told):
        keep_blocks(Powers(2), store)
    assert content_of(store) == before


@pytest.mark.parametrize(("name", "content"), [("1.0", b""), ("7.0", b"\1"), ("x", b"")])
def test_a_mark_that_is_none_is_told(store, name, content):
    keep_blocks(Powers(2), store)
    (store / "blocks" / "done" / name).write_bytes(content)
    with pytest.raises(JobError, match=rf"done/{name}' is no mark of a block; delete this file"):
        keep_blocks(Powers(2), store)


def lose(file):
    file.unlink()


def empty(file):
    file.write_bytes(b"")


@pytest.mark.parametrize("harm", [lose, empty])
def test_a_block_that_has_lost_a_file_is_computed_again_and_no_other(store, tmp_path, harm):
    job = Powers(3, log=str(tmp_path / "log"))
    keep_blocks(job, store, "synchronous")
    before = content_of(store)
    harm(store / "power" / "3.0")
    keep_blocks(job, store, "synchronous")
    assert computed(tmp_path / "log") == [0, 1, 2, 1]
    assert content_of(store) == before


@pytest.mark.parametrize(
    "name",
    [".zgroup", ".zmetadata", "power/.zarray", "number/.zarray", "called/.zattrs", "number/0"],
)
@pytest.mark.parametrize("harm", [lose, empty])
def test_a_damaged_file_of_the_group_is_told_and_nothing_is_changed(store, name, harm):
    keep_blocks(Powers(2), store)
    harm(store / name)
    before = content_of(store)
    with pytest.raises(JobError, match=rf"the file '.*{name}' is damaged or gone; take another"):
        keep_blocks(Powers(2), store)
    assert content_of(store) == before


@pytest.mark.parametrize("content", ["{", "[]", '{"shape": [3]}'])
@pytest.mark.parametrize("name", [".zmetadata", "power/.zarray"])
def test_metadata_that_are_garbage_are_told(store, name, content):
    keep_blocks(Powers(2), store)
    (store / name).write_text(content)
    with pytest.raises(JobError, match=rf"the file '.*{name}' is damaged or gone"):
        keep_blocks(Powers(2), store)


def test_attributes_may_be_added_by_hand(store):
    keep_blocks(Powers(2), store)
    zarr.open_group(store, mode="r+").attrs["note"] = "mine"
    keep_blocks(Powers(2), store)


def test_a_record_without_marks_is_told(store):
    keep_blocks(Powers(2), store)
    shutil.rmtree(store / "blocks" / "done")
    with pytest.raises(JobError, match=r"done' cannot be read: .*; take another name, or delete"):
        keep_blocks(Powers(2), store)


def test_an_empty_folder_and_a_link_to_one_are_taken(tmp_path):
    (tmp_path / "empty").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "empty")
    assert keep_blocks(Powers(2), tmp_path / "link") == tmp_path / "empty"
    assert marked(tmp_path / "empty") == {0, 1}


def test_a_store_in_no_folder_is_told(tmp_path):
    with pytest.raises(JobError, match=r"there is no folder '.*nowhere' for a store; make it"):
        keep_blocks(Powers(2), tmp_path / "nowhere" / "a.zarr")
    assert not [*tmp_path.iterdir()]


@pytest.mark.parametrize("name", [3, "", None])
def test_what_is_no_name_is_told(name):
    with pytest.raises(JobError, match="name"):
        keep_blocks(Powers(2), name)


def test_who_is_interrupted_in_making_a_store_leaves_none(store, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr("zarr.consolidate_metadata", interrupted)
        with pytest.raises(KeyboardInterrupt):
            keep_blocks(Powers(2), store)
    assert not [*store.parent.iterdir()]
    keep_blocks(Powers(2), store)


def test_half_a_store_of_who_was_killed_is_in_nobodys_way(store, monkeypatch):
    with monkeypatch.context() as patch:
        patch.setattr("zarr.consolidate_metadata", lambda *_, **__: 1 / 0)
        patch.setattr(shutil, "rmtree", lambda *_, **__: None)
        with pytest.raises(ZeroDivisionError):
            keep_blocks(Powers(2), store)
    assert [file.name.split(".")[1] for file in store.parent.iterdir()] == ["powers"]
    keep_blocks(Powers(2), store)
    assert marked(store) == {0, 1}


@pytest.mark.parametrize("title", ["powers", "other powers"])
def test_who_makes_a_store_at_the_same_time_shares_it_or_is_refused(store, monkeypatch, title):
    make = block_store.make_group

    def slower(job, folder):
        make(job, folder)
        make(Powers(2, title=title), store)

    monkeypatch.setattr(block_store, "make_group", slower)
    if title == "powers":
        keep_blocks(Powers(2), store)
        assert marked(store) == {0, 1}
    else:
        with pytest.raises(JobError, match="another job"):
            keep_blocks(Powers(2), store)
    assert [file.name for file in store.parent.iterdir()] == [store.name]


@pytest.mark.parametrize("scheduler", ["synchronous", "threads"])
@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EACCES, errno.EROFS])
def test_a_disk_that_takes_no_more_is_told_and_finished_blocks_stay(
    store, monkeypatch, number, scheduler
):
    write = block_store.write_file

    def full(file, content):
        if file.name == "6.0":
            raise OSError(number, os.strerror(number))
        write(file, content)

    with monkeypatch.context() as patch:
        patch.setattr(block_store, "write_file", full)
        with pytest.raises(JobError, match=f"cannot be written: {os.strerror(number)}; mend that"):
            keep_blocks(Powers(5), store, scheduler)
        assert 3 not in marked(store)
    before = marked(store)
    assert before >= ({0, 1, 2} if scheduler == "synchronous" else set())
    keep_blocks(Powers(5), store)
    assert marked(store) == {*range(5)}


@dataclass(frozen=True)
class Careless(Powers):
    """Gives what is asked of it for its first array."""

    gives: tuple = ()

    def compute(self, number):
        del number
        return dict([self.gives]) if self.gives else {}


WHOLE = np.zeros((4, 3))


@pytest.mark.parametrize(
    ("gives", "told"),
    [
        ((), "block 0 gives no array 'power'"),
        (("S9", (slice(0, 4), WHOLE)), "block 0 gives 'S9', which is not kept"),
        (("power", ((slice(1, 5), slice(0, 3)), WHOLE)), r"\(1, 5\).* no whole chunks of \(2, 3\)"),
        (("power", ((slice(0, 3), slice(0, 3)), WHOLE[:3])), r"\(0, 3\).* is no whole chunks"),
        (("power", ((slice(0, 4),), WHOLE)), r"\[\(0, 4\)\] of shape .* is no whole chunks"),
        (("power", ((slice(6, 10), slice(0, 3)), WHOLE)), "no whole chunks"),
        (("power", ((slice(0, 4), slice(0, 3)), WHOLE[:2])), r"of shape \(2, 3\), not float64 of"),
        (("power", ((slice(0, 4), slice(0, 3)), WHOLE.astype("f4"))), "as float32 of shape"),
    ],
)
def test_what_a_block_gives_is_what_its_job_says(store, gives, told):
    with pytest.raises(JobError, match=told):
        keep_blocks(Careless(2, gives=gives), store, "synchronous")
    assert not store.exists()  # Nothing is done of it.


ROWS = (slice(0, 4), slice(0, 3))


@pytest.mark.parametrize(
    ("gives", "told"),
    [
        (("power", WHOLE), r"gives 'power' as .*; give \(region, values\)"),
        (("power", (ROWS, WHOLE.tolist())), r"gives 'power' as .*; give \(region, values\)"),
        (("power", ((slice(None), slice(0, 3)), WHOLE)), "give a tuple of slices"),
        (("power", ((0, slice(0, 3)), WHOLE)), "give a tuple of slices"),
        (("power", ((slice(0, 4, 2), slice(0, 3)), WHOLE)), "give a tuple of slices"),
        (("power", (slice(0, 4), WHOLE)), "give a tuple of slices"),
    ],
)
def test_what_is_no_part_is_told(store, gives, told):
    with pytest.raises(JobError, match=told):
        keep_blocks(Careless(2, gives=gives), store, "synchronous")


def test_a_block_of_nothing_is_told(store):
    class Idle(Powers):
        def compute(self, number):
            del number

    with pytest.raises(JobError, match="block 0 gives None; return what is in each array"):
        keep_blocks(Idle(2), store, "synchronous")


class Twice(Powers):
    """Its second block is its first one."""

    def compute(self, number):
        return super().compute(0 * number)


class Half(Powers):
    """One block, and arrays of two."""

    @property
    def arrays(self):
        return Powers(2).arrays

    @property
    def coords(self):
        return Powers(2).coords


def test_blocks_that_fill_one_part_are_told(store):
    with pytest.raises(JobError, match="blocks 0 and 1 both fill the part"):
        keep_blocks(Twice(2), store, "synchronous")


def test_chunks_that_no_block_fills_are_told(store):
    with pytest.raises(JobError, match="of the 4 chunks of 'power' 2 are filled by none"):
        keep_blocks(Half(1), store, "synchronous")


def test_dark_blocks_and_blocks_of_nan_are_kept_too(store):
    @dataclass(frozen=True)
    class Dark(Powers):
        def compute(self, number):
            found = super().compute(number)
            region, values = found["power"]
            return found | {"power": (region, np.full_like(values, [np.nan, -0.0][number]))}

    keep_blocks(Dark(2), store)
    found = zarr.open_group(store, mode="r")["power"][:]
    assert np.isnan(found[:4]).all()
    assert np.signbit(found[4:]).all()
    assert powers(2).shape == found.shape


@pytest.mark.parametrize("stood", [True, False])
def test_a_new_store_without_blocks_goes_where_its_job_fails(store, stood):
    if stood:
        store.mkdir()
    with pytest.raises(op.ValueFault):
        keep_blocks(Powers(3, fails_at=0), store, "synchronous")
    assert store.exists() == stood
    keep_blocks(Powers(2, title="mended"), store, "synchronous")
    assert marked(store) == {0, 1}


def test_a_store_that_was_there_before_or_has_a_block_stays(store):
    with pytest.raises(op.ValueFault):
        keep_blocks(Powers(3, fails_at=1), store, "synchronous")
    assert marked(store) == {0}
    for mark in (store / "blocks" / "done").glob("0*"):
        mark.unlink()
    with pytest.raises(op.ValueFault):
        keep_blocks(Powers(3, fails_at=0), store, "synchronous")
    assert store.exists()
