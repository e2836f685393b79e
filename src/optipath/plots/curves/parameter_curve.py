"""Curves of the light of a path against one of its parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.plots.curves.drawn_curves import draw_curves, units_of
from optipath.plots.curves.drawn_quantity import drawn_quantities
from optipath.plots.curves.light_at_detector import axis_of, quantities_at, varied
from optipath.plots.own_axes import own_axes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from optipath.paths.path_graph import PathGraph

_SIZE = 6.4, 4.2
_COUNT = 721


def curve(
    path: PathGraph,
    x: str,
    y: str | Sequence[str] = ("S0",),
    ax: Axes | None = None,
    *,
    values: Any = None,
    detector: str | None = None,
    **parameters: Any,
) -> Axes:
    """Draw quantities of the light at a detector against one parameter.

    Quantities of one unit share an axis, those of a second one have the axis on the right. Curves
    are open where light does not have a quantity, as the angle of unpolarised light, and where an
    angle goes out at one end and comes in at the other. A thin line marks the value by default.

    Parameters
    ----------
    path : PathGraph
        The path.
    x : str
        The parameter that goes along x, in its unit.
    y : str or sequence of str, optional
        What goes up, in capitals or not: ``"S0"`` to ``"S3"``, ``"DoP"``, ``"DoLP"``, ``"AoP"``,
        ``"ellipticity"``, ``"psi"``, ``"delta"``, ``"log10_intensity"``.
    ax : Axes, optional
        Where; a figure of its own by default, ``.figure`` of what is returned.
    values : array_like or str, optional
        Those of `x`, as a sweep takes them: ``"0 deg:90 deg:91"``, texts with units, or numbers in
        radians and metres. By default 721 over its usual range, and the curve is open where
        the path does not take them.
    detector : str, optional
        A detector or a dump; needed only where there are several detectors.
    **parameters : float or str
        The other values, as in `PathGraph.trace`, one each.

    Returns
    -------
    Axes
        That on the left.

    Raises
    ------
    OptipathError
        With what is wrong with names, values and units.

    Examples
    --------
    >>> import optipath as op
    >>> ax = curve(op.load_preset("malus"), "angle", values="0 deg:90 deg:91")
    >>> ax.get_xlabel(), ax.get_ylabel()
    ('angle: turn of the analyser against the polariser (°)', 'S0: intensity')
    """
    quantities = drawn_quantities(y)
    units_of(quantities)
    (parameter,) = varied(path, [x], parameters)
    along, given = axis_of(path, parameter, values, _COUNT)
    _, numbers = quantities_at(
        path, detector, quantities, {x: given}, parameters, chosen=values is None
    )
    ax = own_axes(ax, _SIZE)
    draw_curves(ax, along, [*zip(quantities, numbers, strict=True)])
    return ax
