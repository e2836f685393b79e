"""Charts and races as JSON: what was measured before, and the times of other software."""

from __future__ import annotations

import json
from collections.abc import Mapping
from itertools import product
from math import isfinite
from typing import Any, NamedTuple

import numpy as np

from optipath.composer.composer import CHOICES, Composer
from optipath.engines.choice import is_installed
from optipath.errors import OptipathError
from optipath.faults import shown
from optipath.kernels.catalog import METHODS
from optipath.lab.bench import processor
from optipath.values.precision import DTYPES

FORMAT = 1

CRITICAL = "errors next to critical places"
"""What a chart says that it is of, if not of speed against accuracy."""

KINDS = ("componentwise", "normwise")
"""Of errors: the fields of `Errors`, which needs mpmath; a picture is drawn without."""


def chart_text(chart: Mapping[str, Any]) -> str:
    """Return a chart as JSON, which has no infinity: an infinite error is null."""
    return json.dumps(_written(chart), indent=1, allow_nan=False) + "\n"


def read_chart(text: str, name: str) -> dict[str, Any]:
    """Return a chart that was written as JSON."""
    return checked_chart(_loaded(text, _with_infinities), f"'{name}'")


def _loaded(text: str, hook: Any = None) -> Any:
    """Return what is written as JSON; None where nothing is."""
    try:
        return json.loads(text, object_hook=hook)
    except (ValueError, RecursionError):
        return None


def checked_chart(chart: Any, name: str) -> dict[str, Any]:
    """Return a chart of this version."""
    known = isinstance(chart, Mapping) and chart.get("format") == FORMAT
    if not known or not (chart.get("contenders") or chart.get("places")):
        cure = "give a file that 'optipath chart --data' wrote"
        raise OptipathError(f"{name} is no chart of this version; {cure}")
    return chart  # type: ignore[no-any-return]


def _with_infinities(entries: dict[str, Any]) -> dict[str, Any]:
    return {name: _infinite(value) for name, value in entries.items()}


def _infinite(value: Any) -> Any:
    if isinstance(value, list):
        return [_infinite(entry) for entry in value]
    return np.inf if value is None else value


def _written(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {name: _written(entry) for name, entry in value.items()}
    if isinstance(value, list):
        return [_written(entry) for entry in value]
    if isinstance(value, float):
        return float(f"{value:.4g}") if np.isfinite(value) else None
    return value


WORDS = ("method", "dtype", "engine", "composing")
"""What tells contenders apart, as `Composer` takes it."""


def contenders(
    composing: tuple[Any, ...] = CHOICES["composing"], engines: Any = ("numpy", "numba")
) -> list[Composer]:
    """Return all that this machine can run, but JAX, which compiles anew for every path.

    >>> Composer("stable", engine="numpy", composing="jones") in contenders()
    True
    """
    has_longdouble = np.finfo(np.longdouble).eps < np.finfo(np.float64).eps
    dtypes = [dtype for dtype in DTYPES if dtype != "longdouble" or has_longdouble]
    return [
        Composer(method, dtype=dtype, engine=engine, composing=way)
        for method, dtype, engine, way in product(METHODS, dtypes, engines, composing)
        if engine == "numpy" or (is_installed(engine) and dtype != "longdouble")
    ]


_SHARED = {"optipath, numba": "numba", "optipath, numpy": "numpy"}
"""Who is in both: the name in a race, and the engine in a chart."""


class Racer(NamedTuple):
    """Who took part in a race, and whether it is optipath."""

    name: str
    ns: float
    error: float
    is_own: bool


class PeerTimes(NamedTuple):
    """A race beside a chart."""

    racers: tuple[Racer, ...]
    shared: str
    ratio: float


def check_race(text: str, name: str) -> None:
    """Refuse what is no race of this machine, before a chart is measured for it."""
    _check_same(name, {"processor": (_race(text, name)["processor"], processor())})


def peer_times(text: str, name: str, chart: Mapping[str, Any]) -> PeerTimes:
    """Return the times of a race that can be compared with a chart."""
    race, versions = _race(text, name), chart.get("versions", {})
    _check_same(
        name,
        {
            "processor": (race["processor"], chart.get("machine", {}).get("model")),
            **{each: (race["software"].get(each), versions[each]) for each in versions},
            "preset": (race["path"]["preset"], chart["title"].partition(",")[0]),
        },
    )
    values = chart.get("parameters", {})
    for contest in race["contests"].values():
        if all(values.get(key) == str(value) for key, value in contest["path"].items()):
            break
    else:
        raise OptipathError(f"'{name}' has no race of the values of the chart")
    times = {entry["contender"]: float(entry["least"]) for entry in contest["results"]}
    for shared, engine in _SHARED.items():
        way = {"method": "stable", "dtype": "float64", "composing": "stokes", "engine": engine}
        own = [entry for entry in chart["contenders"] if way.items() <= entry.items()]
        if own and shared in times:
            ratio = own[0]["ns"]["least"] / times[shared]
            racers = tuple([_racer(entry, ratio) for entry in contest["results"]])
            return PeerTimes(racers, shared, ratio)
    cure = "measure the chart with engine numpy or numba in float64"
    raise OptipathError(f"'{name}' and the chart share no contender; {cure}")


def _race(text: str, name: str) -> Any:
    race = _loaded(text)
    if not isinstance(race, dict) or not {"processor", "software", "path", "contests"} <= {*race}:
        cure = "give a file that 'benchmarks/peers/race.py --json' wrote"
        raise OptipathError(f"'{name}' is no race; {cure}")
    return race


def _check_same(name: str, pairs: Mapping[str, tuple[Any, Any]]) -> None:
    """Refuse what differs between a race and a chart."""
    faults = [
        f"the {what} of '{name}' is {shown(raced)}, and that of the chart {shown(charted)}; run "
        f"the race and the chart on one machine, one after the other"
        for what, (raced, charted) in pairs.items()
        if raced != charted
    ]
    OptipathError.raise_for(faults)


def _racer(entry: Mapping[str, Any], ratio: float) -> Racer:
    error = float(entry["error"])  # One of which no digit is right may be NaN.
    error = min(max(error, 1e-20), 1.0) if isfinite(error) else 1.0
    name = entry["contender"]
    return Racer(name, float(entry["least"]) * ratio, error, name.split(",")[0] == "optipath")
