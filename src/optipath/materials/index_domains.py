"""Domains of indices of refraction, of single boundaries and of stacks of layers."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from optipath.errors import UnitError, ValueFault
from optipath.faults import Cure, Fault, closest, shown
from optipath.materials.material import K, Material, RealPart, index_of
from optipath.values.arrays import read_only
from optipath.values.domains import LEAST, Domain, in_unit_of
from optipath.values.jax_values import namespace
from optipath.values.precision import held, real_number


class Followed(Domain):
    """The numbers of a domain, or `FOLLOWS`, which stands for one of them.

    >>> Followed("angle", "angle").parts("incidence", FOLLOWS)
    []
    """

    def kept(self, value: Any) -> Any:
        return value if value is FOLLOWS else super().kept(value)

    def parse(self, text: str) -> Any:
        if closest(text.lower(), [FOLLOWS.word]) is not None:
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

    __array_ufunc__ = None  # NumPy's numbers leave arithmetic to it, which has none.

    word = "follows"
    """How files write it."""

    in_file = f'"{word}"'
    """The same with its quotes."""

    def __repr__(self) -> str:
        return "FOLLOWS"

    def __reduce__(self) -> str:
        # Copies are the same one.
        return "FOLLOWS"


FOLLOWS = Follows()
"""For ``outside`` the medium of arrival, for ``incidence`` that of the boundary before, refracted
by Snell's law; in files ``"follows"``."""


@dataclass(frozen=True)
class NoAbsorption(Domain):
    """Extinction coefficients that are 0.

    >>> NoAbsorption("k", besides=", since light goes on in there").described()
    '0, since light goes on in there: take the medium without its k'
    """

    minimum: float = 0.0
    maximum: float = 0.0

    def described(self) -> str:
        return f"0{self.besides}: take the medium without its k"


class _IndexOrMaterial(Domain):
    """Numbers that a `Material` has n and k in place of."""

    takes_materials = True

    def domains_of(self, material: Material) -> tuple[Domain, Domain]:
        """Return what n and k of a material may be."""
        return material.domain_of_n, K

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        if not isinstance(value, Material):
            return super().parts(name, value)
        of_n, of_k = self.domains_of(value)
        return [(f"{name}.n", value.n, of_n), (f"{name}.k", value.k, of_k)]

    def parse(self, text: str) -> Any:
        return index_of(text)

    def read(self, owner: str, value: Any) -> Any:
        if isinstance(value, (list, tuple)):
            value = [_as_number(one) for one in value]
        return super().read(owner, value)

    def check(self, owner: str, value: Any) -> npt.NDArray[Any]:
        return super().check(owner, _as_number(value))


@dataclass(frozen=True)
class IndexDomain(_IndexOrMaterial):
    """Complex numbers n + ik: n of `least` or more, k not negative, and both not above `most`."""

    complex_parts = ("n", "k")

    least: float = 0.0
    most: float = math.inf
    limits: str = "n and k not negative"
    of_parts: tuple[Domain, Domain] | None = None  # What n and k of a material may be.

    @property
    def interval(self) -> tuple[float, float]:
        """The limits of n."""
        return self.least, self.most

    def domains_of(self, material: Material) -> tuple[Domain, Domain]:
        return self.of_parts or super().domains_of(material)

    def quickly_allows(self, value: Any) -> bool:
        if type(value) is not float and type(value) is not complex:
            return False
        n, k = value.real, value.imag
        inside = value != 0.0 and self.least <= n <= self.most and 0.0 <= k <= self.most
        return inside and n < math.inf and k < math.inf

    def read(self, owner: str, value: Any) -> Any:
        numbers = map(real_number, value) if isinstance(value, (list, tuple)) else ()
        if len(pair := [*numbers]) == 2 and None not in pair:
            n, k = value
            cure = Cure(
                f"write {n}{k:+}j for one index, np.array([{n}, {k}]) for two paths",
                f"write {{ n = {n}, k = {k} }} for one index, {{ n = [{n}, {k}] }} for two paths",
            )
            raise ValueFault(Fault(f"{owner} is {value}", cure))
        return super().read(owner, value)

    def described(self) -> str:
        return f"an index of refraction n + ik with {self.limits}"

    def allows(self, numbers: Any) -> Any:
        least, most = held(numbers, (self.least, self.most))
        n, k = numbers.real, numbers.imag
        there = namespace(numbers).isfinite(numbers) & (numbers != 0.0)
        return there & (n >= least) & (n <= most) & (k >= 0.0) & (k <= most)

    def refused(self, number: Any) -> tuple[str, str]:
        if number.imag < 0.0:
            return str(number), " (the field is exp(-iwt): k > 0 absorbs)"
        return str(number), "" if number else ", and not both 0"


@dataclass(frozen=True)
class OutsideDomain(_IndexOrMaterial):
    """Positive real numbers: indices of media that do not absorb."""

    minimum: float = LEAST  # Beyond, waves across a layer have squares that vanish.
    besides: str = ", since light comes from there"

    def domains_of(self, material: Material) -> tuple[Domain, Domain]:
        return self, NoAbsorption("extinction coefficient", besides=self.besides)


class FollowedIndex(Followed, IndexDomain):
    """An index, or that of the boundary before."""


class FollowedOutside(Followed, OutsideDomain):
    """The same of media that do not absorb."""


class LitBehind(OutsideDomain):
    """Indices of a medium behind a boundary from which light comes as well.

    Of complex numbers those without an imaginary part will do.
    """

    def allows(self, numbers: Any) -> Any:
        return super().allows(numbers.real) & (numbers.imag == 0.0)

    def _check_numbers(self, owner: str, array: npt.NDArray[Any], rounding: float) -> None:
        real = array.real if array.dtype.kind == "c" and not np.any(array.imag) else array
        super()._check_numbers(owner, real, rounding)


