"""Pictures of a sweep: ``dataset.optipath``, which xarray has once this module is imported."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

import xarray as xr

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

_PICTURES = "optipath.plots"  # Whose room is above.
_OF_DATASETS = f"{_PICTURES}.curves.dataset_pictures"


class SweepPictures:
    """Pictures of the Dataset of a sweep, in memory, in chunks, or read from a file.

    Examples
    --------
    >>> import optipath as op
    >>> sweep = op.load_preset("malus").sweep(angle="0 deg:90 deg:91")
    >>> sweep.optipath.curve("S0").get_xlabel()
    'angle: turn of the analyser against the polariser (°)'
    """

    def __init__(self, dataset: xr.Dataset) -> None:
        self._dataset = dataset

    def curve(
        self,
        y: str | Sequence[str] = ("S0",),
        x: str | None = None,
        ax: Axes | None = None,
        *,
        detector: str | None = None,
    ) -> Axes:
        """Draw quantities against one coordinate, as `optipath.plots.curve` draws them."""
        drawn: Axes = _drawn("curve", self._dataset, y, x, ax, detector)
        return drawn

    def map(
        self,
        quantity: str = "S0",
        x: str | None = None,
        y: str | None = None,
        ax: Axes | None = None,
        *,
        detector: str | None = None,
    ) -> Axes:
        """Draw a quantity over two coordinates, as `optipath.plots.quantity_map` draws it."""
        drawn: Axes = _drawn("quantity_map", self._dataset, quantity, x, y, ax, detector)
        return drawn

    def poincare(self, x: str | None = None, ax: Any = None, *, detector: str | None = None) -> Any:
        """Draw the light along one coordinate on the Poincaré sphere, coloured by it."""
        return _drawn("poincare", self._dataset, x, ax, detector)


def _drawn(picture: str, *given: Any) -> Any:
    import_module(_PICTURES).check_matplotlib()
    return getattr(import_module(_OF_DATASETS), picture)(*given)


if not hasattr(xr.Dataset, "optipath"):  # Else xarray warns, where this is loaded anew.
    xr.register_dataset_accessor("optipath")(SweepPictures)  # type: ignore[no-untyped-call]
