"""Store of finished blocks: a Zarr group that xarray opens."""

from __future__ import annotations

import errno
import json
import os
import secrets
import shutil
import warnings
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import zarr
from zarr.core.buffer import default_buffer_prototype
from zarr.storage import MemoryStore

from optipath.errors import JobError, StoreWarning
from optipath.sweeps.jobs import (
    FILES,
    OTHER_PLACE,
    StoredArray,
    check_files,
    check_record,
    clear,
    damaged_files,
    group_attrs,
    mark_of,
    put_file,
    record_of,
    stamp_of,
)
from optipath.values.angles import calls_up

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    import numpy.typing as npt
    from zarr.core.buffer import Buffer

    from optipath.sweeps.jobs import BlockJob, WholeArray


_MARKS = "blocks/done"
_NAMED = 20
"""How many damaged blocks are named."""


@dataclass(frozen=True)
class BlockStore:
    """The store of a job.

    A block's arrays are written first and its mark last, each file whole or not at all:
    interruption leaves no false block, and two writers of one block write the same bits. The marks,
    in ``blocks/done``, have the sizes and digests of the block's files, and a digest of themselves,
    the job and the block number.
    """

    folder: Path
    seal: str
    is_new: bool = False
    stood: bool = False

    @classmethod
    def of(cls, job: BlockJob, folder: Path) -> BlockStore:
        """Return the store of a job, made if nothing is there."""
        record = record_of(job)
        seal = sha256(json.dumps(record).encode()).hexdigest()
        store = cls(Path(os.path.realpath(folder)), seal)
        if not store.folder.parent.is_dir():
            raise JobError(f"there is no folder '{store.folder.parent}' for a store; make it first")
        with store._writing():
            stood = store.folder.exists()
            if not stood or _is_empty(store.folder):
                store = replace(store, is_new=store._make(job, record), stood=stood)
            check_record(store.folder, record)
            check_files(store.folder, store.about("files"), job)
        return store

    def about(self, name: object) -> str:
        """Return what the mark of a block, or of the files before any block, is made with."""
        return f"{name} of {self.seal}"

    def done(self, job: BlockJob) -> set[int]:
        """Return the numbers of intact blocks, and remove the marks of damaged ones."""
        try:
            names = {each.name for each in (self.folder / _MARKS).iterdir()}
        except OSError as fault:
            raise JobError(
                f"the record '{self.folder / _MARKS}' cannot be read: {fault.strerror}; "
                f"{OTHER_PLACE}: '{self.folder}'"
            ) from None
        marked = {number for number in range(job.blocks) if f"{number}.0" in names}
        with self._writing():
            damaged = [
                number
                for number in sorted(marked)
                if any(damaged_files(self.folder, _mark(number), self.about(number)))
            ]
            for number in damaged:
                clear(self.folder / _mark(number))
        if damaged:
            more = f" and {len(damaged) - _NAMED:,} more" if len(damaged) > _NAMED else ""
            warnings.warn(
                f"blocks of '{self.folder}' are damaged and computed anew: "
                f"{', '.join(map(str, damaged[:_NAMED]))}{more}",
                StoreWarning,
                stacklevel=calls_up(),
            )
        return marked.difference(damaged)

    def holds(self, number: int) -> bool:
        """Tell whether a block is there."""
        return (self.folder / _mark(number)).exists()

    def keep(self, number: int, results: Mapping[str, Any]) -> None:
        """Write a block, and then mark it as done."""
        with self._writing():
            stamps = {}
            for name, (region, values) in results.items():
                metadata = (self.folder / name / ".zarray").read_bytes()
                for file, content in chunk_files(metadata, region, values):
                    put_file(self.folder / name / file, content)
                    stamps[f"{name}/{file}"] = stamp_of(content)
            put_file(self.folder / _mark(number), mark_of(self.about(number), stamps))

    def discard_unused(self) -> None:
        """Remove it if this run has made it and no block of it is done."""
        if self.is_new and not any((self.folder / _MARKS).glob("[0-9]*")):
            draft = self._draft()
            self.folder.rename(draft)
            shutil.rmtree(draft, ignore_errors=True)
            if self.stood:
                self.folder.mkdir()

    def _make(self, job: BlockJob, record: dict[str, Any]) -> bool:
        """Make it beside its place and move it there; False if another run was faster."""
        draft = self._draft()
        try:
            make_group(job, record, self.about("files"), draft)
            with suppress(OSError):
                self.folder.rmdir()
            draft.rename(self.folder)
        except OSError as fault:
            if fault.errno not in (errno.ENOTEMPTY, errno.EEXIST):
                raise
            return False
        else:
            return True
        finally:
            shutil.rmtree(draft, ignore_errors=True)

    def _draft(self) -> Path:
        return self.folder.with_name(f".{self.folder.name}.{secrets.token_hex(4)}.draft")

    @contextmanager
    def _writing(self) -> Iterator[None]:
        try:
            yield
        except OSError as fault:
            raise JobError(
                f"the store '{self.folder}' cannot be written: {fault.strerror or fault}; mend "
                f"that and start again, and what is done is not computed again"
            ) from None


