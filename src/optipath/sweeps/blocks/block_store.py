"""A folder in which finished blocks are kept: a Zarr group that xarray opens as it is."""

from __future__ import annotations

import errno
import os
import secrets
import shutil
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from optipath.errors import JobError
from optipath.sweeps.blocks.block_parts import check_parts, chunk_files
from optipath.sweeps.blocks.job_record import OTHER_PLACE, check_record
from optipath.sweeps.blocks.new_group import make_group
from optipath.values.written_files import write_file

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from optipath.sweeps.blocks.block_job import BlockJob, BlockPart

_MARK = b"\1"


@dataclass(frozen=True)
class BlockStore:
    """The store of a job.

    A block's arrays are written first and its mark last, each file whole or not at all. So whoever
    is interrupted leaves nothing that passes for a block, and two who do one block at a time write
    the same bits. The marks are a Zarr array of their own, ``blocks/done``, with a chunk a block.

    Attributes
    ----------
    folder : Path
        Where it is.
    """

    folder: Path

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
            if not store.folder.exists() or _is_empty(store.folder):
                store._make(job)
            check_record(store.folder, store.folder / "blocks" / ".zattrs", job)
        return store

    @property
    def _marks(self) -> Path:
        return self.folder / "blocks" / "done"

    def done(self, blocks: int) -> set[int]:
        """Return the numbers of the blocks that it holds.

        Raises
        ------
        JobError
            If what it says of them is damaged.
        """
        try:
            with os.scandir(self._marks) as found:
                marks = {each.name: each.stat().st_size for each in found if each.name[0] != "."}
        except OSError as fault:
            raise JobError(
                f"the record '{self._marks}' cannot be read: {fault.strerror}; {OTHER_PLACE}: "
                f"'{self.folder}'"
            ) from None
        for name, size in marks.items():
            if not name.isdecimal() or int(name) >= blocks or size != len(_MARK):
                raise JobError(
                    f"'{self._marks / name}' is no mark of a block; delete this file, and what is "
                    f"missing is computed again"
                )
        return {int(name) for name in marks}

    def holds(self, number: int) -> bool:
        """Tell whether a block is there."""
        return (self._marks / str(number)).exists()

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
            write_file(self._marks / str(number), _MARK)

    def _make(self, job: BlockJob) -> None:
        """Make it beside its place and move it there: nobody finds half of it."""
        draft = self.folder.with_name(f".{self.folder.name}.{secrets.token_hex(4)}.draft")
        try:
            make_group(job, draft)
            with suppress(OSError):
                self.folder.rmdir()
            draft.rename(self.folder)
        except OSError as fault:
            # Another run may have been faster.
            if fault.errno not in (errno.ENOTEMPTY, errno.EEXIST):
                raise
        finally:
            shutil.rmtree(draft, ignore_errors=True)

    @contextmanager
    def _writing(self) -> Iterator[None]:
        try:
            yield
        except OSError as fault:
            raise JobError(
                f"the store '{self.folder}' cannot be written: {fault.strerror or fault}; mend "
                f"that and start again, and what is done is not computed again"
            ) from None


def _is_empty(folder: Path) -> bool:
    return folder.is_dir() and not any(folder.iterdir())
