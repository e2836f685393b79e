"""A folder in which finished blocks are kept: a Zarr group that xarray opens as it is."""

from __future__ import annotations

import errno
import os
import secrets
import shutil
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING, Any

from optipath.errors import JobError
from optipath.sweeps.blocks.block_marks import files_of_mark, mark_of, marks_of, name_of_mark
from optipath.sweeps.blocks.block_parts import check_parts, chunk_files
from optipath.sweeps.blocks.group_files import check_group
from optipath.sweeps.blocks.job_record import OTHER_PLACE, check_record
from optipath.sweeps.blocks.new_group import make_group
from optipath.values.written_files import write_file

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from optipath.sweeps.blocks.block_job import BlockJob, BlockPart


@dataclass(frozen=True)
class BlockStore:
    """The store of a job.

    A block's arrays are written first and its mark last, each file whole or not at all. So whoever
    is interrupted leaves nothing that passes for a block, and two who do one block at a time write
    the same bits. The marks are a Zarr array of their own, ``blocks/done``, with a chunk a block,
    and say which files the block has written: where one of these is lost, so is the block.

    Attributes
    ----------
    folder : Path
        Where it is.
    is_new : bool
        Whether this run has made it.
    stood : bool
        Whether an empty folder was there.
    """

    folder: Path
    is_new: bool = False
    stood: bool = False

    @classmethod
    def of(cls, job: BlockJob, folder: Path) -> BlockStore:
        """Return the store of a job, made if nothing is there.

        Parameters
        ----------
        job : BlockJob
            What is kept.
        folder : Path
            Where.

        Returns
        -------
        BlockStore

        Raises
        ------
        JobError
            If something else is there, or it cannot be made.
        """
        store = cls(Path(os.path.realpath(folder)))
        if not store.folder.parent.is_dir():
            raise JobError(f"there is no folder '{store.folder.parent}' for a store; make it first")
        with store._writing():
            stood = store.folder.exists()
            if not stood or _is_empty(store.folder):
                store = cls(store.folder, store._make(job), stood)
            check_record(store.folder, store.folder / "blocks" / ".zattrs", job)
            check_group(store.folder, job)
        return store

    @property
    def _marks(self) -> Path:
        return self.folder / "blocks" / "done"

    def done(self, job: BlockJob) -> set[int]:
        """Return the numbers of the blocks that it holds.

        The marks of blocks that have lost a file are removed, so that they are computed again.

        Raises
        ------
        JobError
            If what it says of them is damaged, or two blocks have filled one part.
        """
        return self._done(job)[0]

    def _done(self, job: BlockJob) -> tuple[set[int], dict[str, set[str]]]:
        """Return the blocks that it holds, and the files of chunks of each array."""
        marks = self._read_marks(job)
        with self._writing():
            # After the marks, since a block writes these last.
            there = {name: _chunks_with_content(self.folder / name) for name in job.arrays}
            written = dict[tuple[str, str], int]()
            lost = set[int]()
            for number, mark in marks.items():
                for name, file in files_of_mark(job.arrays, mark):
                    if file not in there[name]:
                        lost.add(number)
                    if (other := written.setdefault((name, file), number)) != number:
                        raise JobError(
                            f"blocks {other} and {number} both fill the part '{file}' of "
                            f"'{name}'; let each block fill a part of its own"
                        )
            for number in lost:
                (self._marks / name_of_mark(number)).unlink(missing_ok=True)
        return marks.keys() - lost, there

    def check_whole(self, job: BlockJob) -> None:
        """Refuse a store in which all blocks are done and have not filled all arrays.

        Raises
        ------
        JobError
            Naming an array that is not filled, or two blocks that have filled one part.
        """
        _, there = self._done(job)
        for name, kept in job.arrays.items():
            sides = zip(kept.shape, kept.chunks, strict=True)
            chunks = prod(-(-size // chunk) for size, chunk in sides)
            if len(there[name]) < chunks:
                raise JobError(
                    f"all blocks are done, and of the {chunks} chunks of '{name}' "
                    f"{chunks - len(there[name])} are filled by none; let each be in one block"
                )

    def _read_marks(self, job: BlockJob) -> dict[int, bytes]:
        size = 8 * marks_of(job.arrays, job.blocks).shape[1]
        numbers = {name_of_mark(number): number for number in range(job.blocks)}
        found = {}
        try:
            for file in self._marks.iterdir():
                if file.name.startswith("."):
                    continue
                with suppress(FileNotFoundError):  # Another run has found that the block is lost.
                    mark = file.read_bytes()
                    if file.name not in numbers or len(mark) != size:
                        raise JobError(
                            f"'{file}' is no mark of a block; delete this file, and what is "
                            f"missing is computed again"
                        )
                    found[numbers[file.name]] = mark
        except OSError as fault:
            raise JobError(
                f"the record '{self._marks}' cannot be read: {fault.strerror}; {OTHER_PLACE}: "
                f"'{self.folder}'"
            ) from None
        return found

    def holds(self, number: int) -> bool:
        """Tell whether a block is there."""
        return (self._marks / name_of_mark(number)).exists()

    def keep(self, job: BlockPart, number: int, found: Mapping[str, Any]) -> None:
        """Write a block, and then mark it as done.

        Parameters
        ----------
        job : BlockJob
            What it is of.
        number : int
            Which one it is.
        found : mapping of str to (tuple of slice, ndarray)
            What `BlockJob.compute` gave.

        Raises
        ------
        JobError
            If it is not what the job says of it, or cannot be written.
        """
        check_parts(number, job.arrays, found)
        with self._writing():
            for name, (region, values) in found.items():
                metadata = (self.folder / name / ".zarray").read_bytes()
                for file, content in chunk_files(metadata, region, values):
                    write_file(self.folder / name / file, content)
            write_file(self._marks / name_of_mark(number), mark_of(job.arrays, found))

    def discard_unused(self) -> None:
        """Remove it if this run has made it and no block of it is done."""
        if self.is_new and not any(self._marks.glob("[0-9]*")):
            draft = self._draft()
            self.folder.rename(draft)
            shutil.rmtree(draft, ignore_errors=True)
            if self.stood:
                self.folder.mkdir()

    def _make(self, job: BlockJob) -> bool:
        """Make it beside its place and move it there: nobody finds half of it.

        False if another run was faster.
        """
        draft = self._draft()
        try:
            make_group(job, draft)
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


def _chunks_with_content(folder: Path) -> set[str]:
    with os.scandir(folder) as found:
        return {each.name for each in found if each.name[0] != "." and each.stat().st_size}


def _is_empty(folder: Path) -> bool:
    return folder.is_dir() and not any(folder.iterdir())
