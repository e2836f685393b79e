"""The Numba engine: a formula compiled into one loop, many paths at a time."""

from __future__ import annotations

import os
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.engine import Engine
from optipath.engines.formula import assignments, indented, left_formula
from optipath.engines.numpy_engine import NumpyEngine
from optipath.engines.symbols import Symbol

if TYPE_CHECKING:
    from optipath.engines.code_cache import CodeCache
    from optipath.engines.engine import ArrayPath
    from optipath.engines.formula import Formula


_BLOCK = 512
_HEAD = """\
from math import atan2, cos, exp, inf, nan, sin, sqrt

import numpy as np
from optipath.engines.numba_helpers import chosen, exponent
from optipath.engines.numba_helpers import {ldexp} as ldexp, product_rest

T = np.{dtype}


"""


class NumbaEngine(Engine["Formula", "ArrayPath"]):
    """Compiles a formula into machine code, which is kept for the next process."""

    name, extra = "numba", "fast"
    longest = 4000

    def compiled(self, formula: Formula) -> ArrayPath:
        """Return a function of arrays; NumPy's where ``NUMBA_DISABLE_JIT`` forbids compiling."""
        from optipath.engines.code_cache import CODE  # noqa: PLC0415 - not to load it for NumPy

        if is_forbidden():
            CODE.tell("NUMBA_DISABLE_JIT is set, so that NumPy runs what Numba would compile")
            return NumpyEngine().compiled(formula)
        return _compiled(formula, CODE)

    def is_ready(self, formula: Formula) -> bool:
        """Tell whether the machine code of a formula is kept, in memory or on disk."""
        from optipath.engines.code_cache import CODE  # noqa: PLC0415 - not to load it for NumPy

        return is_forbidden() or CODE.has(source(formula))


def is_forbidden() -> bool:
    """Tell whether the user has forbidden Numba to compile."""
    return os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0")


def _compiled(formula: Formula, cache: CodeCache) -> ArrayPath:
    from optipath.engines.machine_code import compiled  # noqa: PLC0415 - an extra

    function = cache.function(source(formula), compiled)
    shape, kind = (len(_splits(formula)[0]), _BLOCK), formula.dtype

    def path(
        rows: tuple[int, int], columns: tuple[int, int], arguments: list[Any], out: Any, at: int
    ) -> bool:
        own = np.empty(shape, kind) if shape[0] else out
        return function(*rows, *columns, *arguments, own, out, out.shape[1], at) != 0

    return path


@lru_cache(8)
def source(formula: Formula) -> str:
    """Return the text of a function of what `ArrayPath` takes.

    ``path(top, bottom, start, stop, *given, own, out, paths, at)``; ``own`` has room for split
    numbers, and ``paths`` is the row length of ``out``.
    """
    constants: dict[str, str] = {}

    def written(operand: Any) -> str:
        if isinstance(operand, Symbol):
            return f"t{operand.index}"
        if isinstance(operand, (bool, np.bool_, np.integer)):
            return repr(operand.item() if isinstance(operand, np.generic) else operand)
        return constants.setdefault(repr(float(operand)), f"c{len(constants)}")

    before, in_row, cuts, inside = _loads(formula)
    # Numba takes half as long again to compile choices that are branches.
    before += assignments(formula.prologue, written, branchless=True)
    inside += assignments(formula.body, written, branchless=True)
    for row, result in enumerate(formula.computed):
        cuts.append(f"o{row} = {row} * paths + at + first + begin")
        inside.append(f"out[o{row} + i] = {written(result)}")
    inside.append(f"good = good & {written(formula.holds)}")
    rooms, splits = _splits(formula)
    lines = [
        *(f"{name} = T({number})" for number, name in constants.items()),
        *before,
        *(f"{name} = {place * _BLOCK}" for place, name in enumerate(rooms)),
        "good = True",
        "width = stop - start",
        "for row in range(top, bottom):",
        *indented(
            "first = (row - top) * width", *in_row, f"for begin in range(0, width, {_BLOCK}):"
        ),
        *indented(*indented(f"end = min(begin + {_BLOCK}, width)", *cuts, *splits)),
        "        for i in range(end - begin):",
        *indented(*indented(*indented(*inside))),
        "return 1 if good else 0",
    ]
    kind = formula.dtype.name
    arguments = [f"a{s.index}: '{_kind(formula, s)}'" for s in formula.inputs]
    places = ", ".join(f"{name}: 'int64'" for name in ("top", "bottom", "start", "stop"))
    ends = f"own: '*{kind}', out: '*{kind}', paths: 'int64', at: 'int64'"
    head = _HEAD.format(dtype=kind, ldexp="ldexp_single" if kind == "float32" else "ldexp")
    text = f"def path({', '.join([places, *arguments, ends])}):"
    return "\n".join([head + text, *indented(*lines), ""])


