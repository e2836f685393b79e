"""Errors: they travel between processes, and quote whatever was given in one short line."""

import ast
import copy
import inspect
import pickle
import re
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest

import optipath as op
from failing import fails
from optipath import errors
from optipath.errors import OptipathError
from optipath.faults import Cure, Fault, closest, did_you_mean, printable, shown
from tables import rows

KINDS = [k for k in vars(errors).values() if inspect.isclass(k) and issubclass(k, BaseException)]
COPIES = [lambda error: pickle.loads(pickle.dumps(error)), copy.copy, copy.deepcopy]


class OddError(op.OptipathError):
    """An error that is made of something else than its sentence."""

    def __init__(self, *, number):
        super().__init__(f"number {number} is odd", "give an even one")
        self.number = number


# One is made of what is missing, all others of sentences.
@rows("error", [*(kind("plots", "matplotlib", "plot") for kind in KINDS), OddError(number=3)])
def test_an_error_is_the_same_after_a_copy(error):
    error.add_note("while it was looked at")
    for again in (copied(error) for copied in COPIES):
        assert (type(again), str(again), again.args) == (type(error), str(error), error.args)
        assert again.__dict__ == error.__dict__


def test_an_error_comes_out_of_another_process():
    told = pytest.raises(errors.MissingExtraError, match=r"optipath\[plot\]")
    with get_context("spawn").Pool(1) as pool, told:
        pool.apply_async(fails).get(timeout=60)


class Unprintable:
    def __repr__(self):
        raise RuntimeError("no")


class Colours:
    def __repr__(self):
        return "\x1b[31mred\x1b[0m\nand more\u202e"


def nested(levels):
    found = 1
    for _ in range(levels):
        found = [found]
    return found


WITHIN_ITSELF = []
WITHIN_ITSELF.append(WITHIN_ITSELF)
VALUES = [
    *[10**5000, -(1 << 40_000), list(range(10**6)), {n: n for n in range(10**4)}],
    *["x " * 10**6, "\x1b[2J", b"\x1b" * 10**6, {"\x1b[31m": nested(100)}, Colours()],
    *[Unprintable(), [Unprintable()] * 1000, Unprintable, None, np.zeros((1000, 1000))],
    *[nested(1500), nested(100_000), WITHIN_ITSELF, {"a": {"b": {"c": {"d": {"e": {"f": 1}}}}}}],
]


@rows("value", VALUES)
def test_whatever_is_quoted_is_short_and_on_one_line(value):
    text = shown(value)
    assert 0 < len(text) <= 62
    assert text.isprintable()


def test_short_values_are_shown_as_python_writes_them_and_control_characters_by_codes():
    for value in (1, -2.5, "red", [1, [2]], [0.1, None], {"n": 1.5}, (1, 2), True, 1.5 + 2j):
        assert shown(value) == repr(value)
    every = "".join(map(chr, range(0x3000))) + "\ud800\udfff"
    seen = printable(every)
    assert [letter for letter in seen if letter < " "] == ["\n"]
    assert not {*map(chr, range(0x7F, 0xA0)), "\u202e", "\u2066", "\u2028", "\ud800"} & {*seen}
    assert printable("Étienne, 30°, λ/4, 偏光") == "Étienne, 30°, λ/4, 偏光"
    error = OptipathError("node '\x1b]0;title\x07' does not exist", "a\rb")
    assert str(error) == "2 faults:\n- node '\\x1b]0;title\\x07' does not exist\n- a\\rb"


def test_sentences_are_cut_where_they_are_long_and_stay_on_one_line():
    told = str(OptipathError(f"word '{5000 * 'x'}' is unknown; did you mean 'x'?"))
    assert len(told) < 500
    assert told.endswith("xxx' is unknown; did you mean 'x'?")
    told = f"'/home/{100 * 'a'}/b.toml' cannot be read"
    assert str(OptipathError(told)) == told
    told = str(OptipathError("kind 'so\turce' is \x00unknown\r\n"))
    assert told == r"kind 'so\turce' is \x00unknown\r\n"


