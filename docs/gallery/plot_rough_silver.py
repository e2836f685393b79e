"""
Light from rough silver
=======================

Photons that carry their polarisation walk over a random rough surface. What they do is measured in all directions at once, pixel by pixel
(``pip install "optipath[fast,sweep]"``). More photons make less noise: here are few.
"""

import optipath as op

sample = op.Sample([(0.5 + 2.1j, 0.3)], cells=200)
silver = op.measure(sample, "50 deg", photons=400_000, sensor=32)

# %%
# The whole hemisphere, seen from above. Light comes from the left; a mirror would send it to the right, 50 degrees from the middle.

ax = op.plots.hemisphere(silver, "S0")
ax.figure

# %%
# Unpolarised light becomes polarised where it is reflected aslant, and a part of it meets a second facet.

ax = op.plots.hemisphere(silver, "DoLP")
ax.figure

# %%
# In the plane of incidence, with standard errors, beside facets that are a formula:

ax = op.plots.in_plane({"photons": silver}, "S0")
ax.figure