def _kind(formula: Formula, symbol: Symbol) -> str:
    """Return what is given for an input, as `MachineCode` names it."""
    if formula.place_of(symbol) == "one":
        return "float64"
    if symbol.kind != "float":
        return "*uint8" if symbol.kind == "bool" else "*int64"
    return "*float64" if formula.name_of(symbol) in formula.wide else f"*{formula.dtype.name}"


_LOADED = {"float": "t{0} = T({1})", "bool": "t{0} = {1} != 0", "int": "t{0} = {1}"}
_STARTS = {"column": "x{0} = start + begin", "cell": "x{0} = first + begin"}


def _loads(formula: Formula) -> tuple[list[str], list[str], list[str], list[str]]:
    """Return what is read before the loops, in a row, at a block, and in the inner loop."""
    before, in_row, starts, inside = [], [], [], []
    for symbol in formula.inputs:
        n, place = symbol.index, formula.place_of(symbol)
        form = _LOADED[symbol.kind]
        if place == "one":
            before.append(form.format(n, f"a{n}"))
        elif place == "row":
            in_row.append(form.format(n, f"a{n}[row]"))
        else:
            starts.append(_STARTS[place].format(n))
            wide = formula.name_of(symbol) in formula.wide
            inside.append(form.format(n, f"own[h{n} + i]" if wide else f"a{n}[x{n} + i]"))
    for left in formula.lefts:
        if left.uniform:
            lines = _left(left, f"a{formula.whole_of(left).index}")
            before += [*lines, f"t{left.index} = T({lines[-1].split()[0]})"]
        else:
            inside.append(f"t{left.index} = own[l{left.index} + i]")
    return before, in_row, starts, inside


def _splits(formula: Formula) -> tuple[list[str], list[str]]:
    """Return rooms and lines of split numbers: own loops, as the widest type limits vectors."""
    rooms, loops = [], []
    for symbol in formula.inputs:
        n = symbol.index
        if formula.name_of(symbol) in formula.wide:
            rooms.append(f"h{n}")
            low, most = formula.wide[formula.name_of(symbol)]
            lines = [
                f"given = a{n}[x{n} + i]",
                f"good = good & ({low!r} <= given) & (given <= {most!r})",
                f"own[h{n} + i] = T(given)",
            ]
            for left in formula.lefts:
                if formula.whole_of(left) is symbol:
                    rooms.append(f"l{left.index}")
                    lines += _left(left, "given")
                    lines.append(f"own[l{left.index} + i] = T({lines[-1].split()[0]})")
            loops += ["for i in range(end - begin):", *indented(*lines)]
    return rooms, loops


def _left(left: Symbol, angle: str) -> list[str]:
    """Return the lines that compute what is left of an angle, in double precision."""
    formula = left_formula(left.operation)
    (argument,) = formula.inputs

    def written(operand: Any) -> str:
        if not isinstance(operand, Symbol):
            return repr(operand.item())
        return f"d{left.index}_{operand.index}" if operand is not argument else angle

    return assignments(formula.steps, written)
