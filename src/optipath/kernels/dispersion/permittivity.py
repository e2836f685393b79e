"""The complex index of refraction of a complex permittivity."""

from __future__ import annotations

from typing import Any


def index_of_permittivity(xp: Any, real: Any, imaginary: Any) -> tuple[Any, Any]:
    """Return n and k with (n + ik)^2 = real + i imaginary, both of them not negative.

    The field is exp(-iwt), so that what absorbs has a positive imaginary part. Slopes are finite
    but where the permittivity is 0.

    Examples
    --------
    >>> import numpy as np
    >>> n, k = index_of_permittivity(np, 3.0, 4.0)
    >>> float(n), float(k)
    (2.0, 1.0)
    """
    is_metal = real < 0.0
    dark = (real == 0.0) & (imaginary == 0.0)
    one = xp.where(dark, 1.0, xp.where(is_metal, -real, real))
    larger = xp.sqrt(0.5 * (xp.sqrt(one * one + imaginary * imaginary) + one))
    smaller = 0.5 * imaginary / larger
    larger = xp.where(dark, 0.0, larger)
    return xp.where(is_metal, smaller, larger), xp.where(is_metal, larger, smaller)
