"""Names of values of curves, by which equal ones are known."""

from __future__ import annotations

from hashlib import blake2b
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.values.arrays.jax_values import is_traced
from optipath.values.operands import Operand
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Hashable

    from optipath.values.curves.curve import Curve


def marked_name(curve: Curve, place: int, given_by: tuple[Any, ...]) -> str:
    """Return a name that nobody can give, and that equal values alone share."""
    keys = [Operand(one).key() for one in given_by]
    bound = [_content(p.default) for p in given_by if isinstance(p, Parameter) and p.bound]
    mark = blake2b(repr((curve.digest, keys, bound)).encode(), digest_size=8).hexdigest()
    return f"{curve.parts[place]} of {curve.label} [{mark}]"


def _content(number: Any) -> Hashable:
    """Return what equal numbers share; what JAX traces is equal to itself alone."""
    return id(number) if is_traced(number) else np.asarray(number).tobytes()
