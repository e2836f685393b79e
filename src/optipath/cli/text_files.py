"""Files that are named at the command line."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import click

from optipath.errors import shown
from optipath.values.files import bytes_of, message_of, write_file


class NewFile(click.Path):
    """The name of a file to be written: not empty, and no folder."""

    def __init__(self) -> None:
        super().__init__(dir_okay=False, path_type=Path)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the path; refuse an empty one, which would be the folder one stands in."""
        if not str(value) or "\0" in str(value):
            self.fail(f"{shown(str(value))} is no name of a file.", param, ctx)
        return super().convert(value, param, ctx)


def read_text(file: Path) -> str:
    """Return the text of a file."""
    try:
        return bytes_of(file).decode("utf-8")
    except OSError as error:
        raise click.ClickException(f"'{file}' cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise click.ClickException(f"'{file}' is no text in UTF-8") from None


def check_place(file: Path) -> None:
    """Refuse a file that cannot be written, before the work for it is done."""
    folder = file.absolute().parent
    if not folder.is_dir():
        raise click.ClickException(f"'{file}' cannot be written: there is no such folder")
    if not all(os.access(place, os.W_OK) for place in (folder, file) if place.exists()):
        raise click.ClickException(f"'{file}' cannot be written: permission denied")


def write(file: Path, content: bytes) -> None:
    """Write a file, whole or not at all."""
    with message_of(file, click.ClickException, ""):
        write_file(file, content)
