"""The engine that is called "numba": a formula compiled into one loop by LLVM, which Numba brings.

A formula is a list of operations without branches, so its loop is written in LLVM's own language,
which takes a tenth of the time that Numba takes to translate Python. Nothing is contracted or put
in another order: each operation gives the bits that NumPy gives.
"""

from __future__ import annotations

import os
from contextlib import contextmanager
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.formula import Engine, left_formula
from optipath.engines.numpy_engine import NumpyEngine
from optipath.engines.symbols import OPERATIONS, Symbol, strongest

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.engines.formula import ArrayPath, Formula


_BLOCK = 512


class LlvmEngine(Engine):
    """Compiles a formula into machine code, which is kept for the next process."""

    name, extra = "numba", "fast"
    longest = 4000

    def compiled(self, formula: Formula) -> ArrayPath:
        """Return a function of arrays; NumPy's where ``NUMBA_DISABLE_JIT`` forbids compiling."""
        from optipath.engines.code_cache import CODE  # noqa: PLC0415 - not to load it for NumPy

        if is_forbidden():
            CODE.tell("NUMBA_DISABLE_JIT is set, so that NumPy runs what Numba would compile")
            return NumpyEngine().compiled(formula)
        from optipath.engines.machine_code import machine_code_of  # noqa: PLC0415 - an extra

        function = CODE.function(source(formula), machine_code_of)
        shape, kind = (len(_split_inputs(formula)), _BLOCK), formula.dtype

        def path(
            rows: tuple[int, int], columns: tuple[int, int], arguments: list[Any], out: Any, at: int
        ) -> bool:
            own = np.empty(shape, kind) if shape[0] else out
            return function(*rows, *columns, *arguments, own, out, out.shape[1], at) != 0

        return path

    def is_ready(self, formula: Formula) -> bool:
        """Tell whether the machine code of a formula is kept, in memory or on disk."""
        from optipath.engines.code_cache import CODE  # noqa: PLC0415 - not to load it for NumPy

        return is_forbidden() or CODE.has(source(formula))


def is_forbidden() -> bool:
    """Tell whether the user has forbidden Numba to compile."""
    return os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0")


@lru_cache(8)
def source(formula: Formula) -> str:
    """Return the function ``path`` of what `ArrayPath` takes, in LLVM's language.

    ``path(top, bottom, start, stop, *given, own, out, paths, at)``; ``own`` has room for split
    numbers, and ``paths`` is the row length of ``out``.
    """
    return _Writer(formula).text()


def _split_inputs(formula: Formula) -> list[Symbol]:
    """Return what is split into a number of the formula's precision and, of angles, the rest.

    They have a loop of their own, as the widest type of a loop limits its vectors.
    """
    results = []
    for symbol in formula.inputs:
        if formula.name_of(symbol) in formula.wide:
            rests = [x for x in formula.lefts if formula.whole_of(x) is symbol and not x.uniform]
            results += [symbol, *rests]
    return results


_REAL = {"float64": "double", "float32": "float"}
_DONE = {"add": "add", "subtract": "sub", "multiply": "mul", "divide": "div"}
_ORDER = {"less": "lt", "less_equal": "le", "greater": "gt", "greater_equal": "ge"}
_ALIKE = {"equal": "icmp eq", "not_equal": "icmp ne", "logical_and": "and", "logical_or": "or"}
_OPCODES = {
    "float": {name: f"f{opcode}" for name, opcode in _DONE.items()}
    | {name: f"fcmp o{how}" for name, how in _ORDER.items()}
    | {"negative": "fneg", "equal": "fcmp oeq", "not_equal": "fcmp une"},
    "int": _DONE | _ALIKE | {name: f"icmp s{how}" for name, how in _ORDER.items()},
    "bool": _ALIKE
    | {"add": "or", "multiply": "and"}
    | {name: f"icmp u{how}" for name, how in _ORDER.items()},
}
"""Operations that are one instruction, by the kind of their operands."""

_CHOSEN = {"maximum": "greater_equal", "minimum": "less_equal"}
"""The comparison by which the larger or the smaller of two numbers is chosen."""

_CALLED = {"absolute": "fabs", "sqrt": "sqrt", "exp": "exp", "sin": "sin", "cos": "cos"}
_CALLED |= {"power": "pow"}
"""Functions of floats that LLVM has."""


