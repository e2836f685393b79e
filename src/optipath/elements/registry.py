"""The registry: where classes of elements enter their kinds."""

from __future__ import annotations

from typing import Any

from optipath.errors import PathError

KINDS: dict[str, type[Any]] = {}
"""The class of each kind that has been imported so far."""


def register(kind: str, element_class: type[Any]) -> None:
    """Enter a class under its kind; defining the same class again replaces it."""
    known = KINDS.get(kind)
    if known is not None and _identity(known) != _identity(element_class):
        raise PathError(
            f"element kind '{kind}' is taken by {'.'.join(_identity(known))}; choose another"
        )
    KINDS[kind] = element_class


def _identity(element_class: type[Any]) -> tuple[str, str]:
    return element_class.__module__, element_class.__qualname__
