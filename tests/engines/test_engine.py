"""What engines say of themselves, and what is made of it."""

import numpy as np
import pytest

from optipath import extras
from optipath.engines.engine import Engine
from optipath.engines.float_engine import FLOAT_ENGINE
from optipath.engines.formulas.formula import Formula
from optipath.engines.formulas.recorder import Recorder
from optipath.engines.known_engines import REGISTRY


def doubled():
    """A formula that no plan has."""
    recorder = Recorder(np.dtype("float64"))
    return Formula(recorder.dtype, (2.0 * recorder.input("x") + 0.1234,))


class Absent(Engine):
    name, extra, longest = "no_such_package", "fast", 100

    def compiled(self, formula):
        return formula


def test_an_engine_whose_package_is_not_there_names_what_brings_it(monkeypatch):
    monkeypatch.setitem(extras._EXTRA_OF, "no_such_package", "fast")
    assert not Absent().is_installed
    assert "optipath[fast]" in str(Absent().missing)


def test_what_needs_no_compiler_is_always_ready():
    assert FLOAT_ENGINE.is_ready(doubled())
    assert REGISTRY["numpy"].is_ready(doubled())


def test_numba_is_ready_for_what_it_has_compiled(tmp_path, monkeypatch):
    pytest.importorskip("numba")
    monkeypatch.setenv("OPTIPATH_CACHE", str(tmp_path / "cache"))
    monkeypatch.delenv("NUMBA_DISABLE_JIT", raising=False)
    numba, formula = REGISTRY["numba"], doubled()
    assert not numba.is_ready(formula)
    path, out = numba.compiled(formula), np.empty((1, 3))
    assert path((0, 1), (0, 3), [np.array([1.0, 2.0, 3.0])], out, 0)
    assert out.tolist() == [[2.1234, 4.1234, 6.1234]]
    assert numba.is_ready(formula)
    assert numba.is_ready(doubled())
