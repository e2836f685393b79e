"""Jobs of blocks, and the store of those that are done: a Zarr group that xarray opens.

The values of a block are written first and its mark last, so interruption leaves no false block,
and two runs that share a store write the same bits. The mark, a row of ``blocks/done``, is a digest
of the job, the number of the block, and its values; it is 0 of a block that is not done.
"""

from __future__ import annotations

import json
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from functools import cached_property
from hashlib import sha256
from itertools import zip_longest
from pathlib import Path
from secrets import token_hex
from shutil import rmtree
from typing import TYPE_CHECKING, Any, Literal, Protocol

import numpy as np
import xarray as xr
import zarr
from fsspec.core import url_to_fs
from zarr.errors import ContainsArrayError
from zarr.storage import FsspecStore, LocalStore

from optipath.errors import JobError, OptipathError, StoreWarning
from optipath.faults import shown
from optipath.values.angles import warn

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    import numpy.typing as npt


FORMAT = 3
"""That of stores as they are written now."""

_OTHER_PLACE = "take another name, or delete it"
_RECORD, _MARKS, _BEGINNING = "blocks", "blocks/done", "beginning"


class BlockJob(Protocol):
    """A large job, cut into blocks that are computed each by itself, in any order."""

    @property
    def identity(self) -> str:
        """All of what is computed, a line each: two jobs with one text come to the same bits."""

    @property
    def blocks(self) -> int:
        """How many there are."""

    @property
    def dataset(self) -> xr.Dataset:
        """What is kept: variables of any numbers, which blocks fill, coordinates and attributes."""

    @property
    def chunks(self) -> Mapping[str, tuple[int, ...]]:
        """The chunks of each variable, of which each belongs to one block."""

    def places(self, number: int) -> Mapping[str, tuple[slice, ...]]:
        """Return which part of each array a block is."""

    def task(self, number: int) -> Callable[[], Mapping[str, npt.NDArray[Any]]]:
        """Return what computes the values of a block; it is pickled to workers."""


