"""A kernel: one piece of the physics, its structure, and its methods."""

from __future__ import annotations

from collections.abc import Callable, Mapping
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
    """

    name: str
    structure: Structure | None
    factory: Factory

    def made_for(self, primitives: Primitives) -> Callable[..., tuple[Any, ...]]:
        """Return the function in terms of these primitives, made once and kept."""
        function: Callable[..., tuple[Any, ...]] = made(self.factory, primitives)
        return function

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
