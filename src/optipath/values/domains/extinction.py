"""The domain of extinction ratios, which may be infinite."""

from __future__ import annotations

from typing import Any, ClassVar

from optipath.values.arrays.jax_values import namespace
from optipath.values.domains.domain import Domain


class ExtinctionDomain(Domain):
    """Ratios of what is wanted to what is not, beyond 1; infinite where nothing of that is left.

    Examples
    --------
    >>> ExtinctionDomain("extinction ratio", minimum=1.001).parse("1000:1")
    1000.0
    """

    of_numbers: ClassVar[str] = "finite or infinite"

    def are_numbers(self, numbers: Any) -> Any:
        return ~namespace(numbers).isnan(numbers)

    def described(self) -> str:
        return (
            f"a real {self.name} of {self.minimum} or more, or infinity (a BeamSplitter does not "
            f"polarise)"
        )
