import errno
import logging
import os
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pytest

from optipath.engines import cache_folder, code_cache, code_key
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
    return placed(monkeypatch, tmp_path, "cache")


@pytest.fixture
def kept(folder):
    CodeCache().keep(TEXT, CODE)
    (file,) = folder.iterdir()
    return file


def told(caplog):
    return [record.message for record in caplog.records]


def process(code, **options):
    """A process that runs a text, with the modules that are found here."""
    code = f"import sys; sys.path[:0] = {sys.path!r}\n{code}"
    return subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, **options)


def lines_of(code, **environment):
    with process(code, text=True, env={**os.environ, **environment}) as done:
        printed = done.stdout.read()
    assert done.returncode == 0
    return printed.splitlines()


def test_what_is_kept_is_found_by_its_text_this_processor_and_these_settings(kept, monkeypatch):
    assert CodeCache().load(TEXT) == CODE
    assert CodeCache().load(TEXT + " ") is None
    assert CodeCache().has(TEXT)
    assert not CodeCache().has(TEXT + " ")
    CodeCache().keep("another", b"another code")
    other = next(file for file in kept.parent.iterdir() if file != kept)
    monkeypatch.setenv("NUMBA_LOOP_VECTORIZE", "0")
    assert not CodeCache().has(TEXT)
    assert CodeCache().load(TEXT) is None
    monkeypatch.delenv("NUMBA_LOOP_VECTORIZE")
    kept.write_bytes(other.read_bytes())
    assert CodeCache().load(TEXT) is None


def test_of_a_folder_that_is_not_there_nothing_is_kept(folder):
    assert not CodeCache().has(TEXT)
    assert not folder.exists()


@posix
def test_the_folder_and_its_files_are_for_their_owner_alone(tmp_path, monkeypatch):
    place = placed(monkeypatch, tmp_path, "one", "two")
    before = os.umask(0)
    try:
        CodeCache().keep(TEXT, CODE)
    finally:
        os.umask(before)
    (file,) = place.iterdir()
    found = [stat.S_IMODE(each.stat().st_mode) for each in (place.parent, place, file)]
    assert found == [0o700, 0o700, 0o600]


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


def makers():
    sources, packages, python, processor = code_key._maker()
    yield ["altered", *sources[1:]], packages, python, processor
    yield [sources[0], "altered"], packages, python, processor
    for place in range(len(packages)):
        yield sources, [*packages[:place], "0.0", *packages[place + 1 :]], python, processor
    yield sources, packages, "3.0", processor
    for place in range(len(processor)):
        other = (*processor[:place], "another", *processor[place + 1 :])
        yield sources, packages, python, other


@pytest.mark.usefixtures("kept")
@rows("made_by", makers())
def test_code_by_other_sources_versions_or_processors_is_not_used(made_by):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(code_key, "_maker", lambda: made_by)
        assert CodeCache().load(TEXT) is None


@pytest.mark.usefixtures("folder")
def test_the_folder_of_numba_is_not_ours(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "numba"))
    CodeCache().keep(TEXT, CODE)
    assert CodeCache().load(TEXT) == CODE
    assert not (tmp_path / "numba").exists()


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
@rows("mode", [0o720, 0o702, 0o777, 0o1777, 0o770])
def test_a_folder_that_others_may_write_to_is_refused(kept, caplog, mode):
    kept.parent.chmod(mode)
    assert "others may write" in refused(caplog)


@posix
@rows("mode", [0o720, 0o702, 0o777])
def test_a_folder_that_others_may_replace_is_refused(tmp_path, monkeypatch, caplog, mode):
    place = tmp_path / f"open{mode}"
    placed(monkeypatch, place, "between", "cache")
    CodeCache().keep(TEXT, CODE)
    place.chmod(mode)
    assert "others may replace" in refused(caplog)
    place.chmod(mode | stat.S_ISVTX)
    assert CodeCache().load(TEXT) == CODE


