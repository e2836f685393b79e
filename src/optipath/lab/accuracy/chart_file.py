"""A chart as JSON: written, read back, and refused where something is missing."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from optipath.errors import OptipathError
from optipath.lab.accuracy.contenders import WORDS

FORMAT = 1

CRITICAL = "errors next to critical places"
"""What a chart says that it is of, if not of speed against accuracy."""

KINDS = ("componentwise", "normwise")
"""Of errors: the fields of `Errors`, which needs mpmath; a picture is drawn without."""


_CURE = "give a file that 'optipath chart --data' wrote"


def chart_text(chart: Mapping[str, Any]) -> str:
    """Return a chart as JSON, which has no infinity: an infinite error is null."""
    return json.dumps(_written(chart), indent=1, allow_nan=False) + "\n"


def read_chart(text: str, name: str) -> dict[str, Any]:
    """Return a chart that was written as JSON."""
    try:
        chart = json.loads(text, object_hook=_read)
    except (ValueError, RecursionError):
        raise OptipathError(f"'{name}' is no JSON; {_CURE}") from None
    return checked_chart(chart, f"'{name}'")


def checked_chart(chart: Any, name: str) -> dict[str, Any]:
    """Return a chart in which everything is there that is drawn."""
    if not _is_whole(chart):
        raise OptipathError(f"{name} is no whole chart of this version; {_CURE}")
    return chart  # type: ignore[no-any-return]


def _read(entries: dict[str, Any]) -> dict[str, Any]:
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


def _is_whole(chart: Any) -> bool:
    """Tell whether everything is there that is drawn."""
    try:
        if chart.get("drawn") == CRITICAL:
            return _is_whole_near(chart)
        _check_told(chart)
        words, sizes, off = [chart["title"]], [chart["fails_above"]], []
        sizes += chart["limits_ns"].values()
        for entry in chart["contenders"]:
            words += [entry[word] for word in WORDS]
            sizes += [entry["eps"], entry["ns"]["least"]]
            for kind in KINDS:
                errors = list(entry["errors"][kind].values())
                off += [error[which] for error in errors for which in ("worst", "median")]
                if not errors:
                    return False
        return bool(
            type(chart["format"]) is int
            and chart["format"] == FORMAT
            and chart["contenders"]
            and all(isinstance(word, str) for word in words)
            and all(is_number(size) and 1e-30 < size < 1e30 for size in sizes)
            and all(is_number(error) and error >= 0 for error in off)
        )
    except (KeyError, TypeError, AttributeError):
        return False


def _check_told(chart: Any) -> None:
    """Raise TypeError or KeyError where what a chart may say is said otherwise."""
    if "regions" in chart:
        counts = chart["regions"]["measured"], chart["regions"]["of"]
        if not all(type(count) is int for count in counts):
            raise TypeError
    if "effort" in chart:
        effort = chart["effort"]
        if not isinstance(effort["left_out"], str):
            raise TypeError
        if not all(type(effort[name]) is int for name in ("samples", "rounds")):
            raise TypeError
    for name in ("machine", "versions", "parameters"):
        if not isinstance(chart.get(name, {}), Mapping):
            raise TypeError


def _is_whole_near(chart: Any) -> bool:
    _check_told(chart)
    words = [chart["title"], chart["dtype"]]
    sizes, off, lengths = [chart["eps"], chart["fails_above"]], [], []
    for place in chart["places"]:
        words += [place["name"], place["called"]]
        sizes += place["distances"]
        for kinds in place["errors"].values():
            off += [error for kind in KINDS for error in kinds[kind]]
            lengths += [len(kinds[kind]) == len(place["distances"]) for kind in KINDS]
    return bool(
        chart["format"] == FORMAT
        and type(chart["samples"]) is int
        and lengths
        and all(lengths)
        and all(place["errors"] and place["distances"] for place in chart["places"])
        and all(isinstance(word, str) for word in words)
        and all(is_number(size) and 1e-30 < size < 1e30 for size in sizes)
        and all(is_number(error) and error >= 0 for error in off)
    )


def is_number(value: Any) -> bool:
    """Tell whether what JSON holds is a number that a float can be."""
    # An integer of JSON may have more digits than a float.
    return isinstance(value, float) or (type(value) is int and abs(value) < 1e30)
