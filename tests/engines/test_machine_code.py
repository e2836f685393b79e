"""Machine code by LLVM: that it computes, many at a time, and is freed."""

import ctypes
import gc
import platform
import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import optipath as op
from optipath.engines.path_formula import PathFormula
from optipath.kernels.carriers.carrier import StokesCarrier
from optipath.values.operands import MANY
from paths import chain
from tables import rows

machine_code = pytest.importorskip("optipath.engines.machine_code")
from optipath.engines.code_cache import CodeCache  # noqa: E402 - beside it
from optipath.engines.formula import Formula  # noqa: E402
from optipath.engines.llvm_engine import LlvmEngine, source  # noqa: E402
from optipath.engines.machine_code import MachineCode, machine_code_of, optimized  # noqa: E402
from optipath.engines.numpy_engine import NumpyEngine  # noqa: E402
from optipath.engines.symbols import SYMBOLIC, Recorder  # noqa: E402

TEXT = """
define i64 @path(i64 %count, double %factor, ptr %given, ptr %flags, ptr %out) {{
entry:
  br label %head
head:
  %i = phi i64 [ 0, %entry ], [ %next, %body ]
  %good = phi i1 [ true, %entry ], [ %both, %body ]
  %goes = icmp slt i64 %i, %count
  br i1 %goes, label %body, label %end
body:
  %at = getelementptr inbounds double, ptr %given, i64 %i
  %number = load double, ptr %at
  %times = fmul double %factor, %number
  %more = fadd double %times, {number}
  %to = getelementptr inbounds double, ptr %out, i64 %i
  store double %more, ptr %to
  %flag_at = getelementptr inbounds i8, ptr %flags, i64 %i
  %flag = load i8, ptr %flag_at
  %set = icmp ne i8 %flag, 0
  %both = and i1 %good, %set
  %next = add i64 %i, 1
  br label %head
end:
  %result = zext i1 %good to i64
  ret i64 %result
}}
"""


@pytest.fixture(scope="module")
def code():
    return machine_code_of(TEXT.format(number=0.5))


@rows("last", [True, False])
def test_machine_code_reads_and_writes_arrays(code, last):
    given, flags, out = np.arange(100.0), np.ones(100, bool), np.empty(100)
    flags[-1] = last
    assert MachineCode(code)(100, 3.0, given, flags, out) == last
    np.testing.assert_array_equal(out, 3.0 * given + 0.5)
    # Whether or not they may be written.
    for array in (np.ones(3), np.ones(0), np.broadcast_to(1.0, 4), np.ones((2, 3))[1:]):
        place = ctypes.cast(machine_code._Array.from_param(array), ctypes.c_void_p).value
        assert place == array.__array_interface__["data"][0]


def test_a_function_that_there_is_not_is_no_crash(code):
    header, _, body = code.partition(b"\n")
    damaged = header.replace(b'"needs": []', b'"needs": ["optipath_has_none"]') + b"\n" + body
    with pytest.raises(RuntimeError, match="optipath_has_none"):
        MachineCode(damaged)


def grown(make, before, after):
    """By how many KiB memory grows that is held after some runs."""
    held = []
    for numbers in (range(before), range(before, before + after)):
        for number in numbers:
            make(number)
        gc.collect()
        status = Path("/proc/self/status").read_text()
        held.append(int(re.search(r"VmRSS:\s+(\d+)", status)[1]))
    return held[1] - held[0]


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="tells memory on Linux")
def test_code_that_is_dropped_frees_its_memory_and_compiling_leaves_nothing(code):
    # 2000 that are kept are some 100 MB; what compiling one takes is more than 1 MB.
    assert grown(lambda _: MachineCode(code), 20, 400) < 10_000
    assert grown(lambda number: machine_code_of(TEXT.format(number=float(number))), 3, 6) < 4_000


def test_memory_holds_as_many_functions_as_it_may(code, monkeypatch, tmp_path):
    monkeypatch.setenv("OPTIPATH_CACHE", str(tmp_path))
    monkeypatch.setattr("optipath.engines.code_cache._MOST_FUNCTIONS", 3)
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
    assert held[1](1, 2.0, np.ones(1), np.ones(1, bool), out) == 1
    assert out[0] == 2.5


def test_threads_that_ask_together_compile_once(code, monkeypatch, tmp_path):
    monkeypatch.setenv("OPTIPATH_CACHE", str(tmp_path))
    cache, asked = CodeCache(), []
    with ThreadPoolExecutor(8) as pool:
        held = pool.map(lambda _: cache.function("a", lambda t: asked.append(t) or code), range(8))
        assert len(set(held)) == 1
    assert asked == ["a"]


@pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="reads x86 assembly")
def test_a_path_is_computed_many_at_a_time():
    metal = op.Material(op.Parameter("n"), op.Parameter("k"))
    plan = chain([op.Interface(metal, op.Parameter("a"))]).compose()
    forms = {operand.input_key: MANY for operand in plan.program.operands if not operand.known}
    formula = PathFormula(plan.program, "float64", forms, plan.inputs.limits).lights(StokesCarrier)
    module, machine = optimized(source(formula))
    text = machine.emit_assembly(module)
    packed, single = text.count("mulpd"), text.count("mulsd")
    assert packed > 50
    # The rest of a batch that fills no vector is done one by one.
    assert packed >= single / 2


