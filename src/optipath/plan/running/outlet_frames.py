"""The frame of light by the values of a run, made when somebody looks at it."""

from __future__ import annotations

from contextlib import suppress
from copy import deepcopy
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.plan.running.batch import sliced

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.elements.vertices.frame import VertexFrame
    from optipath.light.frames import Frame
    from optipath.values.inputs import Inputs


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
        given = {
            name: self.inputs.numbers_for(name, self.parameters.get(name, opened[name].default))
            for name in self.frame.names
        }
        if not self.where:
            return self.frame.frame(given)
        _, batch = self.inputs.resolve(self.parameters)
        return self.frame.frame(given, lambda numbers: sliced(numbers, batch, self.where))


def kept(value: Any) -> Any:
    """Return a value that was given, or a copy of what somebody may change.

    Examples
    --------
    >>> given = np.ones(2)
    >>> kept(given) is given, kept(0.5)
    (False, 0.5)
    """
    if isinstance(value, np.ndarray):
        return value.copy() if value.flags.writeable else value
    with suppress(RecursionError, MemoryError):  # What is too much is refused by the run.
        return deepcopy(value) if isinstance(value, list) else value
    return value
