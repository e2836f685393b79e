"""The engine for one path: a formula as a function of plain Python floats."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.engine import Engine
from optipath.engines.symbols import OPERATIONS, Symbol
from optipath.kernels.primitives import FLOAT

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.engines.formula import Formula


_DEEPEST = 30
_TWICE = ("maximum", "minimum")
"""Operations whose text names an operand twice."""

_SPACE = {
    "atan2": math.atan2,
    "cos": math.cos,
    "exp": math.exp,
    "exponent": FLOAT.scaling,
    "inf": math.inf,
    "ldexp": math.ldexp,
    "nan": math.nan,
    "product_rest": lambda a, b: FLOAT.two_product(a, b)[1],
    "sin": math.sin,
    "sqrt": math.sqrt,
}


class FloatEngine(Engine["Formula", "Callable[..., tuple[Any, ...] | None]"]):
    """Runs one path; nobody asks for it by name, since it is the fastest for one."""

    name = "floats"
    precisions = ("float64",)

    def compiled(self, formula: Formula) -> Callable[..., tuple[Any, ...] | None]:
        """Return a function of floats, in the order of the formula's inputs.

        Its result is None where the formula does not hold; it may raise an ArithmeticError or
        a ValueError there, too.
        """
        space: dict[str, Any] = dict(_SPACE)
        exec(compile(source(formula), "<formula>", "exec"), space)  # noqa: S102 - our own text
        path: Callable[..., tuple[Any, ...] | None] = space["path"]
        return path


FLOAT_ENGINE = FloatEngine()


def source(formula: Formula) -> str:
    """Return the text of a function ``path(*given)``.

    What is used once stands where it is used, so that of two choices one is computed.
    """
    texts: dict[int, str] = {}
    depth: dict[int, int] = {}
    lines: list[str] = []

    def written(operand: Any) -> str:
        if not isinstance(operand, Symbol):
            return f"({operand.item()!r})" if isinstance(operand, np.generic) else repr(operand)
        return texts.get(operand.index, f"t{operand.index}")

    used_twice = {
        o.index
        for s in formula.steps
        if s.operation in _TWICE
        for o in s.operands
        if isinstance(o, Symbol)
    }
    for step in formula.steps:
        text = OPERATIONS[step.operation].text.format(*map(written, step.operands))
        deep = 1 + max(
            (depth.get(o.index, 0) for o in step.operands if isinstance(o, Symbol)), default=0
        )
        if formula.uses[step.index] == 1 and step.index not in used_twice and deep < _DEEPEST:
            texts[step.index] = f"({text})"
            depth[step.index] = deep
        else:
            lines.append(f"t{step.index} = {text}")
    results = ", ".join(map(written, formula.results))
    lines += [f"if {written(formula.holds)}:", f"    return ({results},)", "return None"]
    argument = ", ".join(f"t{s.index}" for s in formula.inputs)
    body = "".join(f"    {line}\n" for line in lines)
    return f"def path({argument}):\n{body}"
