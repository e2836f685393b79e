"""A chart as JSON: written, read back, and refused where something is missing."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from optipath.errors import OptipathError
from optipath.lab.accuracy.contenders import WORDS
from optipath.lab.accuracy.error_measures import Errors

FORMAT = 1


def chart_text(chart: Mapping[str, Any]) -> str:
    """Return a chart as JSON, which has no infinity: an infinite error is null."""
    return json.dumps(_written(chart), indent=1, allow_nan=False) + "\n"


def read_chart(text: str, name: str) -> dict[str, Any]:
    """Return a chart that was written as JSON.

    Parameters
    ----------
    text : str
        The JSON.
    name : str
        What it is called where it is refused.

    Returns
    -------
    dict
        As `path_chart` returns it.

    Raises
    ------
    OptipathError
        If it is none, or one of another form.
    """
    cure = "give a file that 'optipath chart --data' wrote"
    try:
        chart = json.loads(text, object_hook=_read)
    except (ValueError, RecursionError):
        raise OptipathError(f"'{name}' is no JSON; {cure}") from None
    if not _is_whole(chart):
        raise OptipathError(f"'{name}' is no whole chart of this version; {cure}")
    return chart  # type: ignore[no-any-return]


def _read(entries: dict[str, Any]) -> dict[str, Any]:
    return {name: np.inf if value is None else value for name, value in entries.items()}


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
        words, sizes, off = [chart["title"]], [chart["fails_above"]], []
        sizes += chart["limits_ns"].values()
        for entry in chart["contenders"]:
            words += [entry[word] for word in WORDS]
            sizes += [entry["eps"], entry["ns"]["least"]]
            for kind in Errors._fields:
                errors = list(entry["errors"][kind].values())
                off += [error[which] for error in errors for which in ("worst", "median")]
                if not errors:
                    return False
        return bool(
            type(chart["format"]) is int
            and chart["format"] == FORMAT
            and chart["contenders"]
            and all(isinstance(word, str) for word in words)
            and all(_is_number(size) and 1e-30 < size < 1e30 for size in sizes)
            and all(_is_number(error) and error >= 0 for error in off)
        )
    except (KeyError, TypeError, AttributeError):
        return False


def _is_number(value: Any) -> bool:
    # An integer of JSON may have more digits than a float.
    return isinstance(value, float) or (type(value) is int and abs(value) < 1e30)
