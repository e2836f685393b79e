"""Meshes that are kept with their sample."""

import gc
import weakref

import pytest

import optipath as op
from optipath.surfaces.walk.kept_meshes import kept_meshes

pytest.importorskip("numba")


@pytest.fixture
def no_collection():
    """Nothing goes but what nobody refers to."""
    gc.disable()
    yield
    gc.enable()


@pytest.mark.usefixtures("no_collection")
def test_meshes_go_at_once_with_their_sample():
    sample = op.Sample([(1.5, 0.3)], cells=200)
    meshes = weakref.ref(kept_meshes(sample).of(0).meshes.heights)
    assert meshes() is not None
    del sample
    assert meshes() is None
