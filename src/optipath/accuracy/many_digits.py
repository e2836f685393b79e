"""mpmath, or the sentence that says how to get it."""

from __future__ import annotations

from optipath.errors import MissingExtraError

try:
    import mpmath
except ImportError:  # pragma: no cover - the tests bring it
    raise MissingExtraError("50-digit references", "mpmath", "chart") from None

__all__ = ["mpmath"]
