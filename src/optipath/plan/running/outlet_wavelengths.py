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


def wavelength_among(inputs: Inputs) -> Parameter | None:
    """Return the parameter by which light has its wavelength.

    Parameters
    ----------
    inputs : Inputs
        What may be given to a plan, and what it is bound to.

    Returns
    -------
    Parameter or None
        The one that is called ``wavelength``, or the only `Wavelength` by another name.
    """
    several = {**inputs.bound, **inputs.open}
    usual = several.get(USUAL)
    if usual is not None and inputs.dimensions.get(USUAL, "length") == "length":
        return usual
    found = None
    for one in several.values():
        if isinstance(one, Wavelength):
            if found is not None:
                return None
            found = one
    return found


class LaterWavelength:
    """Finds the wavelengths of light in what a run was given.

    Parameters
    ----------
    parameter : Parameter
        What gives them.
    inputs : Inputs
        What could be given.
    parameters : mapping of str to Any
        What was; arrays that somebody may change are copied.
    where : tuple, optional
        Which part of the batch the light is.
    """

    def __init__(
        self, parameter: Parameter, inputs: Inputs, parameters: Mapping[str, Any], where: Any = ()
    ) -> None:
        self.parameter = parameter
        self.inputs = inputs
        self.where = where
        # The batch, of which the light is a part, depends on all of them.
        names = parameters if where else {parameter.name} & parameters.keys()
        self.parameters = {name: kept(parameters[name]) for name in names}

    def __call__(self) -> Any:
        """Return the wavelengths, in metres; they broadcast to the batch."""
        return self._found

    @cached_property
    def _found(self) -> Any:
        given = self.parameters.get(self.parameter.name, self.parameter.default)
        found, present = self.parameter.resolve(given)
        if not np.all(present):
            found = np.where(present, found, np.nan)
        if self.where:
            _, batch = self.inputs.resolve(self.parameters)
            found = sliced(found, batch, self.where)
        return found if is_traced(found) else locked(np.array(found, np.float64))
