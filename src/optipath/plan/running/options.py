"""How programs are run."""

from __future__ import annotations

from typing import NamedTuple


class RunOptions(NamedTuple):
    """How programs are run, as `Composer` takes it."""

    method: str
    composing: str
    dtype: str
    engine: str
    threads: int
