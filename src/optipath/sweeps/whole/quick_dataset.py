"""A Dataset of parts that go together, put together without looking for what does not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import xarray as xr
from xarray.indexes import PandasIndex

if TYPE_CHECKING:
    from collections.abc import Mapping

_DIRECT = "_construct_direct"
"""How xarray itself makes a Dataset of what it has looked at already."""


def quick_dataset(
    variables: Mapping[str, Any], coords: Mapping[str, Any], attrs: Mapping[str, Any]
) -> xr.Dataset:
    """Return what ``xarray.Dataset`` returns, in a third of the time.

    Examples
    --------
    >>> import numpy as np
    >>> parts = {"S0": ("x", np.ones(2), {})}, {"x": ("x", np.arange(2.0), {})}, {}
    >>> quick_dataset(*parts).identical(xr.Dataset(*parts))
    True
    """
    direct: Any = getattr(xr.Dataset, _DIRECT, None)
    if direct is None:
        return xr.Dataset(variables, coords, attrs)
    found = {name: _variable(*parts) for name, parts in variables.items()}
    indexes: dict[str, PandasIndex] = {}
    for name, (dimensions, values, told) in coords.items():
        alone = {name: _variable(dimensions, values, told)}
        if dimensions == name:
            indexes[name] = PandasIndex(values, name, values.dtype)
            alone = indexes[name].create_variables(alone)
        found |= alone
    quick: xr.Dataset = direct(found, {*coords}, None, dict(attrs), indexes)
    return quick


def _variable(dimensions: Any, values: Any, attrs: Mapping[str, Any]) -> xr.Variable:
    return xr.Variable(dimensions, values, attrs, fastpath=True)
