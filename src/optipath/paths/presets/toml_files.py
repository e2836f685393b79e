"""Files of TOML that come with the library, by name, and those of one's own, by path."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

from optipath.errors import PresetError, did_you_mean, shown

if TYPE_CHECKING:
    from collections.abc import Sequence

_NAME = re.compile(r"[a-z0-9-]+")
_LARGEST = 4 * 1024 * 1024


def names_in(folder: Path) -> list[str]:
    """Return the names of the files of a folder, sorted; none where there is no such folder."""
    return sorted([path.stem for path in folder.glob("*.toml")])


def file_of(given: Any, what: str, folder: Path, see: str) -> Path:
    """Return the file that a name or a path stands for, which need not exist if it is a path."""
    names: Sequence[str] = names_in(folder)
    if isinstance(given, str) and _NAME.fullmatch(given):
        if given not in names:
            raise PresetError(f"{what} '{given}' is unknown{did_you_mean(given, names)}")
        return folder / f"{given}.toml"
    try:
        path = Path(given)
    except TypeError:
        raise PresetError(f"a {what} is a name or the path of a file, not {shown(given)}") from None
    if path.suffix.lower() != ".toml":
        cure = did_you_mean(path.stem, names)
        if not cure.startswith("; did you mean"):
            cure = f"; see the names with {see}"
        raise PresetError(
            f"'{given}' is neither the name of a {what} (a-z, 0-9 and -) nor the path of a "
            f".toml file{cure}"
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
            f"'{path}' is not UTF-8: byte {error.start} is 0x{data[error.start]:02x}; "
            f"save it as UTF-8"
        ) from None


def presets_folder() -> Path:
    """Return the folder of the files that come with the library."""
    # Inside the package in an installed wheel; beside src/ where the project is installed in place.
    package = Path(__file__).resolve().parents[2]
    installed = package / "presets"
    return installed if installed.is_dir() else package.parents[1] / "presets"
