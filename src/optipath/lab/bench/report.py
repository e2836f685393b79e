"""The report on a path: one run, batches by every engine, and what comes before them."""

from __future__ import annotations

import platform
import subprocess
import sys
from dataclasses import dataclass, field
from functools import cache, partial
from importlib.metadata import PackageNotFoundError, version
from itertools import product
from typing import TYPE_CHECKING, Any

from optipath.composer.composer import Composer
from optipath.engines.automatic import ENGINES, is_installed
from optipath.engines.known_engines import REGISTRY
from optipath.kernels.catalogue import METHODS
from optipath.lab.bench.random_values import random_values
from optipath.lab.bench.timing import race

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan

_DTYPES = ("float64", "float32")
_OUTPUTS = ("stokes", "mueller")
_BATCH = ("engine", "dtype", "output", "paths")
_COMPARED = 100_000
_FIRST_PATH = "from optipath import Detector, Source; (Source() >> Detector()).trace()"


@dataclass(frozen=True)
class Report:
    """How long a path takes."""

    single: dict[str, float] = field(default_factory=dict)
    batches: list[dict[str, Any]] = field(default_factory=list)
    methods: list[dict[str, Any]] = field(default_factory=list)
    software: dict[str, str] = field(default_factory=dict)


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
    found = [*engines] or [name for name in ENGINES if name != "auto" and is_installed(name)]
    for engine in found:
        if not is_installed(engine):
            raise REGISTRY[engine].missing

    @cache
    def plan_of(engine: str, dtype: str, method: str) -> Plan:
        # Kept, so that nothing is compiled for one batch after the other.
        return Composer(engine=engine, dtype=dtype, method=method, threads=threads).compose(path)

    report = Report(software=software(("numpy", "networkx", *found)))
    plan = Composer().compose(path)
    one = {name: float(value[0]) for name, value in random_values(plan, 1).items()}
    single: dict[str, Callable[[], object]] = {
        "load": load,
        "compose": partial(Composer().compose, path),
        "one run of plain floats": partial(plan.run_all, **one),
        # What is imported is loaded as it is asked for first, so that an import alone says little.
        "import optipath, run a path": _import(_FIRST_PATH),
        "import numpy, networkx": _import("import numpy, networkx"),
    }
    timings = race(single, tick=progress)
    report.single.update({name: 1e3 * timing.least for name, timing in timings.items()})
    kinds = slice(None if long else 1)
    # First, since their first calls tell how long they take to be compiled.
    methods = product(found, METHODS[kinds], [min(_COMPARED, largest)])
    report.methods.extend(_timed(plan_of, ("engine", "method", "paths"), methods, progress))
    tens = [10**power for power in range(len(str(largest)))]
    for size in tens if long else sorted({max(1, largest // 100), largest}):
        batches = product(found, _DTYPES[kinds], _OUTPUTS[kinds], [size])
        report.batches.extend(_timed(plan_of, _BATCH, batches, progress))
    return report


def software(names: Iterable[str]) -> dict[str, str]:
    """Return the versions of Python, the library, and packages."""
    found = {"python": platform.python_version()}
    for name in ("optipath", *names):
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found


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
    found = run(**values)
    for light in found.values() if isinstance(found, dict) else [found]:
        numbers = light.matrix if hasattr(light, "matrix") else light.stokes
        getattr(numbers, "block_until_ready", bool)()


def _import(statement: str) -> Callable[[], object]:
    return partial(subprocess.run, [sys.executable, "-c", statement], check=True)
