"""What is JAX's: when it is asked, and what becomes of values that it traces."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.choice import REGISTRY
from optipath.errors import ParameterError
from optipath.values.angles import CosSin
from optipath.values.jax_values import is_jax, is_traced, namespace

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.plan.runner import Runner
    from optipath.values.parameters import Resolved


class ForJax:
    """The program of a runner as JAX runs it."""

    def __init__(self, runner: Runner) -> None:
        self.runner = runner

    @cached_property
    def path(self) -> Any:
        """The program, ready for JAX."""
        runner = self.runner
        return REGISTRY["jax"].compiled((runner.program, runner.carrier, runner.dtype))

    @cached_property
    def has_traced(self) -> bool:
        """Whether a value of the path is one that JAX traces."""
        return any(operand.traced for operand in self.runner.program.operands)

    def is_requested(self, parameters: Mapping[str, Any]) -> bool:
        """Tell whether a run is asked of JAX: by name, or by what is given."""
        engine = self.runner.options.engine
        traced = self.has_traced or any(map(_is_of_jax, parameters.values()))
        if traced and engine not in ("auto", "jax"):
            raise ParameterError(
                f"values of JAX were given, but the plan was composed for engine "
                f"'{engine}'; compose with engine='jax' or 'auto'"
            )
        return traced or engine == "jax"

    def needs_closer_look(self, sound: Any, resolved: Mapping[str, Resolved]) -> bool:
        """Tell whether hardly any light leaves a loop, of values that are all known."""
        traces = self.has_traced or any(is_traced(argument.value) for argument in resolved.values())
        return not traces and not np.all(sound)

    def nan_outside(self, numbers: Any, resolved: Mapping[str, Resolved], axes: int) -> Any:
        """Return what JAX gives, NaN where a value that it traces is not allowed, or S0 is NaN."""
        inputs = self.runner.inputs
        inside = inputs.inside(resolved)
        if inputs.masks:
            # What is known is NumPy's from here, whatever precision JAX is set to.
            numbers = numbers if is_traced(numbers) else np.asarray(numbers)
            inside = inside & ~namespace(numbers).isnan(numbers[(..., *[0] * axes)])
        if inside is True:
            return numbers
        xp = namespace(numbers)
        # As a factor it makes slopes NaN as well, and those of what is allowed stay as they are.
        factor = xp.where(inside, 1.0, xp.nan).astype(numbers.dtype)
        return numbers * factor.reshape(*factor.shape, *[1] * axes)

    def traces(self, parameters: Mapping[str, Any]) -> bool:
        """Tell whether JAX traces a value, so that it is not known yet."""
        return self.has_traced or any(
            value.is_traced if type(value) is CosSin else is_traced(value)
            for value in parameters.values()
        )

    def refuse_traced(self, parameters: Mapping[str, Any], what: str) -> None:
        """Refuse values that are not known yet."""
        if self.traces(parameters):
            raise ParameterError(
                f"{what} of numbers, not of values that JAX traces; do it outside of jit and grad"
            )


def _is_of_jax(value: Any) -> bool:
    """Tell whether a value is JAX's, or an angle by such a cosine and sine."""
    parts = (value.cos, value.sin) if type(value) is CosSin else (value,)
    return any(map(is_jax, parts))
