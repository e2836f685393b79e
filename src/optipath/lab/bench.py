"""Bench: the report on a path's speed, timings of contenders that take turns, this machine."""

from __future__ import annotations

import platform
import subprocess
import sys
from functools import cache, partial
from importlib.metadata import PackageNotFoundError, version
from itertools import product
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.composer.composer import Composer
from optipath.engines.choice import ENGINES, is_installed
from optipath.errors import ParameterError
from optipath.kernels.catalog import METHODS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan


_DTYPES = ("float64", "float32")
_OUTPUTS = ("stokes", "mueller")
_BATCH = ("engine", "dtype", "output", "paths")
_COMPARED = 100_000
_STATEMENTS = {
    # What is imported is loaded as it is asked for first, so that an import alone says little.
    "import optipath, run a path": "from optipath import Detector, Source; "
    "(Source() >> Detector()).trace()",
    "import numpy, networkx": "import numpy, networkx",
}


class Report(NamedTuple):
    """How long a path takes: single calls in ms, batches in ns a path."""

    single: dict[str, float]
    batches: list[dict[str, Any]]
    methods: list[dict[str, Any]]
    software: dict[str, str]


def bench(
    path: PathGraph,
    load: Callable[[], object],
    *,
    largest: int = _COMPARED,
    long: bool = False,
    engines: Iterable[str] = (),
    threads: int = 1,
    progress: Callable[[str], object] = lambda _: None,
) -> Report:
    """Measure a path."""
    result = [*engines] or [name for name in ENGINES if name != "auto" and is_installed(name)]

    @cache
    def plan_of(engine: Any, dtype: Any, method: Any) -> Plan:
        # Kept, so that nothing is compiled for one batch after the other.
        return Composer(engine=engine, dtype=dtype, method=method, threads=threads).compose(path)

    plan = Composer().compose(path)
    one = {name: float(value[0]) for name, value in random_values(plan, 1).items()}
    single: dict[str, Callable[[], object]] = {
        "load": load,
        "compose": partial(Composer().compose, path),
        "one run of plain floats": partial(plan.run_all, **one),
    }
    for name, statement in _STATEMENTS.items():
        single[name] = partial(subprocess.run, [sys.executable, "-c", statement], check=True)
    timings = race(single, tick=progress)
    kinds = slice(None if long else 1)
    # First, since their first calls tell how long they take to be compiled.
    compared = product(result, METHODS[kinds], [min(_COMPARED, largest)])
    methods = _timed(plan_of, ("engine", "method", "paths"), compared, progress)
    tens, batches = [10**power for power in range(len(str(largest)))], []
    for size in tens if long else sorted({max(1, largest // 100), largest}):
        each = product(result, _DTYPES[kinds], _OUTPUTS[kinds], [size])
        batches += _timed(plan_of, _BATCH, each, progress)
    single_ms = {name: 1e3 * timing.least for name, timing in timings.items()}
    return Report(single_ms, batches, methods, software(("numpy", "networkx", *result)))


def software(names: Iterable[str]) -> dict[str, str]:
    """Return the versions of Python, the library, and packages."""
    results = {"python": platform.python_version()}
    for name in ("optipath", *names):
        try:
            results[name] = version(name)
        except PackageNotFoundError:
            continue
    return results


def _timed(
    plan_of: Callable[..., Plan],
    labels: tuple[str, ...],
    choices: Iterable[tuple[Any, ...]],
    progress: Callable[[str], object],
) -> list[dict[str, Any]]:
    runs = {", ".join(map(str, each)): dict(zip(labels, each, strict=True)) for each in choices}
    contenders: dict[str, Callable[[], object]] = {}
    for name, run in runs.items():
        plan = plan_of(run["engine"], run.get("dtype", "float64"), run.get("method", "stable"))
        values = random_values(plan, run["paths"])
        values = {name: value.astype(plan.dtype) for name, value in values.items()}
        action: Callable[..., object] = plan.run_all
        if run.get("output") == "mueller":
            ends = next(iter(plan.whole.sources)), next(iter(plan.whole.readings))
            action = partial(plan.mueller, *ends)
        contenders[name] = partial(_finished, action, values)
    return [
        {
            **runs[name],
            "ns_least": 1e9 * timing.least / runs[name]["paths"],
            "ns_median": 1e9 * timing.middle / runs[name]["paths"],
            "first_s": timing.first,
        }
        for name, timing in race(contenders, tick=progress).items()
    ]


def _finished(run: Callable[..., Any], values: dict[str, Any]) -> None:
    """Run, and wait for engines that answer before they are done."""
    result = run(**values)
    for light in result.values() if isinstance(result, dict) else [result]:
        numbers = light.matrix if hasattr(light, "matrix") else light.stokes
        getattr(numbers, "block_until_ready", bool)()


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
