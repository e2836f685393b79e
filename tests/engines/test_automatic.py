"""What engines say of themselves, and the rule of "auto": what costs least, with compiling."""

import numpy as np
import pytest

import optipath as op
from optipath import extras
from optipath.composer import composer
from optipath.engines import choice as automatic
from optipath.engines.choice import FLOATS, HANDFUL, NUMPY_STEPS, REGISTRY, EngineChoice
from optipath.engines.formula import Engine, Formula
from optipath.engines.numpy_engine import NumpyEngine
from optipath.engines.symbols import Recorder
from optipath.plan import runner as shared


class Paths:
    """Paths of so many operations, of which nothing has been compiled."""

    has_floats = False

    def __init__(self, operations=300, *, kept=False):
        self.length = operations
        self.kept = kept
        self.asked = 0

    def operations(self, *, floats):
        del floats
        return self.length

    @property
    def is_stored(self):
        self.asked += 1
        return self.kept


@pytest.fixture(autouse=True)
def _with_numba(monkeypatch):
    monkeypatch.setattr(automatic, "is_installed", lambda _: True)
    # As in a process that has not run anything by Numba yet.
    monkeypatch.setattr(automatic, "_LOOKING_AGAIN", automatic._LOOKING)


def auto(*, floats=True):
    return EngineChoice("auto", floats=floats)


def test_the_first_runs_of_a_few_paths_make_nothing_and_a_handful_is_run_as_floats():
    choice = auto()
    assert [choice.of(10, Paths()) for _ in range(5)] == 3 * [NUMPY_STEPS] + 2 * [FLOATS]
    assert (choice.of(HANDFUL - 1, Paths()), choice.of(HANDFUL, Paths())) == (FLOATS, "numpy")
    choice = auto(floats=False)
    assert {choice.of(10, Paths()) for _ in range(6)} == {NUMPY_STEPS}


def test_numba_is_waited_for_where_it_saves_more_than_it_costs():
    work = Paths()
    assert (auto().of(100_000, work), work.asked) == ("numpy", 0)
    assert auto().of(10**8, Paths()) == auto().of(1 << 17, Paths(), 10**8) == "numba"
    assert auto().of(1 << 17, Paths()) == "numpy"
    choice, work = auto(), Paths()
    found = [choice.of(100_000, work) for _ in range(10)]
    assert (found[0], found[-1]) == ("numpy", "numba")
    assert found == sorted(found, reverse=True)
    # Code that has been compiled before is run once looking for it pays.
    work = Paths(kept=True)
    assert auto().of(1_000_000, work) == "numba"
    choice = auto()
    found = [choice.of(1000, work) for _ in range(2000)]
    assert (found[3], found[-1]) == ("numpy", "numba")


def test_what_has_no_formula_or_too_long_a_one_is_not_compiled_and_no_other_engine_is_asked():
    choice = auto()
    assert choice.of(10**8, Paths(None)) == choice.of(10**8, Paths()) == NUMPY_STEPS
    assert auto().of(10**8, Paths(4001)) == "numpy"
    for length, engine in ((4001, "numpy"), (300, "numba")):
        assert EngineChoice("numba", floats=True).of(2, Paths(length)) == engine
    numpy = EngineChoice("numpy", floats=True)
    counts = (10, 10, 10, 10, 10, 1023, 1024, 10**8)
    found = [numpy.of(count, Paths(kept=True)) for count in counts]
    assert found == 6 * [NUMPY_STEPS] + 2 * ["numpy"]


def test_a_plan_says_what_ran():
    shared._RUNNERS.clear()
    plan = op.load_preset("malus").compose()
    assert (plan.engine_for(1), plan.engine_for(1000)) == (FLOATS, "numpy")
    assert plan.engine_for(10**400) == plan.engine_for(2**53)
    stream = plan.stream(1000, angle=np.linspace(0.0, 1.0, 2500))
    assert [part.light.stokes.shape[0] for part in stream] == [1000, 1000, 500]
    for dtype, engine in (("float64", FLOATS), ("float32", NUMPY_STEPS)):
        plan = op.Composer(dtype=dtype).compose(op.load_preset("malus"))
        assert plan.engine_for(10) == plan.engine_for(HANDFUL - 1) == engine
        assert plan.engine_for(HANDFUL) == "numpy"
        assert f"batches are run by {engine}; from 58 paths, numpy; from " in plan.explain()


class Toy(Engine):
    """What NumPy does, counted, in one precision and for formulas that are not long."""

    name, precisions, longest = "toy", ("float64",), 400

    def __init__(self):
        self.compilations = 0

    def compiled(self, formula):
        self.compilations += 1
        return NumpyEngine().compiled(formula)


@pytest.fixture
def toy(monkeypatch):
    engine = Toy()
    monkeypatch.setitem(REGISTRY, "toy", engine)
    monkeypatch.setitem(composer.CHOICES, "engine", (*automatic.ENGINES, "toy"))
    shared._RUNNERS.clear()
    return engine


def test_a_new_engine_runs_what_is_composed_for_it(toy):
    path, angles = op.load_preset("malus"), np.linspace(0.0, 1.0, 20)
    plan = op.Composer(engine="toy").compose(path)
    found = plan.run(angle=angles).stokes
    assert toy.compilations
    assert plan.engine == plan.engine_for(20) == plan.engine_for(10**6) == "toy"
    assert plan.explain().count("batches are run by floats; from 2 paths, toy\n") == 1
    numpy = op.Composer(engine="numpy").compose(path)
    many = numpy.run(angle=np.resize(angles, 2000)).stokes
    np.testing.assert_array_equal(found, many[:20])


def test_a_new_engine_is_given_nothing_beyond_its_limits(toy):
    single = op.Composer(engine="toy", dtype="float32").compose(op.load_preset("malus"))
    single.run(angle=np.linspace(0.0, 1.0, 2000))
    assert single.engine == single.engine_for(10) == "numpy"
    assert "batches are run by numpy\n" in single.explain()
    assert EngineChoice("toy", floats=True).of(2, Paths(400)) == "toy"
    assert EngineChoice("toy", floats=True).of(2, Paths(401)) == "numpy"
    assert not toy.compilations


def test_an_engine_whose_package_is_not_there_names_what_brings_it(monkeypatch):
    monkeypatch.undo()
    monkeypatch.setitem(extras._EXTRA_OF, "no_such_package", "fast")
    monkeypatch.setattr(Toy, "name", "no_such_package")
    monkeypatch.setattr(Toy, "extra", "fast")
    assert not Toy().is_installed
    assert "optipath[fast]" in str(Toy().missing)


def test_numba_is_ready_for_what_it_has_compiled_and_others_always(tmp_path, monkeypatch):
    recorders = [Recorder(np.dtype("float64")) for _ in range(2)]
    # Formulas that no plan has.
    formula, again = (Formula(r.dtype, (2.0 * r.input("x") + 0.1234,)) for r in recorders)
    assert REGISTRY["numpy"].is_ready(formula)
    pytest.importorskip("numba")
    monkeypatch.setenv("OPTIPATH_CACHE", str(tmp_path / "cache"))
    monkeypatch.delenv("NUMBA_DISABLE_JIT", raising=False)
    numba = REGISTRY["numba"]
    assert not numba.is_ready(formula)
    path, out = numba.compiled(formula), np.empty((1, 3))
    assert path((0, 1), (0, 3), [np.array([1.0, 2.0, 3.0])], out, 0)
    assert out.tolist() == [[2.1234, 4.1234, 6.1234]]
    assert numba.is_ready(formula)
    assert numba.is_ready(again)
