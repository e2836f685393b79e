"""Console: what the command line prints, and progress bars."""

from __future__ import annotations

import json
import shutil
from contextlib import contextmanager
from textwrap import TextWrapper
from typing import TYPE_CHECKING, Any

import click
from rich.console import Console, Group
from rich.padding import Padding
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn
from rich.table import Column, Table
from rich.text import Text

from optipath.faults import printable

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator


JSON = click.Option(["--json", "as_json"], is_flag=True, help="Print one JSON object.")
DIGITS = click.Option(
    ["--digits"],
    type=click.IntRange(1, 17),
    default=6,
    help="How many digits printed numbers have; --json has all.",
)

_NARROWEST, _WIDEST = 20, 1000
_COLUMN = 30
"""How wide a column that needs it is on the narrowest terminal."""


def say(text: str, *, err: bool = False) -> None:
    """Print lines as they are, control characters by their codes."""
    click.echo(printable(text), err=err)


def say_wrapped(text: str) -> None:
    """Print lines, those longer than the terminal going on in the next, which is indented."""
    click.echo(wrapped(printable(text), _width()))


def wrapped(text: str, width: int, *, whole_words: bool = False) -> str:
    """Return lines of which those that are longer go on in the next, which is indented."""
    wrapper = TextWrapper(width, subsequent_indent=" " * 4, break_on_hyphens=False)
    wrapper.break_long_words = not whole_words
    return "\n".join("\n".join(wrapper.wrap(line)) for line in text.splitlines())


def say_json(results: dict[str, Any]) -> None:
    """Print one JSON object."""
    click.echo(json.dumps(results, allow_nan=False))


def cell(text: str, style: str = "") -> Text:
    """Return a text for tables and paragraphs, without markup and control characters."""
    return Text(printable(text), style=style)


def title(name: str, description: str) -> Text:
    """Return the line above what a command prints."""
    result = Text.assemble(cell(name, "bold"))
    return result.append_text(cell(f": {description}")) if description else result


def headed(
    *headers: str, rows: Iterable[Iterable[str]] = (), right: int | None = None, **keywords: Any
) -> Table:
    """Return a table with headers and rows, flush right from a number of columns on."""
    made = Table(header_style="bold", title_justify="left", title_style="", **keywords)
    for number, header in enumerate(headers):
        is_right = right is not None and number >= right
        made.add_column(cell(header), justify="right" if is_right else "left")
    for row in rows:
        made.add_row(*map(cell, row))
    return made


class PlainConsole(Console):
    """A console that leaves it to a narrow terminal to break lines, rather than to cut them."""

    def __init__(self, **keywords: Any) -> None:
        # With both told, rich does not read them from the environment, where anything may stand.
        width = keywords.pop("width", None) or _width()
        super().__init__(width=width, height=25, highlight=False, **keywords)

    def print(self, *objects: Any, **keywords: Any) -> None:
        """Print; what is too long for a line goes on in the next."""
        for shown in objects:
            if not isinstance(shown, Table):
                super().print(shown, **{"crop": False, **keywords})
                continue
            for column in shown.columns:
                column.overflow = "fold"
                column.min_width = min(_COLUMN, self._widest(column))
            wide = self.measure(shown, options=self.options.update(width=_WIDEST)).minimum
            whole = shown if wide <= self.width else Group(*_stacked(shown))
            super().print(whole, **{"crop": False, **keywords})
        if not objects:
            super().print(**keywords)

    def on_broken_pipe(self) -> None:
        """Leave it to the command, which ends in silence."""
        raise BrokenPipeError

    def _widest(self, column: Column) -> int:
        options = self.options.update(width=_COLUMN)
        parts = [column.header, *column.cells]
        return max([self.measure(part, options=options).maximum for part in parts])


def _stacked(table: Table) -> Iterator[Any]:
    """Yield the rows of a table one under the other, each label above its values."""
    first, *others = table.columns
    yield from filter(None, map(_text, (table.title or "", first.header)))
    for label, *values in zip(first.cells, *(column.cells for column in others), strict=True):
        yield _text(label)
        for column, value in zip(others, map(_text, values), strict=True):
            header = _text(column.header)
            parts = [header, ": ", value] if header else [value]
            if value:
                yield Padding(Text.assemble(*parts, overflow="fold"), (0, 0, 0, 2), expand=False)
    if table.caption:
        yield _text(table.caption)


def _text(shown: Any) -> Text:
    result = shown if isinstance(shown, Text) else Text(str(shown))
    result.overflow = "fold"
    return result


def _width() -> int:
    try:
        columns = shutil.get_terminal_size().columns
    except ValueError:  # COLUMNS may be a number of 5000 digits.
        return 80
    return min(max(columns, _NARROWEST), _WIDEST)


def say_descriptions(kind: str, descriptions: dict[str, str], *, as_json: bool) -> None:
    """Print what there is of a kind and what each is, as a table or as JSON."""
    if as_json:
        say_json(descriptions)
        return
    PlainConsole().print(headed(kind, "what it is", rows=descriptions.items(), box=None))


@contextmanager
def progress_bar(
    total: float | None = None, *, remaining: bool = False
) -> Iterator[Callable[..., None]]:
    """Show a bar; what is yielded takes what is being done, and ``advance`` or ``completed``."""
    columns: list[Any] = [TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn()]
    columns += [TextColumn("left:"), TimeRemainingColumn()] if remaining else []
    console = PlainConsole(stderr=True)
    if not console.is_terminal:  # Older versions of rich end even a bar that is not shown.
        yield lambda *_, **_change: None
        return
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("", total=total)
        yield lambda what, **change: bar.update(task, description=what, **change)


@contextmanager
def photon_bar(what: str) -> Iterator[Callable[[int, int], None]]:
    """Show a bar on a terminal."""
    with progress_bar(1.0, remaining=True) as show:
        show(f"{what}: surfaces are made")
        yield lambda done, total: show(
            f"{what}: {done:,} of {total:,} photons", completed=done, total=total
        )


_STEPS = 10


@contextmanager
def reported_progress() -> Iterator[Callable[[str, float], None]]:
    """Tell of progress; what is yielded takes what is being done, and the share that is done."""
    told = {-1}

    def write(what: str, done: float) -> None:
        if (step := int(_STEPS * done)) > max(told):
            told.add(step)
            say(f"{100 * step // _STEPS} %: {what}", err=True)

    with progress_bar(1.0) as tell:
        is_shown = PlainConsole(stderr=True).is_terminal
        yield (lambda what, done: tell(what, completed=done)) if is_shown else write
