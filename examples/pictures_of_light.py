"""Light, and what turns it, as pictures.

    pip install "optipath[plot]"
    python examples/pictures_of_light.py docs

Draws the pictures of docs/pictures.md into the folder.
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import optipath as op

RETARDANCES = np.radians(np.arange(0.0, 181.0, 10.0))


def ellipses():
    """Draw light behind a wave plate, alone, and for three retardances."""
    figure = Figure(figsize=(10.4, 6.4), layout="constrained")
    left, right = figure.subplots(1, 2)
    light = op.Retarder("60 deg", "20 deg") @ op.Light([1.0, 0.0, 0.8, 0.0])
    light.plot(ax=left)
    behind = op.Retarder(RETARDANCES[[3, 9, 15]], "0 deg") @ op.Light(
        [1.0, 0.5, np.sqrt(0.75), 0.0]
    )
    op.plots.ellipse(behind, right, labels=["30 deg", "90 deg", "150 deg"])
    return figure


def spheres():
    """Draw a trail by retardance, and the light along a path."""
    figure = Figure(figsize=(11.6, 6.4), layout="constrained")
    left, right = figure.subplots(1, 2, subplot_kw={"projection": "3d"})
    light = op.Retarder(RETARDANCES, "10 deg") @ op.Light([1.0, 0.0, 0.95, 0.0])
    light.plot("poincare", left, by=np.degrees(RETARDANCES), label="retardance (deg)")
    op.plots.poincare_path(op.load_preset("senarmont"), right)
    return figure


def bars():
    """Draw the light of a preset beside what was published for it."""
    path = op.load_preset("npgr026", case="8")
    return path.trace().plot("stokes", published=path.cases["8"].published["E"])


def matrix():
    """Draw the Mueller matrix of gold."""
    return op.Interface(0.17 + 3.15j, "70 deg").mueller("in", "reflected").plot()


def pictures():
    """Yield the pictures with their names."""
    yield "light-ellipses", ellipses()
    yield "light-spheres", spheres()
    yield "light-bars", bars()
    yield "light-matrix", matrix()


if __name__ == "__main__":
    for name, drawn in pictures():
        op.plots.save(drawn, Path(sys.argv[1]) / f"{name}.png", dots_per_inch=80)