@posix
def test_a_way_through_links_is_as_safe_as_what_they_lead_through(tmp_path, monkeypatch, caplog):
    (tmp_path / "open" / "true").mkdir(parents=True, mode=0o700)
    (tmp_path / "link").symlink_to(tmp_path / "open" / "true")
    placed(monkeypatch, tmp_path, "link", "cache")
    CodeCache().keep(TEXT, CODE)
    assert CodeCache().load(TEXT) == CODE
    (tmp_path / "open").chmod(0o777)
    assert "others may replace" in refused(caplog)
    placed(monkeypatch, tmp_path, "link")
    assert "is a link" in refused(caplog)


@posix
def test_files_that_others_may_write_links_and_pipes_are_not_used(kept, tmp_path, caplog):
    for mode in (0o620, 0o602):
        kept.chmod(mode)
        assert CodeCache().load(TEXT) is None
        assert "not a file of your own" in told(caplog)[-1]
    kept.chmod(0o600)
    kept.rename(tmp_path / "elsewhere")
    kept.symlink_to(tmp_path / "elsewhere")
    assert CodeCache().load(TEXT) is None
    kept.unlink()
    os.mkfifo(kept, 0o600)
    assert CodeCache().load(TEXT) is None


AS_OTHER = f"""
import logging, os
import llvmlite.binding
from optipath.engines.code_cache import CodeCache
from optipath.engines.code_key import _maker
_maker()
logging.basicConfig(stream=sys.stdout, format="%(message)s")
os.setgroups([]); os.setgid(12345); os.setuid(12345)
print(CodeCache().load({TEXT!r}))
CodeCache().keep({TEXT!r}, b"planted")
print(CodeCache().load({TEXT!r}))
"""


@pytest.fixture
def of_all(monkeypatch):
    """A folder that everybody may come to, which the folders of tests are not."""
    if not hasattr(os, "getuid") or os.getuid() != 0:
        pytest.skip("only root can be another user")
    place = Path(tempfile.mkdtemp())
    place.chmod(0o1777)
    placed(monkeypatch, place, "cache")
    yield place
    shutil.rmtree(place)


@pytest.mark.usefixtures("of_all")
def test_what_another_user_owns_is_neither_used_nor_changed():
    CodeCache().keep(TEXT, CODE)
    found = lines_of(AS_OTHER)
    assert found[-1] == "None"
    assert any("belongs to another user" in line for line in found)
    assert CodeCache().load(TEXT) == CODE


@pytest.mark.usefixtures("of_all")
def test_what_another_user_has_planted_is_not_used(caplog):
    assert lines_of(AS_OTHER)[-1] == "b'planted'"
    assert "belongs to another user" in refused(caplog)


def test_files_and_ways_of_another_user_are_not_used(of_all, monkeypatch, caplog):
    CodeCache().keep(TEXT, CODE)
    (file,) = (of_all / "cache").iterdir()
    os.chown(file, 12345, 12345)
    assert CodeCache().load(TEXT) is None
    assert "not a file of your own" in told(caplog)[0]
    placed(monkeypatch, of_all, "theirs", "cache")
    CodeCache().keep(TEXT, CODE)
    os.chown(of_all / "theirs", 12345, 12345)
    assert "others may replace" in refused(caplog)


def test_a_user_who_may_not_write_there_computes_on(of_all):
    of_all.chmod(0o755)
    lines = lines_of(AS_OTHER)
    assert sum("Permission denied" in line for line in lines) == 1
    assert lines[-1] == "None"


@rows("fault", [errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EIO])
def test_a_full_or_broken_disk_is_told_once_and_leaves_nothing(folder, caplog, fault):
    def write(*_):
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


LIMITED = """
import logging, resource
logging.basicConfig(stream=sys.stdout, format="%(message)s")
resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
from optipath.engines.code_cache import CodeCache
cache = CodeCache()
cache.keep("long", bytes(100_000))
cache.keep("longer", bytes(200_000))
print(cache.load("long"))
"""


@posix
def test_a_file_that_may_not_grow_is_told_once_and_leaves_nothing(folder):
    message, last = lines_of(LIMITED)
    assert os.strerror(errno.EFBIG) in message
    assert last == "None"
    assert list(folder.iterdir()) == []


