"""The domain of whole numbers, which files and texts give as floats."""

from __future__ import annotations

from typing import Any

from optipath.values.domains.domain import Domain


class WholeNumber(Domain):
    """Whole numbers, kept as such."""

    def quickly_allows(self, value: Any) -> bool:
        return type(value) is int

    def kept(self, value: Any) -> Any:
        """Return a value that nobody can change.

        Examples
        --------
        >>> WholeNumber("place").kept(2.0)
        2
        """
        kept = super().kept(value)
        return int(kept) if isinstance(kept, float) and kept.is_integer() else kept
