"""TOML files: by name or path, up to a limit of size."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

from optipath.errors import PresetError, did_you_mean, shown

_LARGEST = 4 * 1024 * 1024


def parsed(text: str, source: str) -> dict[str, Any]:
    """Return what a text holds."""
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise PresetError(f"'{source}' is too deeply nested") from None
    except ValueError as error:  # Also of numbers of more than 4300 digits.
        place = re.search(r"\(at line (\d+),", str(error))
        line = text.split("\n")[int(place[1]) - 1].strip() if place else ""
        where = f": {shown(line)}" if line else ""
        raise PresetError(f"'{source}' is not TOML: {error}{where}") from None


def names_in(folder: Path) -> list[str]:
    """Return the names of the files of a folder, sorted; none where there is no such folder."""
    return sorted(path.stem for path in folder.glob("*.toml"))


def file_of(argument: Any, what: str, folder: Path, see: str) -> Path:
    """Return the file that a name or a path stands for, which need not exist if it is a path."""
    names = names_in(folder)
    if isinstance(argument, str) and re.fullmatch(r"[a-z0-9-]+", argument):
        if argument not in names:
            raise PresetError(f"{what} '{argument}' is unknown{did_you_mean(argument, names)}")
        return folder / f"{argument}.toml"
    try:
        path = Path(argument)
    except TypeError:
        raise PresetError(
            f"a {what} is a name or the path of a file, not {shown(argument)}"
        ) from None
    if path.suffix.lower() != ".toml":
        raise PresetError(
            f"'{argument}' is neither the name of a {what} (a-z, 0-9 and -) nor the path of a "
            f".toml file; see the names with {see}"
        )
    return path


def text_of(path: Path, what: str) -> str:
    """Return the text of a file."""
    try:
        if path.exists() and not path.is_file():
            raise PresetError(f"'{path}' cannot be read: it is no file")
        with path.open("rb") as file:
            data = file.read(_LARGEST + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise PresetError(f"'{path}' cannot be read: {reason}") from None
    if len(data) > _LARGEST:
        raise PresetError(f"'{path}' is larger than {_LARGEST // 1024**2} MiB; no {what} is")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise PresetError(
            f"'{path}' is not UTF-8 at byte {error.start}; save it as UTF-8"
        ) from None


def presets_folder() -> Path:
    """Return the folder of the files that come with the library."""
    # Inside the package in an installed wheel; beside src/ where the project is installed in place.
    package = Path(__file__).resolve().parents[2]
    installed = package / "presets"
    return installed if installed.is_dir() else package.parents[1] / "presets"
