"""The NumPy engine: a formula as calls of ufuncs on blocks that stay in the cache."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.block_writer import BlockWriter
from optipath.formulas import Symbol
from optipath.formulas.operations import OPERATIONS

if TYPE_CHECKING:
    from optipath.engines.array_path import ArrayPath
    from optipath.formulas import Formula

_BLOCK = 12288


def compiled(formula: Formula) -> ArrayPath:
    """Return a function that does what a formula says, to arrays."""
    writer = BlockWriter(formula)
    space: dict[str, Any] = {name: about.ufunc for name, about in OPERATIONS.items()}
    space |= {"bitwise_and": np.bitwise_and, "bitwise_xor": np.bitwise_xor}
    exec(compile(writer.text(), "<formula>", "exec"), space)  # noqa: S102 - our own text
    block, buffers = space["block"], tuple(writer.buffers.values())
    bits = np.dtype(f"i{formula.dtype.itemsize}")
    kinds = {"float": formula.dtype, "bool": np.dtype(bool), "mask": bits}

    @np.errstate(all="ignore")
    def path(start: int, stop: int, given: list[Any], out: Any, at: int) -> bool:
        known = dict(zip((s.index for s in formula.inputs), given, strict=True))
        uniform = [*_prologue(formula, known), *writer.constants.values()]
        arrays = [n for s, n in zip(formula.inputs, given, strict=True) if not s.uniform]
        blocks = max(1, -(-(stop - start) // _BLOCK))
        size = -(-(stop - start) // blocks)
        free = [np.empty(size, kinds[kind]) for kind in buffers]
        holds = True
        for begin in range(start, stop, size):
            end = min(begin + size, stop)
            parts = [array[begin:end] for array in arrays]
            cut = free if end - begin == size else [buffer[: end - begin] for buffer in free]
            seen = [
                buffer.view(bits) if buffer.dtype == formula.dtype else buffer for buffer in cut
            ]
            results = out[:, at + begin : at + end]
            holds &= bool(np.all(block(*parts, *uniform, *cut, *seen, *results)))
        return holds

    return path


def _prologue(formula: Formula, known: dict[int, Any]) -> list[Any]:
    """Return what is one number for the whole batch, in order, as arrays without axes."""
    kind = formula.dtype.type
    values = {s.index: kind(known[s.index]) for s in formula.inputs if s.uniform}
    for step in formula.prologue:
        operands = (values[o.index] if isinstance(o, Symbol) else o for o in step.operands)
        values[step.index] = OPERATIONS[step.operation].ufunc(*operands)
    return [np.asarray(value) for value in values.values()]
