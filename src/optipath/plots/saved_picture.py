"""Pictures, saved in files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from optipath.errors import OptipathError, shown
from optipath.plots.positive import positive
from optipath.surfaces.files.file_faults import told_of
from optipath.values.given_files import given_file
from optipath.values.picture_files import write_picture

if TYPE_CHECKING:
    import os


def save(drawn: Any, file: str | os.PathLike[str], dots_per_inch: float = 150.0) -> None:
    """Save a picture in a file whose ending says the form: ``.png``, ``.svg`` or ``.pdf``.

    Texts of ``.svg`` and ``.pdf`` are texts, which can be searched; a file is there whole or not
    at all, and that of a picture which is drawn anew has the same bits.

    Parameters
    ----------
    drawn : Axes, array_like of Axes, or Figure
        What a function of `optipath.plots` returned.
    file : str or path
        Where; what is there is replaced.
    dots_per_inch : float, optional
        Of ``.png``, and of the pixels of maps in the other forms.

    Raises
    ------
    OptipathError
        If nothing was drawn, nothing can be drawn in the form that the ending says, or the file
        cannot be written.
    """
    first = np.array(drawn, object).ravel()[:1]
    if not (first.size and isinstance(first[0], Axes | Figure)):
        raise OptipathError(f"{shown(drawn)} is no picture; give what a function of plots returned")
    if faults := positive("dots_per_inch", dots_per_inch):
        raise OptipathError(*faults)
    figure: Any = first[0].figure.figure if isinstance(first[0], Axes) else first[0]
    place = given_file(file, OptipathError)
    with told_of(place, OptipathError):
        write_picture(figure, place, dots_per_inch)
