"""The NumPy engine: a formula as calls of ufuncs on blocks that stay in the cache."""

from __future__ import annotations

from collections import Counter
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.engine import Engine
from optipath.engines.formula import DOUBLE, LEFT
from optipath.engines.symbols import OPERATIONS, Symbol
from optipath.kernels.primitives import NUMPY

if TYPE_CHECKING:
    from optipath.engines.engine import ArrayPath
    from optipath.engines.formula import Formula


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


_OWN = ("exponent", "ldexp", "power", "product_rest", "where")
"""Operations that make their own arrays, unless said otherwise below."""

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
        self._free: dict[str, list[str]] = {"float": [], "bool": [], "mask": []}
        self._masks: dict[int, str] = {}
        self._chosen = Counter(
            step.operands[0].index for step in formula.body if self._is_choice(step)
        )
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
                self._names[symbol.index] = f"t{symbol.index}"
                if formula.name_of(symbol) in formula.wide:
                    low, high = formula.wide[formula.name_of(symbol)]
                    inside = (
                        f"({low!r} <= a{symbol.index}.min()) & (a{symbol.index}.max() <= {high!r})"
                    )
                    lines.append(f"if not {inside}: return False")
                if symbol.kind == "float":
                    lines.append(f"t{symbol.index} = a{symbol.index}.astype(T, copy=False)")
                else:
                    lines.append(f"t{symbol.index} = a{symbol.index}")
        for left in formula.lefts:
            if not left.uniform:
                angle = f"a{formula.whole_of(left).index}"
                lines.append(f"t{left.index} = left[{left.operation!r}]({angle}).astype(T)")
        for step in formula.body:
            lines += self._choice(step) if self._is_choice(step) else [self._line(step)]
        for row, result in enumerate(formula.computed):
            if self._read(result) != f"out[{row}]":
                lines.append(f"out[{row}][...] = {self._read(result)}")
        lines.append(f"return {self._read(formula.holds)}")
        names = [
            *(f"a{s.index}" for s in formula.inputs if not s.uniform),
            *(f"t{s.index}" for s in (*formula.inputs, *formula.lefts) if s.uniform),
            *(f"t{s.index}" for s in formula.prologue),
            *self.constants_names(),
            *self.buffers,
            *(f"{name}_" for name in self.buffers),
            "*out",
        ]
        body = "".join(f"    {line}\n" for line in lines)
        kind, bits = formula.dtype.name, 8 * formula.dtype.itemsize
        head = f"import numpy\nT, I = numpy.{kind}, numpy.int{bits}\n"
        return f"{head}def block({', '.join(names)}):\n{body}"

    def constants_names(self) -> list[str]:
        """Return how the known numbers are called."""
        return [f"c{place}" for place in range(len(self.constants))]

    def _is_choice(self, step: Symbol) -> bool:
        """Tell whether an operation chooses between numbers path by path."""
        condition = step.operands[0]
        return (
            step.operation == "where"
            and step.kind == "float"
            and isinstance(condition, Symbol)
            and not condition.uniform
        )

    def _choice(self, step: Symbol) -> list[str]:
        """Return the lines of a choice by the bits: a processor that guesses at each is slow.

        ``no ^ ((yes ^ no) & mask)`` with a mask of ones where the condition is true: no branches.
        """
        condition, yes, no = step.operands
        lines = []
        if condition.index not in self._masks:
            mask = self._masks[condition.index] = self._buffer("mask")
            argument = self._read(condition)
            seen = f"{argument}_" if argument in self.buffers else f"{argument}.view(numpy.int8)"
            lines.append(f"negative({seen}, {mask}, dtype=I)")
        mask = self._masks[condition.index]
        first, second = self._bits(yes), self._bits(no)
        name = self._name(step)
        bits = self._bits_of(name)
        if second == "0":
            lines.append(f"bitwise_and({first}, {mask}, {bits})")
        else:
            if first == "0":
                lines.append(f"bitwise_and({second}, {mask}, {bits})")
            else:
                lines.append(f"bitwise_xor({first}, {second}, {bits})")
                lines.append(f"bitwise_and({bits}, {mask}, {bits})")
            lines.append(f"bitwise_xor({bits}, {second}, {bits})")
        self._names[step.index] = name
        self._release(step)
        self._chosen[condition.index] -= 1
        if not self._chosen[condition.index]:
            self._free["mask"].append(self._masks.pop(condition.index))
        return lines

    def _bits(self, operand: Any) -> str:
        if not isinstance(operand, Symbol) and operand == 0.0:
            return "0"
        return self._bits_of(self._read(operand))

    def _bits_of(self, name: str) -> str:
        return f"{name}_" if name in self.buffers else f"{name}.view(I)"

    def _line(self, step: Symbol) -> str:
        operands = ", ".join(map(self._read, step.operands))
        self._release(step)
        name = self._name(step)
        self._names[step.index] = name
        if name.startswith("t"):
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

    def _name(self, step: Symbol) -> str:
        own = step.operation in _OWN and not self._is_choice(step)
        if own or step.kind not in self._free:
            return f"t{step.index}"
        if step.index in self._rows:
            return self._rows[step.index]
        return self._buffer(step.kind)

    def _buffer(self, kind: str) -> str:
        if self._free[kind]:
            return self._free[kind].pop()
        name = f"b{len(self.buffers)}"
        self.buffers[name] = kind
        return name

    def _release(self, step: Symbol) -> None:
        """Free the arrays of operands that no later operation needs."""
        for operand in step.operands:
            if isinstance(operand, Symbol):
                self._left[operand.index] -= 1
                name = self._names.get(operand.index, "")
                if not self._left[operand.index] and name in self.buffers:
                    self._free[self.buffers[name]].append(name)
