"""
Paths in space
==============

Where light goes, how surfaces stand, and which way it is polarised on each link.
"""

import numpy as np

import optipath as op

ax = op.plots.geometry(op.load_preset("fresnel-rhomb"))
ax.figure

# %%
# A path of points: each surface tilts itself to where the light goes on. ``view`` says from
# where it is seen, by elevation and azimuth in degrees.

points = np.array([[0, 0, 2], [0, 0, 0], [0, 2, 0], [1, 2, 1]])
path = op.path_from_vertices(points, materials=[1.5, 0.18 + 3.4j])
ax = op.plots.geometry(path, view=(30, -130))
ax.figure

# %%
# A set-up that lies in one plane is drawn as on an optical bench.

ax = op.plots.bench(op.load_preset("senarmont"))
ax.figure
