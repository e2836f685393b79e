"""The wavelengths of light by the values of a run, found when somebody asks for them."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.plan.running.batch import sliced
from optipath.plan.running.outlet_frames import kept
from optipath.values.arrays.jax_values import is_traced
from optipath.values.arrays.read_only import locked
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.inputs import Inputs
    from optipath.values.parameters import Parameter

USUAL = "wavelength"
"""The name that the wavelength of a path has."""


def wavelengths_among(inputs: Inputs) -> tuple[Parameter, ...]:
    """Return the parameters by which light may have its wavelength."""
    several = {**inputs.bound, **inputs.open}
    if inputs.per_nanometre:
        return tuple([several[name] for name in inputs.per_nanometre])
    usual = several.get(USUAL)
    if inputs.dimensions.get(USUAL, "length") != "length":
        usual = None
    return tuple([one for one in several.values() if one is usual or isinstance(one, Wavelength)])


class LaterWavelength:
    """Finds the wavelengths of light in what a run was given."""

    def __init__(
        self,
        among: tuple[Parameter, ...],
        inputs: Inputs,
        parameters: Mapping[str, Any],
        where: Any = (),
    ) -> None:
        self.among = among
        self.inputs = inputs
        self.where = where
        # The batch, of which the light is a part, depends on all of them.
        names = parameters if where else {among[0].name} & parameters.keys()
        self.parameters = {name: kept(parameters[name]) for name in names}

    def __call__(self) -> Any:
        """Return the wavelengths, in metres; they broadcast to the batch. None if in doubt."""
        return None if self.in_doubt else self._found

    @property
    def in_doubt(self) -> tuple[str, ...]:
        """The names of the parameters that may all give them; none where one does."""
        return tuple([one.name for one in self.among]) if len(self.among) > 1 else ()

    @cached_property
    def _found(self) -> Any:
        (parameter,) = self.among
        found, present = parameter.resolve(self.parameters.get(parameter.name, parameter.default))
        if not np.all(present):
            found = np.where(present, found, np.nan)
        if self.where:
            _, batch = self.inputs.resolve(self.parameters)
            found = sliced(found, batch, self.where)
        return found if is_traced(found) else locked(np.array(found, np.float64))
