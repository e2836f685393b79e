"""Refused: what stands in place of a domain where no value will do, for a reason of its own."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NoReturn

from optipath.errors import ValueFault
from optipath.values.domains.domain import Domain

if TYPE_CHECKING:
    from optipath.values.parameters import Parameter


@dataclass(frozen=True)
class Refused(Domain):
    """No value at all.

    Examples
    --------
    >>> Refused("length", why="is missing; give it").check("Rod length", None)
    Traceback (most recent call last):
    optipath.errors.ValueFault: Rod length is missing; give it
    """

    why: str = ""

    def quickly_allows(self, value: Any) -> bool:
        del value
        return False

    def check(self, owner: str, value: Any) -> NoReturn:
        del value
        raise ValueFault(f"{owner} {self.why}")

    def check_parameter(self, owner: str, parameter: Parameter) -> NoReturn:
        self.check(owner, parameter)
