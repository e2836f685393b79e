"""First values: ways through elements of a user's own, looked at with some numbers of a run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ParameterError
from optipath.faults import listed
from optipath.kernels.primitives import NUMPY
from optipath.values.units import in_unit

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Mapping

    from optipath.elements.own_element import OwnWays
    from optipath.plan.reading import Batch
    from optipath.values.operands import InputKey, Operand


_LOOKED_AT = 16
"""How many paths of a batch."""

_MOST_VALUES = 64
"""How many kinds are remembered."""


class FirstValues:
    """Looks at ways through elements of a user's own, once for each kind of values."""

    def __init__(self, ways: tuple[OwnWays, ...]) -> None:
        self.ways = ways
        self._seen: set[Hashable] = set()

    @property
    def doubt(self) -> str:
        """What else may be wrong with light that is not finite, as a sentence goes on with it."""
        owners = dict.fromkeys(f"'{way.owner}'" for way in self.ways)
        return f", or the rows of {listed([*owners])} are not finite there" if owners else ""

    def check(self, kind: Hashable, read: Callable[[], Batch]) -> None:
        """Refuse what no light can do, found with some of the values that are given."""
        if not self.ways or kind in self._seen:
            return
        argument = read()
        faults = [fault for way in self.ways for fault in _faults(way, argument)]
        ParameterError.raise_for(faults)
        if len(self._seen) >= _MOST_VALUES:
            self._seen.clear()
        self._seen.add(kind)


def _faults(way: OwnWays, arguments: Batch) -> list[str]:
    """Return what is wrong with a way for a few of the paths, the first and the last among them."""
    units = way.units
    some = np.unique(
        np.linspace(0.0, arguments.paths - 1.0, min(_LOOKED_AT, arguments.paths)).astype(int)
    )
    where = np.unravel_index(some, arguments.shape) if arguments.shape else ()

    def few(number: Any) -> Any:
        several = np.asarray(number)
        if several.ndim:  # One number for all stays one, as elements are given it.
            several = np.broadcast_to(several, arguments.shape)[where]
        return several if several.dtype == bool else several.astype(np.float64)

    mine = {key: few(n) for key, n in arguments.numbers.items() if key.name in units}
    if any(key.part == "present" and not np.all(number) for key, number in mine.items()):
        return []  # The element is not everywhere there.

    def read(operand: Operand) -> Any:
        if operand.known:
            return few(arguments.cut(operand.numbers()))
        return operand.evaluated(NUMPY, operand.number_in(mine, np.asarray))

    try:
        result = way.faults(read)
    except KeyError:
        return []  # Not all of its values are of use to what is read.
    return [f"at {_values(mine, place, units)}: {fault}" for place, fault in result]


def _values(numbers: dict[InputKey, Any], place: int, units: Mapping[str, str]) -> str:
    """Write the numbers of one path."""
    written = []
    for key, several in numbers.items():
        number, (name, unit) = np.ravel(several)[place if np.ndim(several) else 0], (str(key), "")
        if key.part == "value":
            name, unit = key.name, units[key.name]
        written.append(f"{name} = {in_unit(number, unit):.6g} {unit}".strip())
    return ", ".join(written)
