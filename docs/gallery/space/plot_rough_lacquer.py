"""
Light from a rough surface
==========================

Photons that carry their polarisation walk over a random rough surface, here black lacquer. What
they do is measured in all directions at once, pixel by pixel (``pip install
"optipath[fast,sweep]"``). Few photons are quick, and make noise.
"""

import optipath as op

sample = op.Sample([(1.5 + 0.01j, 0.3)], cells=200)
lacquer = op.measure(sample, "50 deg", photons=400_000, sensor=32)

# %%
# The hemisphere, seen from above. Light comes from the left; a smooth surface would send it to the
# right, 50 degrees from the middle.

ax = op.plots.hemisphere(lacquer, "S0")
ax.figure

# %%
# Unpolarised light becomes polarised: the more, the nearer its facets are to Brewster's angle.

ax = op.plots.hemisphere(lacquer, "DoLP")
ax.figure

# %%
# In the plane of incidence, with standard errors.

ax = op.plots.in_plane({"black lacquer": lacquer}, "DoLP")
ax.figure
