"""
Light from a rough surface
==========================

Photons that carry their polarisation walk over a random rough surface, here black lacquer. What
they do is measured in all directions at once, pixel by pixel (``pip install
".[fast,plot,sweep]"``, in a clone of optipath).
"""

import optipath as op

sample = op.Sample([(1.5 + 0.01j, 0.3)], cells=200)
lacquer = op.measure(sample, "50 deg", photons=400_000, sensor=96)

# %%
# The hemisphere, seen from above. Light comes from the left; a smooth surface would send it to the
# right, 50 degrees from the middle.

ax = op.plots.hemisphere(lacquer, "S0")
ax.figure

# %%
# Unpolarised light becomes polarised: the more, the nearer its facets are to Brewster's angle.
# Where few photons come, it is not known how much: these pixels are hatched.

ax = op.plots.hemisphere(lacquer, "DoLP")
ax.figure

# %%
# In the plane of incidence, with standard errors. The dip next to the normal is of the pixels and
# not of the lacquer: the frames of photons that fall on one pixel differ there, and their
# polarisation cancels in part (:doc:`more of it </virtual-ellipsometry>`). Smaller pixels make it
# narrower.

ax = op.plots.in_plane({"black lacquer": lacquer}, "DoLP")
ax.figure