class _Writer:
    """Writes the function of a formula, line after line."""

    def __init__(self, formula: Formula) -> None:
        self.formula = formula
        self.real = _REAL[formula.dtype.name]
        self.lines: list[str] = []
        self.declared: set[str] = set()
        self.names: dict[int, str] = {}
        self.temporaries = 0
        self.block, self.good = "entry", "true"
        self.rooms = {s.index: n * _BLOCK for n, s in enumerate(_split_inputs(formula))}

    def text(self) -> str:
        """Return the module."""
        formula, emit = self.formula, self.emit
        for symbol in formula.inputs:
            if formula.place_of(symbol) == "one":
                self.names[symbol.index] = self.converted(f"%a{symbol.index}", symbol.kind)
        for left in formula.lefts:
            if left.uniform:
                number = self.left(left, f"%a{formula.whole_of(left).index}")
                self.names[left.index] = self.converted(number, "float")
        for step in formula.prologue:
            self.operation(step)
        width = emit("sub i64 %stop, %start")
        with self.loop("row", "%top", "%bottom"):
            first = emit(f"mul i64 {emit('sub i64 %row, %top')}, {width}")
            for given in formula.inputs:
                if formula.place_of(given) == "row":
                    self.load(given, "%row")
            with self.loop("begin", "0", width, _BLOCK):
                rest = emit(f"sub i64 {width}, %begin")
                short = emit(f"icmp slt i64 {rest}, {_BLOCK}")
                count = emit(f"select i1 {short}, i64 {rest}, i64 {_BLOCK}")
                starts = {
                    "cell": emit(f"add i64 {first}, %begin"),
                    "column": emit("add i64 %start, %begin"),
                }
                for symbol in formula.inputs:
                    if formula.name_of(symbol) in formula.wide:
                        self.split(symbol, starts["cell"], count)
                self.body(starts, count)
        emit("zext i1 %good.row to i64", "%result")
        places = ", ".join(f"i64 %{name}" for name in ("top", "bottom", "start", "stop"))
        inputs = ""
        for symbol in formula.inputs:
            kind = "double" if formula.place_of(symbol) == "one" else "ptr noalias"
            inputs += f"{kind} %a{symbol.index}, "
        ends = "ptr noalias %own, ptr noalias %out, i64 %paths, i64 %at"
        head = f"define i64 @path({places}, {inputs}{ends}) {{"
        body = "\n".join(line if line.endswith(":") else f"  {line}" for line in self.lines)
        declared = "\n".join(sorted(self.declared))
        return f"{head}\nentry:\n{body}\n  ret i64 %result\n}}\n{declared}\n"

    def emit(self, operation: str, name: str = "") -> str:
        """Write an operation, and return the name of its result."""
        if not name:
            self.temporaries += 1
            name = f"%v{self.temporaries}"
        self.lines.append(f"{name} = {operation}")
        return name

    @contextmanager
    def loop(self, name: str, begin: str, end: str, step: int = 1) -> Iterator[None]:
        """Write a loop; what is inside may end with a condition, `%good`, that is kept.

        The condition of the loop is `%good.NAME`, of all rounds together.
        """
        before = self.block
        self.lines += [f"br label %{name}.head", f"{name}.head:"]
        at = len(self.lines)
        outer = self.good
        self.good = f"%good.{name}"
        self.emit(f"icmp slt i64 %{name}, {end}", f"%{name}.goes")
        self.lines += [f"br i1 %{name}.goes, label %{name}.body, label %{name}.end"]
        self.lines += [f"{name}.body:"]
        self.block = f"{name}.body"
        yield
        self.emit(f"add i64 %{name}, {step}", f"%{name}.next")
        self.lines += [f"br label %{name}.head", f"{name}.end:"]
        # What a value is at the head depends on where one comes from.
        self.lines[at:at] = [
            f"%{name} = phi i64 [ {begin}, %{before} ], [ %{name}.next, %{self.block} ]",
            f"%good.{name} = phi i1 [ {outer}, %{before} ], [ {self.good}, %{self.block} ]",
        ]
        self.block, self.good = f"{name}.end", f"%good.{name}"

    def load(self, symbol: Symbol, at: str) -> None:
        """Write the reading of an input at an index."""
        n, kind = symbol.index, symbol.kind
        stored = {"float": self.real, "int": "i64", "bool": "i8"}[kind]
        given = self.read(f"%a{n}", at, stored)
        self.names[n] = self.emit(f"icmp ne i8 {given}, 0") if kind == "bool" else given

    def read(self, array: str, at: str, kind: str) -> str:
        """Write the reading of an array, and return the number's name."""
        place = self.emit(f"getelementptr inbounds {kind}, ptr {array}, i64 {at}")
        return self.emit(f"load {kind}, ptr {place}")

    def write(self, number: str, array: str, at: str) -> None:
        """Write a float into an array."""
        place = self.emit(f"getelementptr inbounds {self.real}, ptr {array}, i64 {at}")
        self.lines.append(f"store {self.real} {number}, ptr {place}")

    def converted(self, number: str, kind: str) -> str:
        """Write a double as a number of a formula."""
        if kind == "bool":
            return self.emit(f"fcmp une double {number}, 0.0")
        if kind == "int":
            return self.emit(f"fptosi double {number} to i64")
        return number if self.real == "double" else self.emit(f"fptrunc double {number} to float")

    def split(self, symbol: Symbol, start: str, count: str) -> None:
        """Write the loop that splits an input of more digits, and looks whether it is allowed."""
        formula, name = self.formula, f"i{symbol.index}"
        low, most = formula.wide[formula.name_of(symbol)]
        with self.loop(name, "0", count):
            given = self.read(f"%a{symbol.index}", self.emit(f"add i64 {start}, %{name}"), "double")
            above = self.emit(f"fcmp oge double {given}, {_literal(low)}")
            below = self.emit(f"fcmp ole double {given}, {_literal(most)}")
            self.good = self.emit(f"and i1 {self.good}, {self.emit(f'and i1 {above}, {below}')}")
            lefts = [x for x in formula.lefts if x.index in self.rooms]
            parts = {symbol.index: given}
            parts |= {x.index: self.left(x, given) for x in lefts if formula.whole_of(x) is symbol}
            for index, part in parts.items():
                number = self.emit(f"fptrunc double {part} to {self.real}")
                self.write(number, "%own", self.emit(f"add i64 %{name}, {self.rooms[index]}"))

    def body(self, starts: dict[str, str], count: str) -> None:
        """Write the loop over the paths of a block."""
        formula = self.formula
        rows = [
            self.emit(f"add i64 {self.emit(f'mul i64 {row}, %paths')}, %at")
            for row in range(len(formula.computed))
        ]
        rows = [self.emit(f"add i64 {row}, {starts['cell']}") for row in rows]
        with self.loop("i", "0", count):
            for symbol in (*formula.inputs, *formula.lefts):
                if symbol.index in self.rooms:
                    at = self.emit(f"add i64 %i, {self.rooms[symbol.index]}")
                    self.names[symbol.index] = self.read("%own", at, self.real)
                elif symbol.index not in self.names and not symbol.uniform:
                    place = formula.place_of(symbol)
                    if place in starts:
                        self.load(symbol, self.emit(f"add i64 {starts[place]}, %i"))
            for step in formula.body:
                self.operation(step)
            for row, result in zip(rows, formula.computed, strict=True):
                at = self.emit(f"add i64 {row}, %i")
                self.write(self.value(result), "%out", at)
            self.good = self.emit(f"and i1 {self.good}, {self.value(formula.holds, 'bool')}")

    def value(self, operand: Any, kind: str = "float") -> str:
        """Return how a symbol or a number is written, converted to a kind."""
        if not isinstance(operand, Symbol):
            if kind == "bool":
                return "true" if operand else "false"
            return _literal(float(operand)) if kind == "float" else str(int(operand))
        name, own = self.names[operand.index], operand.kind
        if own == kind:
            return name
        if kind == "bool":
            zero = "fcmp une " + self.real if own == "float" else "icmp ne i64"
            return self.emit(f"{zero} {name}, {'0.0' if own == 'float' else '0'}")
        if kind == "int":
            return self.emit(f"zext i1 {name} to i64")
        how = "uitofp i1" if own == "bool" else "sitofp i64"
        return self.emit(f"{how} {name} to {self.real}")

    def operation(self, step: Symbol) -> None:
        """Write an operation."""
        self.names[step.index] = self.done(step)

    def left(self, left: Symbol, angle: str) -> str:
        """Write in double precision what is left of an angle, and return its name."""
        formula = left_formula(left.operation)
        outside = self.names, self.real
        self.names, self.real = {formula.inputs[0].index: angle}, "double"
        for step in formula.steps:
            self.operation(step)
        result = self.value(formula.results[0])
        self.names, self.real = outside
        return result

    def done(self, step: Symbol) -> str:
        """Write an operation, and return the name of its result."""
        emit, operation, operands = self.emit, step.operation, step.operands
        if operation == "ldexp":
            return self.scaled(self.value(operands[0]), self.value(operands[1], "int"))
        chosen = operands[1:] if operation == "where" else operands
        as_float = OPERATIONS[operation].kind == "float" or operation in ("exponent", "integer")
        kind = "float" if as_float else strongest(chosen)
        of = {"float": self.real, "int": "i64", "bool": "i1"}[kind]
        values = [self.value(operand, kind) for operand in chosen]
        both = ", ".join(values)
        match operation:
            case _ if operation in _OPCODES[kind]:
                return emit(f"{_OPCODES[kind][operation]} {of} {both}")
            case "where" | "maximum" | "minimum":
                if operation == "where":
                    condition = self.value(operands[0], "bool")
                else:
                    condition = emit(f"{_OPCODES[kind][_CHOSEN[operation]]} {of} {both}")
                return emit(f"select i1 {condition}, {of} {values[0]}, {of} {values[1]}")
            case "exponent":
                return self.exponent(values[0])
            case "integer" | "logical_not":
                whole = f"fptosi {of} {both} to i64"
                return emit(whole if operation == "integer" else f"xor i1 {both}, true")
            case "product_rest":
                product = emit(f"fmul {of} {both}")
                return self.call("llvm.fma", of, *values, emit(f"fneg {of} {product}"))
            case "absolute" if kind == "bool":
                return both
            case "absolute" | "negative" if kind == "int":
                negative = emit(f"sub i64 0, {both}")
                if operation == "negative":
                    return negative
                below = emit(f"icmp slt i64 {both}, 0")
                return emit(f"select i1 {below}, i64 {negative}, i64 {both}")
            case "floor_divide" | "remainder" if kind != "float":
                return self.whole_divided(operation, *values)
        function = "atan2" if operation == "arctan2" else f"llvm.{_CALLED[operation]}"
        return self.call(function, of, *values)

    def call(self, function: str, of: str, *values: str) -> str:
        """Write the call of a function of floats."""
        if function.startswith("llvm."):
            function += ".f64" if of == "double" else ".f32"
        elif of == "float":
            function += "f"
        self.declared.add(f"declare {of} @{function}({', '.join([of] * len(values))})")
        given = ", ".join(f"{of} {value}" for value in values)
        return self.emit(f"call {of} @{function}({given})")

    def whole_divided(self, operation: str, number: str, divisor: str) -> str:
        """Write the quotient of integers, rounded down, or what it leaves."""
        emit = self.emit
        rest = emit(f"srem i64 {number}, {divisor}")
        sign = emit(f"xor i64 {rest}, {divisor}")
        down = emit(f"and i1 {emit(f'icmp slt i64 {sign}, 0')}, {emit(f'icmp ne i64 {rest}, 0')}")
        if operation == "remainder":
            return emit(f"select i1 {down}, i64 {emit(f'add i64 {rest}, {divisor}')}, i64 {rest}")
        quotient = emit(f"sdiv i64 {number}, {divisor}")
        return emit(f"sub i64 {quotient}, {emit(f'zext i1 {down} to i64')}")

    def as_double(self, number: str) -> str:
        """Write a float of the formula as a double."""
        return number if self.real == "double" else self.emit(f"fpext float {number} to double")

    def exponent(self, number: str) -> str:
        """Write the exponent that frexp gives, of the bits of a double."""
        emit, wide = self.emit, self.as_double(number)
        size = self.call("llvm.fabs", "double", wide)
        small = emit(f"fcmp olt double {size}, {_literal(2.0**-1022)}")
        factor = emit(f"select i1 {small}, double {_literal(2.0**54)}, double 1.0")
        bits = emit(f"bitcast double {emit(f'fmul double {wide}, {factor}')} to i64")
        power = emit(f"and i64 {emit(f'ashr i64 {bits}, 52')}, 2047")
        bias = emit(f"select i1 {small}, i64 {1022 + 54}, i64 1022")
        power = emit(f"sub i64 {power}, {bias}")
        there = emit(f"fcmp une double {wide}, 0.0")
        return emit(f"select i1 {there}, i64 {power}, i64 0")

    def scaled(self, number: str, power: str) -> str:
        """Write a number times two to a power, in two factors that doubles can hold."""
        emit = self.emit
        low = emit(f"select i1 {emit(f'icmp sgt i64 {power}, -2040')}, i64 {power}, i64 -2040")
        power = emit(f"select i1 {emit(f'icmp slt i64 {low}, 2040')}, i64 {low}, i64 2040")
        half = emit(f"ashr i64 {power}, 1")
        result = self.as_double(number)
        for part in (half, emit(f"sub i64 {power}, {half}")):
            bits = emit(f"shl i64 {emit(f'add i64 {part}, 1023')}, 52")
            result = emit(f"fmul double {result}, {emit(f'bitcast i64 {bits} to double')}")
        return result if self.real == "double" else emit(f"fptrunc double {result} to float")


def _literal(number: float) -> str:
    """Return a float as LLVM writes it, by the bits of a double."""
    return f"0x{np.float64(number).view(np.uint64):016X}"
