"""The NumPy engine: a formula as calls of ufuncs on blocks that stay in the cache."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.formulas import Symbol
from optipath.formulas.operations import OPERATIONS

if TYPE_CHECKING:
    from optipath.engines.array_path import ArrayPath
    from optipath.formulas import Formula

_BLOCK = 4096
_OWN = ("exponent", "ldexp", "power", "product_rest", "where")
"""Operations that make their own arrays."""


def compiled(formula: Formula) -> ArrayPath:
    """Return a function that does what a formula says, to arrays."""
    writer = _Writer(formula)
    space: dict[str, Any] = {name: about.ufunc for name, about in OPERATIONS.items()}
    exec(compile(writer.text(), "<formula>", "exec"), space)  # noqa: S102 - our own text
    block, buffers = space["block"], tuple(writer.buffers.values())
    kinds = {"float": formula.dtype, "bool": np.dtype(bool)}

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
            holds &= bool(np.all(block(*parts, *uniform, *cut, *out[:, at + begin : at + end])))
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


class _Writer:
    """Writes the function of a block; an array is free again after its last use."""

    def __init__(self, formula: Formula) -> None:
        self.formula = formula
        self.constants: dict[str, Any] = {}
        self.buffers: dict[str, str] = {}
        self._names: dict[int, str] = {}
        self._left = dict(formula.uses)
        self._free: dict[str, list[str]] = {"float": [], "bool": []}
        self._rows = {
            result.index: f"out[{row}]"
            for row, result in reversed(list(enumerate(formula.results)))
            if isinstance(result, Symbol)
        }

    def text(self) -> str:
        """Return a function ``block(*arrays, *numbers, *constants, *buffers, *out)``."""
        formula = self.formula
        lines = []
        for symbol in formula.inputs:
            if not symbol.uniform:
                self._names[symbol.index] = f"t{symbol.index}"
                if symbol.kind == "float":
                    lines.append(f"t{symbol.index} = a{symbol.index}.astype(T, copy=False)")
                else:
                    lines.append(f"t{symbol.index} = a{symbol.index}")
        for rest in formula.rests:
            whole = next(s.index for s in formula.inputs if s.operands == rest.operands)
            lines.append(f"t{rest.index} = (a{whole} - t{whole}).astype(T)")
        lines += [self._line(step) for step in formula.body]
        for row, result in enumerate(formula.results):
            if isinstance(result, Symbol) and self._read(result) != f"out[{row}]":
                lines.append(f"out[{row}][...] = {self._read(result)}")
        lines.append(f"return {self._read(formula.holds)}")
        names = [
            *(f"a{s.index}" for s in formula.inputs if not s.uniform),
            *(f"t{s.index}" for s in formula.inputs if s.uniform),
            *(f"t{s.index}" for s in formula.prologue),
            *self.constants_names(),
            *self.buffers,
            "*out",
        ]
        body = "".join(f"    {line}\n" for line in lines)
        return (
            f"import numpy\nT = numpy.{formula.dtype.name}\ndef block({', '.join(names)}):\n{body}"
        )

    def constants_names(self) -> list[str]:
        """Return how the known numbers are called."""
        return [f"c{place}" for place in range(len(self.constants))]

    def _line(self, step: Symbol) -> str:
        operands = ", ".join(map(self._read, step.operands))
        for operand in step.operands:
            if isinstance(operand, Symbol):
                self._release(operand)
        name = self._name(step)
        self._names[step.index] = name
        if name.startswith("t"):
            return f"{name} = {step.operation}({operands})"
        return f"{step.operation}({operands}, out={name})"

    def _read(self, operand: Any) -> str:
        if isinstance(operand, Symbol):
            return self._names.get(operand.index, f"t{operand.index}")
        key = repr(operand)
        if key not in self.constants:
            # An array without axes is taken faster than a number.
            self.constants[key] = np.asarray(operand)
        return f"c{list(self.constants).index(key)}"

    def _name(self, step: Symbol) -> str:
        if step.operation in _OWN or step.kind not in self._free:
            return f"t{step.index}"
        if step.index in self._rows:
            return self._rows[step.index]
        if self._free[step.kind]:
            return self._free[step.kind].pop()
        name = f"b{len(self.buffers)}"
        self.buffers[name] = step.kind
        return name

    def _release(self, operand: Symbol) -> None:
        self._left[operand.index] -= 1
        name = self._names.get(operand.index, "")
        if not self._left[operand.index] and name in self.buffers:
            self._free[self.buffers[name]].append(name)
