"""The domain of fractions, which some give in per cent."""

from __future__ import annotations

from typing import Any

from optipath.errors import ValueFault
from optipath.values.domains.domain import Domain


class FractionDomain(Domain):
    """Real numbers of 0 to 1.

    Examples
    --------
    >>> FractionDomain("fraction", minimum=0.0, maximum=1.0).called(50.0)
    ('50', '; did you mean 0.5?')
    """

    def parse(self, text: str) -> Any:
        if text.rstrip().endswith("%"):
            raise ValueFault(f"'{text}' is in per cent; give a fraction, such as 0.5 for '50 %'")
        return super().parse(text)

    def called(self, number: float) -> tuple[str, str]:
        text, nothing = super().called(number)
        per_cent = 2.0 <= number <= 100.0
        return text, f"; did you mean {number / 100.0:g}?" if per_cent else nothing
