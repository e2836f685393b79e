"""Case: a named set of parameter values, with the result that was published for it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from optipath.errors import ParameterError
from optipath.faults import shown
from optipath.values.arrays import ComparedByFields, array_of, read_only
from optipath.values.precision import as_doubles

ALL = "all"
"""Stands for every case of a preset at the command line, so that files name none so."""


@dataclass(frozen=True, eq=False)
class Case(ComparedByFields):
    """A named set of values for the parameters of a path.

    Attributes
    ----------
    values : mapping of str to Any
        What is given for each parameter, in radians and metres, or a word.
    published : mapping of str to tuple of float
        The published Stokes vector for each detector, as printed.
    note : str
        What a reader should know about it.

    Raises
    ------
    ParameterError
        If they are no mappings, or what is published are no numbers.
    """

    values: Mapping[str, Any]
    published: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    note: str = ""

    def __post_init__(self) -> None:
        faults = [
            f"{name} of a case must be a mapping by names, not {shown(one)}"
            for name, one in (("values", self.values), ("published", self.published))
            if not isinstance(one, Mapping)
        ]
        if not isinstance(self.note, str):
            faults.append(f"the note of a case must be a text, not {shown(self.note)}")
        ParameterError.raise_for(faults)
        values = {
            str(name): value if type(value) is float else read_only(value)
            for name, value in self.values.items()
        }
        published = {str(name): _numbers(name, stokes) for name, stokes in self.published.items()}
        object.__setattr__(self, "values", values)
        object.__setattr__(self, "published", published)


def name_faults(name: str) -> list[str]:
    """Return what is wrong with the name of a case; nothing where it can be asked for."""
    if name == ALL:
        return [f"cases.{ALL}: '{ALL}' stands for every case; give this one another name"]
    return [] if name.strip() else ['cases."" has no name; give it one']


def _numbers(name: Any, stokes: Any) -> tuple[float, ...]:
    if type(stokes) is tuple and {*map(type, stokes)} == {float}:
        return stokes
    array = array_of(f"what is published at {name}", stokes, ParameterError)
    if array.ndim != 1 or array.dtype.kind not in "iuf":
        raise ParameterError(f"what is published at {name} must be numbers, not {shown(stokes)}")
    return tuple(as_doubles(array).tolist())
