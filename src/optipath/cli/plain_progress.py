"""How far a measurement is: a bar on a terminal, and lines on standard error elsewhere."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

import click

from optipath.cli.console import PlainConsole
from optipath.cli.progress_bar import progress_bar
from optipath.errors import printable

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

_STEPS = 10


@contextmanager
def told_progress() -> Iterator[Callable[[str, float], None]]:
    """Tell of progress; what is yielded takes what is being done, and the share that is done."""
    if PlainConsole(stderr=True).is_terminal:
        with progress_bar(1.0) as tell:
            yield lambda what, done: tell(what, completed=done)
        return
    last = -1

    def write(what: str, done: float) -> None:
        nonlocal last
        if int(_STEPS * done) > last:
            last = int(_STEPS * done)
            click.echo(printable(f"{100 * last // _STEPS} %: {what}"), err=True)

    yield write
