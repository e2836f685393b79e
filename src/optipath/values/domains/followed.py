"""Followed: a domain of what a boundary may take over from the one before it."""

from __future__ import annotations

from typing import Any

from optipath.errors import UnitError
from optipath.spelling import closest
from optipath.values.cures import cure
from optipath.values.domains.domain import Domain
from optipath.values.follows import FOLLOWS


class Followed(Domain):
    """The numbers of a domain, or `FOLLOWS`, which stands for one of them.

    Examples
    --------
    >>> Followed("angle", "angle").parts("incidence", FOLLOWS)
    []
    """

    def kept(self, value: Any) -> Any:
        return value if value is FOLLOWS else super().kept(value)

    def parse(self, text: str) -> Any:
        if text.strip()[:1].isalpha() and closest(text.lower(), [FOLLOWS.word]) is not None:
            meant = cure("op.FOLLOWS", FOLLOWS.in_file)
            raise UnitError(f"'{text}' is no number; did you mean {meant}?")
        return super().parse(text)

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        return [] if value is FOLLOWS else super().parts(name, value)
