"""Sweeps that do not fit into the memory that is free."""

import tracemalloc

import numpy as np
import pytest

import optipath as op
from optipath.sweeps.whole import free_memory as memory_of
from tables import rows

pytest.importorskip("xarray")


def test_more_than_is_free_is_one_sentence_with_cures(monkeypatch):
    monkeypatch.setattr(memory_of, "free_memory", lambda: 1_100_000_000)
    with pytest.raises(op.OptipathError) as told:
        op.load_preset("npgr026").sweep(
            delta=np.linspace(0.1, 1.0, 1000), phi=np.linspace(0.1, 1.0, 100_000)
        )
    assert str(told.value) == (
        "a sweep of 1,000 x 100,000 points needs 3.2 GB, and 1.1 GB is free; give chunks='auto' "
        "for Dask arrays, store='sweep.zarr' to keep it on disk, or fewer values"
    )


def test_axes_whose_product_no_machine_holds_are_refused():
    values = np.linspace(0.1, 1.0, 1_000_000)
    names = ("delta", "phi", "rho", "n1", "intensity")
    given = dict(zip(names, [values, values, values, 1.0 + values, values], strict=True))
    with pytest.raises(op.OptipathError, match=r"not 1e\+30 paths.*; give fewer values"):
        op.load_preset("npgr026").sweep(**given)


@rows("options", [{}, {"dtype": "float32"}, {"composing": "jones"}])
def test_a_run_takes_little_more_than_was_told(options):
    plan = op.Composer(engine="numpy", **options).compose(op.load_preset("npgr026"))
    axis, points = np.linspace(0.1, 1.0, 400), 400**2
    given = {"delta": axis[:, None], "phi": axis}
    plan.run(**given)
    tracemalloc.start()
    plan.run(**given)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak / points <= 1.6 * memory_of.bytes_of_a_point(plan, points)


def test_a_limit_of_the_process_counts(monkeypatch):
    resource = pytest.importorskip("resource")
    psutil = pytest.importorskip("psutil")
    own = psutil.Process().memory_info().vms
    monkeypatch.setattr(resource, "getrlimit", lambda _: (own + 10**8, -1))
    assert memory_of.free_memory() <= 2 * 10**8


def test_a_limit_of_the_container_counts(monkeypatch):
    psutil = pytest.importorskip("psutil")
    own = psutil.Process().memory_info().rss
    monkeypatch.setattr(memory_of, "_group_limits", lambda: iter([own + 10**8]))
    assert memory_of.free_memory() <= 2 * 10**8
