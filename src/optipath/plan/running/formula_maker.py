"""The formulas of a program: of whatever is asked of it, for numbers given in some forms."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.formulas.path_formula import lights_formula
from optipath.values.operands import ABSENT, ONE
from optipath.values.precision import wide

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from optipath.engines.formulas.formula import Formula
    from optipath.engines.program.program import Program
    from optipath.kernels.carriers.carrier import Carrier
    from optipath.plan.running.options import RunOptions
    from optipath.values.input_key import InputKey
    from optipath.values.inputs import Inputs

LONGEST = 200
"""How many steps are compiled in one piece."""


class FormulaMaker:
    """Makes the formulas of one program."""

    def __init__(
        self,
        program: Program,
        inputs: Inputs,
        carrier: type[Carrier],
        options: RunOptions,
        *,
        unreduced: bool,
    ) -> None:
        self.program = program
        self.limits = inputs.limits
        self.masks = inputs.masks
        self.carrier = carrier
        self.dtype = np.dtype(options.dtype)
        self.unreduced = unreduced
        self.may_make = len(program.steps) <= LONGEST and options.reproducible

    def attempt(self, make: Callable[[], Formula]) -> Formula | None:
        """Return what makes a formula gives; None where it cannot be made."""
        if not self.may_make:
            return None
        try:
            return make()
        except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
            self.may_make = False
            return None

    def of_floats(self, forms: Mapping[InputKey, str]) -> Formula | None:
        """Return the formula of light for plain floats; None where it cannot be made."""
        return self.attempt(lambda: self.lights(forms, single=True))

    def lights(
        self, forms: Mapping[InputKey, str], *, carrier: type[Carrier] | None = None, **options: Any
    ) -> Formula:
        """Return the formula of the light at every end, as `lights_formula` takes options."""
        kind, carrier = self.dtype.name, carrier or self.carrier
        own = self.limits
        return lights_formula(self.program, carrier, kind, forms, own, masks=self.masks, **options)

    def all_given_as(self, form: str) -> dict[InputKey, str]:
        """Return one form for every number that is not known."""
        return dict.fromkeys([o.input_key for o in self.program.operands if not o.known], form)

    @cached_property
    def length(self) -> int | None:
        """How many operations light takes for real numbers; None where there is no formula."""
        forms, unreduced = self.all_given_as(ONE), self.unreduced
        forms |= {key: ABSENT for key in forms if key.part == "imag"}
        made = self.attempt(lambda: self.lights(forms, unreduced=unreduced))
        return None if made is None else len(made.steps)

    @cached_property
    def known_arrays(self) -> dict[str, np.ndarray[Any, Any]]:
        """The arrays that are known beforehand, as formulas name them."""
        kind = wide(self.dtype)
        return {
            f".{place}": operand.numbers(kind=kind).astype(
                bool if operand.part == "present" else self.dtype, copy=False
            )
            for place, operand in enumerate(self.program.operands)
            if operand.known and operand.numbers().ndim
        }
