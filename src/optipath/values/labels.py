"""Labels: what sentences call a thing by."""

from __future__ import annotations

from typing import Any

from optipath.errors import ValueFault, shown


def label_of(what: str, name: Any, usual: str) -> str:
    """Return what sentences call a thing by.

    Examples
    --------
    >>> label_of("a spectrum", "", "a histogram"), label_of("a spectrum", "LED", "a histogram")
    ('a histogram', 'LED')
    """
    if not isinstance(name, str):
        raise ValueFault(f"the name of {what} is {shown(name)}; give a text")
    return name or usual
