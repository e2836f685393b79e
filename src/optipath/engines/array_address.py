"""The address of an array, as compiled code takes it."""

from __future__ import annotations

import ctypes
from typing import Any


def address(array: Any) -> int:
    """Return the address of the first number of an array."""
    try:
        return ctypes.addressof(ctypes.c_char.from_buffer(array))
    except (TypeError, ValueError):  # The array is read-only, or empty.
        found: int = array.__array_interface__["data"][0]
        return found
