"""Curve: numbers that depend on the wavelength, such as n and k of a metal."""

from __future__ import annotations

from abc import ABC, abstractmethod
from hashlib import blake2b
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.values.arrays.jax_values import is_traced, known, namespace
from optipath.values.arrays.read_only import Unchanging

if TYPE_CHECKING:
    from collections.abc import Hashable, Mapping, Sequence

    from optipath.values.domains.domain import Domain
    from optipath.values.resolved import Resolved


class Curve(Unchanging, ABC):
    """Numbers by wavelength, elementwise, in vacuum and in metres.

    A subclass says what its numbers are called, which wavelengths it knows and what it
    comes to there. Two curves of the same content are equal.

    Units: span in metres; unit in radians.
    """

    parts: tuple[str, ...] = ("value",)
    label: str
    span: tuple[float, float] = (0.0, np.inf)
    beyond: str = ""
    takes_grid: bool = False
    unit: str = ""
    unreal: str = ""

    @property
    @abstractmethod
    def content(self) -> tuple[Hashable, ...]:
        """All that its numbers are made of, the label included; texts, numbers and bytes."""

    def arguments(self) -> Sequence[tuple[str, Any, Domain]]:
        """Return what its numbers are made of besides the wavelength that may be a parameter.

        Returns
        -------
        sequence of tuple
            A name, a number or `Parameter`, and what it may be, in the order of `numbers`.
        """
        return ()

    def misfits(self, arguments: Sequence[Any], given: Mapping[str, Resolved]) -> list[str]:
        """Say which of its arguments do not fit to each other, whatever the wavelength.

        Parameters
        ----------
        arguments : sequence of float or Parameter
            As `arguments` lists them, some of them bound since.
        given : mapping of str to Resolved
            The parameters among them.

        Returns
        -------
        list of str
            A sentence for each.
        """
        del arguments, given
        return []

    @abstractmethod
    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        """Return its numbers, one for each part, elementwise and without checks.

        Parameters
        ----------
        xp : module
            ``numpy`` or ``jax.numpy``, by whose functions slopes are found.
        wavelength : array_like
            In metres.
        *arguments : array_like
            As `arguments` lists them; they broadcast with the wavelength.

        Returns
        -------
        tuple of array_like
        """

    def evaluated(self, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        """Return its numbers as arrays of the broadcast shape of what is given.

        A wavelength comes to the same numbers by itself and among others.

        Parameters
        ----------
        wavelength : array_like
            In metres.
        *arguments : array_like
            As `arguments` lists them.

        Returns
        -------
        tuple of ndarray
        """
        given = [known(number) for number in (wavelength, *arguments)]
        traced = [number for number in given if is_traced(number)]
        if traced:
            return self.numbers(namespace(traced[0]), *given)
        several = np.broadcast_arrays(*[np.asarray(number, np.float64) for number in given])
        shape = several[0].shape
        along_one_axis = max(shape, default=1) == several[0].size
        # Functions of NumPy may do other things to arrays that are no row of numbers. What asks
        # for a grid is shown the axes that are too many.
        row = -1 if along_one_axis or not self.takes_grid else shape
        rows = [np.ascontiguousarray(number).reshape(row) for number in several]
        with np.errstate(all="ignore"):
            found = self.numbers(np, *rows)
        return tuple([np.broadcast_to(part, rows[0].shape).reshape(shape) for part in found])

    def unreal_of(self, place: int) -> str:
        """Return why the numbers of one of its parts may be none; see `unreal`."""
        del place
        return self.unreal

    def samples(self, place: int) -> Any:
        """Return the numbers that somebody gave for one of its parts; None where it has none."""
        del place

    def is_nowhere_0(self, place: int) -> bool:
        """Tell whether it is known that the numbers of one of its parts are above 0 throughout."""
        del place
        return False

    @property
    def digest(self) -> str:
        """Some letters that equal curves share, and others do not."""
        return blake2b(
            repr((type(self).__name__, self.content)).encode(), digest_size=8
        ).hexdigest()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Curve):
            return NotImplemented
        return type(self) is type(other) and self.content == other.content

    def __hash__(self) -> int:
        return hash(self.content)
