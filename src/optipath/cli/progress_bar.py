"""A bar that shows how far a measurement is, on a terminal and nowhere else."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from optipath.cli.console import PlainConsole

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


@contextmanager
def progress_bar(total: float) -> Iterator[Callable[..., None]]:
    """Show a bar; what is yielded takes what is being done, and ``advance`` or ``completed``."""
    columns = TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn()
    console = PlainConsole(stderr=True)
    if not console.is_terminal:  # Older versions of rich end even a bar that is not shown.
        yield lambda *_, **_change: None
        return
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("", total=total)

        def tell(what: str, **change: Any) -> None:
            bar.update(task, description=what, **change)

        yield tell
