"""Bench: the report on a path's speed, timings of contenders that take turns, this machine."""

from __future__ import annotations

import platform
from functools import partial
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import ParameterError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from optipath.plan.plan import Plan


def software(names: Iterable[str]) -> dict[str, str]:
    """Return the versions of Python, the library, and packages."""
    results = {"python": platform.python_version()}
    for name in ("optipath", *names):
        try:
            results[name] = version(name)
        except PackageNotFoundError:
            continue
    return results


def random_values(plan: Plan, count: int, seed: int = 1) -> dict[str, Any]:
    """Return arrays for the parameters of a plan that are open.

    Angles are drawn from their range, at most a whole turn; without any, other numbers within 10 %
    of their defaults.

    >>> import optipath as op
    >>> values = random_values(op.load_preset("npgr026").compose(), 5)
    >>> sorted(values), values["phi"].shape
    (['delta', 'phi', 'rho'], (5,))
    """
    draw = np.random.default_rng(seed).uniform
    angles, others = {}, {}
    for name, parameter in plan.inputs.open.items():
        low, high = plan.inputs.limits[name]
        default = parameter.default
        if parameter.optional or plan.inputs.tails[name]:
            continue
        if plan.inputs.dimensions[name] == "angle":
            angles[name] = draw(max(low, -np.pi), min(high, np.pi), count)
        elif isinstance(default, (int, float)):
            others[name] = np.clip(default * draw(0.9, 1.1, count), low, high)
    if angles or others:
        return angles or others
    raise ParameterError("the path has no open parameter to vary; leave an angle open to time it")


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
    return {
        name: Timing(first[name], min(result), median(result)) for name, result in taken.items()
    }


def seconds_of(action: Callable[[], object], calls: int = 1) -> float:
    """Return the mean time, in seconds, of one call of an action."""
    begin = perf_counter()
    for _ in range(calls):
        action()
    return (perf_counter() - begin) / calls


def duration(seconds: float) -> str:
    """Return a time in the unit that suits it, with three digits.

    >>> [duration(seconds) for seconds in (1.05e-6, 2.3e-3, 0.99999, 0.0, 3e-10, 5000)]
    ['1.05 us', '2.3 ms', '1 s', '0 s', '0.3 ns', '5,000 s']
    """
    rounded = float(f"{seconds:.3g}")
    if rounded == 0.0 or rounded >= 1000.0:
        return f"{rounded:,.0f} s"
    size = next((size for size in _UNITS if rounded >= size), 1e-9)
    return f"{rounded / size:.3g} {_UNITS[size]}"


_PREFIXES = {1e9: " G", 1e6: " M", 1e3: " k"}


def rate(number: float) -> str:
    """Return how many are done a second, with three digits.

    >>> [rate(number) for number in (28_412.0, 999_600.0, 4.5, 2.5e9)]
    ['28.4 k', '1 M', '4.5', '2.5 G']
    """
    rounded = float(f"{number:.3g}")
    size = next((size for size in _PREFIXES if rounded >= size), 1.0)
    return f"{rounded / size:.3g}{_PREFIXES.get(size, '')}"


_INNER, _OUTER = 2048, 4_000_000


def processor() -> str:
    """Return what the processor calls itself."""
    message = Path("/proc/cpuinfo")
    lines = message.read_text(encoding="utf-8").splitlines() if message.exists() else []
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, platform.processor() or platform.machine())


def throughput() -> dict[str, float]:
    """Return the ns of a square root and a division in cache, and the ns a byte from memory.

    >>> sorted(throughput())
    ['byte', 'divide', 'sqrt']
    """
    x, y = np.full(_INNER, 1.5), np.empty(_INNER)
    many, copy = np.ones(_OUTER), np.ones(_OUTER)
    return {
        "sqrt": _least_ns(partial(np.sqrt, x, out=y), 200) / _INNER,
        "divide": _least_ns(partial(np.divide, x, x, out=y), 200) / _INNER,
        # A copy reads and writes every byte once.
        "byte": _least_ns(partial(np.copyto, copy, many)) / (2 * many.nbytes),
    }


def _least_ns(action: Callable[[], Any], calls: int = 1) -> float:
    return 1e9 * min(seconds_of(action, calls) for _ in range(9))


def limits(numbers: int, counts: Mapping[str, int]) -> dict[str, float]:
    """Return the least ns a path: its roots and divisions, and its numbers in and out."""
    unit = throughput()
    results = {
        "sqrt and division": sum(counts.get(name, 0) * unit[name] for name in ("sqrt", "divide")),
        "memory": 8 * numbers * unit["byte"],
    }
    return {name: ns for name, ns in results.items() if ns > 0.0}
