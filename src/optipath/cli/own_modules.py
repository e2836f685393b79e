"""Modules of a user's own, imported for the kinds of elements that they define."""

from __future__ import annotations

import sys
from contextlib import contextmanager, redirect_stdout
from importlib import import_module
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import TYPE_CHECKING

from optipath.errors import OptipathError, PathError, shown

if TYPE_CHECKING:
    from collections.abc import Iterator


def import_own(name: str) -> None:
    """Import a module by its name, from this folder or Python's path, or a file of Python."""
    of_file = name.endswith(".py")
    if not of_file and (
        Path(name).is_file() or not all(part.isidentifier() for part in name.split("."))
    ):
        raise PathError(
            f"--import takes the name of a module or a file that ends in .py, not {shown(name)}"
        )
    try:
        # What it prints is no part of what the command finds, which may be read as JSON.
        with redirect_stdout(sys.stderr), _found_first(Path(name).parent if of_file else Path()):
            if of_file:
                _import_file(Path(name))
            else:
                import_module(name)
    except (MemoryError, OptipathError):
        raise
    except ModuleNotFoundError as error:
        if error.name in (name, name.partition(".")[0]):
            raise PathError(
                f"--import: there is no module {shown(name)} in this folder or on Python's path; "
                f"give its name, or a file such as folder/my_elements.py"
            ) from None
        raise PathError(_told(name, error)) from error
    except (Exception, SystemExit) as error:
        raise PathError(_told(name, error)) from error


def _import_file(file: Path) -> None:
    if not file.is_file():
        raise PathError(f"--import: there is no file {shown(str(file))}")
    path = file.resolve()
    known = sys.modules.get(file.stem)
    if known is not None:
        if getattr(known, "__file__", None) == str(path):
            return
        raise PathError(
            f"--import: a module named {shown(file.stem)} is there already; rename "
            f"{shown(str(file))}"
        )
    spec = spec_from_file_location(file.stem, path)
    if spec is None or spec.loader is None:
        raise PathError(f"--import: {shown(str(file))} cannot be read as Python")
    module = sys.modules[file.stem] = module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[file.stem]
        raise


@contextmanager
def _found_first(folder: Path) -> Iterator[None]:
    """Let modules of a folder be found before all others, as long as one is imported."""
    place = str(folder.resolve())
    sys.path.insert(0, place)
    try:
        yield
    finally:
        if place in sys.path:
            sys.path.remove(place)


def _told(name: str, error: BaseException) -> str:
    return f"--import: {shown(name)} raises {type(error).__name__}: {error}"
