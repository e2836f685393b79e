"""Domains of indices of refraction: of what light meets, comes from, or goes to and fro in."""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from optipath.errors import ValueFault
from optipath.values.arrays.jax_values import namespace
from optipath.values.arrays.shapes import first_place
from optipath.values.domains.domain import Domain
from optipath.values.domains.followed import Followed
from optipath.values.domains.no_absorption import NoAbsorption
from optipath.values.domains.pair import pair_in
from optipath.values.materials import LEAST, K, Material, index_of
from optipath.values.roundings import held

_NO_K = NoAbsorption("extinction coefficient", why=", since light comes from there")
_NO_K_BEHIND = NoAbsorption(
    "extinction coefficient", why=", since light comes from there too (by port 'back')"
)
_NO_K_BEYOND = NoAbsorption("extinction coefficient", why=", since light goes on in there")


class IndexDomain(Domain):
    """Complex numbers n + ik with n and k not negative."""

    complex_parts = ("n", "k")

    @property
    def interval(self) -> tuple[float, float]:
        """The limits of n and of k."""
        return 0.0, math.inf

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        if not isinstance(value, Material):
            return [(name, value, self)]
        return [(f"{name}.n", value.n, value.domain_of_n), (f"{name}.k", value.k, K)]

    def quickly_allows(self, value: Any) -> bool:
        if type(value) is complex:
            return value != 0.0 <= value.real < math.inf and 0.0 <= value.imag < math.inf
        return type(value) is float and 0.0 < value < math.inf

    def parse(self, text: str) -> Any:
        return index_of(text)

    def doubt(self, owner: str, value: Any) -> str:
        if (pair := pair_in(value, self)) is None:
            return ""
        n, k = pair
        return (
            f"{owner} is {value}, which may be n and k, or the indices of two paths; write "
            f"Material({n}, {k}) or {n}{k:+}j for the one, np.array([{n}, {k}]) for the other"
        )

    def read(self, owner: str, value: Any) -> Any:
        if doubt := self.doubt(owner, value):
            raise ValueFault(doubt)
        return super().read(owner, _as_numbers(value))

    def check(self, owner: str, value: Any) -> npt.NDArray[Any]:
        return super().check(owner, _as_number(value))

    def described(self) -> str:
        return "an index of refraction n + ik with n and k not negative"

    def allows(self, numbers: Any) -> Any:
        there = namespace(numbers).isfinite(numbers) & (numbers != 0.0)
        return there & (numbers.real >= 0.0) & (numbers.imag >= 0.0)

    def _check_numbers(self, owner: str, array: npt.NDArray[Any], rounding: float) -> None:
        del rounding
        bad = ~self.allows(array)
        if np.any(bad):
            value = array[bad].ravel()[0]
            cure = ", and not both 0" if value == 0.0 else ""
            cure = " (the field is exp(-iwt): k > 0 absorbs)" if value.imag < 0.0 else cure
            raise ValueFault(f"{owner} is {value}{first_place(bad)}; give {self.described()}{cure}")


class OutsideDomain(Domain):
    """Positive real numbers: the medium that light comes from does not absorb."""

    of_k: ClassVar[Domain] = _NO_K

    def read(self, owner: str, value: Any) -> Any:
        return super().read(owner, _as_numbers(value))

    def check(self, owner: str, value: Any) -> npt.NDArray[Any]:
        return super().check(owner, _as_number(value))

    def parse(self, text: str) -> Any:
        return index_of(text, "its index as a number, such as 1.33")

    def described(self) -> str:
        return "a real index of refraction above 0, since light comes from there"

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        if not isinstance(value, Material):
            return [(name, value, self)]
        return [(f"{name}.n", value.n, self), (f"{name}.k", value.k, self.of_k)]


class LitIndexDomain(IndexDomain):
    """Complex numbers n + ik with n above 0: a medium that light comes from may absorb."""

    @property
    def interval(self) -> tuple[float, float]:
        """The limits of n."""
        return LEAST, math.inf

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        if not isinstance(value, Material):
            return [(name, value, self)]
        return [(f"{name}.n", value.n, OUTSIDE), (f"{name}.k", value.k, K)]

    def quickly_allows(self, value: Any) -> bool:
        return super().quickly_allows(value) and value.real >= LEAST

    def described(self) -> str:
        return (
            "an index of refraction n + ik with n above 0 and k not negative, since light comes "
            "from there"
        )

    def allows(self, numbers: Any) -> Any:
        least, _ = held(numbers, (LEAST, math.inf))
        return super().allows(numbers) & (numbers.real >= least)


class FollowedLitIndex(Followed, LitIndexDomain):
    """The same, or that of the boundary before."""


class OptionalLitIndex(LitIndexDomain):
    """The same, or none."""

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        return [] if value is None else super().parts(name, value)


class FollowedOutside(Followed, OutsideDomain):
    """The same, or that of the boundary before."""


class OptionalOutside(OutsideDomain):
    """The same, or none."""

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        return [] if value is None else super().parts(name, value)


class LitBehind(OutsideDomain):
    """Indices of a medium behind a boundary from which light comes as well."""

    of_k = _NO_K_BEHIND

    def described(self) -> str:
        return (
            "a real index of refraction above 0, since light comes from there too (by port "
            "'back'), and let a Medium absorb between"
        )

    def allows(self, numbers: Any) -> Any:
        # A complex number without an imaginary part will do.
        return super().allows(numbers.real) & (numbers.imag == 0.0)

    def _check_numbers(self, owner: str, array: npt.NDArray[Any], rounding: float) -> None:
        real = array.real if array.dtype.kind == "c" and not np.any(array.imag) else array
        super()._check_numbers(owner, real, rounding)


class ClearDomain(OutsideDomain):
    """Indices of a medium that light goes on in."""

    of_k = _NO_K_BEYOND

    def described(self) -> str:
        return (
            "a real index of refraction above 0, since light goes on in there, and let a Medium "
            "absorb on the way"
        )


def _as_number(index: Any) -> Any:
    return index.refractive_index if isinstance(index, Material) else index


def _as_numbers(value: Any) -> Any:
    """Return a list with the index of each medium in it; anything else as it is."""
    return [_as_number(one) for one in value] if isinstance(value, (list, tuple)) else value


INDEX = IndexDomain("index of refraction")
OUTSIDE = OutsideDomain("index of refraction", minimum=LEAST)
LIT_INDEX = LitIndexDomain("index of refraction")
FOLLOWED_LIT_INDEX = FollowedLitIndex("index of refraction")
OPTIONAL_LIT_INDEX = OptionalLitIndex("index of refraction")
FOLLOWED_OUTSIDE = FollowedOutside("index of refraction", minimum=LEAST)
OPTIONAL_OUTSIDE = OptionalOutside("index of refraction", minimum=LEAST)
LIT_BEHIND = LitBehind("index of refraction", minimum=LEAST)
CLEAR = ClearDomain("index of refraction", minimum=LEAST)
# Beyond, waves across a layer have squares that vanish.
