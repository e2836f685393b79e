"""Progress bars of measurements and photons."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import click
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from optipath.cli.console import PlainConsole
from optipath.errors import printable

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


@contextmanager
def progress_bar(total: float, *, remaining: bool = False) -> Iterator[Callable[..., None]]:
    """Show a bar; what is yielded takes what is being done, and ``advance`` or ``completed``."""
    messages = TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn()
    left = (TextColumn("left:"), TimeRemainingColumn()) if remaining else ()
    console = PlainConsole(stderr=True)
    if not console.is_terminal:  # Older versions of rich end even a bar that is not shown.
        yield lambda *_, **_change: None
        return
    with Progress(*messages, *left, console=console, transient=True) as bar:
        task = bar.add_task("", total=total)

        def tell(what: str, **change: Any) -> None:
            bar.update(task, description=what, **change)

        yield tell


@contextmanager
def photon_bar(what: str) -> Iterator[Callable[[int, int], None]]:
    """Show a bar on a terminal."""
    with progress_bar(1.0, remaining=True) as show:
        show(f"{what}: surfaces are made")

        def tell(done: int, total: int) -> None:
            show(f"{what}: {done:,} of {total:,} photons", completed=done, total=total)

        yield tell


_STEPS = 10


@contextmanager
def reported_progress() -> Iterator[Callable[[str, float], None]]:
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
