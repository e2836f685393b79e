"""Stages: a formula parted by the axes of the batch on which each of its numbers depends."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from optipath.formulas.symbol import Symbol

if TYPE_CHECKING:
    from optipath.formulas.formula import Formula


def stages(whole: Formula, axes: frozenset[int], last: int | None) -> tuple[Formula, ...]:
    """Return formulas to be done one after the other; the last gives the results.

    What depends on a few axes of the batch only is computed along these alone, by a stage
    whose results are given to later ones.

    Parameters
    ----------
    whole : Formula
        What is to be done.
    axes : frozenset of int
        The axes of the batch.
    last : int or None
        The innermost axis, where it is long enough for a loop of its own.
    """
    known: list[Symbol] = []
    found: list[Formula] = []
    for own in sorted({s.axes for s in whole.steps if s.axes < axes and s.axes}, key=_order):
        of_own = [symbol for symbol in whole.steps if symbol.axes == own]
        later = {
            operand.index
            for step in whole.steps
            if step.axes > own
            for operand in step.operands
            if isinstance(operand, Symbol)
        }
        later |= {result.index for result in whole.computed}
        results = tuple(symbol for symbol in of_own if symbol.index in later)
        earlier = frozenset(symbol.index for symbol in known if symbol.axes < own)
        inner = last if last in own and len(own) > 1 else None
        conditions = _conditions(whole, own)
        found.append(
            replace(
                whole,
                results=results,
                conditions=conditions,
                axes=own,
                last=inner,
                earlier=earlier,
            )
        )
        known += results
    earlier = frozenset(symbol.index for symbol in known)
    results = tuple(
        result
        for result in whole.results
        if not (isinstance(result, Symbol) and result.index in earlier)
    )
    others = (*_conditions(whole, axes), *_conditions(whole, frozenset()))
    final = replace(
        whole,
        results=results,
        conditions=others,
        axes=axes,
        last=last if len(axes) > 1 else None,
        earlier=earlier,
    )
    return (*found, final)


def _conditions(whole: Formula, axes: frozenset[int]) -> tuple[object, ...]:
    return tuple(
        condition
        for condition in whole.conditions
        if (condition.axes if isinstance(condition, Symbol) else frozenset()) == axes
    )


def _order(axes: frozenset[int]) -> tuple[int, list[int]]:
    return len(axes), sorted(axes)
