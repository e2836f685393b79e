"""Case: a named set of parameter values, with the result that was published for it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True)
class Case:
    """A named set of values for the parameters of a path.

    Attributes
    ----------
    values : mapping of str to Any
        What is given for each parameter, in radians and metres, or a word.
    published : mapping of str to tuple of float
        The published Stokes vector for each detector, as printed.
    note : str
        What a reader should know about it.
    """

    values: Mapping[str, Any]
    published: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    note: str = ""
