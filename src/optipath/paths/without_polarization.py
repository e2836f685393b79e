"""A program in which some elements, or all, dim light by their mean."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from optipath.engines.program.program import Evaluation
from optipath.kernels.carriers.kernel import Kernel

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from optipath.engines.program.program import Program
    from optipath.kernels.numbers.primitives import Primitives


def polarising(program: Program) -> dict[str, list[int]]:
    """Return the steps of each element that may polarise, by its name."""
    found: dict[str, list[int]] = {}
    for light, step in enumerate(program.steps):
        if step.evaluation is None or not step.inputs:
            continue
        kernel = program.evaluations[step.evaluation].kernel
        if kernel.structure is not None and kernel.structure.unpolarising is not None:
            found.setdefault(step.label.rpartition(".")[0], []).append(light)
    return found


def without_polarization(program: Program, steps: Iterable[int]) -> Program:
    """Return a program in which some steps dim all light alike, by their mean.

    Of a stack of layers, each boundary does so.
    """
    evaluations, changed = list(program.evaluations), list(program.steps)
    for light in steps:
        step = changed[light]
        old = evaluations[step.evaluation or 0]
        changed[light] = replace(step, evaluation=len(evaluations))
        evaluations.append(Evaluation(_unpolarising(old.kernel), old.arguments, old.presence))
    return replace(program, evaluations=tuple(evaluations), steps=tuple(changed))


def _unpolarising(kernel: Kernel) -> Kernel:
    """Return the kernel of an element that dims all light by the mean."""
    if kernel.unpolarising is not None:
        return kernel.unpolarising
    cheaper = kernel.without and (kernel.without[0], _unpolarising(kernel.without[1]))
    return Kernel(kernel.name, kernel.structure, _ByMean(kernel), cheaper)


@dataclass(frozen=True)
class _ByMean:
    """Makes the function of a kernel whose element polarises no light."""

    kernel: Kernel

    def __call__(self, xp: Primitives) -> Callable[..., tuple[Any, ...]]:
        function, structure = self.kernel.made_for(xp), self.kernel.structure
        assert structure is not None and structure.unpolarising is not None  # noqa: S101, PT018
        unpolarising = structure.unpolarising

        def numbers(*arguments: Any) -> tuple[Any, ...]:
            return tuple(unpolarising(function(*arguments)))

        return numbers
