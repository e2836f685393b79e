"""A formula as lines of Python, for engines that compile scalars."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.engines.formulas.operations import OPERATIONS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from optipath.engines.formulas.symbol import Symbol


def indented(*lines: str) -> list[str]:
    """Return lines one level deeper."""
    return ["    " + line for line in lines]


def assignments(
    steps: Iterable[Symbol], written: Callable[[Any], str], *, branchless: bool = False
) -> list[str]:
    """Return a line for each operation."""
    found = []
    for step in steps:
        text = OPERATIONS[step.operation].text
        if branchless and step.operation == "where":
            text = "chosen({0}, {1}, {2})"
        found.append(f"{written(step)} = {text.format(*map(written, step.operands))}")
    return found
