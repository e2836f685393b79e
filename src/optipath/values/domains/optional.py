"""OptionalDomain: numbers that may be left out."""

from __future__ import annotations

from typing import Any

from optipath.values.domains.domain import Domain


class OptionalDomain(Domain):
    """The numbers of a domain, or None.

    Examples
    --------
    >>> OptionalDomain("angle", "angle").parts("angle", None)
    []
    """

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        return [] if value is None else super().parts(name, value)
