"""Files that are read and written: their names, sizes and permissions."""

from __future__ import annotations

import os
import stat
from pathlib import Path

import pytest

import optipath as op
from optipath.values.columns import columns_of
from optipath.values.files import LARGEST, write_file
from tables import rows


def height_field(file):
    return op.surfaces.HeightField.from_file(file, size=("1 mm", "1 mm"))


READERS = [("x.csv", op.Spectrum.from_csv), ("x.csv", op.Material.from_csv)]
READERS += [("x.yml", op.Material.from_yaml), ("x.txt", height_field), ("x.npy", height_field)]
READERS += [("x.nc", op.surfaces.load_hemisphere), ("x.csv", columns_of)]


@rows("read", [read for _, read in READERS[:3]])
@rows("path", [None, b"x.csv", "", "a\0b.toml"])
def test_what_is_no_name_of_a_file_is_refused(read, path):
    with pytest.raises(op.OptipathError, match="name of a file"):
        read(path)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no named pipes")
def test_what_is_no_file_is_refused_and_not_waited_for(tmp_path):
    for number, (name, read) in enumerate(READERS):
        folder = tmp_path / f"{number}"
        folder.mkdir()
        for make in (os.mkfifo, lambda path: path.symlink_to("/dev/zero"), os.mkdir):
            make(folder / name)
            with pytest.raises(op.OptipathError):
                read(folder / name)
            (folder / name).rename(folder / f"{len(list(folder.iterdir()))}")


def test_a_column_is_asked_for_by_its_name_in_a_file_that_is_not_too_large(tmp_path):
    file = tmp_path / "lamp.csv"
    file.write_text("wavelength (nm), power\n400, 1\n500, 1\n")
    for given, told in (
        ({"column": 1}, "as texts, not as 1"),
        ({"unit": 5}, "as texts, not as 5"),
    ):
        with pytest.raises(op.errors.ValueFault, match=told):
            op.Spectrum.from_csv(file, **given)
    with file.open("wb") as stream:
        stream.truncate(LARGEST + 1)
    with pytest.raises(op.OptipathError, match="larger than 64 MiB"):
        columns_of(file)


def names(folder):
    return sorted(file.name for file in folder.iterdir())


def mode(file):
    return stat.S_IMODE(file.stat().st_mode)


def test_a_file_that_is_written_has_its_permissions_and_any_name(tmp_path):
    for umask in (0o022, 0o077, 0o002):
        folder = tmp_path / f"{umask}"
        folder.mkdir()
        before = os.umask(umask)
        try:
            write_file(folder / "a", b"new")
        finally:
            os.umask(before)
        assert (folder / "a").read_bytes() == b"new"
        assert mode(folder / "a") == 0o666 & ~umask
        assert names(folder) == ["a"]
    file = tmp_path / "18" / "a"
    file.write_bytes(b"old and longer")
    file.chmod(0o640)
    write_file(file, b"new")
    assert (file.read_bytes(), mode(file)) == (b"new", 0o640)
    write_file(file.with_name("a" * 255), b"new")
    assert names(file.parent) == ["a", "a" * 255]


def test_links_are_followed_and_left_where_they_lead_to_each_other(tmp_path):
    (tmp_path / "there").mkdir()
    target, link, dangling = tmp_path / "there" / "a", tmp_path / "link", tmp_path / "dangling"
    target.write_bytes(b"old")
    link.symlink_to(target)
    dangling.symlink_to("there/b")
    write_file(link, b"new")
    write_file(dangling, b"new")
    assert (link.is_symlink(), dangling.is_symlink()) == (True, True)
    assert target.read_bytes() == (tmp_path / "there" / "b").read_bytes() == b"new"
    assert names(tmp_path / "there") == ["a", "b"]
    (tmp_path / "a").symlink_to("b")
    (tmp_path / "b").symlink_to("a")
    with pytest.raises(OSError, match="Too many levels"):
        write_file(tmp_path / "a", b"light")
    assert (tmp_path / "a").is_symlink()


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
@pytest.mark.parametrize("place", [(os, "fsync"), (Path, "replace")])
def test_what_was_there_stays_where_writing_fails_and_no_draft_is_left(
    tmp_path, monkeypatch, error, place
):
    def fail(*_):
        raise error

    monkeypatch.setattr(*place, fail)
    (tmp_path / "a").write_bytes(b"old")
    for name in ("a", "b"):
        with pytest.raises(type(error)):
            write_file(tmp_path / name, b"new")
    assert names(tmp_path) == ["a"]
    assert (tmp_path / "a").read_bytes() == b"old"


@pytest.mark.skipif(not Path("/dev/fd").is_dir(), reason="there are no names of pipes")
def test_devices_and_pipes_are_written_to_and_not_replaced_and_pipes_are_read():
    write_file(Path("/dev/null"), b"light")
    assert stat.S_ISCHR(Path("/dev/null").stat().st_mode)
    with pytest.raises(OSError, match="No space left"):
        write_file(Path("/dev/full"), b"light")
    reads, writes = os.pipe()
    write_file(Path(f"/dev/fd/{writes}"), b"angle (deg)\n10\n20\n")
    os.close(writes)
    (column,) = columns_of(f"/dev/fd/{reads}")
    os.close(reads)
    assert column.texts == ("10 deg", "20 deg")
