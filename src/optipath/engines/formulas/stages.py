"""Stages: a formula parted by the axes of the batch on which each of its numbers depends."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from optipath.engines.formulas.symbol import Symbol

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.engines.formulas.formula import Formula


def stages(whole: Formula, axes: frozenset[int], last: int | None) -> tuple[Formula, ...]:
    """Return formulas to be done one after the other; the last gives the results.

    What depends on a few axes of the batch only is computed along these alone, by a stage
    whose results are given to later ones.
    """
    known: list[Symbol] = []
    found: list[Formula] = []
    for own in sorted({s.axes for s in whole.steps if s.axes < axes and s.axes}, key=_order):
        later = _later(whole, own)
        results = tuple(s for s in whole.steps if s.axes == own and s.index in later)
        found.append(_stage(whole, results, own, last, known))
        known += results
    done = {symbol.index for symbol in known}
    results = tuple(
        result
        for result in whole.results
        if not (isinstance(result, Symbol) and result.index in done)
    )
    return (*found, _stage(whole, results, axes, last, known, frozenset()))


def _later(whole: Formula, own: frozenset[int]) -> set[int]:
    """Return what is needed of a stage once it is done."""
    operands = (o for step in whole.steps if step.axes > own for o in step.operands)
    return {o.index for o in (*operands, *whole.computed) if isinstance(o, Symbol)}


def _stage(
    whole: Formula,
    results: tuple[object, ...],
    own: frozenset[int],
    last: int | None,
    known: Sequence[Symbol],
    *others: frozenset[int],
) -> Formula:
    """Return what is to be done along some axes; conditions along others may be looked at too."""
    conditions = tuple(
        condition
        for condition in whole.conditions
        if (condition.axes if isinstance(condition, Symbol) else frozenset()) in (own, *others)
    )
    return replace(
        whole,
        results=results,
        conditions=conditions,
        axes=own,
        last=last if last in own and len(own) > 1 else None,
        earlier=frozenset(symbol.index for symbol in known if symbol.axes < own),
    )


def _order(axes: frozenset[int]) -> tuple[int, list[int]]:
    return len(axes), sorted(axes)
