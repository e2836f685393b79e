"""Paths as they stand in space, and as optical benches.

    pip install "optipath[plot]"
    python examples/pictures_in_space.py docs

Draws the pictures of docs/pictures.md into the folder.
"""

import sys
from pathlib import Path

from matplotlib.figure import Figure

import optipath as op


def two_paths():
    """Draw a slab that light goes round in, and a long straight path."""
    figure = Figure(figsize=(13.0, 5.4), layout="constrained")
    for name, ax in zip(("glass-slab", "solc-filter"), figure.subplots(1, 2), strict=True):
        op.plots.geometry(op.load_preset(name), ax)
    return figure


def pictures():
    """Yield the pictures with their names."""
    yield "space-npgr026", op.plots.geometry(op.load_preset("npgr026", case="8"))
    yield "space-paths", two_paths()
    yield "space-senarmont", op.plots.bench(op.load_preset("senarmont"), analyzer="100 deg")
    yield "space-isolator", op.plots.bench(op.load_preset("faraday-isolator"))


if __name__ == "__main__":
    for name, drawn in pictures():
        op.plots.save(drawn, Path(sys.argv[1]) / f"{name}.png", dots_per_inch=80)
