import os
import stat
from pathlib import Path

import pytest

from optipath.values.written_files import write_file


def names(folder):
    return sorted(file.name for file in folder.iterdir())


def mode(file):
    return stat.S_IMODE(file.stat().st_mode)


@pytest.mark.parametrize("umask", [0o022, 0o077, 0o002])
def test_a_new_file_has_the_permissions_that_the_umask_leaves(tmp_path, umask):
    before = os.umask(umask)
    try:
        write_file(tmp_path / "a", b"new")
    finally:
        os.umask(before)
    assert (tmp_path / "a").read_bytes() == b"new"
    assert mode(tmp_path / "a") == 0o666 & ~umask
    assert names(tmp_path) == ["a"]


def test_a_file_that_is_replaced_keeps_its_permissions(tmp_path):
    file = tmp_path / "a"
    file.write_bytes(b"old and longer")
    file.chmod(0o640)
    write_file(file, b"new")
    assert (file.read_bytes(), mode(file)) == (b"new", 0o640)


def test_links_are_followed(tmp_path):
    (tmp_path / "there").mkdir()
    target, link, dangling = tmp_path / "there" / "a", tmp_path / "link", tmp_path / "dangling"
    target.write_bytes(b"old")
    link.symlink_to(target)
    dangling.symlink_to("there/b")
    write_file(link, b"new")
    write_file(dangling, b"new")
    assert link.is_symlink()
    assert dangling.is_symlink()
    assert target.read_bytes() == (tmp_path / "there" / "b").read_bytes() == b"new"
    assert names(tmp_path / "there") == ["a", "b"]


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
@pytest.mark.parametrize("call", ["fsync", "replace"])
def test_what_was_there_stays_where_writing_fails_and_no_draft_is_left(
    tmp_path, monkeypatch, error, call
):
    def fail(*_):
        raise error

    monkeypatch.setattr(*((os, "fsync") if call == "fsync" else (Path, "replace")), fail)
    (tmp_path / "a").write_bytes(b"old")
    for name in ("a", "b"):
        with pytest.raises(type(error)):
            write_file(tmp_path / name, b"new")
    assert names(tmp_path) == ["a"]
    assert (tmp_path / "a").read_bytes() == b"old"


def test_devices_are_written_to_and_not_replaced():
    write_file(Path("/dev/null"), b"light")
    assert stat.S_ISCHR(Path("/dev/null").stat().st_mode)
    with pytest.raises(OSError, match="No space left"):
        write_file(Path("/dev/full"), b"light")


def test_the_longest_names_can_be_written(tmp_path):
    write_file(tmp_path / ("a" * 255), b"new")
    assert names(tmp_path) == ["a" * 255]


def test_a_pipe_is_written_to_by_any_of_its_names():
    reads, writes = os.pipe()
    write_file(Path(f"/dev/fd/{writes}"), b"light")
    os.close(writes)
    with os.fdopen(reads, "rb") as pipe:
        assert pipe.read() == b"light"


def test_links_that_lead_to_each_other_are_left_as_they_are(tmp_path):
    (tmp_path / "a").symlink_to("b")
    (tmp_path / "b").symlink_to("a")
    with pytest.raises(OSError, match="Too many levels"):
        write_file(tmp_path / "a", b"light")
    assert (tmp_path / "a").is_symlink()
