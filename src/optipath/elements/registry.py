"""The registry: which class stands behind each kind of element."""

from __future__ import annotations

from typing import Any

from optipath.errors import PathError, did_you_mean

_KINDS: dict[str, type[Any]] = {}


def register(kind: str, element_class: type[Any]) -> None:
    """Enter a class under its kind; defining the same class again replaces it.

    Parameters
    ----------
    kind : str
        The name in preset files.
    element_class : type
        Its class.

    Raises
    ------
    PathError
        If another class has the kind already.
    """
    known = _KINDS.get(kind)
    if known is not None and _identity(known) != _identity(element_class):
        raise PathError(
            f"element kind '{kind}' is taken by {'.'.join(_identity(known))}; choose another"
        )
    _KINDS[kind] = element_class


def element_class(kind: str) -> type[Any]:
    """Return the class of a kind.

    Raises
    ------
    PathError
        If the kind is unknown.

    Examples
    --------
    >>> element_class("rotator").__name__
    'Rotator'
    """
    if kind not in _KINDS:
        raise PathError(f"element kind '{kind}' is unknown{did_you_mean(kind, sorted(_KINDS))}")
    return _KINDS[kind]


def _identity(element_class: type[Any]) -> tuple[str, str]:
    return element_class.__module__, element_class.__qualname__
