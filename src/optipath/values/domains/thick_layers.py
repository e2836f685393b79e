"""Domains of what a stack is given whose layers absorb: indices, and lengths."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from optipath.errors import ValueFault, shown
from optipath.values.arrays.array_likes import entries_of
from optipath.values.arrays.read_only import read_only
from optipath.values.domains.domain import Domain, in_unit_of
from optipath.values.domains.indices import IndexDomain
from optipath.values.domains.stack_indices import INNER
from optipath.values.materials import Material
from optipath.values.roundings import held

# Light-years are shorter; beyond, what is absorbed overflows before it is too much.
LENGTH_OF_LAYER = Domain("length", "length", minimum=0.0, maximum=1e100, own_unit="mm")


@dataclass(frozen=True)
class LengthsDomain(Domain):
    """Lengths of the layers of a stack, one for each, or none at all."""

    layers: int | None = None

    def quickly_allows(self, value: Any) -> bool:
        del value
        return False

    def read(self, owner: str, value: Any) -> Any:
        if not isinstance(value, (list, tuple)):
            return value
        try:
            entries = [*enumerate(entries_of(owner, "lengths", value))]
        except ValueFault:
            return value  # For validation to name.
        return [LENGTH_OF_LAYER.read(f"{owner}[{place}]", length) for place, length in entries]

    def kept(self, value: Any) -> Any:
        """Return the lengths one by one, since each may be an array of its own."""
        if not isinstance(value, (list, tuple, np.ndarray)):
            return value
        try:
            entries = entries_of("", "lengths", value)
        except ValueFault:
            return value  # For validation to name.
        return tuple(in_unit_of(read_only(length), LENGTH_OF_LAYER) for length in entries)

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        if value is None:
            return []
        if not isinstance(value, tuple) or self.layers not in (None, len(value)):
            return [(name, value, self)]
        return [(f"{name}[{place}]", one, LENGTH_OF_LAYER) for place, one in enumerate(value)]

    def described(self) -> str:
        return "a list of lengths, one for each layer between the first medium and the last"

    def check(self, owner: str, value: Any) -> Any:
        if isinstance(value, tuple):
            raise ValueFault(
                f"{owner} has {len(value)} entries, where the stack has {self.layers} between its "
                f"first medium and its last; give {self.described()}"
            )
        if value is not None and not isinstance(value, (float, int, complex)):
            # Good lists are checked by their parts.
            entries_of(owner, "lengths", value)
        raise ValueFault(f"{owner} is {shown(value)}; give {self.described()}")

    def check_parameter(self, owner: str, parameter: Any) -> None:
        raise ValueFault(
            f"{owner} cannot be the parameter '{parameter.name}'; give a list, of parameters too"
        )


class LossyDomain(IndexDomain):
    """Indices n + ik of the layers of a stack whose lengths are known."""

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        if not isinstance(value, Material):
            return [(name, value, self)]
        return [(f"{name}.n", value.n, _N), (f"{name}.k", value.k, _K)]

    def quickly_allows(self, value: Any) -> bool:
        return type(value) is float and INNER.minimum <= value <= INNER.maximum

    def described(self) -> str:
        return (
            f"an index of refraction n + ik with n within {INNER.minimum:g} .. {INNER.maximum:g} "
            f"and k within 0 .. {INNER.maximum:g}"
        )

    def allows(self, numbers: Any) -> Any:
        least, most = held(numbers, (INNER.minimum, INNER.maximum))
        inside = (numbers.real >= least) & (numbers.real <= most)
        return super().allows(numbers) & inside & (numbers.imag <= most)


_N = Domain("index of refraction", minimum=INNER.minimum, maximum=INNER.maximum)
_K = Domain("extinction coefficient", minimum=0.0, maximum=INNER.maximum)
LOSSY = LossyDomain("index of refraction")
LENGTHS = LengthsDomain("lengths of layers", "length", own_unit="mm")
