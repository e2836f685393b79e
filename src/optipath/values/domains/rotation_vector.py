"""Components of rotation vectors."""

from __future__ import annotations

from typing import Any

from optipath.values.domains.domain import Domain
from optipath.values.domains.pair import is_real

_COMPONENTS = 3


class FirstComponentDomain(Domain):
    """The first component of a rotation vector, of which three may be the vector itself.

    Examples
    --------
    >>> FirstComponentDomain("component of a rotation vector", "angle").doubt("s1", [0.1, 0.2])
    ''
    """

    def doubt(self, owner: str, value: Any) -> str:
        if not _may_be_a_vector(value):
            return ""
        parts = ", ".join(map(repr, value))
        return (
            f"{owner} is {value}, which may be a rotation vector, or s1 of three paths; write "
            f"EllipticalRetarder({parts}) for the one, np.array([{parts}]) for the other"
        )


def _may_be_a_vector(value: Any) -> bool:
    """Tell whether a value is three numbers, or their texts, written by hand."""
    listed = isinstance(value, (list, tuple)) and len(value) == _COMPONENTS
    return listed and all(isinstance(part, str) or is_real(part) for part in value)
