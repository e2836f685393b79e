"""
A pile of plates at Brewster's angle
====================================

At Brewster's angle a face reflects none of the light along p. Plate by plate, more of the light
along s is sent back, and what goes through a pile becomes polarised. Light that goes to and fro
between all the faces is summed up exactly.
"""

import numpy as np
from matplotlib.figure import Figure

import optipath as op

GLASS = 1.5
angles = np.linspace(0, 89.5, 180)


def through(plates):
    """Return the light that unpolarised light becomes behind some plates in air."""
    pile = op.LayerStack([1.0] + [GLASS, 1.0] * plates, incidence=np.radians(angles))
    return pile.mueller("in", "transmitted") @ op.Light([1.0, 0.0, 0.0, 0.0])


figure = Figure(figsize=(6.4, 4), layout="constrained")
ax = figure.subplots()
for plates in (1, 2, 4, 8, 16):
    ax.plot(angles, through(plates).dop, label=f"{plates}")
brewster = np.degrees(np.arctan(GLASS))
ax.axvline(brewster, color="#8a8a8a", linewidth=1)
ax.text(brewster - 1, 0.97, "Brewster's angle", ha="right", va="top", color="#555555")
ax.set(
    xlabel="angle of incidence (deg)", ylabel="degree of polarisation", xlim=(0, 90), ylim=(0, 1)
)
ax.legend(title="plates", loc="upper left")
figure

# %%
# A few plates polarise more beyond Brewster's angle, where less light is left. At that angle all of
# the light along p goes through, which is half of the lamp's, however many plates there are; that
# along s fades with each.

for plates in (1, 4, 16):
    light = through(plates)
    at = np.abs(angles - brewster).argmin()
    print(f"{plates:2} plates: intensity {light.intensity[at]:.3f}, DoP {light.dop[at]:.3f}")