KILLED = """
import os, time
from optipath.engines.code_cache import CodeCache
def fsync(*_):
    print("writing", flush=True)
    time.sleep(60)
os.fsync = fsync
CodeCache().keep("a text", b"code")
"""


@posix
def test_what_a_killed_process_has_left_is_cleared_by_the_next(folder):
    with process(KILLED) as killed:
        killed.stdout.readline()
        assert len(list(folder.iterdir())) == 1
        killed.send_signal(signal.SIGKILL)
    assert len(list(folder.iterdir())) == 1
    CodeCache().load(TEXT)
    assert list(folder.iterdir()) == []


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
    monkeypatch.setattr(cache_folder.Path, "home", staticmethod(home))
    assert "there is no home folder" in refused(caplog)


@pytest.mark.usefixtures("kept")
def test_a_file_removed_between_look_and_load_is_compiled_anew(monkeypatch, caplog):
    read = code_cache.read_own

    def removed(file):
        file.unlink(missing_ok=True)
        return read(file)

    monkeypatch.setattr(code_cache, "read_own", removed)
    assert CodeCache().load(TEXT) is None
    assert told(caplog) == []


def test_a_folder_removed_meanwhile_is_made_anew(kept):
    cache = CodeCache()
    assert cache.load(TEXT) == CODE
    kept.unlink()
    kept.parent.rmdir()
    assert cache.load(TEXT) is None
    cache.keep(TEXT, CODE)
    assert cache.load(TEXT) == CODE


BESIDE = """
from optipath.engines.code_cache import CodeCache
for number in range(60):
    text, cache = f"text {number % 7}", CodeCache()
    found = cache.load(text)
    assert found in (None, text.encode() * 50), found
    cache.keep(text, text.encode() * 50)
    if number % 20 == 19:
        cache.clear()
"""


def test_processes_beside_each_other_do_each_other_no_harm(folder):
    several = [process(BESIDE, stderr=subprocess.PIPE) for _ in range(3)]
    for each in several:
        _, errors = each.communicate()
        assert each.returncode == 0, errors
    CodeCache().clear()
    assert list(folder.iterdir()) == []


def test_what_was_not_used_for_longest_goes_first(folder, monkeypatch):
    size = len(CODE) + 32
    monkeypatch.setenv("OPTIPATH_CACHE_BYTES", str(3 * size))
    cache = CodeCache()
    for age, text in enumerate("abc"):
        cache.keep(text, CODE)
        newest = max(folder.iterdir(), key=lambda file: file.stat().st_mtime_ns)
        os.utime(newest, (time.time() - 100 + age,) * 2)
    assert cache.load("a") == CODE
    cache.keep("d", CODE)
    assert [cache.load(text) is not None for text in "abcd"] == [True, False, True, True]
    assert sum(entry.length for entry in cache.entries()) <= cache.limit


def test_the_disk_is_bounded_whatever_is_kept(folder, monkeypatch):
    monkeypatch.setenv("OPTIPATH_CACHE_BYTES", "5000")
    cache = CodeCache()
    for number in range(60):
        cache.keep(f"text {number}", bytes(37 * number))
        assert sum(file.stat().st_size for file in folder.iterdir()) <= 5000
    cache.keep("too long", bytes(6000))
    assert cache.load("too long") is None


@rows("name", ["OPTIPATH_CACHE_BYTES", "OPTIPATH_CACHE_FUNCTIONS"])
@rows("value", ["abc", "-1", "1e6", "0x10", "٣", "9" * 5000])
def test_a_limit_that_is_no_number_is_told(name, value):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(name, value)
        with pytest.raises(CacheError, match=name):
            _ = CodeCache().limit + CodeCache().most_functions


def test_clearing_removes_everything_of_ours_and_nothing_else(kept):
    (kept.parent / "notes.txt").write_text("mine")
    (kept.parent / "left.draft").write_text("half")
    assert CodeCache().clear() == 1
    assert [file.name for file in kept.parent.iterdir()] == ["notes.txt"]
