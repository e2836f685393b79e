"""A million chains of one to eight reflections and refractions in any order, in one batch."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import optipath as op
from subjects import ENGINES, finished

sys.path.append(str(Path(__file__).parents[1] / "tests"))
from batches_of_chains import random_batch

COUNT = 1_000_000
GROUP = "a million chains of one to eight events"


@pytest.fixture(scope="module")
def batch():
    """Chains of 96 texts, many of each, with ids of a few materials, eight of which absorb."""
    found = random_batch(1, 8, several=96, each=COUNT // 96)
    absorbs = np.iscomplex(found.palette)
    kept = np.concatenate([np.flatnonzero(~absorbs), np.flatnonzero(absorbs)[:8]])
    few = np.arange(len(absorbs)) % 8 + np.sum(~absorbs)
    few[kept] = np.arange(len(kept))
    ids = np.where(found.ids < 0, found.ids, few[found.ids])
    return replace(found, palette=[found.palette[i] for i in kept], ids=ids)


def path_of(batch, **others):
    letters = {"events": batch.letters, "lengths": batch.lengths}
    return op.path_from_vertices(batch.points, batch.palette, ids=batch.ids, **letters, **others)


@pytest.mark.skipif("numba" not in ENGINES, reason="needs Numba")
def test_a_path_that_is_there(benchmark, batch):
    benchmark.group = GROUP
    plan = op.Composer(engine="numba").compose(path_of(batch, bad="mask"))
    finished(plan.run().stokes)
    benchmark(lambda: finished(plan.run().stokes))


@pytest.mark.parametrize("bad", ["mask", "refuse"])
def test_the_making_of_a_path(benchmark, batch, bad):
    benchmark.group = GROUP
    benchmark(lambda: path_of(batch, bad=bad))


@pytest.mark.skipif("numba" not in ENGINES, reason="needs Numba")
def test_a_path_of_its_own_for_new_points(benchmark, batch):
    benchmark.group = GROUP
    composer = op.Composer(engine="numba")
    finished(composer.compose(path_of(batch, bad="mask")).run().stokes)
    benchmark(lambda: finished(composer.compose(path_of(batch, bad="mask")).run().stokes))
