"""Domains of the indices of refraction of a stack of layers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from optipath.errors import ValueFault, shown
from optipath.values.arrays.array_likes import entries_of
from optipath.values.arrays.read_only import read_only
from optipath.values.domains.domain import Domain
from optipath.values.domains.indices import (
    FOLLOWED_OUTSIDE,
    INDEX,
    OutsideDomain,
)
from optipath.values.domains.no_absorption import NoAbsorption
from optipath.values.follows import FOLLOWS

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


@dataclass(frozen=True)
class IndicesDomain(Domain):
    """Indices of the media of a stack, the front medium first and the substrate last."""

    inner: Domain | None = None

    def quickly_allows(self, value: Any) -> bool:
        del value
        return False

    def read(self, owner: str, value: Any) -> Any:
        if not isinstance(value, (list, tuple)):
            return value
        try:
            entries = [*enumerate(entries_of(owner, "indices", value))]
        except ValueFault:
            return value  # For validation to name.
        for place in (place for place, index in entries if place and index is FOLLOWS):
            raise ValueFault(
                f"{owner}[{place}] cannot be FOLLOWS; only {owner}[0], the medium in front, can be "
                f"taken over; give an index of refraction"
            )
        return [INDEX.read(f"{owner}[{place}]", index) for place, index in entries]

    def kept(self, value: Any) -> Any:
        """Return the indices one by one, since each may be an array of its own."""
        if not isinstance(value, (list, tuple, np.ndarray)):
            return value
        try:
            entries = entries_of("", "indices", value)
        except ValueFault:
            return value  # For validation to name.
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
