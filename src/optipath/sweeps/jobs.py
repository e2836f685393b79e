"""Jobs of blocks: identity, records and marks of what is stored."""

from __future__ import annotations

import json
import shutil
from hashlib import sha256
from pathlib import Path
from stat import S_ISREG
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from optipath.errors import JobError, shown
from optipath.values.files import write_own_file

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from os import PathLike

    import numpy.typing as npt


class StoredArray(NamedTuple):
    """An array that blocks fill, part by part."""

    dims: tuple[str, ...]
    shape: tuple[int, ...]
    chunks: tuple[int, ...]
    dtype: str = "float64"
    attrs: Mapping[str, Any] = {}


class WholeArray(NamedTuple):
    """A small array that is written when the store is made, such as a coordinate."""

    dims: tuple[str, ...]
    values: npt.NDArray[Any]
    attrs: Mapping[str, Any] = {}


class BlockPart(Protocol):
    """What a worker is sent of a job for one block."""

    def compute(self, number: int) -> Mapping[str, tuple[tuple[slice, ...], npt.NDArray[Any]]]:
        """Compute one block."""


class BlockJob(BlockPart, Protocol):
    """A large job, cut into blocks that are computed each by itself, in any order.

    It is pickled to workers, so its fields are plain data. A large one has a method
    ``part(number)``, which returns the `BlockPart` that is sent in its place.
    """

    @property
    def identity(self) -> str:
        """All of what is computed: two jobs with one text come to the same bits."""

    @property
    def blocks(self) -> int:
        """How many there are."""

    @property
    def arrays(self) -> Mapping[str, StoredArray]:
        """What is kept, by name."""

    @property
    def coords(self) -> Mapping[str, WholeArray]:
        """What is known before, by name: the coordinates of the arrays."""

    @property
    def attrs(self) -> Mapping[str, Any]:
        """What the whole is, as JSON can hold it."""


FORMAT = 2
"""That of stores as they are written now."""

OTHER_PLACE = "take another name, or delete it"
RECORD = "blocks/.zattrs"
FILES = "blocks/files"
"""The mark of the files that are there before any block."""

_METADATA = (".zarray", ".zattrs")


def record_of(job: BlockJob) -> dict[str, Any]:
    """Return all that two jobs have in common if blocks of one may stand for those of the other."""
    arrays = {
        name: [[*each.dims], [*map(int, each.shape)], [*map(int, each.chunks)], each.dtype]
        for name, each in job.arrays.items()
    }
    return {"format": FORMAT, "identity": job.identity, "blocks": job.blocks, "arrays": arrays}


def check_record(folder: Path, record: dict[str, Any]) -> None:
    """Refuse a folder that is not the store of a job."""
    if not folder.is_dir():
        raise JobError(f"'{folder}' is there, and is no folder; {OTHER_PLACE}")
    if not (folder / RECORD).exists():
        raise JobError(f"'{folder}' is there, and is no store of blocks; {OTHER_PLACE}")
    result = object_of(folder / RECORD)
    version, identity = result.get("format"), result.get("identity")
    if version is None or not isinstance(identity, str):
        raise JobError(f"the record '{folder / RECORD}' is damaged; {OTHER_PLACE}: '{folder}'")
    if version != FORMAT:
        raise JobError(
            f"'{folder}' has format {shown(version)}, and this version of optipath knows {FORMAT}; "
            f"use the version that made it, or {OTHER_PLACE}"
        )
    if result != record:
        difference = _difference(identity, record["identity"]) or _layout(result, record)
        raise JobError(f"'{folder}' holds blocks of another job{difference}; {OTHER_PLACE}")


def group_attrs(job: BlockJob) -> dict[str, Any]:
    """Return the attributes of the group of a job."""
    # Coordinates that do not bear the name of a dimension are told apart by this attribute.
    others = [name for name, each in job.coords.items() if each.dims != (name,)]
    return {**job.attrs, **({"coordinates": " ".join(others)} if others else {})}


def check_files(folder: Path, about: str, job: BlockJob) -> None:
    """Refuse a store of which a file is damaged or gone that no block writes again."""
    damaged = [*damaged_files(folder, FILES, about)]
    if damaged and not ({*damaged} <= {".zattrs", ".zmetadata"} and _has_notes(folder, job)):
        raise JobError(
            f"the file '{folder / damaged[0]}' is damaged or gone; {OTHER_PLACE}: '{folder}'"
        )


