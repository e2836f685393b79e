"""Colors of lines and marks, distinguishable by color-blind eyes."""

from __future__ import annotations

from numbers import Real
from typing import Any

from optipath.errors import shown

INK = "#222222"
"""Of texts, axes and what is drawn in one colour alone."""

FAINT = "#8a8a8a"
"""Of lines that help: grids, directions, limits."""

LINES = (
    "#0072B2",
    "#D55E00",
    "#009E73",
    "#CC79A7",
    "#56B4E9",
    "#E69F00",
)
"""Of lines beside one another, in this order (Okabe and Ito, Color Universal Design, 2008)."""

DASHES = ("-", (0, (6, 2)), (0, (2, 1.5)), (0, (6, 2, 1.5, 2)), (0, (9, 3)), (0, (1, 1)))
"""Of the same lines, which tells them apart without colours."""


HATCHED: dict[str, Any] = {
    "facecolor": "white",
    "edgecolor": FAINT,
    "hatch": "////",
    "linewidth": 0.0,
}
"""Of places where there is no number."""


def positive(what: str, number: Any) -> list[str]:
    """Return the sentence for what is no number above 0; none for one that is, or for None.

    >>> positive("largest", -1.0), positive("largest", 2), positive("largest", None)
    (['largest is -1.0; give a number above 0'], [], [])
    """
    real = isinstance(number, Real) and not isinstance(number, bool)
    if number is None or (real and float(number) > 0.0):
        return []
    return [f"{what} is {shown(number)}; give a number above 0"]
