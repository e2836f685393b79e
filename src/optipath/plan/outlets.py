"""Frames and wavelengths of the light at the outlets of a plan."""

from __future__ import annotations

from contextlib import suppress
from copy import deepcopy
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.plan.reading import sliced
from optipath.values.arrays import locked
from optipath.values.jax_values import is_traced
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.elements.vertex_place import VertexFrame
    from optipath.light.frame import Frame
    from optipath.plan.inputs import Inputs
    from optipath.values.parameters import Parameter


class LaterFrame:
    """Makes a frame out of what a run was given."""

    def __init__(
        self, frame: VertexFrame, inputs: Inputs, parameters: Mapping[str, Any], where: Any = ()
    ) -> None:
        self.frame = frame
        self.inputs = inputs
        self.where = where
        # The batch, of which the light is a part, depends on all of them.
        names = parameters if where else frame.names & parameters.keys()
        self.parameters = {name: kept(parameters[name]) for name in names}

    def __call__(self) -> Frame:
        """Return the frame."""
        return self._made

    @cached_property
    def _made(self) -> Frame:
        opened = self.inputs.open
        arguments = {
            name: self.inputs.numbers_for(name, self.parameters.get(name, opened[name].default))
            for name in self.frame.names
        }
        if not self.where:
            return self.frame.frame(arguments)
        _, batch = self.inputs.resolve(self.parameters)
        return self.frame.frame(arguments, lambda numbers: sliced(numbers, batch, self.where))


def kept(value: Any) -> Any:
    """Return a value that was given, or a copy of what somebody may change.

    >>> given = np.ones(2)
    >>> kept(given) is given, kept(0.5)
    (False, 0.5)
    """
    if isinstance(value, np.ndarray):
        return value.copy() if value.flags.writeable else value
    with suppress(RecursionError, MemoryError):  # What is too much is refused by the run.
        return deepcopy(value) if isinstance(value, list) else value
    return value


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
        return None if self.in_doubt else self._wavelength

    @property
    def in_doubt(self) -> tuple[str, ...]:
        """The names of the parameters that may all give them; none where one does."""
        return tuple([one.name for one in self.among]) if len(self.among) > 1 else ()

    @cached_property
    def _wavelength(self) -> Any:
        (parameter,) = self.among
        result, present = parameter.resolve(self.parameters.get(parameter.name, parameter.default))
        if not np.all(present):
            result = np.where(present, result, np.nan)
        if self.where:
            _, batch = self.inputs.resolve(self.parameters)
            result = sliced(result, batch, self.where)
        return result if is_traced(result) else locked(np.array(result, np.float64))
