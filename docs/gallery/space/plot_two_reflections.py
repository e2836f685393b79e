"""
Two reflections, in planes that are turned
==========================================

Light from a lamp is reflected at one surface, then at another, and reaches the eye; the two planes
of incidence stand at an angle to each other. Unpolarised light is polarised by the first surface,
and its state decides what the second one reflects.
"""

import numpy as np
from matplotlib.figure import Figure

import optipath as op

path = op.load_preset("npgr026", case="8")

# %%
# A published case, a filter and two metals: what was computed, beside what was published.

ax = op.plots.stokes(path.trace(), published=path.cases["8"].published["E"])
ax.figure

# %%
# The light that reaches the eye, as an ellipse, and from link to link on the sphere of Poincaré.

ax = op.plots.ellipse(path.trace())
ax.figure

# %%

ax = op.plots.poincare_path(path)
ax.figure

# %%
# Two panes of glass at Brewster's angle: the first polarises, and when the plane of the second is
# turned by 90 degrees, there is nothing left (E. L. Malus, 1808).

glass = op.load_preset("npgr026", n1=1.5, n2=1.5, filter="none")
turn = np.linspace(0, 180, 181)
brewster = np.arctan(1.5)

figure = Figure(figsize=(6.4, 3.6), layout="constrained")
ax = figure.subplots()
for degrees in (0, 20, 40):
    phi = brewster - np.radians(degrees)
    light = glass.trace(rho=np.radians(turn), delta=brewster, phi=phi)
    ax.plot(turn, light.intensity, label=f"first incidence {np.degrees(phi):.1f} deg")
ax.set(xlabel="angle between the planes of incidence (deg)", ylabel="intensity, of 100")
ax.set(xlim=(0, 180), xticks=range(0, 181, 30), ylim=(0, None))
ax.legend()
figure
