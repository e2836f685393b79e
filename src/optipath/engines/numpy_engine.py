"""The NumPy engine: a formula as calls of ufuncs on blocks that stay in the cache."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.block_writer import BlockWriter
from optipath.engines.engine import Engine
from optipath.engines.formulas.left import DOUBLE, LEFT
from optipath.engines.formulas.operations import OPERATIONS
from optipath.engines.formulas.symbol import Symbol
from optipath.kernels.numbers.primitives import NUMPY

if TYPE_CHECKING:
    from optipath.engines.array_path import ArrayPath
    from optipath.engines.formulas.formula import Formula

_BLOCK = 12288
_LEFT = {operation: factory(NUMPY, DOUBLE) for operation, factory in LEFT.items()}


class NumpyEngine(Engine["Formula", "ArrayPath"]):
    """Does operation after operation to blocks of paths."""

    name = "numpy"

    def compiled(self, formula: Formula) -> ArrayPath:
        """Return a function that does what a formula says, to arrays."""
        return _compiled(formula)


def _compiled(formula: Formula) -> ArrayPath:
    writer = BlockWriter(formula)
    space: dict[str, Any] = {name: about.ufunc for name, about in OPERATIONS.items()}
    space |= {"bitwise_and": np.bitwise_and, "bitwise_xor": np.bitwise_xor, "left": _LEFT}
    exec(compile(writer.text(), "<formula>", "exec"), space)  # noqa: S102 - our own text
    block, buffers = space["block"], tuple(writer.buffers.values())
    bits = np.dtype(f"i{formula.dtype.itemsize}")
    kinds = {"float": formula.dtype, "bool": np.dtype(bool), "mask": bits}
    as_bits = {"float": bits, "bool": np.dtype(np.int8), "mask": bits}

    indices = [symbol.index for symbol in formula.inputs]
    places = [formula.place_of(symbol) for symbol in formula.inputs]

    @np.errstate(all="ignore")
    def path(
        rows: tuple[int, int], columns: tuple[int, int], given: list[Any], out: Any, at: int
    ) -> bool:
        known = dict(zip(indices, given, strict=True))
        uniform = [*_prologue(formula, known), *writer.constants.values()]
        (top, bottom), (start, stop), width = rows, columns, columns[1] - columns[0]
        alone = bottom - top == 1
        # Whole rows as long as they fit, or else parts of one.
        deep = max(1, min(bottom - top, _BLOCK // max(width, 1)))
        parts = -(-width // _BLOCK) if deep == 1 else 1
        wide = -(-width // max(parts, 1))
        free = [np.empty((deep, wide), kinds[kind]) for kind in buffers]
        holds = True
        for row, begin in product(range(top, bottom, deep), range(start, stop, max(wide, 1))):
            tall, long = min(deep, bottom - row), min(wide, stop - begin)
            first = (row - top) * width + begin - start
            cells = slice(first, first + tall * long)
            shape = (long,) if alone else (tall, long)
            cut = {
                "row": (slice(row, row + tall), *([] if alone else [np.newaxis])),
                "column": slice(begin, begin + long),
                "cell": cells,
            }
            arrays = [
                n[cut[place]].reshape(shape) if place == "cell" else n[cut[place]]
                for place, n in zip(places, given, strict=True)
                if place != "one"
            ]
            own = [buffer[:tall, :long].reshape(shape) for buffer in free]
            seen = [buffer.view(as_bits[kind]) for buffer, kind in zip(own, buffers, strict=True)]
            results = [n[at:][cells].reshape(shape) for n in out]
            holds &= bool(np.all(block(*arrays, *uniform, *own, *seen, *results)))
        return holds

    return path


def _prologue(formula: Formula, known: dict[int, Any]) -> list[Any]:
    """Return what is one number for the whole batch, in order, as arrays without axes."""
    kind = formula.dtype.type
    values = {s.index: kind(known[s.index]) for s in formula.inputs if s.uniform}
    for left in formula.lefts:
        if left.uniform:
            angle = np.float64(known[formula.whole_of(left).index])
            values[left.index] = kind(_LEFT[left.operation](angle))
    for step in formula.prologue:
        operands = (values[o.index] if isinstance(o, Symbol) else o for o in step.operands)
        values[step.index] = OPERATIONS[step.operation].ufunc(*operands)
    return [np.asarray(value) for value in values.values()]
