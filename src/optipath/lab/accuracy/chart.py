"""The chart of speed against accuracy, as data: measured here, drawn elsewhere."""

from __future__ import annotations

import platform
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.composer import Composer
from optipath.errors import ComposerError, ParameterError
from optipath.kernels.catalogue import REFLECTION
from optipath.lab.accuracy.chart_effort import FULL, Effort
from optipath.lab.accuracy.chart_file import FORMAT, KINDS
from optipath.lab.accuracy.contenders import WORDS, contenders
from optipath.lab.accuracy.error_measures import LIMIT, Errors
from optipath.lab.accuracy.interface_errors import interface_errors, matrix_numbers
from optipath.lab.accuracy.machine import limits, processor
from optipath.lab.accuracy.many_paths import many_paths
from optipath.lab.accuracy.path_errors import path_errors, trials, worst_and_median
from optipath.lab.accuracy.region_path import interfaces
from optipath.lab.accuracy.regions import REGIONS
from optipath.lab.accuracy.slow_operations import kernel_operations, slow_operations
from optipath.lab.bench.report import software
from optipath.lab.bench.timing import seconds_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from typing import TypeAlias

    from optipath.paths.path_graph import PathGraph

    Progress: TypeAlias = Callable[[str, float], object]
    Keep: TypeAlias = Callable[[dict[str, Any]], object]

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
    _refuse_batches(path)
    runners = _different(path, effort)
    graph, values = many_paths(path, PATHS)
    found = [_entry(runner) for runner in runners]
    progress("composing and compiling", 0.0)
    plans = [runner.compose(graph) for runner in runners]
    _time(found, [partial(plan.run_all, **values) for plan in plans], effort, progress)
    program = Composer(engine="numpy").compose(graph).program
    given, _ = plans[0].inputs.resolve(values)
    arrays = sum(operand.numbers(given).size > 1 for operand in program.operands)
    least = limits(arrays + 4 * len(program.readings), slow_operations(program))
    words = {name: p.text(p.default) for name, p in path.parameters.items()}
    made = {"parameters": words, **_chart(title, found, least, effort)}
    # Longdouble is given the numbers of float64, and so has its references.
    rounded = {"float64": "float64", "float32": "float32", "longdouble": "float64"}
    dtypes = dict.fromkeys(rounded[runner.dtype] for runner in runners)
    count = 1 + len(REGIONS) * bool(interfaces(path))
    drawn = [trials(path, REGIONS, dtype, effort.samples) for dtype in dtypes]
    for number in range(count):
        name = "the path as given" if number == 0 else REGIONS[number - 1].name
        progress(f"errors, {name}", _TIMED + (1 - _TIMED) * number / count)
        tests = dict(zip(dtypes, map(next, drawn), strict=True))
        for runner, entry in zip(runners, found, strict=True):
            trial = tests[rounded[runner.dtype]]
            _add(entry, trial.region, path_errors(runner, trial, runner.dtype))
        keep({**made, "regions": {"measured": number + 1, "of": count}})
    return {**made, "regions": {"measured": count, "of": count}}


def interface_chart(
    effort: Effort = FULL, progress: Progress = lambda *_: None, keep: Keep = lambda _: None
) -> dict[str, Any]:
    """Measure every way to compute (A, B, C, S) of one interface."""
    runners = contenders(("stokes",), ("numpy",))
    found, actions = [_entry(runner) for runner in runners], []
    for runner in runners:
        samples = REGIONS[0].samples(PATHS, runner.dtype)
        actions.append(partial(matrix_numbers, REFLECTION.by_method(runner.method), samples))
    _time(found, actions, effort, progress)
    least = limits(4 + 4, kernel_operations(REFLECTION.by_method("stable"), 5))
    made = _chart("one interface", found, least, effort)
    count = len(REGIONS)
    for number, region in enumerate(REGIONS):
        progress(f"errors, {region.name}", _TIMED + (1 - _TIMED) * number / count)
        for runner, entry in zip(runners, found, strict=True):
            off = interface_errors(runner.method, region, runner.dtype, effort.samples)
            _add(entry, region.name, off)
        keep({**made, "regions": {"measured": number + 1, "of": count}})
    return {**made, "regions": {"measured": count, "of": count}}


def _refuse_batches(path: PathGraph) -> None:
    _, batch = path.compose().inputs.resolve({})
    if batch:
        raise ParameterError(
            f"a chart is of one path, and this is a batch of shape {batch}; give single values"
        )


def _different(path: PathGraph, effort: Effort) -> list[Composer]:
    """Return the contenders that can compute a path, and each computation once."""
    found: dict[Any, Composer] = {}
    for runner in filter(effort.measures, contenders(engines=effort.engines)):
        try:
            runner.compose(path)
            # Whether it can run is told without waiting for what compiles.
            plan = replace(runner, engine="numpy").compose(path)
            plan.run_all()
        except (ComposerError, ParameterError):
            continue
        kernels = tuple(evaluation.kernel for evaluation in plan.program.evaluations)
        found.setdefault((kernels, runner.dtype, runner.engine, runner.composing), runner)
    return list(found.values())


def _entry(runner: Composer) -> dict[str, Any]:
    return {
        **{word: getattr(runner, word) for word in WORDS},
        "eps": float(np.finfo(runner.dtype).eps),
        "errors": {kind: {} for kind in KINDS},
    }


def _add(entry: dict[str, Any], region: str, off: Errors) -> None:
    for kind in KINDS:
        entry["errors"][kind][region] = worst_and_median(getattr(off, kind))


def _time(
    entries: list[dict[str, Any]],
    actions: Sequence[Callable[[], Any]],
    effort: Effort,
    progress: Progress,
) -> None:
    """Time the actions in turn, so that what disturbs one disturbs all."""
    for number, action in enumerate(actions):
        progress("composing and compiling", 0.9 * _TIMED * number / len(actions))
        action()
    turns = []
    for turn in range(effort.rounds):
        progress("times", _TIMED * (0.9 + 0.1 * turn / effort.rounds))
        turns.append([seconds_of(action) * 1e9 / PATHS for action in actions])
    for entry, taken in zip(entries, zip(*turns, strict=True), strict=True):
        entry["ns"] = {"least": min(taken), "median": float(np.median(taken))}


def _chart(
    title: str, found: list[dict[str, Any]], least: Mapping[str, float], effort: Effort
) -> dict[str, Any]:
    return {
        "format": FORMAT,
        "title": title,
        "contenders": found,
        "limits_ns": dict(least),
        "fails_above": LIMIT,
        "paths": PATHS,
        "effort": effort.told(),
        "machine": {
            "system": platform.system(),
            "processor": platform.machine(),
            "model": processor(),
        },
        "versions": software(["numpy"]),
    }
