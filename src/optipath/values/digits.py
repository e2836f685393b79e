"""How many digits a sentence needs, so that what it says holds as it is written."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

_ALL = 17


def digits_until(holds: Callable[[int], bool], least: int = 10) -> int:
    """Return with how few significant digits something holds; 17, which tell all doubles apart.

    Examples
    --------
    >>> digits_until(lambda digits: f"{1 + 1e-11:.{digits}g}" != "1")
    12
    """
    return next((digits for digits in range(least, _ALL) if holds(digits)), _ALL)
