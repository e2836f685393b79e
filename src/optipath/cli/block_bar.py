"""A bar that shows how many blocks of a sweep are done, and what is said of those kept before."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

import click

from optipath.cli.progress_bar import progress_bar
from optipath.cli.sweep_options import ending_of
from optipath.errors import printable
from optipath.sweeps.kept.block_place import place_of_blocks

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


@contextmanager
def block_bar(store: str) -> Iterator[Callable[[int, int], None]]:
    """Show a bar on a terminal; say how many blocks were there, and are where Ctrl-C comes."""
    counts: list[tuple[int, int]] = []
    # A file is written once all are there.
    kept = place_of_blocks(store) if ending_of(store) == ".nc" else store
    try:
        with progress_bar(1.0) as show:

            def tell(done: int, total: int) -> None:
                if not counts and done:
                    _say(f"{_counted(done, total)} in {kept} already")
                counts.append((done, total))
                show(f"{done} of {total} blocks", completed=done / total)

            yield tell
    except KeyboardInterrupt:
        if counts and counts[-1][0]:
            _say(f"{_counted(*counts[-1])} in {kept}; the same command goes on from there")
        raise


def _counted(done: int, total: int) -> str:
    return f"{done:,} of {total:,} block{'s' * (total != 1)} {'is' if done == 1 else 'are'}"


def _say(text: str) -> None:
    click.echo(printable(f"optipath: {text}"), err=True)
