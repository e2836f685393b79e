"""The domain of extinction ratios, which may be infinite."""

from __future__ import annotations

from typing import Any

from optipath.errors import ValueFault
from optipath.values.arrays.jax_values import namespace
from optipath.values.domains.domain import Domain


class ExtinctionDomain(Domain):
    """Ratios of what is wanted to what is not, beyond 1; infinite where nothing of that is left.

    Examples
    --------
    >>> ExtinctionDomain("extinction ratio", minimum=1.001).parse("1000:1")
    1000.0
    """

    def are_numbers(self, numbers: Any) -> Any:
        return ~namespace(numbers).isnan(numbers)

    def parse(self, text: str) -> Any:
        wanted, colon, other = text.partition(":")
        if not colon:
            return super().parse(text)
        divisor = super().parse(other)
        if divisor == 0.0:
            raise ValueFault(f"'{text}' is no ratio of two numbers; write '1000:1', or inf")
        return super().parse(wanted) / divisor

    def described(self) -> str:
        return (
            f"a real {self.name} of {self.minimum} or more, or infinity (a BeamSplitter does not "
            f"polarise)"
        )
