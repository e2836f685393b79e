import gc
import re
import threading
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("numba")
from optipath.engines import code_key, machine_code
from optipath.engines.array_address import address
from optipath.engines.code_cache import CodeCache
from optipath.engines.machine_code import MachineCode, compiled
from tables import rows

TEXT = """
def path(count: 'int64', factor: 'float64', given: '*float64', flags: '*uint8', out: '*float64'):
    good = True
    for i in range(count):
        out[i] = factor * given[i] + {number}
        good = good & (flags[i] != 0)
    return 1 if good else 0
"""


@pytest.fixture(scope="module")
def code():
    return compiled(TEXT.format(number=0.5))


@rows("last", [True, False])
def test_machine_code_reads_and_writes_arrays(code, last):
    given, flags, out = np.arange(100.0), np.ones(100, bool), np.empty(100)
    flags[-1] = last
    assert MachineCode(code)(100, 3.0, *map(address, (given, flags, out))) == last
    np.testing.assert_array_equal(out, 3.0 * given + 0.5)


def test_the_address_of_an_array_is_found_whether_or_not_it_may_be_written():
    for array in (np.ones(3), np.ones(0), np.broadcast_to(1.0, 4), np.ones((2, 3))[1:]):
        assert address(array) == array.__array_interface__["data"][0]


def test_a_function_that_there_is_not_is_no_crash(code):
    header, _, body = code.partition(b"\n")
    damaged = header.replace(b'"needs": []', b'"needs": ["optipath_has_none"]') + b"\n" + body
    with pytest.raises(RuntimeError, match="optipath_has_none"):
        MachineCode(damaged)


def resident():
    return int(re.search(r"VmRSS:\s+(\d+)", Path("/proc/self/status").read_text())[1])


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="tells memory on Linux")
def test_code_that_is_dropped_frees_its_memory(code):
    for _ in range(20):
        MachineCode(code)
    before = resident()
    for _ in range(400):
        MachineCode(code)
    gc.collect()
    # 2000 that are kept are some 100 MB.
    assert resident() - before < 10_000


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="tells memory on Linux")
def test_compiling_leaves_nothing_in_memory():
    for number in range(5):
        compiled(TEXT.format(number=float(number)))
    gc.collect()
    before = resident()
    for number in range(5, 15):
        compiled(TEXT.format(number=float(number)))
    gc.collect()
    # What the engine of Numba keeps of each is more than 1 MB.
    assert resident() - before < 4_000


def test_memory_holds_as_many_functions_as_it_may(code, monkeypatch, tmp_path):
    monkeypatch.setenv("OPTIPATH_CACHE", str(tmp_path))
    monkeypatch.setenv("OPTIPATH_CACHE_FUNCTIONS", "3")
    cache, asked = CodeCache(), []

    def compiling(text):
        asked.append(text)
        return code

    monkeypatch.setattr(cache, "load", lambda _: None)
    held = [cache.function(text, compiling) for text in "abcaded"]
    assert asked == ["a", "b", "c", "d", "e"]
    assert len(cache._functions) == 3
    cache.function("b", compiling)
    assert asked[-1] == "b"
    out = np.empty(1)
    assert held[1](1, 2.0, address(np.ones(1)), address(np.ones(1, bool)), address(out)) == 1
    assert out[0] == 2.5


def test_threads_that_ask_together_compile_once(code, monkeypatch, tmp_path):
    monkeypatch.setenv("OPTIPATH_CACHE", str(tmp_path))
    cache, asked = CodeCache(), []
    several = [
        threading.Thread(target=cache.function, args=("a", lambda t: asked.append(t) or code))
        for _ in range(8)
    ]
    for thread in several:
        thread.start()
    for thread in several:
        thread.join()
    assert asked == ["a"]


def test_altered_helpers_are_compiled_anew(code, monkeypatch, tmp_path):
    monkeypatch.setenv("OPTIPATH_CACHE", str(tmp_path / "cache"))
    CodeCache().keep("a text", code)
    assert CodeCache().load("a text") == code
    package = Path(machine_code.__file__).parent
    for name in ("numba_helpers.py", "machine_code.py"):
        (tmp_path / name).write_text((package / name).read_text("utf-8") + "\n", "utf-8")
    code_key._maker.cache_clear()
    monkeypatch.setattr(code_key, "files", lambda _: tmp_path)
    assert CodeCache().load("a text") is None
    monkeypatch.undo()
    code_key._maker.cache_clear()