@dataclass(frozen=True)
class BlockStore:
    """The store of a job; it is pickled to workers."""

    place: str
    seal: str
    is_new: bool = False

    @classmethod
    def of(cls, job: BlockJob, place: str) -> BlockStore:
        """Return the store of a job, made if nothing is there."""
        record = _record_of(job)
        seal = sha256(json.dumps(record).encode()).hexdigest()
        is_new, is_here = _is_free(place), "://" not in place
        store = cls(str(Path(place).resolve()) if is_here else place, seal, is_new)
        with store._writing():
            if is_new and is_here:
                store = replace(store, is_new=store._put(job, record))
            store.begin(job, record)
        return store

    def _put(self, job: BlockJob, record: Mapping[str, Any]) -> bool:
        """Put the store in its place at once, lest another run finds half of it; tell if it is."""
        place = Path(self.place)
        draft = replace(self, place=str(place.with_name(f".{place.name}.{token_hex(8)}")))
        try:
            draft.begin(job, record)
            with suppress(OSError):  # An empty folder, which not every system replaces.
                place.rmdir()
            Path(draft.place).rename(place)
        except OSError:
            if not (place / _RECORD).is_dir():
                raise
            return False  # Another run has put its own there.
        finally:
            rmtree(draft.place, ignore_errors=True)
        return True

    def begin(self, job: BlockJob, record: Mapping[str, Any]) -> None:
        """Make what is not there yet, and check that all is of this job."""
        try:
            if self.is_new:
                group = self.group.require_group(_RECORD)
                group.attrs.update({**record, "seal": self.seal})
            self._check_record(record)
            try:
                beginning = self.marks.attrs.get(_BEGINNING)
            except KeyError:  # They are what is made last.
                beginning = _make(self, job)
            self._check_arrays(job, beginning)
        except OptipathError:
            raise
        except Exception as fault:  # Zarr may raise anything.
            if isinstance(fault, OSError) and not isinstance(fault, FileNotFoundError):
                raise
            raise JobError(
                f"the metadata of the store '{self.place}' are damaged; {_OTHER_PLACE}"
            ) from None

    def __getstate__(self) -> dict[str, Any]:
        # What is open stays here.
        return {"place": self.place, "seal": self.seal, "is_new": self.is_new}

    @cached_property
    def group(self) -> zarr.Group:
        """The group, open for writing."""
        files = FsspecStore.from_url(self.place) if "://" in self.place else LocalStore(self.place)
        # Metadata in one place, as xarray reads it, may be of another time.
        mode: Literal["a", "r+"] = "a" if self.is_new else "r+"
        return zarr.open_group(files, mode=mode, zarr_format=2, use_consolidated=False)

    @cached_property
    def marks(self) -> Any:
        """The array of the marks, a row for each block."""
        return self.group[_MARKS]

    @cached_property
    def arrays(self) -> dict[str, Any]:
        """The arrays that blocks fill, and those of the coordinates, by name."""
        # Opened at once, by the metadata in one place, by which xarray opens them as well.
        return dict(zarr.open_consolidated(self.group.store, mode="r+", zarr_format=2).arrays())

    def done(self, job: BlockJob) -> set[int]:
        """Return the numbers of intact blocks, and remove the marks of damaged ones."""
        marks = self._readable_marks(job.blocks)
        with ThreadPoolExecutor() as executor:
            intact = executor.map(self._is_intact, marks.values(), marks, map(job.places, marks))
            damaged = [number for number, good in zip(marks, intact, strict=True) if not good]
        with self._writing():
            for number in damaged:
                self.marks[number] = 0
        if damaged:
            warn(
                f"{len(damaged):,} of {job.blocks:,} blocks of '{self.place}' are damaged and "
                f"computed anew",
                StoreWarning,
            )
        return marks.keys() - {*damaged}

    def holds(self, number: int) -> bool:
        """Tell whether a block is marked as done."""
        return bool(np.any(self.marks[number]))

    def keep(
        self,
        number: int,
        places: Mapping[str, tuple[slice, ...]],
        values: Mapping[str, npt.NDArray[Any]],
    ) -> None:
        """Write a block, and then mark it as done."""
        with self._writing():
            if self.group[_RECORD].attrs.get("seal") != self.seal:
                raise JobError(f"another job has come to be in '{self.place}'; {_OTHER_PLACE}")
            for name, each in values.items():
                self.arrays[name][places[name]] = each
            self.marks[number] = self._mark(number, values)

    def discard_unused(self) -> None:
        """Remove it if this run has made it and no block of it is done."""
        if self.is_new and not np.any(self.marks[...]):
            files, path = url_to_fs(self.place)
            with suppress(FileNotFoundError):  # Another run has done so.
                files.rm(path, recursive=True)

    def _mark(self, number: int, values: Mapping[str, Any]) -> npt.NDArray[np.uint8]:
        digest = sha256(f"{number} of {self.seal}".encode())
        for name in sorted(values):
            each = values[name]
            if each.dtype.kind == "f":  # Zarr leaves out chunks of NaN alone, be it -NaN.
                each = np.where(np.isnan(each), each.dtype.type(np.nan), each)
            digest.update(np.ascontiguousarray(each).tobytes())
        return np.frombuffer(digest.digest(), np.uint8)

    def _readable_marks(self, blocks: int) -> dict[int, npt.NDArray[np.uint8]]:
        """Return the marks of all blocks that have one that can be read."""
        marks = _read(self.marks, ...)
        if marks is None:
            marks = [_read(self.marks, number) for number in range(blocks)]
        return {n: mark for n, mark in enumerate(marks) if mark is not None and np.any(mark)}

    def _is_intact(
        self, mark: npt.NDArray[np.uint8], number: int, places: Mapping[str, tuple[slice, ...]]
    ) -> bool:
        values = {name: _read(self.arrays[name], place) for name, place in places.items()}
        is_read = all(each is not None for each in values.values())
        return is_read and np.array_equal(mark, self._mark(number, values))

    def _check_record(self, record: Mapping[str, Any]) -> None:
        """Refuse what is no store of this job."""
        place = self.place
        try:
            result = dict(self.group[_RECORD].attrs)
        except (KeyError, FileNotFoundError):
            raise JobError(
                f"'{place}' is there, and is no store of blocks; {_OTHER_PLACE}"
            ) from None
        if result == {**record, "seal": self.seal}:
            return
        lines = result.get("lines")
        there = [
            f"format {result.get('format')}",
            *(lines if isinstance(lines, list) else record["lines"]),
        ]
        here = [f"format {FORMAT}", *record["lines"]]
        for one, other in zip_longest(there, here, fillvalue=""):
            if one != other:
                raise JobError(
                    f"'{place}' holds blocks of another job: it has {shown(one)}, where this one "
                    f"has {shown(other)}; {_OTHER_PLACE}"
                )
        raise JobError(f"the record of '{place}' is damaged; {_OTHER_PLACE}")

    def beginning(self, job: BlockJob) -> str:
        """Return a digest of the files that no block writes again, empty where one is lost."""
        files, place = url_to_fs(self.place)
        coords = job.dataset.coords.variables.items()
        names = [f"{name}/{'.'.join('0' * each.ndim or '0')}" for name, each in coords]
        digest = sha256(self.seal.encode())
        with suppress(OSError):
            there = files.cat([f"{place}/{name}" for name in (".zmetadata", *names)])
            for _, content in sorted(there.items()):
                digest.update(sha256(content).digest())
            return digest.hexdigest()
        return ""

    def _check_arrays(self, job: BlockJob, beginning: Any) -> None:
        """Refuse lost arrays, and coordinates that are damaged, which no block writes again."""
        damaged = sorted(job.chunks.keys() - self.arrays.keys())
        # To read them one by one takes longer, and is for files that somebody has written anew.
        same = beginning and beginning == self.beginning(job)
        for name, each in job.dataset.coords.variables.items() if not same else ():
            there, given = _read(self.arrays[str(name)], ...), _as_stored(each).to_numpy()
            if there is None or there.dtype != given.dtype or there.tobytes() != given.tobytes():
                damaged.append(str(name))
        if damaged:
            raise JobError(f"'{damaged[0]}' of the store '{self.place}' is damaged; {_OTHER_PLACE}")

    @contextmanager
    def _writing(self) -> Iterator[None]:
        try:
            yield
        except OSError as fault:
            raise JobError(
                f"the store '{self.place}' cannot be written: {fault.strerror or fault}; mend "
                f"that and start again, and what is done is not computed again"
            ) from None


