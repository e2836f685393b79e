"""Curves of light, a reflection, and the way of its energy, as pictures.

    pip install "optipath[plot]"
    python examples/pictures_of_curves.py docs

Draws the pictures of docs/pictures.md, where curves and energy stand, into the folder.
"""

import sys
from pathlib import Path

from matplotlib.figure import Figure

import optipath as op


def curves():
    """Draw light against one parameter, and over two."""
    figure = Figure(figsize=(11.0, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    path = op.load_preset("glass-slab")
    op.plots.curve(path, "theta", ("S0", "DoLP"), left)
    rhomb = op.load_preset("fresnel-rhomb")
    op.plots.quantity_map(rhomb, "incidence", "n", "ellipticity", right)
    return figure


def reflections():
    """Draw what glass reflects from within, and gold."""
    figure = Figure(figsize=(11.0, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    op.plots.reflection(1.0, left, outside=1.5)
    op.plots.reflection("gold", right, wavelength="516 nm")
    return figure


def energies():
    """Draw where light goes: through a slab, and in an ellipsometer."""
    figure = Figure(figsize=(11.0, 3.8), layout="constrained")
    left, right = figure.subplots(1, 2)
    op.plots.energy(op.load_preset("ellipsometer-pcsa"), left)
    op.plots.energy(op.load_preset("glass-slab", case="grey"), right)
    return figure


def pictures():
    """Yield the pictures with their names."""
    yield "curves-of-light", curves()
    yield "curves-of-reflection", reflections()
    yield "energy-along-paths", energies()


if __name__ == "__main__":
    for name, drawn in pictures():
        op.plots.save(drawn, Path(sys.argv[1]) / f"{name}.png", dots_per_inch=80)
