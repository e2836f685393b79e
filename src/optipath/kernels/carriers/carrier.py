"""The contract of a carrier: how light is carried from element to element along a path."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.kernels.carriers.carried import Components
    from optipath.kernels.carriers.parted import SolvedLoop
    from optipath.kernels.carriers.structures import Numbers, Structure
    from optipath.kernels.numbers.primitives import Primitives


class Carrier(ABC):
    """How light is carried: as a state, which nobody but the carrier looks into.

    Parameters
    ----------
    xp : Primitives
        What it is computed with.
    """

    def __init__(self, xp: Primitives) -> None:
        self.xp = xp

    @abstractmethod
    def emit(self, stokes: Components, count: int = 4) -> Any:
        """Return the state of emitted light.

        Parameters
        ----------
        stokes : tuple
            S0, S1, S2 and S3, each a number or an array of the batch.
        count : int
            How many components are asked for, the first ones; a carrier may carry all.

        Returns
        -------
        Any
            The state.
        """

    @abstractmethod
    def act(self, structure: Structure, numbers: Numbers, state: Any, count: int = 4) -> Any:
        """Return the state behind an element.

        Parameters
        ----------
        structure : Structure
            The shape of the element's Mueller matrix.
        numbers : sequence
            The numbers that describe it, as many as the structure has.
        state : Any
            The state in front.
        count : int
            How many components are asked for behind.

        Returns
        -------
        Any
            The state behind.
        """

    @abstractmethod
    def add(self, first: Any, second: Any) -> Any:
        """Return the state of two lights together, incoherently.

        Parameters
        ----------
        first, second : Any
            Their states.

        Returns
        -------
        Any
            The state of both.
        """

    def meet(self, solver: SolvedLoop, arriving: Mapping[int, Any]) -> dict[int, Any]:
        """Return the states at the junctions of a loop; not every carrier goes through loops.

        Parameters
        ----------
        solver : SolvedLoop
            The loop.
        arriving : mapping of int to Any
            The state of what arrives from outside, at some junctions.

        Returns
        -------
        dict of int to Any
            The state at each junction.
        """
        raise NotImplementedError(f"{type(self).__name__} carries no light through loops")

    @abstractmethod
    def read(self, state: Any, count: int = 4) -> tuple[Components, Any]:
        """Return the Stokes components, and the exponent of the power of two times them.

        Parameters
        ----------
        state : Any
            The state of the light that is read.
        count : int
            How many components are asked for; a carrier may give more.

        Returns
        -------
        components : tuple
            S0, S1, S2 and S3; what is left out is 0.
        exponent : int or array_like
            0 but for carriers of faint light.
        """
