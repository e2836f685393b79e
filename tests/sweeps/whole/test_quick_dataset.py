"""A Dataset that is put together without checks, against the one of xarray."""

import numpy as np
import pytest

xr = pytest.importorskip("xarray")
pd = pytest.importorskip("pandas")

from optipath.sweeps.whole.quick_dataset import quick_dataset  # noqa: E402

X = np.linspace(0.0, 1.0, 4)
PARTS = (
    {"S0": (("x", "word"), np.ones((4, 2)), {"units": "1"}), "one": ((), np.array(2.0), {})},
    {
        "x": ("x", pd.Index(X, copy=False), {"units": "rad"}),
        "word": ("word", np.array(["none", "horizontal"], object), {}),
        "single": ("single", np.array([1.0, 2.0], np.float32), {}),
        "beside": ("x", np.arange(4.0), {"units": "nm"}),
        "n": ((), np.array(1.5), {"units": "1"}),
        "filter": ((), np.array("none", object), {}),
    },
    {"method": "stable"},
)


def test_it_is_what_xarray_makes():
    quick, usual = quick_dataset(*PARTS), xr.Dataset(*PARTS)
    assert quick.identical(usual)
    assert list(quick.variables) == list(usual.variables)
    assert dict(quick.sizes) == dict(usual.sizes)
    assert {n: i.dtype for n, i in quick.indexes.items()} == {
        n: i.dtype for n, i in usual.indexes.items()
    }
    assert quick.sel(word="horizontal", x=X[2]).identical(usual.sel(word="horizontal", x=X[2]))


def test_long_axes_are_not_copied():
    assert np.shares_memory(quick_dataset(*PARTS).x.values, X)


def test_an_xarray_without_the_short_way_goes_the_long_one(monkeypatch):
    monkeypatch.setattr("optipath.sweeps.whole.quick_dataset._DIRECT", "_none")
    assert quick_dataset(*PARTS).identical(xr.Dataset(*PARTS))
