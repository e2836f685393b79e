"""Runnable: a program with what is needed to run it step by step, as a formula, or by JAX."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.engines.choice import REGISTRY
from optipath.engines.path_formula import PathFormula
from optipath.errors import ParameterError
from optipath.kernels.trigonometry import DIGITS
from optipath.plan.first_values import FirstValues
from optipath.plan.interpreter import Interpreter, carrier_of
from optipath.plan.reading import InputReader
from optipath.values.angles import CosSin
from optipath.values.arrays import CURE, enough_for
from optipath.values.jax_values import is_jax, is_traced, namespace
from optipath.values.operands import ABSENT, ONE
from optipath.values.precision import wide

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from contextlib import AbstractContextManager

    from optipath.elements.own_element import OwnWays
    from optipath.engines.formula import Formula
    from optipath.engines.program import Program
    from optipath.plan.inputs import Inputs
    from optipath.plan.reading import Batch
    from optipath.values.operands import InputKey
    from optipath.values.parameters import Resolved
    from optipath.values.precision import Array


LONGEST, LONGEST_ALONE = 200, 4000
"""How many steps are compiled in one piece, of batches and of one path by floats."""


class RunOptions(NamedTuple):
    """How programs are run, as `Composer` takes it."""

    method: str
    composing: str
    dtype: str
    engine: str
    threads: int

    @property
    def reproducible(self) -> bool:
        """Whether a path comes to the same bits alone and in any batch, but with JAX."""
        return self.dtype in DIGITS


@dataclass(eq=False, repr=False)
class Runnable:
    """A program, and the ways to run it."""

    program: Program
    inputs: Inputs
    options: RunOptions
    own_ways: tuple[OwnWays, ...] = ()
    _: KW_ONLY
    unreduced: bool = False

    def __post_init__(self) -> None:
        program, inputs, options = self.program, self.inputs, self.options
        self.first_values = FirstValues(self.own_ways)
        self.dtype = np.dtype(options.dtype)
        self.carrier = carrier_of(program, options.composing)
        self.may_compile = options.reproducible
        self.for_jax = ForJax(self)
        self.reader = InputReader(program, inputs, self.dtype, reproducible=options.reproducible)

    @cached_property
    def interpreter(self) -> Interpreter:
        """What runs the program step by step."""
        limits = self.inputs.limits if self.options.reproducible else None
        return Interpreter(self.program, self.carrier, self.dtype, limits)

    def read_for_bounds(self, parameters: Mapping[str, Any]) -> Batch:
        """Return what is given, for both the bounds of light and the light."""
        self.for_jax.refuse_traced(parameters, "certificates are made")
        return self.reader.read(parameters)

    def attempt(self, make: Callable[[], Formula], longest: int = LONGEST) -> Formula | None:
        """Return what makes a formula gives; None where it cannot be made."""
        if not self.may_compile or len(self.program.steps) > longest:
            return None
        try:
            return make()
        except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
            self.may_compile = False
            return None

    def recorded(self, forms: Mapping[InputKey, str], **options: Any) -> PathFormula:
        """Return what records formulas, for numbers of some forms, as `PathFormula` has options."""
        inputs, kind = self.inputs, self.options.dtype
        return PathFormula(self.program, kind, forms, inputs.limits, masks=inputs.masks, **options)

    def all_passed_as(self, form: str) -> dict[InputKey, str]:
        """Return one form for every number that is not known."""
        return dict.fromkeys(chain(*self.reader.keys.values()), form)

    @cached_property
    def length(self) -> int | None:
        """How many operations light takes for real numbers; None where there is no formula."""
        forms, unreduced = self.all_passed_as(ONE), self.unreduced
        forms |= {key: ABSENT for key in forms if key.part == "imag"}
        made = self.attempt(lambda: self.recorded(forms, unreduced=unreduced).lights(self.carrier))
        return None if made is None else len(made.steps)

    @cached_property
    def known_arrays(self) -> dict[str, Array]:
        """The arrays that are known beforehand, as formulas name them."""
        kind = wide(self.dtype)
        return {
            f".{place}": operand.numbers(kind=kind).astype(
                bool if operand.part == "present" else self.dtype, copy=False
            )
            for place, operand in enumerate(self.program.operands)
            if operand.known and operand.numbers().ndim
        }

    def enough_for(
        self, batch: tuple[int, ...], numbers: int, cure: str = CURE
    ) -> AbstractContextManager[None]:
        """Return a context for so many numbers a path."""
        return enough_for(batch, self.dtype.itemsize * numbers, cure, ParameterError)

    def refuse_infinite(self, numbers: Array) -> None:
        """Refuse light that is not finite, but for NaN where that says what cannot be."""
        method = self.options.method
        if not is_traced(numbers) and np.any(self.inputs.unsound(numbers)):
            raise ParameterError(
                f"the light is not finite in {self.dtype} by method '{method}': a value is "
                f"too extreme{self.first_values.doubt}; give values nearer to 1"
                + ("" if method == "stable" else ", or use method 'stable'")
            )


class ForJax:
    """A program as JAX runs it."""

    def __init__(self, runner: Runnable) -> None:
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
