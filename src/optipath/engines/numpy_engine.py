"""The NumPy engine: a formula as calls of ufuncs on blocks that stay in the cache."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.formula import DOUBLE, LEFT, Engine
from optipath.engines.symbols import OPERATIONS, Symbol
from optipath.kernels.primitives import NUMPY

if TYPE_CHECKING:
    from optipath.engines.formula import ArrayPath, Formula


_BLOCK = 12288
_LEFT = {operation: factory(NUMPY, DOUBLE) for operation, factory in LEFT.items()}


class NumpyEngine(Engine):
    """Does operation after operation to blocks of paths."""

    name = "numpy"

    def compiled(self, formula: Formula) -> ArrayPath:
        """Return a function that does what a formula says, to arrays."""
        writer = BlockWriter(formula)
        space: dict[str, Any] = {name: about.ufunc for name, about in OPERATIONS.items()}
        space["left"] = _LEFT
        exec(compile(writer.text(), "<formula>", "exec"), space)  # noqa: S102 - our own text
        block, buffers = space["block"], tuple(writer.buffers.values())
        kinds = {"float": formula.dtype, "bool": np.dtype(bool)}

        indices = [symbol.index for symbol in formula.inputs]
        places = [formula.place_of(symbol) for symbol in formula.inputs]

        @np.errstate(all="ignore")
        def path(
            rows: tuple[int, int], columns: tuple[int, int], arguments: list[Any], out: Any, at: int
        ) -> bool:
            known = dict(zip(indices, arguments, strict=True))
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
                    for place, n in zip(places, arguments, strict=True)
                    if place != "one"
                ]
                own = [buffer[:tall, :long].reshape(shape) for buffer in free]
                results = [n[at:][cells].reshape(shape) for n in out]
                holds &= bool(np.all(block(*arrays, *uniform, *own, *results)))
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


_OWN = ("exponent", "ldexp", "power", "product_rest", "where")
"""Operations that make their own arrays."""

_BY_KEYWORD = ("maximum", "minimum")
"""Operations that may take more operands one day; others are told faster where to write."""


class BlockWriter:
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
            for row, result in reversed(list(enumerate(formula.computed)))
            if result.kind == "float"
        }

    def text(self) -> str:
        """Return a function ``block(*arrays, *numbers, *constants, *buffers, *out)``."""
        formula = self.formula
        lines = []
        for symbol in formula.inputs:
            if not symbol.uniform:
                given, name = f"a{symbol.index}", formula.name_of(symbol)
                self._names[symbol.index] = f"t{symbol.index}"
                if name in formula.wide:
                    low, high = formula.wide[name]
                    inside = f"({low!r} <= {given}.min()) & ({given}.max() <= {high!r})"
                    lines.append(f"if not {inside}: return False")
                cast = ".astype(T, copy=False)" if symbol.kind == "float" else ""
                lines.append(f"t{symbol.index} = {given}{cast}")
        for left in formula.lefts:
            if not left.uniform:
                angle = f"a{formula.whole_of(left).index}"
                lines.append(f"t{left.index} = left[{left.operation!r}]({angle}).astype(T)")
        lines += map(self._line, formula.body)
        for row, result in enumerate(formula.computed):
            if self._read(result) != f"out[{row}]":
                lines.append(f"out[{row}][...] = {self._read(result)}")
        lines.append(f"return {self._read(formula.holds)}")
        names = [
            *(f"a{s.index}" for s in formula.inputs if not s.uniform),
            *(f"t{s.index}" for s in (*formula.inputs, *formula.lefts) if s.uniform),
            *(f"t{s.index}" for s in formula.prologue),
            *(f"c{place}" for place in range(len(self.constants))),
            *self.buffers,
            "*out",
        ]
        body = "".join(f"    {line}\n" for line in lines)
        head = f"from numpy import {formula.dtype.name} as T\n"
        return f"{head}def block({', '.join(names)}):\n{body}"

    def _line(self, step: Symbol) -> str:
        operands = ", ".join(map(self._read, step.operands))
        self._release(step)
        name, own = f"t{step.index}", step.operation in _OWN or step.kind not in self._free
        if not own and step.index in self._rows:
            name = self._rows[step.index]
        elif not own and self._free[step.kind]:
            name = self._free[step.kind].pop()
        elif not own:
            name = f"b{len(self.buffers)}"
            self.buffers[name] = step.kind
        self._names[step.index] = name
        if own:
            return f"{name} = {step.operation}({operands})"
        out = f"out={name}" if step.operation in _BY_KEYWORD else name
        return f"{step.operation}({operands}, {out})"

    def _read(self, operand: Any) -> str:
        if isinstance(operand, Symbol):
            return self._names.get(operand.index, f"t{operand.index}")
        key = repr(operand)
        if key not in self.constants:
            # An array without axes is taken faster than a number.
            self.constants[key] = np.asarray(operand)
        return f"c{list(self.constants).index(key)}"

    def _release(self, step: Symbol) -> None:
        """Free the arrays of operands that no later operation needs."""
        for operand in step.operands:
            if isinstance(operand, Symbol):
                self._left[operand.index] -= 1
                name = self._names.get(operand.index, "")
                if not self._left[operand.index] and name in self.buffers:
                    self._free[self.buffers[name]].append(name)
