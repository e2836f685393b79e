"""Kernels that are given what some arguments come to, and not the arguments themselves."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from optipath.kernels.carriers.kernel import Kernel, KernelFamily

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.carriers.kernel import Factory
    from optipath.kernels.numbers.primitives import Primitives


@dataclass(frozen=True)
class Composed:
    """A factory whose last arguments are made by another; a class, so that plans can be pickled.

    Attributes
    ----------
    outer, inner : callable
        The factories.
    takes : int
        How many of the last arguments are given to `inner`.

    Examples
    --------
    >>> from optipath.kernels import FLOAT
    >>> outer, inner = lambda xp: lambda a, b: (a - b,), lambda xp: lambda x, y: (x * y,)
    >>> Composed(outer, inner, 2)(FLOAT)(10.0, 2.0, 3.0)
    (4.0,)
    """

    outer: Factory
    inner: Factory
    takes: int

    def __call__(self, xp: Primitives) -> Callable[..., tuple[Any, ...]]:
        """Return the function of all arguments."""
        outer, inner, takes = self.outer(xp), self.inner(xp), self.takes

        def both(*values: Any) -> tuple[Any, ...]:
            before = len(values) - takes
            return outer(*values[:before], *inner(*values[before:]))

        return both


def composed(family: KernelFamily, inner: Factory, takes: int) -> KernelFamily:
    """Return a family whose last arguments are made by a factory out of several others.

    The cheaper kernels of each come along; the arguments that they are about keep their
    places, since they stand before those.

    Parameters
    ----------
    family : KernelFamily
        The kernels.
    inner : callable
        The factory that makes their last arguments.
    takes : int
        How many arguments `inner` takes, which come last.

    Returns
    -------
    KernelFamily
        The same methods.
    """
    methods = {name: _composed(kernel, inner, takes) for name, kernel in family.methods.items()}
    return KernelFamily(family.name, methods)


def _composed(kernel: Kernel, inner: Factory, takes: int) -> Kernel:
    without, denser, powers = kernel.without, kernel.denser, kernel.powers
    return replace(
        kernel,
        factory=Composed(kernel.factory, inner, takes),
        without=without and (without[0], _composed(without[1], inner, takes)),
        denser=denser and (denser[0], denser[1], _composed(denser[2], inner, takes)),
        powers=powers and _composed(powers, inner, takes),
    )
