"""Domains of Stokes vectors, and of the amplitudes of reflection."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from optipath.errors import ValueFault
from optipath.values.arrays.jax_values import namespace
from optipath.values.arrays.read_only import read_only
from optipath.values.cures import cure
from optipath.values.domains.domain import Domain
from optipath.values.domains.pair import is_real, pair_in
from optipath.values.roundings import rounding_of

_ROUNDING = 1e-12
_GATHERED = 16.0
"""How many roundings light of less than double precision may have gathered."""
_LEAST, _MOST = 1e-280, 1e300
_SINGLE_ROUNDING = 1e-6
"""How far the size of an amplitude may be above 1: numbers of single precision are rounded so."""


class AmplitudeDomain(Domain):
    """Complex numbers of a size of 1 or less, but for the rounding of single precision."""

    complex_parts = ("re", "im")

    def doubt(self, owner: str, value: Any) -> str:
        if (pair := pair_in(value, self)) is None:
            return ""
        return (
            f"{owner} is {value}, which may be one complex number, or the amplitudes of two "
            f"paths; write complex{pair} for the one, np.array({[*pair]}) for the other"
        )

    def read(self, owner: str, value: Any) -> Any:
        if doubt := self.doubt(owner, value):
            raise ValueFault(doubt)
        return super().read(owner, value)

    @property
    def interval(self) -> tuple[float, float]:
        """The limits of both parts."""
        return -1.0 - _SINGLE_ROUNDING, 1.0 + _SINGLE_ROUNDING

    def quickly_allows(self, value: Any) -> bool:
        return type(value) is float and -1.0 <= value <= 1.0

    def described(self) -> str:
        return f"a real or complex {self.name} of a size of 1 or less"

    def allows(self, numbers: Any) -> Any:
        xp = namespace(numbers)
        # Cut off, so that squares of what is far too much do not overflow.
        parts = (xp.minimum(abs(part), 2.0) for part in (numbers.real, numbers.imag))
        return xp.hypot(*parts) <= 1.0 + _SINGLE_ROUNDING

    def _check_numbers(self, owner: str, array: npt.NDArray[Any], rounding: float) -> None:
        del rounding
        bad = ~self.allows(array)
        if np.any(bad):
            raise ValueFault(f"{owner} is {array[bad].ravel()[0]}; give {self.described()}")


class IntensityDomain(Domain):
    """Numbers that are not negative, of which four may be a state of polarisation."""

    def doubt(self, owner: str, value: Any) -> str:
        if not _may_be_a_state(value):
            return ""
        return (
            f"{owner} is {value}, which may be a state, or the intensities of four paths; give "
            f"stokes={value} to the Source for the one, np.array({[*value]}) for the other"
        )


def _may_be_a_state(value: Any) -> bool:
    """Tell whether four numbers written by hand are light that is polarised by 100 % at most."""
    if not isinstance(value, (list, tuple)) or len(value) != 4 or not all(map(is_real, value)):
        return False
    return math.hypot(*map(float, value[1:])) <= float(value[0])


@dataclass(frozen=True)
class StokesDomain(Domain):
    """Stokes vectors that light can have; none at all is unpolarised light."""

    physical: bool = True

    @property
    def unphysical(self) -> Domain:
        """The domain of Stokes vectors as they are measured."""
        return replace(self, physical=False)

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        return [] if value is None else super().parts(name, value)

    def kept(self, value: Any) -> Any:
        """Return a value that nobody can change, in the precision by which it is judged."""
        return read_only(value, widened=False)

    def allows(self, numbers: Any) -> Any:
        finite = super().allows(numbers).all(axis=-1)
        lit = finite & (numbers[..., 0] >= 0.0)
        return lit & can_be_light(numbers, rounding_of(numbers)) if self.physical else lit

    def _check_numbers(self, owner: str, array: npt.NDArray[Any], rounding: float) -> None:
        super()._check_numbers(owner, array, rounding)
        negative = array[..., 0] < 0.0
        if np.any(negative):
            value = array[..., 0][negative].ravel()[0]
            raise ValueFault(f"{owner} has the negative intensity {value}; give S0 >= 0")
        if not self.physical or surely_light(array):
            return
        bad = ~can_be_light(array, rounding)
        if np.any(bad):
            state = array[bad].reshape(-1, 4)[0].tolist()
            raise ValueFault(
                f"{owner} is {state}, polarised by more than 100 %; give S1^2 + S2^2 + S3^2 <= "
                f"S0^2, or {cure('physical=False', 'physical = false')} for what is measured as it "
                f"is"
            )


def surely_light(stokes: npt.NDArray[Any]) -> bool:
    """Tell quickly, and never wrongly, whether all are light, polarised by 100 % at most.

    Examples
    --------
    >>> surely_light(np.array([[1.0, 0.6, 0.0, 0.8], [2.0, 0.0, 0.0, 0.0]]))
    True
    """
    with np.errstate(all="ignore"):
        squares = np.einsum("...i,...i->...", stokes, stokes)
        most = (2.0 + _ROUNDING) * stokes[..., 0] ** 2
        # Beyond, squares have lost digits.
        sure = (squares <= most) & (most < _MOST) & (most > _LEAST)
        return bool(np.all(sure & (stokes[..., 0] > 0.0)))


def can_be_light(stokes: Any, rounding: float) -> Any:
    """Return which Stokes vectors are polarised by 100 % at most.

    Shapes: stokes (..., 4); returns (...).

    Examples
    --------
    >>> can_be_light(np.array([[1.0, 0.6, 0.0, 0.8], [1.0, 1.0, 1.0, 1.0]]), 0.0)
    array([ True, False])
    """
    xp = namespace(stokes)
    dark = stokes[..., :1] == 0.0
    shares = abs(stokes[..., 1:]) / xp.where(dark, 1.0, stokes[..., :1])
    # Cut off, so that squares of what is far too much do not overflow.
    polarised = xp.linalg.norm(xp.minimum(shares, 2.0), axis=-1)
    most = 1.0 + max(_ROUNDING, _GATHERED * rounding)
    return xp.where(dark[..., 0], xp.max(shares, axis=-1) == 0.0, polarised <= most)