def _has_notes(folder: Path, job: BlockJob) -> bool:
    """Tell whether attributes were added by hand to the group, in both of Zarr's files alike."""
    attrs, result = group_attrs(job), object_of(folder / ".zattrs")
    message = object_of(folder / ".zmetadata").get("metadata")
    needed = {f"{name}/{each}" for name in (*job.arrays, *job.coords) for each in _METADATA}
    return (
        isinstance(message, dict)
        and {".zgroup", ".zattrs", *needed} <= message.keys()
        and attrs.items() < result.items()
        and all(content == object_of(folder / name) for name, content in message.items())
    )


def _difference(there: str, here: str) -> str:
    """Return where two identities begin to differ, ready to be put behind a fault."""
    for line_there, line_here in zip(there.splitlines(), here.splitlines(), strict=False):
        if line_there != line_here:
            return f": it has {shown(line_there)}, where this one has {shown(line_here)}"
    return ""


def _layout(there: dict[str, Any], here: dict[str, Any]) -> str:
    """Return what else of two records differs, ready to be put behind a fault."""
    for name, value in here.items():
        if there.get(name) != value:
            return f": it has {name} {shown(there.get(name))}, where this one has {shown(value)}"
    return ""


_MOST = 1 << 26
"""How many bytes a mark or a file of metadata may have; that of a chunk is known."""


def mark_of(about: str, stamps: Mapping[str, list[Any]]) -> bytes:
    """Return the content of a mark."""
    content = json.dumps(stamps, sort_keys=True).encode()  # Chunks come in any order.
    return _seal(about, content) + b"\n" + content


def damaged_files(folder: Path, mark: str, about: str) -> Iterator[str]:
    """Yield the names of files that are not as a mark says; its own name where it is damaged.

    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     place = Path(folder)
    ...     put_file(place / "mark", mark_of("block 0", {"S0": stamp_of(b"light")}))
    ...     put_file(place / "S0", b"night")
    ...     print(*damaged_files(place, "mark", "block 0"), *damaged_files(place, "mark", "1"))
    S0 mark
    """
    seal, _, stamps = content_of(folder / mark).partition(b"\n")
    if seal != _seal(about, stamps):
        yield mark
        return
    for name, stamp in json.loads(stamps).items():
        if stamp_of(content_of(folder / name, stamp[0])) != stamp:
            yield name


def _seal(about: str, stamps: bytes) -> bytes:
    return sha256(f"{about}\n".encode() + stamps).hexdigest().encode()


def stamp_of(content: bytes) -> list[Any]:
    """Return the size and the digest of what a file is to hold."""
    return [len(content), sha256(content).hexdigest()]


def content_of(file: Path, most: int = _MOST) -> bytes:
    """Return what is in a regular file that is not too large; pipes may never end."""
    try:
        about = file.stat()
        if S_ISREG(about.st_mode) and 0 < about.st_size <= most:
            with file.open("rb") as stream:
                return stream.read(about.st_size)
    except PermissionError:
        raise
    except OSError:
        pass
    return b""


def object_of(file: Path) -> dict[str, Any]:
    """Return the JSON object that is in a file; an empty one where there is none."""
    try:
        result = json.loads(content_of(file))
    except (ValueError, RecursionError):
        return {}
    return result if isinstance(result, dict) else {}


def put_file(file: Path, content: bytes) -> None:
    """Write a file, whole or not at all, in place of whatever is there."""
    if file.is_dir():
        clear(file)
    write_own_file(file, content, 0o666)


def clear(place: Path) -> None:
    """Remove a file, a folder, or what else may be at a place; a link, and not what it leads to."""
    if place.is_dir() and not place.is_symlink():
        shutil.rmtree(place)
    else:
        place.unlink(missing_ok=True)


def place_of_blocks(store: str | PathLike[str]) -> Path:
    """Return where the blocks of a sweep are until all are there.

    >>> place_of_blocks("sweep.zarr").name, place_of_blocks("sweep.nc").name
    ('sweep.zarr', '.sweep.nc.blocks')
    """
    place = Path(store)
    return place.with_name(f".{place.name}.blocks") if place.suffix == ".nc" else place
