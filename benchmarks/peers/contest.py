"""All contenders, in turns, in one process: the time of each, and its error."""

from importlib import import_module
from typing import NamedTuple

import contenders
from exact import Exact
from optipath.lab.bench import race
from work import MATERIALS, random_angles


class Result(NamedTuple):
    """Nanoseconds a path, and the largest error over S0."""

    contender: str
    how: str
    paths: int
    least: float
    median: float
    error: float


def entrants():
    """Return all contenders whose packages are there, and why the others are not."""
    found, absent = [], {}
    for name in contenders.MODULES:
        try:
            found += import_module(f"contenders.{name}").CONTENDERS
        except ImportError as error:
            absent[name] = str(error)
    return found, absent


def contest(materials, paths, seconds, tick):
    """Return the results of all who could take part, and why the others could not."""
    entered, absent = entrants()
    angles = random_angles(paths)
    exact = Exact(angles, MATERIALS[materials])
    ready, errors = {}, {}
    for contender in entered:
        tick(f"{materials}: {contender.name}")
        count = min(paths, contender.most)
        try:
            action = contender.prepare(*angles.at(slice(count)), MATERIALS[materials])
            errors[contender.name] = exact.error(action())
        except Exception as error:  # noqa: BLE001 - whatever a peer stumbles over, the others go on
            absent[contender.name] = f"{type(error).__name__}: {error}".splitlines()[0]
        else:
            ready[contender] = action
    timings = race({c.name: action for c, action in ready.items()}, seconds, tick)
    return [_result(c, paths, timings[c.name], errors[c.name]) for c in ready], absent


def _result(contender, paths, timing, error):
    count = min(paths, contender.most)
    per_path = 1e9 / count
    least, median = per_path * timing.least, per_path * timing.middle
    return Result(contender.name, contender.how, count, least, median, error)
