"""Pictures of the Dataset of a sweep."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError
from optipath.light.light import Light
from optipath.plots.curves.dataset_axes import at_detector, axes_of, numbers_of
from optipath.plots.curves.drawn_curves import draw_curves, units_of
from optipath.plots.curves.drawn_quantity import drawn_quantities, drawn_quantity
from optipath.plots.curves.quantity_colours import draw_map
from optipath.plots.own_axes import own_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_CURVE, _MAP = (6.4, 4.2), (6.4, 4.8)


def curve(dataset: Any, y: Any, x: str | None, ax: Axes | None, detector: str | None) -> Axes:
    """Draw quantities against a coordinate; see `SweepPictures.curve`."""
    quantities = drawn_quantities(y)
    units_of(quantities)
    there = at_detector(dataset, detector)
    (along,) = axes_of(there, [x])
    curves = [(each, numbers_of(there, each, [along])) for each in quantities]
    ax = own_axes(ax, _CURVE)
    draw_curves(ax, along, curves)
    return ax


def quantity_map(
    dataset: Any,
    quantity: Any,
    x: str | None,
    y: str | None,
    ax: Axes | None,
    detector: str | None,
) -> Axes:
    """Draw a quantity over two coordinates; see `SweepPictures.map`."""
    drawn = drawn_quantity(quantity)
    there = at_detector(dataset, detector)
    along, up = axes_of(there, [x, y])
    numbers = numbers_of(there, drawn, [along, up])
    ax = own_axes(ax, _MAP)
    draw_map(ax, along, up, drawn, numbers)
    return ax


def poincare(dataset: Any, x: str | None, ax: Any, detector: str | None) -> Any:
    """Draw light on the Poincaré sphere, coloured by a coordinate; see `SweepPictures.poincare`."""
    there = at_detector(dataset, detector)
    (along,) = axes_of(there, [x])
    components = drawn_quantities(("S0", "S1", "S2", "S3"))
    stokes = np.stack([numbers_of(there, each, [along]) for each in components], axis=-1)
    if np.isnan(stokes).any():
        raise OptipathError(
            "the light has components that are not read, and a sphere shows all; sweep "
            "path.reading('stokes')"
        )
    sphere = import_module("optipath.plots").poincare
    return sphere(Light(stokes), ax, by=along.numbers, label=along.labels[-1])
