"""The handful of elementwise functions that every kernel is written in.

A kernel is made by a factory that takes one of these records, so that one text
of the physics serves plain floats, NumPy blocks, and engines to come.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

T = TypeVar("T")


@dataclass(frozen=True)
class Primitives:
    """The functions a kernel may call; all are elementwise and none raises.

    ``where`` may evaluate both of its branches, so kernels keep both free of
    division by zero and of roots of negative numbers. ``fixed`` is a value without its
    slope, where an engine takes gradients, and the value itself elsewhere.
    """

    where: Callable[[Any, Any, Any], Any]
    sqrt: Callable[[Any], Any]
    absolute: Callable[[Any], Any]
    maximum: Callable[[Any, Any], Any]
    minimum: Callable[[Any, Any], Any]
    sin: Callable[[Any], Any]
    cos: Callable[[Any], Any]
    exp: Callable[[Any], Any]
    atan2: Callable[[Any, Any], Any]
    fixed: Callable[[Any], Any]


@cache
def made(factory: Callable[[Primitives], T], primitives: Primitives) -> T:
    """Return what a factory makes of primitives, made once and kept."""
    return factory(primitives)


def _itself(value: Any) -> Any:
    return value


NUMPY = Primitives(
    where=np.where,
    sqrt=np.sqrt,
    absolute=np.absolute,
    maximum=np.maximum,
    minimum=np.minimum,
    sin=np.sin,
    cos=np.cos,
    exp=np.exp,
    atan2=np.arctan2,
    fixed=_itself,
)

FLOAT = Primitives(
    where=lambda condition, yes, no: yes if condition else no,
    sqrt=math.sqrt,
    absolute=abs,
    maximum=max,
    minimum=min,
    sin=math.sin,
    cos=math.cos,
    exp=math.exp,
    atan2=math.atan2,
    fixed=_itself,
)
