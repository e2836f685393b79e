"""The names of axes."""

from __future__ import annotations

import math
from types import MappingProxyType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

AXES: Mapping[str, float] = MappingProxyType(
    {
        "horizontal": 0.0,
        "vertical": math.pi / 2.0,
        "diagonal": math.pi / 4.0,
        "antidiagonal": -math.pi / 4.0,
    }
)
"""The angles of axes that have names, from x towards y."""
