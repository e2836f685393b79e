"""Maps of the light of a path over two of its parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.plots.curves.drawn_quantity import drawn_quantity
from optipath.plots.curves.light_at_detector import axis_of, quantities_at, reads_of, varied
from optipath.plots.curves.quantity_colours import draw_map
from optipath.plots.own_axes import own_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from optipath.paths.path_graph import PathGraph

_SIZE = 6.4, 4.8
_COUNT = 121


def quantity_map(
    path: PathGraph,
    x: str,
    y: str,
    quantity: str = "S0",
    ax: Axes | None = None,
    *,
    x_values: Any = None,
    y_values: Any = None,
    detector: str | None = None,
    **parameters: Any,
) -> Axes:
    """Draw a quantity of the light at a detector in colours, over two parameters.

    Colours of S0 and of degrees of polarisation are in order from 0, those of S1 to S3 and of the
    ellipticity go apart from white at 0, and those of angles come round. Places at which light
    does not have the quantity are grey; a cross marks the values by default.

    Parameters
    ----------
    path : PathGraph
        The path.
    x, y : str
        The parameters along the axes, each in its unit.
    quantity : str, optional
        What the colours show; the names are those of `curve`.
    ax : Axes, optional
        Where; a figure of its own by default, ``.figure`` of what is returned.
    x_values, y_values : array_like or str, optional
        As `curve` takes values; by default 121 each over the usual range, and the map is grey
        where the path does not take them.
    detector : str, optional
        A detector or a dump; needed only where there are several detectors.
    **parameters : float or str
        The other values, as in `PathGraph.trace`, one each.

    Returns
    -------
    Axes

    Raises
    ------
    OptipathError
        With what is wrong with names and values.

    Examples
    --------
    >>> import optipath as op
    >>> path = op.load_preset("malus")
    >>> ax = quantity_map(path, "angle", "intensity", y_values=[0.0, 1.0, 2.0])
    >>> ax.get_title()
    '+ by default: angle 30°, intensity 1'
    """
    drawn = drawn_quantity(quantity)
    one, other = varied(path, [x, y], parameters)
    along, first = axis_of(path, one, x_values, _COUNT)
    up, second = axis_of(path, other, y_values, _COUNT)
    given = {x: first, y: second}
    chosen = x_values is None and y_values is None
    end, (numbers,) = quantities_at(path, detector, [drawn], given, parameters, chosen=chosen)
    ax = own_axes(ax, _SIZE)
    draw_map(ax, along, up, drawn, numbers, reads=reads_of(path, end))
    return ax
