"""Axes to draw into: given or new; saved pictures."""

from __future__ import annotations

from numbers import Real
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from optipath.errors import OptipathError
from optipath.faults import shown
from optipath.plots.colors import LINES
from optipath.plots.text import missing_letters_as_boxes
from optipath.values.files import input_file, message_of, write_picture

if TYPE_CHECKING:
    import os

    Panel: TypeAlias = np.ndarray[Any, Any]


Drawn = TypeVar("Drawn", bound=Axes)


def own_axes(argument: Any, size: tuple[float, float]) -> Axes:
    """Return the axes that are given, or those of a new figure that no window belongs to."""
    if argument is None:
        return own_lines(Figure(figsize=size, layout="constrained").add_subplot())
    if not (isinstance(argument, Axes) and argument.name == "rectilinear"):
        raise OptipathError(
            f"ax is {shown(argument)}; give flat Axes, as figure.add_subplot() makes them, or none"
        )
    return argument


def own_panel(argument: Any, shape: tuple[int, int], size: tuple[float, float]) -> Panel:
    """Return the axes that are given, or those of a new figure, row by row."""
    if argument is None:
        panel = Figure(figsize=size, layout="constrained").subplots(*shape, squeeze=False)
        for ax in panel.flat:
            own_lines(ax)
        return panel
    panel = np.array(argument, object)
    flat = all(isinstance(ax, Axes) and ax.name == "rectilinear" for ax in panel.flat)
    if not flat or panel.size != np.prod(shape):
        wanted = "{} x {} Axes of Matplotlib, as figure.subplots({}, {})".format(*shape, *shape)
        raise OptipathError(f"axes are {shown(argument)}; give {wanted} makes them, or none")
    return panel.reshape(shape)


def own_lines(ax: Drawn) -> Drawn:
    """Return axes whose lines are solid by default, whatever Matplotlib's settings are."""
    ax.set_prop_cycle(color=LINES)
    return ax


def positive(what: str, number: Any) -> list[str]:
    """Return the sentence for what is no number above 0; none for one that is, or for None.

    >>> positive("largest", -1.0), positive("largest", 2), positive("largest", None)
    (['largest is -1.0; give a number above 0'], [], [])
    """
    real = isinstance(number, Real) and not isinstance(number, bool)
    if number is None or (real and float(number) > 0.0):
        return []
    return [f"{what} is {shown(number)}; give a number above 0"]


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
    OptipathError.raise_for(positive("dots_per_inch", dots_per_inch))
    place = input_file(file, OptipathError)
    with message_of(place, OptipathError), missing_letters_as_boxes():
        write_picture(first[0].figure.figure, place, dots_per_inch)
