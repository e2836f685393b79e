"""The operations that formulas are made of, each with the ufunc that says what it means."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.kernels.numbers.primitives import product_rest

if TYPE_CHECKING:
    from collections.abc import Callable


class About(NamedTuple):
    """What is known of an operation.

    Attributes
    ----------
    ufunc : callable
        Does it to NumPy's arrays and scalars.
    kind : str
        ``"float"``, ``"bool"`` or ``"int"``; ``"same"`` as its operands.
    commutes : bool
        Whether its two operands may change places.
    """

    ufunc: Callable[..., Any]
    kind: str
    commutes: bool = False


OPERATIONS = {
    "absolute": About(np.absolute, "same"),
    "add": About(np.add, "same", commutes=True),
    "arctan2": About(np.arctan2, "float"),
    "cos": About(np.cos, "float"),
    "divide": About(np.divide, "float"),
    "equal": About(np.equal, "bool", commutes=True),
    "exp": About(np.exp, "float"),
    "exponent": About(lambda number: np.frexp(number)[1], "int"),
    "fixed": About(lambda number: number, "same"),
    "floor_divide": About(np.floor_divide, "same"),
    "greater": About(np.greater, "bool"),
    "greater_equal": About(np.greater_equal, "bool"),
    "ldexp": About(np.ldexp, "float"),
    "less": About(np.less, "bool"),
    "less_equal": About(np.less_equal, "bool"),
    "logical_and": About(np.logical_and, "bool", commutes=True),
    "logical_not": About(np.logical_not, "bool"),
    "logical_or": About(np.logical_or, "bool", commutes=True),
    "maximum": About(np.maximum, "same", commutes=True),
    "minimum": About(np.minimum, "same", commutes=True),
    "multiply": About(np.multiply, "same", commutes=True),
    "multiply_add": About(lambda a, b, c: a * b + c, "float"),
    "negative": About(np.negative, "same"),
    "not_equal": About(np.not_equal, "bool", commutes=True),
    "power": About(np.power, "float"),
    "product_rest": About(product_rest, "float", commutes=True),
    "remainder": About(np.remainder, "same"),
    "sin": About(np.sin, "float"),
    "sqrt": About(np.sqrt, "float"),
    "subtract": About(np.subtract, "same"),
    "where": About(np.where, "same"),
}
