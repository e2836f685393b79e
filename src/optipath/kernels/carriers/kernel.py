"""A kernel: one piece of the physics, its structure, and its methods."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from optipath.errors import ComposerError, unknown
from optipath.kernels.carriers.own_code import GuardedFactory, is_defined_in
from optipath.kernels.numbers.primitives import Factory, KernelFunction, Primitives, made

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from optipath.kernels.carriers.structures import Structure


@dataclass(frozen=True)
class Kernel:
    """A pure elementwise function, made for any set of primitives."""

    name: str
    structure: Structure | None
    factory: Factory
    without: tuple[int, Kernel] | None = None
    denser: tuple[int, int, Kernel] | None = None
    powers: Kernel | None = None
    unpolarising: Kernel | None = None

    def __hash__(self) -> int:
        # Asked for once a step; what else belongs to a name is compared where names are equal.
        return hash(self.name)

    def made_for(self, primitives: Primitives) -> KernelFunction:
        """Return the function in terms of these primitives, made once and kept."""
        factory = self.factory if self.of_library else GuardedFactory(self.name, self.factory)
        function: KernelFunction = made(factory, primitives)
        return function

    @cached_property
    def of_library(self) -> bool:
        """Whether it comes with the library, so that nothing it raises is a user's doing."""
        return is_defined_in("optipath.", self.factory)

    def specialised(
        self, arguments: Sequence[Any], vanishes: Callable[[Any], bool]
    ) -> tuple[Kernel, tuple[Any, ...]]:
        """Return the cheapest kernel for these arguments, and those that it takes."""
        if self.without is None or not vanishes(arguments[self.without[0]]):
            return self, tuple(arguments)
        position, cheaper = self.without
        left = (*arguments[:position], *arguments[position + 1 :])
        return cheaper.specialised(left, vanishes)

    def never_less(
        self, arguments: Sequence[Any], ranges: Callable[[Any], tuple[float, float]]
    ) -> Kernel:
        """Return the cheapest kernel for the ranges that the arguments are known to be in."""
        if self.denser is None:
            return self
        larger, smaller, cheaper = self.denser
        known = ranges(arguments[larger])[0] >= ranges(arguments[smaller])[1]
        return cheaper if known else self

    def by_method(self, method: str) -> Kernel:
        """Return the kernel itself: it has one method only."""
        del method
        return self


@dataclass(frozen=True)
class KernelFamily:
    """One piece of the physics that several methods compute."""

    name: str
    methods: Mapping[str, Kernel]

    def by_method(self, method: str) -> Kernel:
        """Return the kernel of a method."""
        if faults := unknown("method", method, self.methods):
            raise ComposerError(*faults)
        return self.methods[method]
