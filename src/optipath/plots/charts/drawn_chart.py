"""A chart of the lab as a picture, whether just measured or read from its file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from optipath.errors import OptipathError, shown
from optipath.lab.accuracy.chart_file import CRITICAL, checked_chart, read_chart
from optipath.lab.accuracy.peer_times import peer_times
from optipath.plots.charts.critical_curves import draw_critical
from optipath.plots.charts.speed_and_accuracy import draw_speed_and_accuracy
from optipath.values.given_files import given_file

if TYPE_CHECKING:
    import os
    from pathlib import Path

    from optipath.plots.own_axes import Panel


def chart(
    measured: Mapping[str, Any] | str | os.PathLike[str],
    *,
    peers: str | os.PathLike[str] | None = None,
) -> Panel:
    """Draw speed against accuracy, or how errors grow next to the places where methods fail.

    A colour is a method, a shape a precision; filled marks are of Numba and open ones of NumPy,
    small ones are of Jones columns. What fails in some region stands in a band of its own.

    Parameters
    ----------
    measured : mapping, str or path
        What ``optipath chart --data`` wrote: the file, or what is in it.
    peers : str or path, optional
        What ``benchmarks/peers/race.py --json`` wrote: other software is drawn beside, its times
        multiplied by that of optipath here over that in the race.

    Returns
    -------
    ndarray of Axes
        Of a figure of their own.

    Raises
    ------
    OptipathError
        If it is no chart, or a race that cannot be compared with it.

    Examples
    --------
    >>> place = {"name": "normal", "called": "the normal", "distances": [1e-6, 1e-3]}
    >>> place["errors"] = {"stable": {"componentwise": [2.0, 1.0], "normwise": [1.0, 1.0]}}
    >>> head = {"format": 1, "drawn": "errors next to critical places", "title": "glass"}
    >>> head |= {"dtype": "float64", "eps": 2.2e-16, "fails_above": 1000.0, "samples": 6}
    >>> [ax.get_xlabel() for ax in chart({**head, "places": [place]})]
    ['distance from the normal (rad)']
    """
    if isinstance(measured, Mapping):
        found = checked_chart(measured, "what is given")
    else:
        file = given_file(measured, OptipathError)
        found = read_chart(_text(file), str(file))
    if found.get("drawn") == CRITICAL:
        if peers is not None:
            raise OptipathError("peers stand beside speed and accuracy alone; leave them out")
        return draw_critical(found)
    if peers is None:
        return draw_speed_and_accuracy(found)
    file = given_file(peers, OptipathError)
    return draw_speed_and_accuracy(found, peer_times(_text(file), str(file), found))


def _text(file: Path) -> str:
    try:
        return file.read_text("utf-8")
    except OSError as error:
        raise OptipathError(f"{shown(str(file))} cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise OptipathError(f"{shown(str(file))} is no text in UTF-8") from None
