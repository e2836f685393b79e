"""The kinds of elements that files may name: those of the library, and what users have added."""

from __future__ import annotations

from typing import Any

# Importing them enters their kinds.
from optipath.elements import (  # noqa: F401
    ends,
    interface,
    layer_stack,
    medium,
    mueller_element,
    polarizers,
    retarders,
    splitters,
    vertices,
)
from optipath.elements.coupling import KINDS
from optipath.errors import PathError
from optipath.faults import did_you_mean


def element_class(kind: str) -> type[Any]:
    """Return the class of a kind."""
    if kind not in KINDS:
        cure = did_you_mean(kind, sorted(KINDS))
        if "did you mean" not in cure:
            cure += (
                "; one of your own is known once its module is imported (optipath --import "
                "my_elements ...)"
            )
        raise PathError(f"element kind '{kind}' is unknown{cure}")
    return KINDS[kind]
