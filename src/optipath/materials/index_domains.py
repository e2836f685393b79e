"""Domains of indices of refraction, of single boundaries and of stacks of layers."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar, NoReturn

import numpy as np
import numpy.typing as npt

from optipath.errors import Cure, Fault, ParameterError, UnitError, ValueFault, closest, shown
from optipath.materials.material import LEAST, K, Material, index_of
from optipath.values.arrays import entries_of, first_place, read_only
from optipath.values.domains import Domain, OptionalDomain, in_unit_of, pair_in
from optipath.values.jax_values import namespace
from optipath.values.precision import held


class Followed(Domain):
    """The numbers of a domain, or `FOLLOWS`, which stands for one of them.

    >>> Followed("angle", "angle").parts("incidence", FOLLOWS)
    []
    """

    def kept(self, value: Any) -> Any:
        return value if value is FOLLOWS else super().kept(value)

    def parse(self, text: str) -> Any:
        if text.strip()[:1].isalpha() and closest(text.lower(), [FOLLOWS.word]) is not None:
            cure = Cure.of("did you mean {}?".format, "op.FOLLOWS", FOLLOWS.in_file)
            raise UnitError(Fault(f"'{text}' is no number", cure))
        return super().parse(text)

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        return [] if value is FOLLOWS else super().parts(name, value)


class Follows:
    """What stands for a value of the boundary before; `FOLLOWS` is the only one.

    Examples
    --------
    >>> FOLLOWS
    FOLLOWS
    """

    __slots__ = ()

    # NumPy's numbers leave arithmetic to it.
    __array_ufunc__ = None

    word = "follows"
    """How files write it."""

    in_file = f'"{word}"'
    """The same with its quotes."""

    def __repr__(self) -> str:
        return "FOLLOWS"

    def __reduce__(self) -> str:
        # Copies are the same one.
        return "FOLLOWS"


def _refused(*_: Any) -> NoReturn:
    raise ParameterError(
        "FOLLOWS stands for what the boundary before has, just as it is, and has no arithmetic; "
        "give the number, or the Parameter that the boundary before has, which has it"
    )


_REFUSED = "add radd sub rsub mul rmul truediv rtruediv pow rpow matmul rmatmul neg pos abs"
for _name in _REFUSED.split():
    setattr(Follows, f"__{_name}__", _refused)

FOLLOWS = Follows()
"""For ``outside`` the medium of arrival, for ``incidence`` that of the boundary before, refracted
by Snell's law; in files ``"follows"``."""


