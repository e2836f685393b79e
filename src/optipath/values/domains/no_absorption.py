"""NoAbsorption: what k may be of a medium that must not absorb."""

from __future__ import annotations

from dataclasses import dataclass

from optipath.values.cures import cure
from optipath.values.domains.domain import Domain


@dataclass(frozen=True)
class NoAbsorption(Domain):
    """Extinction coefficients that are 0.

    Examples
    --------
    >>> NoAbsorption("k", why=", since light goes on in there").described()
    '0, since light goes on in there: take the medium without its k, such as Material(glass.n)'
    """

    minimum: float = 0.0
    maximum: float = 0.0
    why: str = ""
    otherwise: str = ""

    def described(self) -> str:
        """Say in words that it is 0, and how to have it."""
        without = cure("such as Material(glass.n)", "by k = 0.0")
        return f"0{self.why}: take the medium without its k, {without}{self.otherwise}"
