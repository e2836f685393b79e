"""Times of other software, from a race on the same machine, put on the scale of a chart."""

from __future__ import annotations

import json
from math import isfinite
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.errors import OptipathError, shown
from optipath.lab.bench import processor
from optipath.lab.chart_file import is_number

if TYPE_CHECKING:
    from collections.abc import Mapping


_CURE = "give a file that 'benchmarks/peers/race.py --json' wrote"
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
    """Refuse what is no race, before a chart is measured for it."""
    race = _read(text, name)
    if race["processor"] != (here := processor()):
        raise OptipathError(
            f"the processor of '{name}' is {_plain_text(race['processor'])}, and this one is "
            f"{_plain_text(here)}; run the race and the chart on one machine, one after the other"
        )


def peer_times(text: str, name: str, chart: Mapping[str, Any]) -> PeerTimes:
    """Return the times of a race that can be compared with a chart."""
    return _compared(_read(text, name), name, chart)


def _read(text: str, name: str) -> Any:
    """Return a race in which everything is there that is compared."""
    try:
        race = json.loads(text)
    except (ValueError, RecursionError):
        raise OptipathError(f"'{name}' is no JSON; {_CURE}") from None
    if not _is_whole(race):
        raise OptipathError(f"'{name}' is no whole race of this version; {_CURE}")
    return race


def _is_whole(race: Any) -> bool:
    try:
        words = [race["processor"], race["path"]["preset"], *race["software"].values()]
        sizes, errors = [], []
        for contest in race["contests"].values():
            words += contest["path"]
            words += [entry["contender"] for entry in contest["results"]]
            sizes += [entry["least"] for entry in contest["results"]]
            errors += [entry["error"] for entry in contest["results"]]
        return bool(
            all(isinstance(word, str) for word in words)
            and sizes
            and all(is_number(size) and 1e-30 < size < 1e30 for size in sizes)
            # One of which no digit is right may be told as NaN.
            and all(is_number(error) and not error < 0 for error in errors)
        )
    except (KeyError, TypeError, AttributeError):
        return False


def _compared(race: Any, name: str, chart: Mapping[str, Any]) -> PeerTimes:
    machine, versions = chart.get("machine", {}), chart.get("versions", {})
    faults = []
    for what, raced, charted in (
        ("the processor", race["processor"], machine.get("model")),
        *((each, race["software"].get(each), versions.get(each)) for each in versions),
        ("the preset", race["path"]["preset"], chart["title"].partition(",")[0]),
    ):
        if raced != charted:
            faults.append(
                f"{what} of '{name}' is {_plain_text(raced)}, and that of the chart "
                f"{_plain_text(charted)}; "
                f"run the race and the chart on one machine, one after the other"
            )
    argument = chart.get("parameters", {})
    results = [
        entry["results"] for entry in race["contests"].values() if _is_of(entry["path"], argument)
    ]
    if not results and not faults:
        raced = " or ".join(
            ", ".join(f"{key} {value}" for key, value in entry["path"].items())
            for entry in race["contests"].values()
        )
        faults.append(f"'{name}' is a race of {raced}, and the chart is of other values")
    if faults:
        raise OptipathError(*faults)
    times = {entry["contender"]: float(entry["least"]) for entry in results[0]}
    for shared, engine in _SHARED.items():
        charted = [
            entry["ns"]["least"] for entry in chart["contenders"] if _is_shared(entry, engine)
        ]
        if charted and times.get(shared, 0.0) > 0.0:
            ratio = charted[0] / times[shared]
            return PeerTimes(tuple(_racer(entry, ratio) for entry in results[0]), shared, ratio)
    raise OptipathError(
        f"'{name}' and the chart share no contender whose times can be compared; measure the "
        f"chart with engine numpy or numba in float64"
    )


def _plain_text(value: Any) -> str:
    return "not told" if value is None else shown(value)


def _is_of(path: Mapping[str, Any], arguments: Mapping[str, str]) -> bool:
    return all(arguments.get(name) == str(value) for name, value in path.items())


def _is_shared(entry: Mapping[str, Any], engine: str) -> bool:
    own = entry["method"], entry["dtype"], entry["composing"], entry["engine"]
    return own == ("stable", "float64", "stokes", engine)


def _racer(entry: Mapping[str, Any], ratio: float) -> Racer:
    error = float(entry["error"])
    return Racer(
        str(entry["contender"]),
        float(entry["least"]) * ratio,
        min(max(error, 1e-20), 1.0) if isfinite(error) else 1.0,
    )
