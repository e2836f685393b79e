"""How many square roots and divisions a program needs for one path."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.kernels.numbers.primitives import Primitives

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.engines.program.program import Program
    from optipath.kernels.carriers.kernel import Kernel


@dataclass(frozen=True, eq=False)
class _Counted:
    """A number that nobody knows; what is done to it is counted."""

    counts: Counter[str]

    def _same(self, *_: object) -> _Counted:
        return self

    def _divided(self, *_: object) -> _Counted:
        self.counts["div"] += 1
        return self

    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = _same
    __neg__ = __pos__ = __abs__ = __pow__ = __rpow__ = __and__ = __rand__ = __or__ = __ror__ = _same
    __lt__ = __le__ = __gt__ = __ge__ = __eq__ = __ne__ = _same  # type: ignore[assignment]
    __truediv__ = __rtruediv__ = _divided
    __hash__ = None  # type: ignore[assignment]


def slow_operations(program: Program) -> dict[str, int]:
    """Return the number of square roots ("sqrt") and divisions ("div") for one path.

    Examples
    --------
    >>> import optipath as op
    >>> slow_operations(op.load_preset("malus").compose().program)["sqrt"]
    2
    """
    counts: Counter[str] = Counter(sqrt=0, div=0)
    for evaluation in program.evaluations:
        counts += kernel_operations(evaluation.kernel, len(evaluation.arguments))
    xp, number = _counting(counts)
    for step in program.steps:
        if step.evaluation is None:
            continue
        structure = program.evaluations[step.evaluation].kernel.structure
        if structure is not None:
            structure.action(xp)([number] * len(structure.identity), (number,) * 4, 4)
    return {"sqrt": counts["sqrt"], "div": counts["div"]}


def kernel_operations(kernel: Kernel, arguments: int) -> Counter[str]:
    """Return the number of square roots and divisions of one evaluation of a kernel."""
    counts: Counter[str] = Counter()
    xp, number = _counting(counts)
    # Not made_for, which would keep what is made for these primitives, used once.
    kernel.factory(xp)(*[number] * arguments)
    return counts


def _counting(counts: Counter[str]) -> tuple[Primitives, _Counted]:
    number = _Counted(counts)

    def root(_: object) -> _Counted:
        counts["sqrt"] += 1
        return number

    one: Callable[..., Any] = lambda *_: number  # noqa: E731 - a def would need a name for each
    pair: Callable[..., Any] = lambda *_: (number, number)  # noqa: E731
    names = ("where", "absolute", "maximum", "minimum", "sin", "cos", "exp", "atan2")
    others = ("scaling", "ldexp", "below_rounding", "fixed")
    functions: dict[str, Any] = dict.fromkeys((*names, *others), one)
    return Primitives(sqrt=root, two_product=pair, **functions), number
