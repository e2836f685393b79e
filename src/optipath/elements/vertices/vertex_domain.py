"""The domain of vertices: finite points, each apart from the next, and not too far."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import numpy as np

from optipath.elements.vertices.by_angles import VerticesByAngles
from optipath.elements.vertices.naming import of_chain, pieces_of
from optipath.errors import ValueFault
from optipath.kernels.geometry.vertex_chain import LONGEST, SHORTEST
from optipath.values.arrays.array_likes import array_of
from optipath.values.arrays.jax_values import is_traced, namespace
from optipath.values.arrays.read_only import read_only
from optipath.values.domains.choice import Choice
from optipath.values.domains.domain import Domain
from optipath.values.domains.quantities import Quantity
from optipath.values.roundings import held

if TYPE_CHECKING:
    import numpy.typing as npt

_LEAST, _MOST = SHORTEST**2, LONGEST**2


@dataclass(frozen=True)
class VerticesDomain(Domain):
    """Points from the light to the eye, in the unit of any length."""

    masks: bool = False
    ends: bool = False

    @property
    def takes_any(self) -> bool:
        """Whether any numbers are let in, which others look at."""
        return self.masks or self.ends

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        if isinstance(value, VerticesByAngles):
            return list(value.parts(name))
        return super().parts(name, value)

    def described(self) -> str:
        """Say in words which values are allowed."""
        return "the points of a chain, without a unit"

    @property
    def shows_in_light(self) -> bool:
        """Two vertices in one point have no direction, and light along none is not finite."""
        return True

    def kept(self, value: Any) -> Any:
        """Return a value that nobody can change; whole numbers, whose differences wrap, as floats.

        Examples
        --------
        >>> VERTICES.kept(np.eye(3, dtype=np.uint8)).dtype
        dtype('float64')
        """
        kept = read_only(value)
        whole = isinstance(kept, np.ndarray) and kept.dtype.kind in "iu"
        return read_only(kept.astype(np.float64)) if whole else kept

    def check(self, owner: str, value: Any) -> npt.NDArray[Any]:
        if self.takes_any and not is_traced(value):
            points = array_of(owner, value)
            if points.dtype.kind in "iuf":
                self._check_shape(owner, points.shape)
                return points
        try:
            return super().check(owner, value)
        except ValueFault:
            # Where all is well, nobody needs to know where.
            if fault := self._not_finite(owner, value):
                raise ValueFault(fault) from None
            raise

    def _not_finite(self, owner: str, value: Any) -> str:
        try:
            array = array_of(owner, value)
        except ValueFault:
            return ""
        if array.dtype.kind not in "fc" or array.shape[-2:] != self.tail[-2:] or array.ndim < 2:
            return ""
        chains = array.reshape(-1, *array.shape[-2:])
        bad = np.argwhere(~np.isfinite(chains))
        if not len(bad):
            return ""
        chain, vertex = int(bad[0, 0]), int(bad[0, 1])
        where, given = of_chain(chain, array.shape[:-2]), chains[chain, vertex].tolist()
        return f"{owner}: vertex {vertex}{where}{_COUNTED}, is {given}; give finite coordinates"

    def allows(self, numbers: Any) -> Any:
        """Return which chains of an array are allowed."""
        if self.takes_any:
            return namespace(numbers).ones(numbers.shape[:-2], bool)
        return super().allows(numbers).all(axis=(-2, -1)) & legs_fit(numbers).all(axis=-1)

    def _check_numbers(self, owner: str, array: npt.NDArray[Any], rounding: float) -> None:
        super()._check_numbers(owner, array, rounding)
        chains = array.reshape(-1, *array.shape[-2:])
        for piece in pieces_of(len(chains)):
            some = chains[piece]
            if _are_surely_apart(some):
                continue
            with np.errstate(over="ignore"):
                bad = ~legs_fit(some)
            if bad.any():
                chain, place = (int(found[0]) for found in np.nonzero(bad))
                where = of_chain(piece.start + chain, array.shape[:-2])
                raise ValueFault(_leg_fault(owner, some[chain], place, where))


def legs_fit(chains: Any) -> Any:
    """Return which legs of chains are within the limits, shape (..., m + 1)."""
    legs = chains[..., 1:, :] - chains[..., :-1, :]
    squares = namespace(chains).einsum("...i,...i", legs, legs)
    least, most = held(squares, (_LEAST, _MOST))
    return (squares >= least) & (squares <= most)


def _are_surely_apart(chains: npt.NDArray[Any]) -> bool:
    """Tell, quickly, whether all legs are within the limits; those from chain to chain as well."""
    flat = chains.reshape(-1)
    with np.errstate(over="ignore"):
        squares = flat[3:] - flat[:-3]
        squares *= squares
        lengths = squares[:-2] + squares[1:-1]
        lengths += squares[2:]
    of_legs = lengths[::3]
    return bool(of_legs.min() >= _LEAST and of_legs.max() <= _MOST)


def _leg_fault(owner: str, chain: npt.NDArray[Any], place: int, where: str) -> str:
    both = f"{owner}: vertices {place} and {place + 1}{where}{_COUNTED},"
    start, end = chain[place], chain[place + 1]
    if np.array_equal(start, end):
        return f"{both} are one point, {start.tolist()}; move one, or leave it out"
    with np.errstate(over="ignore"):
        length = float(np.max(np.abs(end - start)))
    return (
        f"{both} are about {length:.2g} apart; legs are within {SHORTEST:g} .. {LONGEST:g}: give "
        f"the points in another unit"
    )


_COUNTED = ", counted from the light as 0"
VERTICES = VerticesDomain("coordinate")
BAD = ("refuse", "mask")
"""What becomes of chains that cannot be: an error, or light that is NaN."""
Vertices: TypeAlias = Annotated[Quantity | VerticesByAngles, VERTICES]
Bad: TypeAlias = Annotated[str, Choice("what becomes of chains that cannot be", words=BAD)]
