"""Standard errors are as large as what results of other seeds differ by.

Statistical tests have fixed seeds, and would fail by chance once in a million of other seeds.
"""

import numpy as np
import pytest

import optipath as op
from optipath import surfaces

pytest.importorskip("numba")

SEEDS, PHOTONS = 50, 2000
HEIGHTS = np.random.default_rng(1).normal(size=(8, 8))
LEAST, MOST = 14.0, 114.0
"""Between which chi-square of 49 degrees of freedom is, but for once in a million, either way."""


def spread(sample, found):
    """Chi-square of results about their mean."""
    shares = [
        surfaces.energy(sample, "60 deg", photons=PHOTONS, seed=seed, threads=1)
        for seed in range(SEEDS)
    ]
    values, errors = (
        np.array([found(each, name) for each in shares], float) for name in ("R", "R_se")
    )
    return np.sum((values - values.mean()) ** 2) / np.mean(errors**2)


@pytest.mark.parametrize(
    "layers",
    [
        [(1.5, 0), (2.4, 0)],
        [(1.5, surfaces.HeightField(HEIGHTS, 8.0, periodic=True))],
    ],
)
@pytest.mark.parametrize("part", ["", "scalar", "difference"])
def test_results_of_other_seeds_differ_by_their_errors(layers, part):
    found = spread(op.Sample(layers), lambda each, name: getattr(getattr(each, part, each), name))
    assert LEAST < found < MOST


@pytest.mark.filterwarnings("ignore::optipath.MeshWarning")
def test_random_surfaces_differ_by_no_more_than_the_error():
    shares = [
        surfaces.energy(
            op.Sample([(1.5, 1.0)], cells=64, surfaces=4, seed=seed),
            "60 deg",
            photons=4 * 16384,
            seed=seed,
        )
        for seed in range(8)
    ]
    found = np.array([each.R_m for each in shares])
    errors = np.array([each.R_m_se for each in shares])
    # F of 7 and 24 degrees of freedom is less, but for once in a million.
    assert found.var(ddof=1) < 14.0 * np.mean(errors**2)
