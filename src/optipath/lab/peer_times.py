"""Times of other software, from a race on the same machine, put on the scale of a chart."""

from __future__ import annotations

import json
from math import isfinite
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.errors import OptipathError, shown
from optipath.lab.bench import processor

if TYPE_CHECKING:
    from collections.abc import Mapping


_SHARED = {"optipath, numba": "numba", "optipath, numpy": "numpy"}
"""Who is in both: the name in a race, and the engine in a chart."""


class Racer(NamedTuple):
    """Who took part in a race."""

    name: str
    ns: float
    error: float

    @property
    def is_own(self) -> bool:
        """Whether it is optipath."""
        return self.name.split(",")[0] == "optipath"


class PeerTimes(NamedTuple):
    """A race beside a chart."""

    racers: tuple[Racer, ...]
    shared: str
    ratio: float


def check_race(text: str, name: str) -> None:
    """Refuse what is no race of this machine, before a chart is measured for it."""
    _check_same(name, {"processor": (_read(text, name)["processor"], processor())})


def peer_times(text: str, name: str, chart: Mapping[str, Any]) -> PeerTimes:
    """Return the times of a race that can be compared with a chart."""
    race, versions = _read(text, name), chart.get("versions", {})
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
    raise OptipathError(
        f"'{name}' and the chart share no contender whose times can be compared; measure the "
        f"chart with engine numpy or numba in float64"
    )


def _read(text: str, name: str) -> Any:
    try:
        race = json.loads(text)
    except (ValueError, RecursionError):
        race = None
    if not isinstance(race, dict) or not {"processor", "software", "path", "contests"} <= {*race}:
        raise OptipathError(
            f"'{name}' is no race; give a file that 'benchmarks/peers/race.py --json' wrote"
        )
    return race


def _check_same(name: str, pairs: Mapping[str, tuple[Any, Any]]) -> None:
    """Refuse what differs between a race and a chart."""
    faults = [
        f"the {what} of '{name}' is {shown(raced)}, and that of the chart {shown(charted)}; run "
        f"the race and the chart on one machine, one after the other"
        for what, (raced, charted) in pairs.items()
        if raced != charted
    ]
    if faults:
        raise OptipathError(*faults)


def _racer(entry: Mapping[str, Any], ratio: float) -> Racer:
    error = float(entry["error"])  # One of which no digit is right may be NaN.
    error = min(max(error, 1e-20), 1.0) if isfinite(error) else 1.0
    return Racer(entry["contender"], float(entry["least"]) * ratio, error)
