"""Compiled code is found by all that it depends on, is its owner's alone, and never in the way."""

import errno
import logging
import os
import stat
import subprocess
import sys
import time
from pathlib import Path

import pytest

from optipath.engines import code_cache
from optipath.engines.code_cache import CodeCache
from optipath.errors import CacheError
from tables import rows

pytest.importorskip("llvmlite")
posix = pytest.mark.skipif(not hasattr(os, "getuid"), reason="folders of others are a POSIX matter")
TEXT, CODE = "the text of a path", b"what is made of it" * 20


def placed(monkeypatch, *parts):
    """The folder of the cache, from now on."""
    place = Path(*parts)
    monkeypatch.setenv("OPTIPATH_CACHE", str(place))
    return place


@pytest.fixture
def folder(tmp_path, monkeypatch):
    return placed(monkeypatch, tmp_path, "open", "between", "cache")


@pytest.fixture
def kept(folder):
    CodeCache().keep(TEXT, CODE)
    (file,) = folder.iterdir()
    return file


def told(caplog):
    return [record.message for record in caplog.records]


def test_what_is_kept_is_found_by_its_text(
    folder,
):
    assert not CodeCache().has(TEXT)
    assert not folder.exists()
    CodeCache().keep(TEXT, CODE)
    (kept,) = folder.iterdir()
    assert [CodeCache().load(text) for text in (TEXT, TEXT + " ")] == [CODE, None]
    assert [CodeCache().has(text) for text in (TEXT, TEXT + " ")] == [True, False]
    CodeCache().keep("another", b"another code")
    other = next(file for file in folder.iterdir() if file != kept)
    kept.write_bytes(other.read_bytes())
    assert CodeCache().load(TEXT) is None


def test_one_flipped_bit_anywhere_or_another_length_is_seen(kept):
    whole = kept.read_bytes()
    changed = [whole[:length] for length in (0, 1, 31, 32, 33, 100)] + [whole + b"\0"]
    for place in range(len(whole)):
        flipped = bytearray(whole)
        flipped[place] ^= 1 << place % 8
        changed.append(flipped)
    for damaged in changed:
        kept.write_bytes(damaged)
        assert CodeCache().load(TEXT) is None
        assert not kept.exists()


@pytest.mark.usefixtures("kept")
def test_code_by_other_versions_or_processors_is_not_used(monkeypatch):
    made_by = code_cache._maker()
    assert len(made_by) == 6
    for place in range(len(made_by) + 1):
        other = (*made_by[:place], "another", *made_by[place + 1 :])[: len(made_by)]
        monkeypatch.setattr(code_cache, "_maker", lambda other=other: other)
        assert CodeCache().load(TEXT) == (CODE if other == made_by else None), other


def refused(caplog):
    """What is told once where nothing is read from or put into the folder."""
    cache = CodeCache()
    caplog.clear()
    with caplog.at_level(logging.WARNING, "optipath"):
        assert cache.load(TEXT) is None
        cache.keep(TEXT, CODE)
        cache.keep(TEXT, CODE)
        assert cache.load(TEXT) is None
    (message,) = told(caplog)
    assert message.startswith("compiled code is not kept: ")
    for ask in (cache.entries, cache.clear):
        with pytest.raises(CacheError):
            ask()
    return message


@posix
def test_a_folder_that_others_may_write_to_is_refused(kept, tmp_path, monkeypatch, caplog):
    for mode in (0o720, 0o702, 0o702 | stat.S_ISVTX):
        kept.parent.chmod(mode)
        assert "is not yours alone" in refused(caplog)
    kept.parent.chmod(0o700)
    # A way through links is as safe as what is at its end; a link at its end may be another's.
    (tmp_path / "link").symlink_to(kept.parent.parent)
    placed(monkeypatch, tmp_path, "link", "cache")
    assert CodeCache().load(TEXT) == CODE
    placed(monkeypatch, tmp_path, "link")
    assert "is no folder" in refused(caplog)


@posix
def test_the_folder_and_its_files_are_for_their_owner_and_other_files_are_not_used(
    folder, tmp_path, caplog
):
    before = os.umask(0)
    try:
        CodeCache().keep(TEXT, CODE)
    finally:
        os.umask(before)
    (kept,) = folder.iterdir()
    found = [stat.S_IMODE(each.stat().st_mode) for each in (folder.parent, folder, kept)]
    assert found == [0o700, 0o700, 0o600]
    for mode in (0o620, 0o602):
        kept.chmod(mode)
        assert CodeCache().load(TEXT) is None
        assert "is not yours alone" in told(caplog)[-1]
    kept.chmod(0o600)
    kept.rename(tmp_path / "elsewhere")
    kept.symlink_to(tmp_path / "elsewhere")
    assert CodeCache().load(TEXT) is None
    kept.unlink()
    os.mkfifo(kept, 0o600)
    assert CodeCache().load(TEXT) is None


