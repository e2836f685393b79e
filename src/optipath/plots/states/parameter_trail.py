"""The trail that the light at a detector takes over the Poincaré sphere with one parameter."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.plots.curves.light_at_detector import axis_of, varied
from optipath.plots.fine_steps import START, fine_steps
from optipath.plots.states.sphere_picture import poincare
from optipath.plots.states.sphere_points import sphere_point
from optipath.plots.titles_and_keys import head

if TYPE_CHECKING:
    import numpy.typing as npt
    from mpl_toolkits.mplot3d import Axes3D

    from optipath.light.light import Light
    from optipath.paths.path_graph import PathGraph


def parameter_trail(path: PathGraph, name: str, detector: str, values: Any = None) -> Axes3D:
    """Draw the light at a detector on the Poincaré sphere, coloured by a parameter.

    Examples
    --------
    >>> import optipath as op
    >>> ax = parameter_trail(op.load_preset("malus"), "angle", "eye", "0 deg:90 deg:7")
    >>> [each.get_ylabel() for each in ax.figure.axes if each is not ax]
    ['angle (°)']
    """
    (parameter,) = varied(path, [name], {})
    along, given = axis_of(path, parameter, values, START)

    def light_at(values: npt.NDArray[np.float64]) -> Light:
        return path.trace_all(**{name: values})[detector]

    def points_at(values: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        return sphere_point(light_at(values))

    told, numbers = "", along.numbers
    if values is None:
        fine = fine_steps(given, points_at(given), points_at, on_picture=np.asarray)
        told, numbers = fine.told(name), np.interp(fine.values, given, numbers)
        given = fine.values
    ax = poincare(light_at(given), by=numbers, label=along.labels[-1])
    if told:
        head(ax, "\n".join(filter(None, (ax.get_title(), told))))
    return ax
