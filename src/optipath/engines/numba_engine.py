"""The Numba engine: a formula compiled into one loop, many paths at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.code_cache import compiled_once, forget
from optipath.engines.expressions import assignments
from optipath.formulas import Symbol, left_formula

if TYPE_CHECKING:
    from optipath.engines.array_path import ArrayPath
    from optipath.formulas import Formula

_BLOCK = 512
_HEAD = """\
from math import atan2, cos, exp, inf, nan, sin, sqrt

import numpy as np
from optipath.engines.numba_helpers import exponent, fused as multiply_add
from optipath.engines.numba_helpers import ldexp as scaled, product_rest

T = np.{dtype}


def ldexp(number, power):
    return T(scaled(number, power))


"""


def compiled(formula: Formula) -> ArrayPath:
    """Return a function that does what a formula says, to arrays."""
    text = source(formula)
    function = compiled_once(text)

    def path(
        rows: tuple[int, int], columns: tuple[int, int], given: list[Any], out: Any, at: int
    ) -> bool:
        nonlocal function
        try:
            return bool(function(*rows, *columns, *given, out, at))
        except Exception:  # noqa: BLE001 - a damaged file may raise anything while it is read
            forget(text)
            function = compiled_once(text)
            return bool(function(*rows, *columns, *given, out, at))

    return path


def source(formula: Formula) -> str:
    """Return the text of a function ``path(top, bottom, start, stop, *given, out, at) -> bool``.

    One number for the whole batch is done before the loops, one for a row before the inner
    loop. Arrays are cut to the block before it, so that its index begins at 0: a loop whose
    index might be negative is not vectorised.
    """
    constants: dict[str, str] = {}

    def written(operand: Any) -> str:
        if isinstance(operand, Symbol):
            return f"t{operand.index}"
        if isinstance(operand, (bool, np.bool_, np.integer)):
            return repr(operand.item() if isinstance(operand, np.generic) else operand)
        return constants.setdefault(repr(float(operand)), f"c{len(constants)}")

    before, in_row, cuts, inside = _loads(formula)
    before += assignments(formula.prologue, written)
    inside += assignments(formula.body, written)
    for row, result in enumerate(formula.computed):
        cuts.append(f"o{row} = out[{row}, at + first + begin:at + first + end]")
        inside.append(f"o{row}[i] = {written(result)}")
    inside.append(f"good = good & {written(formula.holds)}")
    parts, splits = _splits(formula)
    lines = [
        *(f"{name} = T({number})" for number, name in constants.items()),
        *before,
        "good = True",
        "width = stop - start",
        *(f"{name} = np.empty({_BLOCK}, T)" for name in parts),
        "for row in range(top, bottom):",
        *_indented(
            "first = (row - top) * width", *in_row, f"for begin in range(0, width, {_BLOCK}):"
        ),
        *_indented(*_indented(f"end = min(begin + {_BLOCK}, width)", *cuts, *splits)),
        "        for i in range(end - begin):",
        *_indented(*_indented(*_indented(*inside))),
        "return good",
    ]
    given = "".join(f"a{s.index}, " for s in formula.inputs)
    head = _HEAD.format(dtype=formula.dtype.name)
    text = f"def path(top, bottom, start, stop, {given}out, at):"
    return "\n".join([head, text, *_indented(*lines), ""])


_CUTS = {
    "column": "x{0} = a{0}[start + begin:start + end]",
    "cell": "x{0} = a{0}[first + begin:first + end]",
}


def _loads(formula: Formula) -> tuple[list[str], list[str], list[str], list[str]]:
    """Return what is read before the loops, in a row, at a block, and in the inner loop."""
    before, in_row, cuts = [], [], []
    inside = []
    for symbol in formula.inputs:
        n, place = symbol.index, formula.place_of(symbol)
        kind = "T" if symbol.kind == "float" else ""
        if place == "one":
            before.append(f"t{n} = {kind}(a{n})")
        elif place == "row":
            in_row.append(f"t{n} = {kind}(a{n}[row])")
        else:
            cuts.append(_CUTS[place].format(n))
            array = "h" if formula.name_of(symbol) in formula.wide else "x"
            inside.append(f"t{n} = {kind}({array}{n}[i])")
    for left in formula.lefts:
        if left.uniform:
            lines = _left(left, f"a{formula.whole_of(left).index}")
            before += [*lines, f"t{left.index} = T({lines[-1].split()[0]})"]
        else:
            inside.append(f"t{left.index} = l{left.index}[i]")
    return before, in_row, cuts, inside


def _splits(formula: Formula) -> tuple[list[str], list[str]]:
    """Return the arrays for numbers of more digits, and the lines that make them.

    In loops of their own, since the widest number in a loop says how many fit at a time.
    """
    arrays, loops = [], []
    for symbol in formula.inputs:
        n = symbol.index
        if formula.name_of(symbol) in formula.wide:
            arrays.append(f"h{n}")
            low, most = formula.wide[formula.name_of(symbol)]
            lines = [
                f"good = good & ({low!r} <= x{n}[i]) & (x{n}[i] <= {most!r})",
                f"h{n}[i] = T(x{n}[i])",
            ]
            for left in formula.lefts:
                if formula.whole_of(left) is symbol:
                    arrays.append(f"l{left.index}")
                    lines += _left(left, f"x{n}[i]")
                    lines.append(f"l{left.index}[i] = T({lines[-1].split()[0]})")
            loops += ["for i in range(end - begin):", *_indented(*lines)]
    return arrays, loops


def _left(left: Symbol, angle: str) -> list[str]:
    """Return the lines that compute what is left of an angle, in double precision."""
    formula = left_formula(left.operation)
    (given,) = formula.inputs

    def written(operand: Any) -> str:
        if not isinstance(operand, Symbol):
            return repr(operand.item())
        return f"d{left.index}_{operand.index}" if operand is not given else angle

    return assignments(formula.steps, written)


def _indented(*lines: str) -> list[str]:
    return ["    " + line for line in lines]
