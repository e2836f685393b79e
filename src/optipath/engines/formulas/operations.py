"""The operations that formulas are made of, each with the ufunc that says what it means."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.kernels.numbers.primitives import NUMPY, product_rest

if TYPE_CHECKING:
    from collections.abc import Callable


class About(NamedTuple):
    """What is known of an operation."""

    ufunc: Callable[..., Any]
    kind: str
    text: str
    commutes: bool = False


OPERATIONS = {
    "absolute": About(np.absolute, "same", "abs({0})"),
    "add": About(np.add, "same", "{0} + {1}", commutes=True),
    "arctan2": About(np.arctan2, "float", "atan2({0}, {1})"),
    "cos": About(np.cos, "float", "cos({0})"),
    "divide": About(np.divide, "float", "{0} / {1}"),
    "equal": About(np.equal, "bool", "{0} == {1}", commutes=True),
    "exp": About(np.exp, "float", "exp({0})"),
    "exponent": About(NUMPY.scaling, "int", "exponent({0})"),
    "fixed": About(lambda number: number, "same", "{0}"),
    "floor_divide": About(np.floor_divide, "same", "{0} // {1}"),
    "greater": About(np.greater, "bool", "{0} > {1}"),
    "greater_equal": About(np.greater_equal, "bool", "{0} >= {1}"),
    "integer": About(NUMPY.integer, "int", "int({0})"),
    "ldexp": About(np.ldexp, "float", "ldexp({0}, {1})"),
    "less": About(np.less, "bool", "{0} < {1}"),
    "less_equal": About(np.less_equal, "bool", "{0} <= {1}"),
    "logical_and": About(np.logical_and, "bool", "{0} & {1}", commutes=True),
    "logical_not": About(np.logical_not, "bool", "not {0}"),
    "logical_or": About(np.logical_or, "bool", "{0} | {1}", commutes=True),
    "maximum": About(np.maximum, "same", "{0} if {0} >= {1} else {1}", commutes=True),
    "minimum": About(np.minimum, "same", "{0} if {0} <= {1} else {1}", commutes=True),
    "multiply": About(np.multiply, "same", "{0} * {1}", commutes=True),
    "negative": About(np.negative, "same", "-{0}"),
    "not_equal": About(np.not_equal, "bool", "{0} != {1}", commutes=True),
    "power": About(np.power, "float", "{0} ** {1}"),
    "product_rest": About(product_rest, "float", "product_rest({0}, {1})", commutes=True),
    "remainder": About(np.remainder, "same", "{0} % {1}"),
    "sin": About(np.sin, "float", "sin({0})"),
    "sqrt": About(np.sqrt, "float", "sqrt({0})"),
    "subtract": About(np.subtract, "same", "{0} - {1}"),
    "where": About(np.where, "same", "{1} if {0} else {2}"),
}
