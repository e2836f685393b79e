"""Timings of contenders that take turns, so that a busy machine is unfair to none of them."""

from __future__ import annotations

from statistics import median
from time import perf_counter
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

_UNITS = {1.0: "s", 1e-3: "ms", 1e-6: "us", 1e-9: "ns"}


class Timing(NamedTuple):
    """Seconds of one call."""

    first: float
    least: float
    middle: float


def race(
    contenders: Mapping[str, Callable[[], object]],
    seconds: float = 0.2,
    tick: Callable[[str], object] = lambda _: None,
) -> dict[str, Timing]:
    """Return the timing of each contender.

    Examples
    --------
    >>> timings = race({"nothing": lambda: None}, seconds=0.001)
    >>> timings["nothing"].least <= timings["nothing"].middle
    True
    """
    first: dict[str, float] = {}
    calls: dict[str, int] = {}
    for name, action in contenders.items():
        tick(name)
        first[name] = seconds_of(action)
        # Calls that are too short for the clock are timed several at a time.
        calls[name] = max(1, int(seconds / 20 / max(seconds_of(action), 1e-9)))
    taken: dict[str, list[float]] = {name: [] for name in contenders}
    for turn in range(20):
        for name, action in contenders.items():
            if turn < 3 or sum(taken[name]) * calls[name] < seconds:
                taken[name].append(seconds_of(action, calls[name]))
    return {name: Timing(first[name], min(found), median(found)) for name, found in taken.items()}


def seconds_of(action: Callable[[], object], calls: int = 1) -> float:
    """Return the time of one call of an action, the mean of several.

    Units: the result in seconds.
    """
    begin = perf_counter()
    for _ in range(calls):
        action()
    return (perf_counter() - begin) / calls


def duration(seconds: float) -> str:
    """Return a time in the unit that suits it, with three digits.

    Examples
    --------
    >>> [duration(seconds) for seconds in (1.05e-6, 2.3e-3, 0.99999, 0.0, 3e-10, 5000)]
    ['1.05 us', '2.3 ms', '1 s', '0 s', '0.3 ns', '5,000 s']
    """
    rounded = float(f"{seconds:.3g}")
    if rounded == 0.0 or rounded >= 1000.0:
        return f"{rounded:,.0f} s"
    sizes = [size for size in _UNITS if rounded >= size] or [min(_UNITS)]
    return f"{rounded / sizes[0]:.3g} {_UNITS[sizes[0]]}"
