"""Why something cannot stand in a product such as ``element @ light``, and what can."""

from __future__ import annotations

from typing import Any

from optipath.errors import shown


def why_refused(factor: Any) -> str:
    """Say why something is no factor of a product, and what to write in its place.

    Examples
    --------
    >>> print(why_refused([1, 0, 0, 0]))  # doctest: +NORMALIZE_WHITESPACE
    [1, 0, 0, 0] has no frames; write element @ light, optipath.Mueller(matrix) @ light,
    and optipath.Light(numbers) for light
    """
    if isinstance(factor, type):
        return f"{factor.__name__} is a class; write {factor.__name__}(...)"
    if hasattr(factor, "mueller"):
        kind = type(factor).__name__
        return (
            f"a {kind} begins with light of its own; write path.mueller() @ light for what is "
            f"between its source and its detector, or give its Source these stokes"
        )
    if hasattr(factor, "element"):
        return f"{shown(factor)} is of a path; write the element without a name"
    return (
        f"{shown(factor)} has no frames; write element @ light, optipath.Mueller(matrix) @ light, "
        f"and optipath.Light(numbers) for light"
    )