def test_a_fault_is_written_for_who_follows_its_cure():
    fault = Fault("'n' has no value", Cure.giving("n"), subject="n").under("[0]").under("a.x")
    assert fault == "a.x[0]: 'n' has no value; n=..."
    error = op.errors.PathError(fault.cured("or leave it out"), about="x.toml")
    assert error.written("command") == (
        "x.toml: a.x[0]: 'n' has no value; --n ...; or leave it out"
    )
    assert (
        op.errors.PathError(*error.within("file"))
        .written("page")
        .endswith("n = ...; or leave it out")
    )
    again = COPIES[0](error).faults[0]
    assert (again.subject, again.place, again.cure) == ("n", "a.x[0]", error.faults[0].cure)


def test_20_faults_are_listed_and_others_are_counted():
    error = op.errors.PathError(*[f"fault {number}" for number in range(20_000)])
    told = ["20000 faults:", *(f"- fault {number}" for number in range(20)), "and 19,980 more"]
    assert str(error).splitlines() == told
    assert len(error.faults) == 20_000


def test_values_of_every_kind_are_refused_by_errors_of_the_library():
    for value in VALUES:
        if value is None or value is Unprintable:
            continue
        for build in (
            lambda v: op.PathGraph(v if not isinstance(v, str) else 1),
            lambda v: op.PathGraph(loops=v),
            lambda v: op.PathGraph().add("x", v),
            op.Parameter,
            lambda v: op.Parameter("x", words=[v]),
            lambda v: op.Composer(model=v),
            lambda v: op.load_preset("malus").trace(angle=[v, "none"]),
            lambda v: op.load_preset("malus", case=v),
        ):
            with pytest.raises(OptipathError):
                build(value)


@rows(
    "word, known, meant",
    [
        ("detla", ["delta", "rho"], "delta"),
        ("--FILTER", ["--filter"], "--filter"),
        ("NM", ["nm", "um"], "nm"),
        ("npgr62", ["npgr026", "malus"], "npgr026"),
        ("ou", ["in", "out"], "out"),
        ("ellips", ["pyelli", "ellipsometry", "elli"], "ellipsometry"),
        ("transmitt", ["transmitted", "strain"], "transmitted"),
        ("--plot", ["--delta"], None),
        ("10", ["1", "100", "0"], None),
        ("n", ["n1", "nm"], None),
        ("n12", ["n1", "n2"], None),
        ("S4", ["S0", "S1"], None),
        ("vertical", ["horizontal"], None),
        ("x" * 1000, ["x" * 999], None),
        ("delta", [], None),
        ("trans", ["transmittance", "transmitted", "strain"], None),
        ("arc", ["arcmin", "arcsec", "deg"], None),
    ],
)
def test_a_misspelt_word_has_one_that_was_meant_and_others_have_none(word, known, meant):
    assert closest(word, known) == meant


def test_lists_of_what_there_is_are_cut():
    assert did_you_mean("ou", ["in", "out"]) == "; did you mean 'out'?"
    assert did_you_mean("?", [f"a{n}" for n in range(2000)]).endswith("a39 and 1960 more")


# What is written into code, or tells sweeps apart, has to be exact; what is shown to people, short.
EXACT = {
    "engines/numpy_engine.py": {"text"},
    "engines/symbols.py": {"opaque"},
    "explorer/answers.py": {"python_lines", "_by_name", "_material"},
    "surfaces/hemisphere/chunks.py": {"_roughness_text"},
    "sweeps/stored.py": {"identity"},
    "values/units.py": {"format_quantity"},
}


def test_no_message_writes_a_value_by_repr():
    source = Path(op.__file__).parent
    for file in source.rglob("*.py"):
        text = file.read_text("utf-8")
        if not re.search(r"!r|=\s*}", text):  # It has no conversion by repr.
            continue
        exact = {"__repr__", *EXACT.get(file.relative_to(source).as_posix(), ())}
        parts = list(ast.walk(ast.parse(text)))
        own = [f for f in parts if isinstance(f, ast.FunctionDef) and f.name in exact]
        apart = {part for function in own for part in ast.walk(function)}
        for part in parts:
            if isinstance(part, ast.FormattedValue) and part.conversion == ord("r"):
                known = isinstance(part.value, ast.Call) and not part.value.args
                assert part in apart or known, f"{file}:{part.lineno}"
