import ast
from pathlib import Path

import numpy as np
import pytest

import optipath as op
from optipath.errors import OptipathError, did_you_mean, printable, shown
from optipath.spelling import few_suggestions
from tables import rows


def deep(levels):
    nested = 1
    for _ in range(levels):
        nested = [nested]
    return nested


class Unwilling:
    def __repr__(self):
        raise ZeroDivisionError


VALUES = [
    10**4400,
    -(1 << 40_000),
    deep(1500),
    {"a": {"b": {"c": {"d": {"e": {"f": 1}}}}}},
    "x " * 10**6,
    list(range(10**5)),
    {number: number for number in range(10**4)},
    np.zeros((1000, 1000)),
    b"\x1b" * 1000,
    Unwilling(),
    {"\x1b[31m": deep(100)},
]


@rows("value", VALUES)
def test_every_value_is_shown_in_few_characters(value):
    assert 0 < len(shown(value)) <= 62


def test_short_values_are_shown_as_python_writes_them_and_control_characters_by_codes():
    for value in (1, -2.5, "red", [1, [2]], {"n": 1.5}, (1, 2), None, True, 1.5 + 2j):
        assert shown(value) == repr(value)
    every = "".join(map(chr, range(0x3000))) + "\ud800\udfff"
    seen = printable(every)
    assert [letter for letter in seen if letter < " "] == ["\n"]
    assert not {*map(chr, range(0x7F, 0xA0)), "\u202e", "\u2066", "\u2028", "\ud800"} & {*seen}
    assert printable("Étienne, 30°, λ/4, 偏光") == "Étienne, 30°, λ/4, 偏光"
    error = OptipathError("node '\x1b]0;title\x07' does not exist", "a\rb")
    assert str(error) == "2 faults:\n- node '\\x1b]0;title\\x07' does not exist\n- a\\rb"


def test_values_of_every_kind_are_refused_by_errors_of_the_library():
    for value in VALUES:
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


def test_only_so_many_suggestions_are_looked_for():
    with few_suggestions(3):
        cures = [did_you_mean("ou", ["in", "out"]) for _ in range(5)]
    assert cures == ["; did you mean 'out'?"] * 3 + [""] * 2
    assert did_you_mean("ou", ["in", "out"]) == "; did you mean 'out'?"


def test_long_lists_of_what_there_is_are_cut():
    cure = did_you_mean("?", [f"a{number}" for number in range(2000)])
    assert cure.endswith("a39 and 1960 more")


def test_no_message_writes_a_value_by_repr():
    # What is written into code, or tells sweeps apart, has to be exact; what is shown to people,
    # short.
    code = {"numba_engine.py", "block_writer.py", "float_engine.py", "recorder.py", "units.py"}
    code |= {"chunk_identity.py", "python_lines.py", "sweep_identity.py"}
    for file in Path(op.__file__).parent.rglob("*.py"):
        parts = list(ast.walk(ast.parse(file.read_text("utf-8"))))
        own = [f for f in parts if isinstance(f, ast.FunctionDef) and f.name == "__repr__"]
        apart = {part for function in own for part in ast.walk(function)}
        for part in parts:
            if isinstance(part, ast.FormattedValue) and part.conversion == ord("r"):
                known = isinstance(part.value, ast.Call) and not part.value.args
                assert file.name in code or part in apart or known, f"{file}:{part.lineno}"