def _is_free(place: str) -> bool:
    """Tell whether nothing is at a place yet, where a store can be made."""
    if "://" not in place:
        here = Path(place).resolve()
        if not here.parent.is_dir():
            raise JobError(f"there is no folder '{here.parent}' for a store; make it first")
        for each in (here, *here.rglob("*")):  # Zarr would wait for who writes to a pipe.
            if not (each.is_file() or each.is_dir()) and each.exists():
                raise JobError(f"'{each}' is there, and is no file; {_OTHER_PLACE}")
    try:
        files, path = url_to_fs(place)
        is_file = files.isfile(path)
        is_free = not (files.exists(path) and files.ls(path, detail=False))
    except Exception as fault:  # noqa: BLE001 - each kind of place has its own
        raise JobError(f"'{place}' cannot be used as a store: {fault}") from None
    if is_file:
        raise JobError(f"'{place}' is there, and is no folder; {_OTHER_PLACE}")
    return is_free


def _record_of(job: BlockJob) -> dict[str, Any]:
    """Return all that two jobs have in common if blocks of one may stand for those of the other."""
    variables = job.dataset.variables
    arrays = [
        f"array {name}: {list(variables[name].dims)}, {list(variables[name].shape)} in chunks of "
        f"{list(chunks)}, {variables[name].dtype}"
        for name, chunks in job.chunks.items()
    ]
    lines = [*job.identity.splitlines(), f"blocks: {job.blocks}", *arrays]
    return {"format": FORMAT, "lines": lines}


def _make(store: BlockStore, job: BlockJob) -> str:
    """Write the arrays of a job and its coordinates; the array of marks last."""
    group, dataset = store.group, job.dataset
    # Coordinates that do not bear the name of a dimension are told apart by this attribute.
    others = [str(name) for name, each in dataset.coords.variables.items() if each.dims != (name,)]
    group.attrs.update(dataset.attrs | ({"coordinates": " ".join(others)} if others else {}))
    for name, chunks in job.chunks.items():
        _create(group, name, dataset.variables[name], chunks)
    for coordinate, each in dataset.coords.variables.items():
        whole = _as_stored(each)
        _create(group, str(coordinate), whole, whole.shape)[...] = whole.to_numpy()
    # Version 2 of the format has all metadata at one place, and words, in its specification.
    zarr.consolidate_metadata(group.store, zarr_format=2)
    result = store.beginning(job)
    none = np.broadcast_to(np.uint8(0), (job.blocks, 32))
    marks = xr.Variable(("block", "byte"), none, {_BEGINNING: result})
    _create(group, _MARKS, marks, (1, 32))
    return result


def _as_stored(coordinate: xr.Variable) -> xr.Variable:
    """Return words as words of a fixed length, which stores have."""
    values = coordinate.to_numpy()
    whole = values.astype(str) if values.dtype.kind == "O" else values
    return xr.Variable(coordinate.dims, whole, coordinate.attrs)


def _create(group: zarr.Group, name: str, like: xr.Variable, chunks: tuple[int, ...]) -> Any:
    # xarray takes a fill value for one that is missing, which a number must not be.
    fill = np.nan if like.dtype.kind in "fc" else 0 if name == _MARKS else None
    chunks = tuple([max(size, 1) for size in chunks])
    with suppress(ContainsArrayError):  # Another run is making the same.
        group.create_array(name, shape=like.shape, chunks=chunks, dtype=like.dtype, fill_value=fill)
    array = group[name]
    array.attrs.update({**like.attrs, "_ARRAY_DIMENSIONS": list(map(str, like.dims))})
    return array


def _read(array: Any, place: Any) -> Any:
    """Return a part of an array, None where it is damaged."""
    try:
        return array[place]
    except Exception:  # noqa: BLE001 - codecs may raise anything
        return None
