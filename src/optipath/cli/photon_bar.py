"""A bar that shows how many photons have been walked, and how long the others will take."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from optipath.cli.progress_bar import progress_bar

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


@contextmanager
def photon_bar(what: str) -> Iterator[Callable[[int, int], None]]:
    """Show a bar on a terminal."""
    with progress_bar(1.0, remaining=True) as show:
        show(f"{what}: surfaces are made")

        def tell(done: int, total: int) -> None:
            show(f"{what}: {done:,} of {total:,} photons", completed=done, total=total)

        yield tell
