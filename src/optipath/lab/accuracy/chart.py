"""The chart of speed against accuracy, as data: measured here, drawn elsewhere."""

from __future__ import annotations

import platform
from functools import partial
from itertools import count
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.composer.composer import Composer
from optipath.errors import ComposerError, ParameterError
from optipath.kernels.catalogue import REFLECTION
from optipath.lab.accuracy.chart_file import FORMAT
from optipath.lab.accuracy.contenders import WORDS, available_dtypes, contenders
from optipath.lab.accuracy.error_measures import LIMIT, Errors
from optipath.lab.accuracy.interface_errors import interface_errors, matrix_numbers
from optipath.lab.accuracy.machine import limits
from optipath.lab.accuracy.many_paths import many_paths
from optipath.lab.accuracy.path_errors import path_errors, trials, worst_and_median
from optipath.lab.accuracy.regions import REGIONS
from optipath.lab.accuracy.slow_operations import kernel_operations, slow_operations
from optipath.lab.bench.report import software
from optipath.lab.bench.timing import seconds_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from optipath.paths.path_graph import PathGraph

PATHS = 4096


class Effort(NamedTuple):
    """How much is measured.

    Attributes
    ----------
    samples : int
        How many a region has.
    rounds : int
        How often each contender is timed.
    engines : tuple of str
        Which are measured.
    """

    samples: int = 24
    rounds: int = 7
    engines: tuple[str, ...] = ("numpy", "numba")


_USUAL = Effort()


def path_chart(
    path: PathGraph,
    title: str,
    effort: Effort = _USUAL,
    progress: Callable[[str, float], object] = lambda *_: None,
) -> dict[str, Any]:
    """Measure every way to compute a path.

    Parameters
    ----------
    path : PathGraph
        All its parameters have values or defaults.
    title : str
        What is measured.
    effort : Effort, optional
        How much is measured.
    progress : callable, optional
        Is told what is being done, and how much of the whole is done.

    Returns
    -------
    dict
        What `draw` draws, ready to be written as JSON.
    """
    _refuse_batches(path)
    runners = _different(path, effort.engines)
    # Longdouble is given the numbers of float64, and so has its references.
    rounded = {"float64": "float64", "float32": "float32", "longdouble": "float64"}
    drawn = dict.fromkeys(rounded[dtype] for dtype in available_dtypes())
    done = count(1)

    def tick() -> None:
        progress("50-digit references", 0.6 * next(done) / (len(drawn) * (len(REGIONS) + 1)))

    tests = {dtype: trials(path, REGIONS, dtype, effort.samples, tick) for dtype in drawn}
    found = []
    for number, runner in enumerate(runners):
        progress("errors", 0.6 + 0.2 * number / len(runners))
        off = {
            trial.region: path_errors(runner, trial, runner.dtype)
            for trial in tests[rounded[runner.dtype]]
        }
        found.append(_entry(runner, off))
    graph, values = many_paths(path, PATHS)
    plans = [runner.compose(graph) for runner in runners]
    _time(found, [partial(plan.run_all, **values) for plan in plans], effort, progress)
    program = Composer(engine="numpy").compose(graph).program
    given, _ = plans[0].inputs.resolve(values)
    arrays = sum(operand.numbers(given).size > 1 for operand in program.operands)
    least = limits(arrays + 4 * len(program.readings), slow_operations(program))
    words = {name: p.text(p.default) for name, p in path.parameters.items()}
    return {"parameters": words, **_chart(title, found, least)}


def interface_chart(
    effort: Effort = _USUAL, progress: Callable[[str, float], object] = lambda *_: None
) -> dict[str, Any]:
    """Measure every way to compute (A, B, C, S) of one interface.

    Parameters
    ----------
    effort, progress
        As for `path_chart`.

    Returns
    -------
    dict
        What `draw` draws.
    """
    runners = contenders(("stokes",), ("numpy",))
    found, actions = [], []
    for number, runner in enumerate(runners):
        progress("50-digit references and errors", 0.8 * number / len(runners))
        off = {
            region.name: interface_errors(runner.method, region, runner.dtype, effort.samples)
            for region in REGIONS
        }
        found.append(_entry(runner, off))
        samples = REGIONS[0].samples(PATHS, runner.dtype)
        actions.append(partial(matrix_numbers, REFLECTION.by_method(runner.method), samples))
    _time(found, actions, effort, progress)
    least = limits(4 + 4, kernel_operations(REFLECTION.by_method("stable"), 5))
    return _chart("one interface", found, least)


def _refuse_batches(path: PathGraph) -> None:
    _, batch = path.compose().inputs.resolve({})
    if batch:
        raise ParameterError(
            f"a chart is of one path, and this is a batch of shape {batch}; give single values"
        )


def _different(path: PathGraph, engines: tuple[str, ...]) -> list[Composer]:
    """Return the contenders that can compute a path, and each computation once."""
    found: dict[Any, Composer] = {}
    for runner in contenders(engines=engines):
        try:
            plan = runner.compose(path)
            plan.run_all()
        except (ComposerError, ParameterError):
            continue
        kernels = tuple(evaluation.kernel for evaluation in plan.program.evaluations)
        found.setdefault((kernels, runner.dtype, runner.engine, runner.composing), runner)
    return list(found.values())


def _entry(runner: Composer, off: Mapping[str, Errors]) -> dict[str, Any]:
    return {
        **{word: getattr(runner, word) for word in WORDS},
        "eps": float(np.finfo(runner.dtype).eps),
        "errors": {
            kind: {region: worst_and_median(getattr(e, kind)) for region, e in off.items()}
            for kind in Errors._fields
        },
    }


def _time(
    entries: list[dict[str, Any]],
    actions: Sequence[Callable[[], Any]],
    effort: Effort,
    progress: Callable[[str, float], object],
) -> None:
    """Time the actions in turn, so that what disturbs one disturbs all."""
    for action in actions:
        action()
    turns = []
    for turn in range(effort.rounds):
        progress("times", 0.8 + 0.2 * turn / effort.rounds)
        turns.append([seconds_of(action) * 1e9 / PATHS for action in actions])
    for entry, taken in zip(entries, zip(*turns, strict=True), strict=True):
        entry["ns"] = {"least": min(taken), "median": float(np.median(taken))}


def _chart(title: str, found: list[dict[str, Any]], least: Mapping[str, float]) -> dict[str, Any]:
    return {
        "format": FORMAT,
        "title": title,
        "contenders": found,
        "limits_ns": dict(least),
        "fails_above": LIMIT,
        "paths": PATHS,
        "machine": {"system": platform.system(), "processor": platform.machine()},
        "versions": software(["numpy"]),
    }
