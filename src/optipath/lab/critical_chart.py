"""How the error of each method grows next to the places where it fails, as data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.composer import Composer
from optipath.errors import ComposerError, OptipathError
from optipath.kernels.catalog import METHODS
from optipath.lab.bench import software
from optipath.lab.chart_file import CRITICAL, FORMAT, KINDS
from optipath.lab.errors import LIMIT, interface_errors, path_errors, trial, worst_and_median
from optipath.lab.regions import interfaces, places_called

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import TypeAlias

    from optipath.lab.errors import Errors
    from optipath.lab.regions import CriticalPlace
    from optipath.paths.path_graph import PathGraph

    Measured: TypeAlias = Callable[[CriticalPlace, float], dict[str, Errors]]


DTYPE = "float64"
DISTANCES = tuple(float(10.0**power) for power in np.arange(-12, -0.75, 0.5))
"""In radians, from 1e-12 to 1e-1: nearer than that float64 has no angles of its own."""

SAMPLES = 8


def critical_chart(
    path: PathGraph | None,
    title: str,
    places: Sequence[str],
    samples: int = SAMPLES,
    progress: Callable[[str, float], object] = lambda *_: None,
    keep: Callable[[dict[str, Any]], object] = lambda _: None,
) -> dict[str, Any]:
    """Measure every method at each of many distances from places where some fail.

    In float64, NumPy and Stokes vectors; media and sides are drawn at random.
    """
    wanted = places_called(places)
    measured = _of_interface(samples) if path is None else _of_path(path, title, samples)
    results: list[dict[str, Any]] = []
    made = {
        "format": FORMAT,
        "drawn": CRITICAL,
        "title": title,
        "dtype": DTYPE,
        "eps": float(np.finfo(DTYPE).eps),
        "samples": samples,
        "fails_above": LIMIT,
        "places": results,
        "versions": software(["numpy"]),
    }
    total = len(wanted) * len(DISTANCES)
    for number, place in enumerate(wanted):
        entry: dict[str, Any] = {"name": place.name, "called": place.called, "distances": []}
        entry["errors"] = {}
        results.append(entry)
        # From afar, where nothing fails yet.
        for step, distance in enumerate(reversed(DISTANCES)):
            progress(f"near {place.called}", (number * len(DISTANCES) + step) / total)
            off = measured(place, distance)
            entry["distances"].append(distance)
            for method, errors in off.items():
                own = entry["errors"].setdefault(method, {kind: [] for kind in KINDS})
                for kind in KINDS:
                    own[kind].append(worst_and_median(getattr(errors, kind))["worst"])
            done = number * len(DISTANCES) + step + 1
            keep({**made, "regions": {"measured": done, "of": total}})
    return made


def _of_interface(samples: int) -> Measured:
    def measured(place: CriticalPlace, distance: float) -> dict[str, Errors]:
        region = place.region(distance)
        # As on a path: where S is exactly 0, its error is told over A.
        keywords: Any = {"count": samples, "against_first": True}
        return {name: interface_errors(name, region, DTYPE, **keywords) for name in METHODS}

    return measured


def _of_path(path: PathGraph, title: str, samples: int) -> Measured:
    if not interfaces(path):
        raise OptipathError(
            f"'{title}' has no interface that can be put near an angle; chart one that has, or "
            f"one interface alone with --interface"
        )
    runners = {}
    for method in METHODS:
        runner = Composer(method, dtype=DTYPE, engine="numpy", composing="stokes")
        try:
            runner.compose(path)
        except ComposerError:
            continue
        runners[method] = runner

    def measured(place: CriticalPlace, distance: float) -> dict[str, Errors]:
        there = trial(path, place.region(distance), DTYPE, samples)
        return {name: path_errors(runner, there, DTYPE) for name, runner in runners.items()}

    return measured
