"""What is known of values before a path runs: whether they are 0, and how large they may be."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from optipath.values.operands import Operand
from optipath.values.parameters import Parameter


def bound_value(parameter: Parameter) -> Any:
    """Return the value of a parameter that is bound; a multiple with its factor and offset.

    >>> float(bound_value(Parameter("a", 2.0, bound=True)))
    2.0
    """
    return parameter.placed(parameter.resolve(parameter.default).value)


def vanishes(value: Any) -> bool:
    """Tell whether a value is known to be 0.

    >>> vanishes(0.0), vanishes([0.0, 0.1]), vanishes(Parameter("a"))
    (True, False, False)
    """
    if type(value) is float:
        return value == 0.0
    operand = Operand(value) if isinstance(value, Parameter) else value
    if isinstance(operand, Operand):
        return operand.known and not operand.traced and not np.any(operand.numbers())
    return isinstance(value, (int, float, np.ndarray)) and not np.any(value)


def largest(value: Any) -> float:
    """Return the size of a known value, or the most of an open one; infinite without a range.

    >>> largest(-2.0), largest(Parameter("a", maximum=3.0, minimum=0.0)), largest(Parameter("a"))
    (2.0, 3.0, inf)
    """
    if isinstance(value, Parameter):
        if not value.bound:
            return value.span_of((value.minimum, value.maximum))[1]
        value = bound_value(value)
    if type(value) is float:
        return abs(value)
    known = np.asarray(value) if isinstance(value, (int, float, np.ndarray)) else np.array(None)
    return float(np.max(np.abs(known), initial=0.0)) if known.dtype.kind in "iuf" else math.inf