def formula_of(kind, *results):
    recorder = Recorder(np.dtype(kind))
    symbols = [recorder.input(name) for name in "ab"]
    return Formula(recorder.dtype, tuple(result(*symbols) for result in results))


def run(formula, **given):
    """The results of a formula by machine code, and by NumPy."""
    given = [np.array(given[symbol.operands[0]], formula.dtype) for symbol in formula.inputs]
    found, expected = np.empty((2, len(formula.results), given[0].size), formula.dtype)
    for engine, out in ((LlvmEngine(), found), (NumpyEngine(), expected)):
        assert engine.compiled(formula)((0, 1), (0, given[0].size), given, out, 0)
    return found, expected


@rows("kind", ["float64", "float32"])
def test_exponents_powers_of_two_and_rests_of_products_are_exact(kind):
    xp = SYMBOLIC
    formula = formula_of(
        kind,
        lambda a, _: xp.scaling(a) // 2 + 0.0 * a,
        lambda a, _: xp.scaling(a) % 2 + 0.0 * a,
        lambda a, b: xp.ldexp(a, xp.integer(b)),
        lambda *of: xp.two_product(*of)[1],
    )
    a = [1.0, 0.75, -3e-310, 5e-324, 1e30, 0.0, 1.0 + 2.0**-30, -0.75]
    b = [0.0, 5.0, -1070.0, 900.0, -3000.0, 3000.0, 1.0 - 2.0**-29, -7.0]
    with np.errstate(over="ignore", under="ignore"):
        found, expected = run(formula, a=a, b=b)
    np.testing.assert_array_equal(found[:3], expected[:3])
    rests = np.isfinite(expected[3]) & (np.abs(a) > 1e-300)
    np.testing.assert_array_equal(found[3][rests], expected[3][rests])


def test_every_operation_of_machine_code_is_that_of_numpy(rng):
    xp, a, b = SYMBOLIC, rng.normal(size=1000), rng.normal(size=1000)
    a[::7], b[::5] = 0.0, a[::5]
    formula = formula_of(
        "float64",
        lambda a, b: a + b * a - b / (1.0 + a * a),
        lambda a, b: xp.where((a < b) | ~(b <= 0.0), xp.maximum(a, b), -xp.minimum(a, b)),
        lambda a, b: xp.where((a == b) & (a != 0.0), xp.sqrt(xp.absolute(a)), xp.fixed(b)),
        lambda a, b: xp.where((a > b) == (b >= 0.0), a, b),
        lambda a, b: xp.where(xp.integer(a) == xp.maximum(xp.integer(b), -1), a, b),
        lambda a, b: (a > 0.0) * b + xp.absolute(a > b) + xp.absolute(xp.integer(4.0 * a)),
    )
    found, expected = run(formula, a=a, b=b)
    np.testing.assert_array_equal(found, expected)
    formula = formula_of(
        "float64",
        lambda a, _: xp.sin(a),
        lambda a, _: xp.cos(a),
        lambda a, _: xp.exp(a),
        xp.atan2,
        lambda a, _: xp.absolute(a) ** 1.5,
    )
    np.testing.assert_allclose(*run(formula, a=a, b=b), rtol=1e-15)


def test_arrays_and_parts_of_complex_numbers_of_any_precision_are_read_as_what_they_are():
    plan = op.Composer(engine="numba").compose(op.load_preset("malus"))
    single = np.linspace(0.1, 1.0, 5, dtype=np.float32)
    for kind in (np.float32, np.float16, ">f4", ">f8"):
        given = single.astype(kind)
        law = 0.5 * np.cos(given.astype(np.float64)) ** 2
        np.testing.assert_allclose(plan.run(angle=given).intensity, law, rtol=1e-14)
        np.testing.assert_allclose(plan.mueller(angle=given).matrix[:, 0, 0], law, rtol=1e-14)
    m = (1.5 + single + 1j * single).astype(np.complex64)
    law = np.abs((m.astype(complex) - 1.0) / (m.astype(complex) + 1.0)) ** 2
    plan = op.Composer(engine="numba").compose(chain([op.Interface(op.Parameter("m"), 0.0)]))
    np.testing.assert_allclose(plan.run(m=m).intensity, law, rtol=1e-13)


@pytest.mark.slow  # Of a grid by Numba; its stack takes seconds to be compiled.
@pytest.mark.filterwarnings("ignore::optipath.errors.CoherenceWarning")
def test_whole_numbers_of_one_axis_of_a_grid_are_whole_numbers_along_the_other():
    # Indices are scaled by powers of two, whose exponents depend on the indices alone.
    material = op.Material(op.Parameter("n"), op.Parameter("k"))
    layers = op.LayerStack([1.0, material, 1.5], op.Parameter("t"), lengths=[1e-6], wavelength=5e-7)
    path = op.Source() >> layers >> op.Detector()
    given = {"n": np.array([[1.3], [2.2], [4.5]]), "k": 0.01, "t": np.linspace(0.1, 1.2, 40)}
    plans = [op.Composer(engine=engine).compose(path) for engine in ("numpy", "numba")]
    by_numpy, by_numba = (plan.run(**given).stokes for plan in plans)
    assert np.allclose(by_numba, by_numpy, rtol=1e-13, atol=1e-15)
