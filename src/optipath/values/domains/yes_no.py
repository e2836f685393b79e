"""YesNo: whether something is so."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault, shown
from optipath.values.cures import cure
from optipath.values.domains.choice import Choice

if TYPE_CHECKING:
    from optipath.values.parameters import Parameter


@dataclass(frozen=True)
class YesNo(Choice):
    """True or False; ``true`` or ``false`` in files.

    Examples
    --------
    >>> YesNo("whether it is measured").check("X1.measured", True)
    True
    """

    def quickly_allows(self, value: Any) -> bool:
        return value is True or value is False

    def kept(self, value: Any) -> Any:
        """Return a plain bool for one of NumPy's."""
        return bool(value) if isinstance(value, np.bool_) else value

    def described(self) -> str:
        return cure("True or False", "true or false")

    def check(self, owner: str, value: Any) -> Any:
        if isinstance(value, (bool, np.bool_)):
            return bool(value)
        raise ValueFault(f"{owner} is {shown(value)}; give {self.described()}")

    def check_parameter(self, owner: str, parameter: Parameter) -> None:
        del parameter
        raise ValueFault(f"{owner} cannot be a parameter; give {self.described()} when building")
