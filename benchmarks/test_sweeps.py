"""A sweep in memory, S0 read, against the plan's run of the same grid."""

import numpy as np
import pytest

import optipath as op
from subjects import long

pytest.importorskip("xarray")

GRIDS = {
    "malus": {"angle": (0.1, 1.4), "intensity": (1.0, 2.0)},
    "npgr026": {"delta": (0.1, 1.4), "phi": (0.1, 1.4)},
    "copper-gold-spectrum": {"wavelength": (400e-9, 700e-9), "phi": (0.1, 1.4)},
    "npgr026, one axis": {"delta": (0.1, 1.4)},
    "ellipsometer-pcsa": {"theta": (0.1, 1.4), "polarizer": (0.1, 1.4)},
    "sky-and-window": {"theta": (0.1, 1.4), "sky_angle": (0.1, 1.4), "n": (1.2, 1.6)},
}
NAMES = [*GRIDS]


@pytest.mark.parametrize("way", ["run", "sweep"])
@pytest.mark.parametrize("points", [10**6, *long(2 * 10**6, 10**7)])
@pytest.mark.parametrize("name", [*NAMES[:3], *long(*NAMES[3:])])
def test_a_grid(benchmark, name, points, way):
    benchmark.group = f"{name}, {points:,} points"
    path, ends = op.load_preset(name.partition(",")[0]), GRIDS[name]
    count = round(points ** (1 / len(ends)))
    axes = {each: np.linspace(low, high, count) for each, (low, high) in ends.items()}
    plan, grid = path.compose(), dict(zip(axes, np.ix_(*axes.values()), strict=True))
    ways = {"sweep": lambda: path.sweep(**axes).S0.values, "run": lambda: plan.run(**grid).S0}
    ways[way]()
    benchmark(ways[way])
