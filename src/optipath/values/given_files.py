"""Names of files to be read, as they are given."""

from __future__ import annotations

from os import PathLike, fspath
from pathlib import Path
from typing import Any

from optipath.errors import OptipathError, ValueFault, shown


def given_file(path: Any, error: type[OptipathError] = ValueFault) -> Path:
    """Return the path of a file that is to be read.

    Parameters
    ----------
    path : str or PathLike
        What is given.
    error : type, optional
        What is raised.

    Returns
    -------
    Path

    Raises
    ------
    OptipathError
        Of that type, if it is no name of a file.

    Examples
    --------
    >>> given_file("lamp.csv").stem
    'lamp'
    """
    name = fspath(path) if isinstance(path, (str, PathLike)) else path
    if not isinstance(name, str):
        raise error(
            f"the name of a file must be a text or a pathlib.Path, not {shown(path)}; write one "
            f"such as 'folder/file.csv'"
        )
    if not name or "\0" in name:
        raise error(f"{shown(name)} is no name of a file; write one such as 'folder/file.csv'")
    return Path(name)
