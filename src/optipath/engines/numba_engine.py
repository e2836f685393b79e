"""The Numba engine: a formula compiled into one loop, many paths at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.code_cache import compiled_once, forget
from optipath.engines.expressions import assignments
from optipath.formulas import Symbol

if TYPE_CHECKING:
    from optipath.engines.array_path import ArrayPath
    from optipath.formulas import Formula

_BLOCK = 512
_HEAD = """\
from math import atan2, cos, exp, sin, sqrt

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

    def path(start: int, stop: int, given: list[Any], out: Any, at: int) -> bool:
        nonlocal function
        try:
            return bool(function(start, stop, *given, out, at))
        except Exception:  # noqa: BLE001 - a damaged file may raise anything while it is read
            forget(text)
            function = compiled_once(text)
            return bool(function(start, stop, *given, out, at))

    return path


def source(formula: Formula) -> str:
    """Return the text of a function ``path(start, stop, *given, out, at) -> bool``.

    One number for the whole batch is done before the loop. Arrays are cut to the block
    before it, so that its index begins at 0: a loop whose index might be negative is not
    vectorised.
    """
    constants: dict[str, str] = {}

    def written(operand: Any) -> str:
        if isinstance(operand, Symbol):
            return f"t{operand.index}"
        if isinstance(operand, (bool, np.bool_, np.integer)):
            return repr(operand.item() if isinstance(operand, np.generic) else operand)
        return constants.setdefault(repr(float(operand)), f"c{len(constants)}")

    before, inside = _loads(formula)
    before += assignments(formula.prologue, written)
    inside += assignments(formula.body, written)
    cuts = [f"x{s.index} = a{s.index}[begin:end]" for s in formula.inputs if not s.uniform]
    for row, result in enumerate(formula.results):
        if isinstance(result, Symbol):
            cuts.append(f"o{row} = out[{row}, at + begin:at + end]")
            inside.append(f"o{row}[i] = {written(result)}")
    inside.append(f"good = good & {written(formula.holds)}")
    parts, splits = _splits(formula)
    lines = [
        *(f"{name} = T({number})" for number, name in constants.items()),
        *before,
        "good = True",
        *(f"{name} = np.empty({_BLOCK}, T)" for name in parts),
        f"for begin in range(start, stop, {_BLOCK}):",
        *_indented(f"end = min(begin + {_BLOCK}, stop)", *cuts, *splits),
        "    for i in range(end - begin):",
        *_indented(*_indented(*inside)),
        "return good",
    ]
    given = "".join(f"a{s.index}, " for s in formula.inputs)
    head = _HEAD.format(dtype=formula.dtype.name)
    return "\n".join([head, f"def path(start, stop, {given}out, at):", *_indented(*lines), ""])


def _loads(formula: Formula) -> tuple[list[str], list[str]]:
    """Return what is read before the loop and in it."""
    before, inside = (
        [],
        [f"t{rest.index} = l{formula.whole_of(rest).index}[i]" for rest in formula.rests],
    )
    for symbol in formula.inputs:
        kind = "T" if symbol.kind == "float" else ""
        if symbol.uniform:
            before.append(f"t{symbol.index} = {kind}(a{symbol.index})")
        else:
            array = "h" if symbol.operands[0] in formula.wide else "x"
            inside.append(f"t{symbol.index} = {kind}({array}{symbol.index}[i])")
    return before, inside


def _splits(formula: Formula) -> tuple[list[str], list[str]]:
    """Return the arrays for numbers of more digits, and the lines that split them.

    In loops of their own, since the widest number in a loop says how many fit at a time.
    """
    with_rest = {formula.whole_of(rest).index for rest in formula.rests}
    arrays, loops = [], []
    for symbol in formula.inputs:
        n = symbol.index
        if symbol.operands[0] in formula.wide:
            arrays.append(f"h{n}")
            low, top = formula.wide[symbol.operands[0]]
            lines = [
                f"good = good & ({low!r} <= x{n}[i]) & (x{n}[i] <= {top!r})",
                f"high = T(x{n}[i])",
                f"h{n}[i] = high",
            ]
            if n in with_rest:
                arrays.append(f"l{n}")
                lines.append(f"l{n}[i] = T(x{n}[i] - high)")
            loops += ["for i in range(end - begin):", *_indented(*lines)]
    return arrays, loops


def _indented(*lines: str) -> list[str]:
    return ["    " + line for line in lines]
