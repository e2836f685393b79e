"""A kernel: one piece of the physics, its structure, and its methods."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.errors import ComposerError, did_you_mean
from optipath.kernels.primitives import Primitives, made

if TYPE_CHECKING:
    from optipath.kernels.structures import Structure

Factory: TypeAlias = Callable[[Primitives], Callable[..., tuple[Any, ...]]]


@dataclass(frozen=True)
class Kernel:
    """A pure elementwise function, made for any set of primitives.

    Attributes
    ----------
    name : str
        What explanations call it.
    structure : Structure or None
        The shape of Mueller matrix that its numbers describe; None for the four
        Stokes components that a source emits.
    factory : callable
        ``factory(primitives)`` gives the function; its result has as many
        numbers as the structure asks for.
    without : tuple of int and Kernel, optional
        A cheaper kernel for where one argument is 0: the position of that argument, and
        the kernel that takes the others.
    """

    name: str
    structure: Structure | None
    factory: Factory
    without: tuple[int, Kernel] | None = None

    def made_for(self, primitives: Primitives) -> Callable[..., tuple[Any, ...]]:
        """Return the function in terms of these primitives, made once and kept."""
        function: Callable[..., tuple[Any, ...]] = made(self.factory, primitives)
        return function

    def leaving_out(
        self, arguments: Sequence[Any], vanishes: Callable[[Any], bool]
    ) -> tuple[Kernel, tuple[Any, ...]]:
        """Return the cheapest kernel for these arguments, and those that it takes."""
        if self.without is None or not vanishes(arguments[self.without[0]]):
            return self, tuple(arguments)
        position, cheaper = self.without
        return cheaper, (*arguments[:position], *arguments[position + 1 :])

    def by_method(self, method: str) -> Kernel:
        """Return the kernel itself: it has one method only."""
        del method
        return self


@dataclass(frozen=True)
class KernelFamily:
    """One piece of the physics that several methods compute.

    Attributes
    ----------
    name : str
        What the methods compute.
    methods : mapping of str to Kernel
        The kernel of each method.
    """

    name: str
    methods: Mapping[str, Kernel]

    def by_method(self, method: str) -> Kernel:
        """Return the kernel of a method.

        Raises
        ------
        ComposerError
            If there is no such method.
        """
        if method not in self.methods:
            raise ComposerError(f"method '{method}' is unknown{did_you_mean(method, self.methods)}")
        return self.methods[method]
