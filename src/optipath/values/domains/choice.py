"""Choice: one word out of a few."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.errors import ValueFault, did_you_mean, shown
from optipath.values.domains.domain import Domain

if TYPE_CHECKING:
    from optipath.values.parameters import Parameter


@dataclass(frozen=True)
class Choice(Domain):
    """One word out of a few."""

    words: tuple[str, ...] = ()

    def quickly_allows(self, value: Any) -> bool:
        return type(value) is str and value in self.words

    def parse(self, text: str) -> Any:
        return text

    def check(self, owner: str, value: Any) -> Any:
        if isinstance(value, str) and value in self.words:
            return value
        raise ValueFault(f"{owner} is {shown(value)}{did_you_mean(value, self.words)}")

    def check_parameter(self, owner: str, parameter: Parameter) -> None:
        del parameter
        raise ValueFault(f"{owner} cannot be a parameter; choose one word when building")
