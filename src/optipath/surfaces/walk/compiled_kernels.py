"""Kernels as functions that compiled code calls, one number at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numba as nb
import numpy as np

from optipath.engines import numba_helpers
from optipath.engines.formulas.formula import Formula
from optipath.engines.formulas.python_text import assignments, indented
from optipath.engines.formulas.recorder import Recorder
from optipath.engines.formulas.symbol import Symbol
from optipath.engines.formulas.symbolic import SYMBOLIC

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.kernels.numbers.primitives import Primitives


def compiled_kernel(
    name: str, kernel: Callable[[Primitives], Callable[..., Sequence[Any]]], given: int
) -> Any:
    """Return a kernel as a function of Numba.

    Examples
    --------
    >>> from optipath.kernels.filters.rotation import align
    >>> compiled_kernel("aligned", align, 2)(0.0, 1.0)
    (-1.0, 0.0)
    """
    space: dict[str, Any] = {**_SPACE, "__name__": __name__}
    exec(kernel_text(name, kernel, given), space)  # noqa: S102 - our own
    # With the flags of the loops that it goes into: nothing is an error, all is a number.
    return nb.njit(space[name], error_model="numpy")


def kernel_text(
    name: str, kernel: Callable[[Primitives], Callable[..., Sequence[Any]]], given: int
) -> str:
    """Return the text of what `compiled_kernel` compiles, common terms found once."""
    recorder = Recorder(np.dtype(float))
    inputs = [recorder.input(f"a{place}") for place in range(given)]
    formula = Formula(recorder.dtype, tuple(kernel(SYMBOLIC)(*inputs)))
    lines = assignments(formula.steps, _written)
    results = ", ".join(map(_written, formula.results))
    parameters = ", ".join(map(_written, inputs))
    return "\n".join([f"def {name}({parameters}):", *indented(*lines, f"return ({results},)"), ""])


def _written(operand: Any) -> str:
    if isinstance(operand, Symbol):
        return f"t{operand.index}"
    return repr(operand.item() if isinstance(operand, np.generic) else operand)


_SPACE = {
    **{name: getattr(np, name) for name in ("sqrt", "inf", "nan")},
    **{name: getattr(numba_helpers, name) for name in ("exponent", "ldexp", "product_rest")},
}
