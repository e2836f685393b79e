"""Charts: speed against accuracy, and errors next to critical places."""

from __future__ import annotations

import platform
from collections import Counter
from contextlib import suppress
from dataclasses import replace
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.composer.composer import Composer
from optipath.composer.path_values import Values
from optipath.elements.ends import Source
from optipath.engines.symbols import SYMBOLIC, Recorder
from optipath.errors import ComposerError, OptipathError, ParameterError
from optipath.kernels.catalog import METHODS, REFLECTION
from optipath.lab.bench import limits, processor, seconds_of, software
from optipath.lab.chart_file import CRITICAL, FORMAT, KINDS, WORDS, contenders
from optipath.lab.errors import (
    AS_PASSED,
    LIMIT,
    Errors,
    interface_errors,
    matrix_numbers,
    path_errors,
    trial,
    worst_and_median,
)
from optipath.lab.regions import REGIONS, in_region, interfaces, places_called

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from typing import TypeAlias

    import networkx as nx

    from optipath.kernels.kernel import Kernel
    from optipath.lab.regions import Region
    from optipath.paths.path_graph import PathGraph

    Progress: TypeAlias = Callable[[str, float], object]
    Keep: TypeAlias = Callable[[dict[str, Any]], object]
    Run: TypeAlias = tuple[Composer, Callable[[], Any]]


class Effort(NamedTuple):
    """How much is measured."""

    samples: int = 24
    rounds: int = 7
    engines: tuple[str, ...] = ("numpy", "numba")
    compiles_all: bool = True

    def measures(self, runner: Composer) -> bool:
        """Tell whether a contender is measured."""
        usual = (runner.method, runner.composing, runner.dtype) == ("stable", "stokes", "float64")
        return runner.engine == "numpy" or self.compiles_all or usual

    def told(self) -> dict[str, Any]:
        """Return what a chart says of it: the numbers, and a sentence of what is left out."""
        left_out = "of Numba only stable in float64 with Stokes vectors"
        some = not self.compiles_all and "numba" in self.engines
        return {"samples": self.samples, "rounds": self.rounds, "left_out": left_out * some}


FULL = Effort()
QUICK = Effort(samples=3, rounds=3, compiles_all=False)
"""Less than a minute for a path of some elements."""


def expected(effort: Effort) -> str:
    """Return about how long a chart of a path of some elements takes, before it is measured.

    >>> expected(QUICK)
    'this takes less than a minute, more on a busy machine'
    >>> print(expected(FULL._replace(engines=("numpy",))))
    this takes about 2 minutes; --quick takes less than one
    """
    if not effort.compiles_all:
        return "this takes less than a minute, more on a busy machine"
    minutes = round((20.0 + 4.0 * effort.samples) / 60)
    wait = ", and longer where Numba must compile" if "numba" in effort.engines else ""
    return f"this takes about {minutes} minutes{wait}; --quick takes less than one"


PATHS = 4096

_TIMED = 0.3
"""The share of the progress that times are; what is left are errors."""


def path_chart(
    path: PathGraph,
    title: str,
    effort: Effort = FULL,
    progress: Progress = lambda *_: None,
    keep: Keep = lambda _: None,
) -> dict[str, Any]:
    """Measure every way to compute a path: first the times, then region after region."""
    if batch := path.compose().inputs.resolve({})[1]:
        raise ParameterError(f"a chart has one path, no batch of shape {batch}; give single values")
    runners = _different(path, effort)
    graph, values = many_paths(path, PATHS)
    progress("composing and compiling", 0.0)
    plans = [runner.compose(graph) for runner in runners]
    argument, _ = plans[0].inputs.resolve(values)
    plan = Composer(engine="numpy").compose(graph)
    arrays = sum(operand.numbers(argument).size > 1 for operand in plan.program.operands)
    counts = (plan.explanation().operations or {}).get("plan", {})
    least = limits(arrays + 4 * len(plan.program.readings), counts)
    # Longdouble is given the numbers of float64, and so has its references.
    rounded = {"float64": "float64", "float32": "float32", "longdouble": "float64"}
    of_region = lru_cache(maxsize=len(rounded))(partial(trial, path, count=effort.samples))

    def off(runner: Composer, region: Region | None) -> Errors:
        return path_errors(runner, of_region(region, rounded[str(runner.dtype)]), str(runner.dtype))

    runs = [
        (runner, partial(p.run_all, **values)) for runner, p in zip(runners, plans, strict=True)
    ]
    regions = {AS_PASSED: None, **{r.name: r for r in REGIONS if interfaces(path)}}
    parameters = {name: p.text(p.default) for name, p in path.parameters.items()}
    return _chart(
        {"parameters": parameters}, title, effort, runs, least, regions, off, progress, keep
    )


