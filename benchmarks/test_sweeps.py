"""A sweep in memory, S0 read, against the plan's run of the same grid."""

import numpy as np
import pytest

import optipath as op

pytest.importorskip("xarray")

GRIDS = {
    "malus": {"angle": (0.1, 1.4), "intensity": (1.0, 2.0)},
    "npgr026": {"delta": (0.1, 1.4), "phi": (0.1, 1.4)},
    "npgr026, one axis": {"delta": (0.1, 1.4)},
    "ellipsometer-pcsa": {"theta": (0.1, 1.4), "polarizer": (0.1, 1.4)},
    "sky-and-window": {"theta": (0.1, 1.4), "sky_angle": (0.1, 1.4), "n": (1.2, 1.6)},
    "copper-gold-spectrum": {"wavelength": (400e-9, 700e-9), "phi": (0.1, 1.4)},
}
POINTS = [10**6, 2 * 10**6, 10**7]


def asked(name, points):
    """Return a path, its axes, and the same as arrays that broadcast."""
    ends = GRIDS[name]
    count = round(points ** (1 / len(ends)))
    axes = {each: np.linspace(low, high, count) for each, (low, high) in ends.items()}
    return (
        op.load_preset(name.partition(",")[0]),
        axes,
        dict(zip(axes, np.ix_(*axes.values()), strict=True)),
    )


@pytest.mark.parametrize("points", POINTS)
@pytest.mark.parametrize("name", GRIDS)
def test_run(benchmark, name, points):
    benchmark.group = f"{name}, {points:,} points"
    path, _, grid = asked(name, points)
    plan = path.compose()
    benchmark(lambda: plan.run(**grid).S0)


@pytest.mark.parametrize("points", POINTS)
@pytest.mark.parametrize("name", GRIDS)
def test_sweep(benchmark, name, points):
    benchmark.group = f"{name}, {points:,} points"
    path, axes, _ = asked(name, points)
    path.sweep(**axes)
    benchmark(lambda: path.sweep(**axes).S0.values)