def _as_number(index: Any) -> Any:
    return index.refractive_index if isinstance(index, Material) else index


INDEX = IndexDomain("index of refraction")
OUTSIDE = OutsideDomain("index of refraction")
OPTIONAL_OUTSIDE = replace(OUTSIDE, optional=True)
FOLLOWED_OUTSIDE = FollowedOutside(**vars(OUTSIDE))
LIT_INDEX = replace(
    INDEX,
    least=LEAST,
    limits="n above 0 and k not negative, since light comes from there",
    of_parts=(OUTSIDE, K),
)
"""Of a medium that light comes from, and that may absorb."""
OPTIONAL_LIT_INDEX = replace(LIT_INDEX, optional=True)
FOLLOWED_LIT_INDEX = FollowedIndex(**vars(LIT_INDEX))
LIT_BEHIND = LitBehind(
    "index of refraction",
    besides=", since light comes from there too (by port 'back'), and let a Medium absorb between",
)
CLEAR = OutsideDomain(
    "index of refraction",
    besides=", since light goes on in there, and let a Medium absorb on the way",
)


MOST_MEDIA = 1000
"""How many media a stack may have: the time to order the work of a path grows with them."""


def inner_domain(missing: str) -> OutsideDomain:
    """Return what the layers of a stack may be that is not given something."""
    why = f" (for a layer that absorbs, give the stack {missing}, too)"
    return OutsideDomain("index of refraction", minimum=1e-60, maximum=1e60, besides=why)


INNER = inner_domain("the lengths (one for each layer) and the wavelength")
LOSSY = IndexDomain(
    "index of refraction",
    least=INNER.minimum,
    most=INNER.maximum,
    limits=f"n within {INNER.minimum:g} .. {INNER.maximum:g} and k within 0 .. {INNER.maximum:g}",
    of_parts=(
        RealPart("index of refraction", minimum=INNER.minimum, maximum=INNER.maximum),
        Domain("extinction coefficient", minimum=0.0, maximum=INNER.maximum),
    ),
)
"""Of the layers of a stack whose lengths are known."""


@dataclass(frozen=True)
class RowDomain(Domain):
    """Numbers of the parts of a stack, each of which may be an array or a parameter of its own."""

    takes_parameters = False
    of_entries: ClassVar[Domain]

    def quickly_allows(self, value: Any) -> bool:
        return False

    def read(self, owner: str, value: Any) -> Any:
        if not isinstance(value, (list, tuple)):
            return value
        return [self.of_entries.read(f"{owner}[{at}]", entry) for at, entry in enumerate(value)]

    def kept(self, value: Any) -> Any:
        if not _is_row(value) or len(value) > MOST_MEDIA:
            return value
        return tuple([self.entry_kept(read_only(entry)) for entry in value])

    def entry_kept(self, entry: Any) -> Any:
        """Return an entry in the form in which it is kept."""
        return in_unit_of(entry, self.of_entries)

    def check(self, owner: str, value: Any) -> Any:
        """Refuse what is no list; those are checked by their parts."""
        if _is_row(value) and len(value) > MOST_MEDIA:
            raise ValueFault(f"{owner} has {len(value):,} entries; give {MOST_MEDIA:,} at most")
        raise ValueFault(f"{owner} is {shown(value)}; give {self.described()}")


def _is_row(value: Any) -> bool:
    return isinstance(value, (list, tuple)) or (isinstance(value, np.ndarray) and value.ndim > 0)


@dataclass(frozen=True)
class IndicesDomain(RowDomain):
    """Indices of the media of a stack, the front medium first and the substrate last."""

    of_entries = INDEX
    inner: Domain | None = None

    def read(self, owner: str, value: Any) -> Any:
        if isinstance(value, (list, tuple)) and any(index is FOLLOWS for index in value[1:]):
            raise ValueFault(f"only {owner}[0], the medium in front, can be FOLLOWS")
        return super().read(owner, value)

    def entry_kept(self, entry: Any) -> Any:
        # Out of an array with complex ones, a real index is one again.
        return entry.real if isinstance(entry, complex) and entry.imag == 0.0 else entry

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        if not isinstance(value, tuple) or len(value) < 2:
            return [(name, value, self)]
        domains = [FOLLOWED_OUTSIDE, *[self.inner or INNER] * (len(value) - 2), INDEX]
        return [
            part
            for place, (index, domain) in enumerate(zip(value, domains, strict=True))
            for part in domain.parts(f"{name}[{place}]", index)
        ]

    def described(self) -> str:
        return (
            "a list of two indices or more, each a number or a parameter, such as [1, 1.5, 1.33] "
            "from front to substrate"
        )


INDICES = IndicesDomain("indices of refraction")


# Light-years are shorter; beyond, what is absorbed overflows before it is too much.
LENGTH_OF_LAYER = Domain("length", "length", minimum=0.0, maximum=1e100, own_unit="mm")


@dataclass(frozen=True)
class LengthsDomain(RowDomain):
    """Lengths of the layers of a stack, one for each, or none at all."""

    of_entries = LENGTH_OF_LAYER
    layers: int | None = None

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        if value is None:
            return []
        if not isinstance(value, tuple) or self.layers not in (None, len(value)):
            return [(name, value, self)]
        return [(f"{name}[{place}]", one, LENGTH_OF_LAYER) for place, one in enumerate(value)]

    def described(self) -> str:
        count = "" if self.layers is None else f" ({self.layers})"
        return (
            f"a list of lengths, one for each layer between the first medium and the last{count}, "
            f"each a number or a parameter"
        )


LENGTHS = LengthsDomain("lengths of layers", "length", own_unit="mm")
