"""Case: a named set of parameter values, with the result that was published for it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from optipath.frozen import frozen, same

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True, eq=False)
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

    def __post_init__(self) -> None:
        values = {str(name): frozen(value) for name, value in self.values.items()}
        published = {
            str(name): tuple(map(float, stokes)) for name, stokes in self.published.items()
        }
        object.__setattr__(self, "values", values)
        object.__setattr__(self, "published", published)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Case):
            return NotImplemented
        return (
            self.values.keys() == other.values.keys()
            and all(same(value, other.values[name]) for name, value in self.values.items())
            and (self.published, self.note) == (other.published, other.note)
        )

    __hash__ = None  # type: ignore[assignment]
