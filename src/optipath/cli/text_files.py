"""Text files that are named at the command line."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from pathlib import Path


def read_text(file: Path) -> str:
    """Return the text of a file.

    Raises
    ------
    click.ClickException
        If it cannot be read, or is no text.
    """
    try:
        return file.read_text("utf-8")
    except OSError as error:
        raise click.ClickException(f"'{file}' cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise click.ClickException(f"'{file}' is no text in UTF-8") from None