@dataclass(frozen=True)
class NoAbsorption(Domain):
    """Extinction coefficients that are 0.

    >>> NoAbsorption("k", why=", since light goes on in there").described()
    '0, since light goes on in there: take the medium without its k'
    """

    minimum: float = 0.0
    maximum: float = 0.0
    why: str = ""
    otherwise: str = ""

    def described(self) -> str:
        """Say in words that it is 0, and how to have it."""
        return f"0{self.why}: take the medium without its k{self.otherwise}"


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
        return Fault(
            f"{owner} is {value}, which may be n and k, or the indices of two paths",
            Cure(
                f"write Material({n}, {k}) or {n}{k:+}j for the one, np.array([{n}, {k}]) for the "
                f"other",
                f"write {{ n = {n}, k = {k} }} for the one, {{ n = [{n}, {k}] }} for the other",
            ),
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


class OptionalLitIndex(OptionalDomain, LitIndexDomain):
    """The same, or none."""


class FollowedOutside(Followed, OutsideDomain):
    """The same, or that of the boundary before."""


class OptionalOutside(OptionalDomain, OutsideDomain):
    """The same, or none."""


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


MOST_MEDIA = 1000
"""How many media a stack may have: the time to order the work of a path grows with them."""


@dataclass(frozen=True)
class InnerDomain(OutsideDomain):
    """Indices of the layers of a stack, between which light goes to and fro."""

    missing: str = "the lengths (one for each layer) and the wavelength"

    @classmethod
    def without(cls, missing: str) -> InnerDomain:
        """Return the domain of layers of a stack that is not given something."""
        return cls(INNER.name, minimum=INNER.minimum, maximum=INNER.maximum, missing=missing)

    @property
    def of_k(self) -> Domain:  # type: ignore[override]
        """What k may be."""
        absorbing = f"; or, for a layer that absorbs, give the stack {self.missing}, too"
        return NoAbsorption("extinction coefficient", otherwise=absorbing)

    def described(self) -> str:
        return (
            f"a real index of refraction within {self.minimum:g} .. {self.maximum:g}; or, for a "
            f"layer that absorbs, give the stack {self.missing}, too"
        )


def _entries_in(value: Any, *kinds: type) -> tuple[Any, ...] | None:
    """Return the entries of a list; None of what validation is to name."""
    if not isinstance(value, (list, tuple, *kinds)):
        return None
    try:
        return entries_of("", "", value)
    except ValueFault:
        return None


@dataclass(frozen=True)
class IndicesDomain(Domain):
    """Indices of the media of a stack, the front medium first and the substrate last."""

    inner: Domain | None = None

    def quickly_allows(self, value: Any) -> bool:
        del value
        return False

    def read(self, owner: str, value: Any) -> Any:
        if (listed := _entries_in(value)) is None:
            return value
        entries = [*enumerate(listed)]
        for place in (place for place, index in entries if place and index is FOLLOWS):
            raise ValueFault(
                f"{owner}[{place}] cannot be FOLLOWS; only {owner}[0], the medium in front, can be "
                f"taken over; give an index of refraction"
            )
        return [INDEX.read(f"{owner}[{place}]", index) for place, index in entries]

    def kept(self, value: Any) -> Any:
        """Return the indices one by one, since each may be an array of its own."""
        if (entries := _entries_in(value, np.ndarray)) is None:
            return value
        if len(entries) > MOST_MEDIA:
            return value
        return tuple(_plain_index(read_only(index)) for index in entries)

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        if not isinstance(value, tuple) or len(value) < 2:
            return [(name, value, self)]
        domains = [FOLLOWED_OUTSIDE, *[self.inner or INNER] * (len(value) - 2), INDEX]
        return [
            part
            for place, (index, domain) in enumerate(zip(value, domains, strict=True))
            for part in domain.parts(f"{name}[{place}]", index)
        ]

    def check(self, owner: str, value: Any) -> Any:
        if value is not None and not isinstance(value, (float, int, complex)):
            # Good lists are checked by their parts.
            entries = entries_of(owner, "two indices or more", value)
            if (media := len(entries)) > MOST_MEDIA:
                raise ValueFault(f"{owner} has {media:,} media; give {MOST_MEDIA:,} at most")
        raise ValueFault(
            f"{owner} is {shown(value)}; give a list of two indices or more, the medium in front "
            f"first and the substrate last, such as [1, 1.5, 1.33]"
        )

    def check_parameter(self, owner: str, parameter: Any) -> None:
        name = parameter.name
        raise ValueFault(
            f"{owner} cannot be the parameter '{name}'; give a list, of parameters too"
        )


def _plain_index(index: Any) -> Any:
    """Return an index that came out of an array with others as the real number that it is."""
    return index.real if isinstance(index, complex) and index.imag == 0.0 else index


INNER = InnerDomain("index of refraction", minimum=1e-60, maximum=1e60)
INDICES = IndicesDomain("indices of refraction")


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
        if (entries := _entries_in(value)) is None:
            return value
        return [LENGTH_OF_LAYER.read(f"{owner}[{i}]", one) for i, one in enumerate(entries)]

    def kept(self, value: Any) -> Any:
        """Return the lengths one by one, since each may be an array of its own."""
        if (entries := _entries_in(value, np.ndarray)) is None:
            return value
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