def interface_chart(
    effort: Effort = FULL, progress: Progress = lambda *_: None, keep: Keep = lambda _: None
) -> dict[str, Any]:
    """Measure every way to compute (A, B, C, S) of one interface."""
    runs: list[Run] = []
    for runner in contenders(("stokes",), ("numpy",)):
        kernel = REFLECTION.by_method(runner.method)
        samples = REGIONS[0].samples(PATHS, str(runner.dtype))
        runs.append((runner, partial(matrix_numbers, kernel, samples)))
    least = limits(4 + 4, kernel_operations(REFLECTION.by_method("stable"), 5))

    def off(runner: Composer, region: Region) -> Errors:
        return interface_errors(runner.method, region, str(runner.dtype), effort.samples)

    regions = {region.name: region for region in REGIONS}
    return _chart({}, "one interface", effort, runs, least, regions, off, progress, keep)


def _different(path: PathGraph, effort: Effort) -> list[Composer]:
    """Return the contenders that can compute a path, and each computation once."""
    results: dict[Any, Composer] = {}
    for runner in filter(effort.measures, contenders(engines=effort.engines)):
        try:
            runner.compose(path)
            # Whether it can run is told without waiting for what compiles.
            plan = replace(runner, engine="numpy").compose(path)
            plan.run_all()
        except (ComposerError, ParameterError):
            continue
        kernels = tuple(evaluation.kernel for evaluation in plan.program.evaluations)
        results.setdefault((kernels, runner.dtype, runner.engine, runner.composing), runner)
    return list(results.values())


def _chart(
    made: dict[str, Any],
    title: str,
    effort: Effort,
    runs: Sequence[Run],
    least: Mapping[str, float],
    regions: Mapping[str, Any],
    off: Callable[[Composer, Any], Errors],
    progress: Progress,
    keep: Keep,
) -> dict[str, Any]:
    """Add to a chart the times of all contenders, and their errors, kept region after region."""
    entries: list[dict[str, Any]] = [
        {
            **{word: getattr(runner, word) for word in WORDS},
            "eps": float(np.finfo(runner.dtype).eps),
            "errors": {kind: {} for kind in KINDS},
        }
        for runner, _ in runs
    ]
    for number, (_, action) in enumerate(runs):
        progress("composing and compiling", 0.9 * _TIMED * number / len(runs))
        action()
    turns = []
    for turn in range(effort.rounds):
        progress("times", _TIMED * (0.9 + 0.1 * turn / effort.rounds))
        # In turn, so that what disturbs one disturbs all.
        turns.append([seconds_of(action) * 1e9 / PATHS for _, action in runs])
    for entry, taken in zip(entries, zip(*turns, strict=True), strict=True):
        entry["ns"] = {"least": min(taken), "median": float(np.median(taken))}
    machine = {"system": platform.system(), "processor": platform.machine(), "model": processor()}
    made |= {
        "format": FORMAT,
        "title": title,
        "contenders": entries,
        "limits_ns": dict(least),
        "fails_above": LIMIT,
        "paths": PATHS,
        "effort": effort.told(),
        "machine": machine,
        "versions": software(["numpy"]),
    }
    for number, (name, region) in enumerate(regions.items()):
        progress(f"errors, {name}", _TIMED + (1 - _TIMED) * number / len(regions))
        for (runner, _), entry in zip(runs, entries, strict=True):
            errors = off(runner, region)
            for kind in KINDS:
                entry["errors"][kind][name] = worst_and_median(getattr(errors, kind))
        made["regions"] = {"measured": number + 1, "of": len(regions)}
        keep(made)
    return made


