"""Pictures of the Dataset of a sweep."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError
from optipath.faults import listed, unknown
from optipath.light.light import Light
from optipath.plots.axes import own_axes
from optipath.plots.light_at_detector import AlongAxis, drawn_quantities, drawn_quantity
from optipath.plots.parameter_curves import draw_curves, draw_map, units_of
from optipath.sweeps.datasets import CAPITALIZED, DETECTOR
from optipath.values.units import in_unit

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from optipath.plots.light_at_detector import DrawnQuantity
    from optipath.values.precision import Numbers


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
    dataset: Any, quantity: Any, x: str | None, y: str | None, ax: Axes | None, detector: str | None
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
            "the light has components that are not read; sweep path.reading('stokes')"
        )
    from optipath.plots import poincare as sphere  # noqa: PLC0415 - in space

    return sphere(Light(stokes), ax, by=along.numbers, label=along.short)


_SHORT = (("nm", 1e-5), ("um", 1e-3), ("mm", np.inf))
"""The units in which lengths in metres are shown, each up to some length."""


def at_detector(dataset: Any, detector: str | None) -> Any:
    """Return what a Dataset has at one detector."""
    known = [str(name) for name in np.atleast_1d(dataset.get(DETECTOR, ()))]
    if detector is None:
        if DETECTOR in dataset.dims and len(known) > 1:
            raise OptipathError(
                f"the Dataset has the detectors {listed(known)}; say detector='{known[0]}'"
            )
        return dataset.squeeze(DETECTOR) if DETECTOR in dataset.dims else dataset
    if not known:
        raise OptipathError("the Dataset is of one detector, which it does not name; leave it out")
    OptipathError.raise_for(unknown("detector", detector, known))
    return dataset.sel(detector=detector) if DETECTOR in dataset.dims else dataset


def axes_of(dataset: Any, names: Sequence[str | None]) -> list[AlongAxis]:
    """Return coordinates along as many dimensions, the only ones with several values."""
    along = {
        str(dimension): [
            str(name) for name, each in dataset.coords.items() if each.dims == (dimension,)
        ]
        for dimension, size in dataset.sizes.items()
        if size > 1
    }
    of = {name: dimension for dimension, each in along.items() for name in each}
    arguments = [name for name in names if name is not None]
    OptipathError.raise_for(one for name in arguments for one in unknown("coordinate", name, of))
    taken = {of[name] for name in arguments}
    if len(taken) < len(arguments):
        raise OptipathError(f"{listed(arguments)} are along one dimension; give one of each")
    rest = [dimension for dimension in along if dimension not in taken]
    if len(rest) != names.count(None):
        wanted = "one dimension" if len(names) == 1 else f"{len(names)} dimensions"
        has = listed([f"'{each}'" for each in along]) if along else "no dimension"
        cure = " with several values"
        if len(along) >= len(names):
            cure = f"; choose a value of what is too much, dataset.isel({rest[0]}=0)"
        raise OptipathError(f"a picture goes over {wanted}, and the Dataset has {has}{cure}")
    results = []
    for name in names:
        known = [name] if name is not None else along[rest.pop(0)]
        if len(known) != 1:
            has = f"the coordinates {listed(known)}; say which" if known else "no coordinate"
            raise OptipathError(f"a dimension of the Dataset has {has}")
        results.append(_axis(dataset, known[0]))
    return results


def _axis(dataset: Any, name: str) -> AlongAxis:
    coordinate = dataset.coords[name]
    numbers = np.asarray(coordinate.values)
    if numbers.dtype.kind not in "fiu":
        raise OptipathError(
            f"coordinate '{name}' has words; choose one, dataset.isel({coordinate.dims[0]}=0)"
        )
    unit = str(coordinate.attrs.get("units", ""))
    help_text = str(coordinate.attrs.get("long_name", ""))
    numbers = numbers.astype(np.float64)
    if unit == "rad":
        unit, numbers = "deg", np.degrees(numbers)
    if unit == "m":
        unit = next(short for short, most in _SHORT if np.abs(numbers).max() < most)
        numbers = numbers * in_unit(1.0, unit)
    return AlongAxis(name, unit, numbers, help_text)


def numbers_of(dataset: Any, quantity: DrawnQuantity, axes: Sequence[AlongAxis]) -> Numbers:
    """Return a quantity as it is drawn."""
    other = CAPITALIZED.get(quantity.name, quantity.name)
    name = other if other in dataset.data_vars else quantity.name
    OptipathError.raise_for(unknown("variable", name, [str(each) for each in dataset.data_vars]))
    dimensions = [dataset.coords[axis.name].dims[0] for axis in axes]
    return quantity.of(dataset[name].squeeze().transpose(*dimensions).values)
