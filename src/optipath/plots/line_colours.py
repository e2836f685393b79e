"""The colours of lines and marks, told apart by colour-blind eyes and, by their order, in print."""

from __future__ import annotations

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
