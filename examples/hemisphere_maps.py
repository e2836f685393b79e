"""What rough samples look like from all directions, drawn as maps and curves.

    pip install "optipath[fast,plot,sweep]"
    python examples/hemisphere_maps.py docs

Measures three samples, two minutes of one processor, and draws the pictures of
docs/virtual-ellipsometry.md into the folder.
"""

import sys
from pathlib import Path

from matplotlib.figure import Figure

import optipath as op

PHOTONS = 1 << 23
QUANTITIES = "S0", "S1", "S2", "DoLP", "AoP", "ADM"


def maps(found):
    """Draw a map of each quantity."""
    figure = Figure(figsize=(15.0, 9.4), layout="constrained")
    for quantity, ax in zip(QUANTITIES, figure.subplots(2, 3).flat, strict=True):
        op.plots.hemisphere(found, quantity, ax)
    return figure


def curves(found):
    """Draw what is in the plane of incidence, for several angles of incidence."""
    figure = Figure(figsize=(13.0, 4.2), layout="constrained")
    for quantity, ax in zip(("S0", "DoLP", "difference"), figure.subplots(1, 3), strict=True):
        op.plots.in_plane(found, quantity, ax)
        ax.set_xlim(0.0, 90.0)
        ax.set_title(quantity)
    return figure


def pictures(photons=PHOTONS, pixels=128):
    """Measure the samples, and yield the pictures with their names."""
    glass = op.Sample([(1.5, 0.1), (2.4, 0.1)])
    found = {
        f"{angle}°": op.measure(glass, f"{angle} deg", photons, sensor=pixels) for angle in (50, 65)
    }
    yield "hemisphere-maps", maps(found["65°"])
    yield "hemisphere-differences", op.plots.differences(found["65°"])
    yield "hemisphere-plane", curves(found)
    gold = op.Sample([(1.5, 0.1), (0.17 + 3.15j, 0.3)])
    found = op.measure(gold, "60 deg", photons, sensor=pixels // 3)
    yield "hemisphere-mueller", op.plots.mueller_hemisphere(found)
    silver = op.Sample([(0.5 + 2.1j, 0.3)])
    found = op.measure(silver, "40 deg", photons, sensor=pixels // 3, events=1)
    yield "hemisphere-facets", op.plots.beside_facets(found)


if __name__ == "__main__":
    for name, drawn in pictures():
        op.plots.save(drawn, Path(sys.argv[1]) / f"{name}.png", dots_per_inch=66)
