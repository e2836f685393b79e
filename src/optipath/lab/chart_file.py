"""Chart files: a chart and its contenders as JSON."""

from __future__ import annotations

import json
from collections.abc import Mapping
from itertools import product
from typing import Any

import numpy as np

from optipath.composer.composer import CHOICES, Composer
from optipath.engines.choice import is_installed
from optipath.errors import ComposerError, OptipathError
from optipath.kernels.catalog import METHODS
from optipath.values.precision import DTYPES, precision

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
        _check_reported(chart)
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


def _check_reported(chart: Any) -> None:
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
    _check_reported(chart)
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


WORDS = ("method", "dtype", "engine", "composing")
"""What tells contenders apart, as `Composer` takes it."""


def contenders(
    composing: tuple[str, ...] = CHOICES["composing"], engines: tuple[str, ...] = ("numpy", "numba")
) -> list[Composer]:
    """Return all that this machine can run, but JAX, which compiles anew for every path.

    >>> Composer("stable", engine="numpy", composing="jones") in contenders()
    True
    """
    return [
        Composer(method, dtype=dtype, engine=engine, composing=way)
        for method, dtype, engine, way in product(METHODS, available_dtypes(), engines, composing)
        if engine == "numpy" or (is_installed(engine) and dtype != "longdouble")
    ]


def available_dtypes() -> tuple[str, ...]:
    """Return the precisions that this platform has."""
    return tuple(name for name in DTYPES if _exists(name))


def _exists(name: str) -> bool:
    try:
        precision(name)
    except ComposerError:
        return False
    return True
