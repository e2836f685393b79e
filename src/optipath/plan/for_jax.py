"""What is JAX's: when it is asked, and what becomes of values that it traces."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.choice import REGISTRY
from optipath.engines.jax_engine import CarriedProgram
from optipath.errors import ParameterError
from optipath.values.angles import CosSin
from optipath.values.jax_values import is_jax, is_traced, namespace

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.engines.program import Program
    from optipath.kernels.carriers.carrier import Carrier
    from optipath.plan.inputs import Inputs
    from optipath.plan.reading import RunOptions
    from optipath.values.parameters import Resolved


class ForJax:
    """A program as JAX runs it."""

    def __init__(
        self, program: Program, inputs: Inputs, carrier: type[Carrier], options: RunOptions
    ) -> None:
        self.program = program
        self.inputs = inputs
        self.carrier = carrier
        self.options = options

    @cached_property
    def path(self) -> Any:
        """The program, ready for JAX."""
        program = CarriedProgram(self.program, self.carrier, np.dtype(self.options.dtype))
        return REGISTRY["jax"].compiled(program)

    @cached_property
    def has_traced(self) -> bool:
        """Whether a value of the path is one that JAX traces."""
        return any(operand.traced for operand in self.program.operands)

    def is_requested(self, parameters: Mapping[str, Any]) -> bool:
        """Tell whether a run is asked of JAX: by name, or by what is given."""
        traced = self.has_traced or any(map(_is_of_jax, parameters.values()))
        if traced and self.options.engine not in ("auto", "jax"):
            raise ParameterError(
                f"values of JAX were given, but the plan was composed for engine "
                f"'{self.options.engine}'; compose with engine='jax' or 'auto'"
            )
        return traced or self.options.engine == "jax"

    def needs_closer_look(self, sound: Any, resolved: Mapping[str, Resolved]) -> bool:
        """Tell whether hardly any light leaves a loop, of values that are all known."""
        traces = self.has_traced or any(is_traced(argument.value) for argument in resolved.values())
        return not traces and not np.all(sound)

    def nan_outside(self, numbers: Any, resolved: Mapping[str, Resolved], axes: int) -> Any:
        """Return what JAX gives, NaN where a value that it traces is not allowed, or S0 is NaN."""
        inside = self.inputs.inside(resolved)
        if self.inputs.masks:
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
