"""A bar that shows how far a measurement is, on a terminal and nowhere else."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from rich.progress import (
    BarColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

from optipath.cli.console import PlainConsole

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


@contextmanager
def progress_bar(total: float, *, remaining: bool = False) -> Iterator[Callable[..., None]]:
    """Show a bar; what is yielded takes what is being done, and ``advance`` or ``completed``."""
    told = TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn()
    left = (TextColumn("left:"), TimeRemainingColumn()) if remaining else ()
    console = PlainConsole(stderr=True)
    if not console.is_terminal:  # Older versions of rich end even a bar that is not shown.
        yield lambda *_, **_change: None
        return
    with Progress(*told, *left, console=console, transient=True) as bar:
        task = bar.add_task("", total=total)

        def tell(what: str, **change: Any) -> None:
            bar.update(task, description=what, **change)

        yield tell
