"""Options of ``optipath sweep`` besides those of every command that runs, and their faults."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from optipath.errors import OptipathError, listed, shown
from optipath.values.text_tables import columns_of

if TYPE_CHECKING:
    from collections.abc import Sequence

ZIP = click.Option(
    ["--zip"],
    metavar="NAME,NAME",
    multiple=True,
    help="Parameters whose values vary together, along one axis. May be repeated.",
)
COORDS = click.Option(
    ["--coords"],
    metavar="FILE.csv",
    help="Axes besides: a column for each parameter, its unit in the heading.",
)
CHUNKS = click.Option(
    ["--chunks"],
    metavar="N|auto",
    help="How many values along each axis are computed at once for .zarr and .nc.",
)
SCHEDULER = click.Option(
    ["--scheduler"],
    metavar="WORD|ADDRESS",
    help="What computes .zarr and .nc: threads, processes, synchronous, or tcp://... of a cluster.",
)
OUT = click.Option(
    ["--out"],
    metavar="FILE",
    help="Write all into this file; its ending says in which form (csv, json, nc, zarr).",
)
SWEEPING = (ZIP, COORDS, CHUNKS, SCHEDULER, OUT)

TEXTS, BLOCKS = (".csv", ".json"), (".nc", ".zarr")
"""Endings of what the command writes itself, and of what is computed and written by blocks."""

_SCHEDULERS = ("threads", "processes", "synchronous")


def ending_of(out: str) -> str:
    """Return the ending of a file, which says in which form it is written.

    Examples
    --------
    >>> ending_of("result.csv"), ending_of("result.zarr/")
    ('.csv', '.zarr')
    """
    return Path(out).suffix


def is_of_blocks(out: str | None) -> bool:
    """Tell whether a file is written block by block, by its ending."""
    return out is not None and ending_of(out) in BLOCKS


def chunks_of(chunks: str | None) -> int | str | None:
    """Return what ``chunks=`` of a sweep is given for what stands behind the option."""
    return int(chunks) if chunks and chunks.isdecimal() else chunks


def zip_groups(
    zip: Sequence[str],  # noqa: A002 - as `path.sweep` has it
) -> dict[str, tuple[str, ...]]:
    """Return the parameters of each group that varies together, by what was written.

    Examples
    --------
    >>> zip_groups(["sky-angle, theta"])
    {'sky-angle, theta': ('sky_angle', 'theta')}
    """
    return {names: tuple(filter(None, map(_parameter, names.split(",")))) for names in zip}


def _parameter(option: str) -> str:
    """Return the parameter of an option, with hyphens before and within it or without."""
    return option.strip().lstrip("-").replace("-", "_")


def coords_names(coords: str | None) -> list[str]:
    """Return the parameters that a file has columns of."""
    return [column.name for column in columns_of(coords)] if coords is not None else []


def coords_faults(coords: str | None) -> list[str]:
    """Return what is wrong with a file of axes, a sentence each."""
    try:
        coords_names(coords)
    except OptipathError as error:
        about = f"{error.about}: " if error.about else ""
        return [f"{about}{fault}" for fault in error.faults]
    return []


def option_faults(
    *,
    as_json: bool,
    out: str | None,
    zip: Sequence[str],  # noqa: A002 - as `path.sweep` has it
    coords: str | None,
    chunks: str | None,
    scheduler: str | None,
    **_others: Any,
) -> list[str]:
    """Return what is wrong with the options of a sweep, a sentence each."""
    faults = [] if out is None else out_faults(out)
    if as_json and out is not None:
        faults.append("--json prints what --out writes into a file; give one of them")
    faults += [
        f"--zip {shown(names)} names fewer than two parameters; write --zip NAME,NAME"
        for names, group in zip_groups(zip).items()
        if len(group) < 2
    ]
    faults += coords_faults(coords)
    if chunks is not None and chunks != "auto" and not (chunks.isdecimal() and int(chunks)):
        faults.append(
            f"--chunks {shown(chunks)} is no size of a block; write 'auto', or how many values "
            f"along each axis, such as 1000"
        )
    if scheduler is not None and scheduler not in _SCHEDULERS and "://" not in scheduler:
        faults.append(
            f"--scheduler {shown(scheduler)} is unknown; write {', '.join(_SCHEDULERS)}, or the "
            f"address of a cluster, such as tcp://127.0.0.1:8786"
        )
    idle = {"--chunks": chunks, "--scheduler": scheduler}
    if not is_of_blocks(out) and (given := [name for name, value in idle.items() if value]):
        faults.append(
            f"{listed(given)} belong{'s' * (len(given) == 1)} to a sweep that is written by "
            f"blocks; add --out FILE.zarr or FILE.nc, or leave it out"
        )
    return faults


def out_faults(out: str) -> list[str]:
    """Return what is wrong with a file that a sweep is to be written to, a sentence each.

    Examples
    --------
    >>> out_faults("result.txt")
    ["--out 'result.txt' has no ending of a sweep; write 'result.csv', .json, .nc or .zarr"]
    """
    file = Path(out)
    if not out or "\0" in out:
        return [f"--out {shown(out)} is no name of a file; write one such as 'result.csv'"]
    suffix = ending_of(out)
    if suffix not in (*TEXTS, *BLOCKS):
        meant = shown(str(file.with_suffix(".csv"))) if file.name else "'result.csv'"
        return [f"--out {shown(out)} has no ending of a sweep; write {meant}, .json, .nc or .zarr"]
    folder = file.absolute().parent
    if not folder.is_dir():
        return [f"--out {shown(out)} cannot be written: there is no folder {shown(str(folder))}"]
    if suffix in TEXTS and (file.exists() or file.is_symlink()):
        return [f"--out {shown(out)} is there already, and stays; name another file, or remove it"]
    if not os.access(folder, os.W_OK):
        return [f"--out {shown(out)} cannot be written: permission denied"]
    return []