def _mark(number: int) -> str:
    return f"{_MARKS}/{number}.0"


def _is_empty(folder: Path) -> bool:
    return folder.is_dir() and not any(folder.iterdir())


_METADATA = ".zarray"


def chunk_files(
    metadata: bytes, region: tuple[slice, ...], values: npt.NDArray[Any]
) -> Iterator[tuple[str, bytes]]:
    """Yield the files of whole chunks of an array, since Zarr may leave half of a file."""
    buffer = default_buffer_prototype().buffer
    like = zarr.open_array(
        MemoryStore({_METADATA: buffer.from_bytes(metadata)}), zarr_format=2, mode="r"
    )
    held: dict[str, Buffer] = {}
    array = zarr.create_array(
        MemoryStore(held),
        shape=like.shape,
        chunks=like.chunks,
        dtype=like.dtype,
        fill_value=like.fill_value,
        compressors=like.compressors,
        filters=like.filters,
        zarr_format=2,
        # Where a file is missing, it is lost. An array that is opened would leave this unheeded.
        config={"write_empty_chunks": True},
    )
    array[region] = values
    for name, content in held.items():
        if not name.startswith(".z"):
            yield name, content.to_bytes()


# Version 2 of the format has words of a fixed length, and all metadata at one place, in its
# specification; zarr and xarray warn that version 3 has neither.
_VERSION: Literal[2] = 2
_DIMENSIONS = "_ARRAY_DIMENSIONS"


def make_group(job: BlockJob, record: dict[str, Any], about: str, folder: Path) -> None:
    """Write a group with the arrays of a job, its coordinates and its record."""
    folder.mkdir()
    group = zarr.create_group(str(folder), zarr_format=_VERSION, attributes=group_attrs(job))
    for name, stored in job.arrays.items():
        _create(group, name, stored)
    for name, whole in job.coords.items():
        _write(group, name, whole)
    zarr.consolidate_metadata(str(folder), zarr_format=_VERSION)
    group.create_group("blocks", attributes=record)
    (folder / "blocks" / "done").mkdir()
    stamps = {
        file.relative_to(folder).as_posix(): stamp_of(file.read_bytes())
        for file in sorted(folder.rglob("*"))
        if file.is_file()
    }
    (folder / FILES).write_bytes(mark_of(about, stamps))


def _create(group: zarr.Group, name: str, stored: StoredArray) -> zarr.Array[Any]:
    dtype = np.dtype(stored.dtype)
    return group.create_array(
        name,
        shape=stored.shape,
        chunks=stored.chunks,
        dtype=dtype,
        # xarray takes a fill value for one that is missing, which a number must not be.
        fill_value=np.nan if dtype.kind in "fc" else None,
        config={"write_empty_chunks": True},
        attributes={**stored.attrs, _DIMENSIONS: list(stored.dims)},
    )


def _write(group: zarr.Group, name: str, whole: WholeArray) -> None:
    shape = whole.values.shape
    chunks = tuple(max(size, 1) for size in shape)
    stored = StoredArray(whole.dims, shape, chunks, whole.values.dtype.str, whole.attrs)
    _create(group, name, stored)[...] = whole.values