def many_paths(path: PathGraph, count: int) -> tuple[nx.MultiDiGraph, dict[str, Any]]:
    """Return a graph, and values of its parameters, that make a batch of a path.

    Interfaces are drawn from the generic region; the rest, and source intensities, are repeated.

    >>> import optipath as op
    >>> graph, values = many_paths(op.load_preset("malus"), 7)
    >>> values["angle"].shape
    (7,)
    """
    graph = in_region(path, REGIONS[0], count, "float64")
    for _, node in graph.nodes(data=True):
        element = node["element"]
        if isinstance(element, Source) and isinstance(element.intensity, (int, float)):
            node["element"] = replace(element, intensity=np.full(count, float(element.intensity)))
    values = {}
    for name, parameter in Values(graph).inputs().open.items():
        resolved = parameter.resolve(parameter.default)
        if np.all(resolved.present) and resolved.value.ndim == 0:
            values[name] = np.full(count, resolved.value)
    return graph, values


def kernel_operations(kernel: Kernel, arguments: int) -> Counter[str]:
    """Return how many operations of each sort one evaluation of a kernel takes.

    >>> kernel_operations(REFLECTION.by_method("stable"), 5)["sqrt"]
    2
    """
    recorder = Recorder(np.dtype("float64"))
    # Not made_for, which would keep what is made for these primitives, used once.
    kernel.factory(SYMBOLIC)(*map(recorder.input, map(str, range(arguments))))
    return Counter(symbol.operation for symbol in recorder.symbols)


DTYPE: Any = "float64"
DISTANCES = tuple(float(10.0**power) for power in np.arange(-12, -0.75, 0.5))
"""In radians, from 1e-12 to 1e-1: nearer than that float64 has no angles of its own."""

SAMPLES = 8


def critical_chart(
    path: PathGraph | None,
    title: str,
    places: Sequence[str],
    samples: int = SAMPLES,
    progress: Progress = lambda *_: None,
    keep: Keep = lambda _: None,
) -> dict[str, Any]:
    """Measure every method (float64, NumPy, Stokes) at many distances from critical places."""
    wanted = places_called(places)
    measured = _of_interface(samples) if path is None else _of_path(path, title, samples)
    entries: list[dict[str, Any]] = []
    made: dict[str, Any] = {
        "format": FORMAT,
        "drawn": CRITICAL,
        "title": title,
        "dtype": DTYPE,
        "eps": float(np.finfo(DTYPE).eps),
        "samples": samples,
        "fails_above": LIMIT,
        "places": entries,
        "versions": software(["numpy"]),
    }
    total, done = len(wanted) * len(DISTANCES), 0
    for place in wanted:
        entries.append({"name": place.name, "called": place.called, "distances": [], "errors": {}})
        # From afar, where nothing fails yet.
        for distance in reversed(DISTANCES):
            progress(f"near {place.called}", done / total)
            off = measured(place.region(distance))
            entries[-1]["distances"].append(distance)
            for method, errors in off.items():
                own = entries[-1]["errors"].setdefault(method, {kind: [] for kind in KINDS})
                for kind in KINDS:
                    own[kind].append(worst_and_median(getattr(errors, kind))["worst"])
            done += 1
            made["regions"] = {"measured": done, "of": total}
            keep(made)
    return made


def _of_interface(samples: int) -> Callable[[Region], dict[str, Errors]]:
    # As on a path: where S is exactly 0, its error is told over A.
    off = partial(interface_errors, dtype=DTYPE, count=samples, against_first=True)
    return lambda region: {name: off(name, region) for name in METHODS}


def _of_path(path: PathGraph, title: str, samples: int) -> Callable[[Region], dict[str, Errors]]:
    if not interfaces(path):
        cure = "chart one that has, or one interface alone with --interface"
        raise OptipathError(f"'{title}' has no interface that can be put near an angle; {cure}")
    runners = {}
    for method in METHODS:
        runner = Composer(method, dtype=DTYPE, engine="numpy", composing="stokes")
        with suppress(ComposerError):
            runner.compose(path)
            runners[method] = runner

    def measured(region: Region) -> dict[str, Errors]:
        there = trial(path, region, DTYPE, samples)
        return {name: path_errors(runner, there, DTYPE) for name, runner in runners.items()}

    return measured