def test_what_another_user_owns_is_not_used(kept, caplog):
    if not hasattr(os, "getuid") or os.getuid() != 0:
        pytest.skip("only root can give files to another user")
    os.chown(kept, 12345, 12345)
    assert CodeCache().load(TEXT) is None
    assert "is not yours alone" in told(caplog)[0]
    os.chown(kept.parent, 12345, 12345)
    assert "is not yours alone" in refused(caplog)


@rows("fault", [errno.ENOSPC, errno.EROFS])
def test_a_full_or_broken_disk_is_told_once_and_leaves_nothing(folder, caplog, fault):
    def write(*_):
        # What a killed process leaves is a draft, which the next clears.
        assert [file.suffix for file in folder.iterdir()] == [".draft"]
        raise OSError(fault, os.strerror(fault))

    caplog.clear()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(os, "fsync", write)
        cache = CodeCache()
        cache.keep(TEXT, CODE)
        cache.keep(TEXT, CODE)
    assert list(folder.iterdir()) == []
    (message,) = told(caplog)
    assert os.strerror(fault) in message


def test_a_folder_that_cannot_be_one_is_told(tmp_path, monkeypatch, caplog):
    (tmp_path / "file").write_text("in the way")
    placed(monkeypatch, tmp_path, "file")
    assert "is no folder" in refused(caplog)
    placed(monkeypatch, tmp_path, "file", "cache")
    refused(caplog)
    assert (tmp_path / "file").read_text() == "in the way"

    def home():
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.delenv("OPTIPATH_CACHE")
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr(code_cache.Path, "home", staticmethod(home))
    assert "there is no home folder" in refused(caplog)


def test_what_is_removed_meanwhile_is_compiled_and_made_anew(kept, monkeypatch, caplog):
    cache, read = CodeCache(), code_cache._bytes_of
    assert cache.load(TEXT) == CODE

    def removed(file):
        file.unlink(missing_ok=True)
        return read(file)

    with monkeypatch.context() as patch:
        patch.setattr(code_cache, "_bytes_of", removed)
        assert CodeCache().load(TEXT) is None
    assert told(caplog) == []
    kept.parent.rmdir()
    assert cache.load(TEXT) is None
    cache.keep(TEXT, CODE)
    assert cache.load(TEXT) == CODE


COMMON_KEYS = f"""
import sys
sys.path[:0] = {sys.path!r}
from optipath.engines.code_cache import CodeCache
for number in range(60):
    text, cache = f"text {{number % 7}}", CodeCache()
    found = cache.load(text)
    assert found in (None, text.encode() * 50), found
    cache.keep(text, text.encode() * 50)
    if number % 20 == 19:
        cache.clear()
"""


def test_processes_beside_each_other_do_each_other_no_harm(folder):
    command = [sys.executable, "-c", COMMON_KEYS]
    for each in [subprocess.Popen(command, stderr=subprocess.PIPE) for _ in range(3)]:
        _, errors = each.communicate()
        assert each.returncode == 0, errors
    CodeCache().clear()
    assert list(folder.iterdir()) == []


def test_what_was_not_used_for_longest_goes_first_and_the_disk_is_bounded(folder, monkeypatch):
    monkeypatch.setenv("OPTIPATH_CACHE_BYTES", str(3 * (len(CODE) + 32)))
    cache = CodeCache()
    for age, text in enumerate("abc"):
        cache.keep(text, CODE)
        newest = max(folder.iterdir(), key=lambda file: file.stat().st_mtime_ns)
        os.utime(newest, (time.time() - 100 + age,) * 2)
    assert cache.load("a") == CODE
    cache.keep("d", CODE)
    assert [cache.load(text) is not None for text in "abcd"] == [True, False, True, True]
    assert sum(entry.length for entry in cache.entries()) <= cache.limit
    monkeypatch.setenv("OPTIPATH_CACHE_BYTES", "5000")
    for number in range(60):
        cache.keep(f"text {number}", bytes(37 * number))
        assert sum(file.stat().st_size for file in folder.iterdir()) <= 5000
    cache.keep("too long", bytes(6000))
    assert cache.load("too long") is None
    for value in ("-1", "1e6", "٣", "9" * 19):
        monkeypatch.setenv("OPTIPATH_CACHE_BYTES", value)
        with pytest.raises(CacheError, match="OPTIPATH_CACHE_BYTES"):
            _ = CodeCache().limit
    monkeypatch.setenv("OPTIPATH_CACHE_BYTES", "9" * 18)
    assert CodeCache().limit == 10**18 - 1


def test_drafts_that_were_left_go_first_and_clearing_removes_nothing_but_ours(kept):
    (kept.parent / "notes.txt").write_text("mine")
    (kept.parent / "left.draft").write_text("half")
    cache = CodeCache()
    assert cache.load(TEXT) == CODE
    assert {file.name for file in kept.parent.iterdir()} == {"notes.txt", kept.name}
    (kept.parent / "left.draft").write_text("half")
    assert cache.clear() == 1
    assert [file.name for file in kept.parent.iterdir()] == ["notes.txt"]
