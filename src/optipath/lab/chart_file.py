"""Chart files: a chart and its contenders as JSON."""

from __future__ import annotations

import json
from collections.abc import Mapping
from itertools import product
from typing import Any

import numpy as np

from optipath.composer.composer import CHOICES, Composer
from optipath.engines.choice import is_installed
from optipath.errors import OptipathError
from optipath.kernels.catalog import METHODS
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
    try:
        chart = json.loads(text, object_hook=_read)
    except (ValueError, RecursionError):
        chart = None
    return checked_chart(chart, f"'{name}'")


def checked_chart(chart: Any, name: str) -> dict[str, Any]:
    """Return a chart of this version."""
    known = isinstance(chart, Mapping) and chart.get("format") == FORMAT
    if not known or not (chart.get("contenders") or chart.get("places")):
        raise OptipathError(
            f"{name} is no chart of this version; give a file that 'optipath chart --data' wrote"
        )
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


WORDS = ("method", "dtype", "engine", "composing")
"""What tells contenders apart, as `Composer` takes it."""


def contenders(
    composing: tuple[str, ...] = CHOICES["composing"], engines: tuple[str, ...] = ("numpy", "numba")
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
