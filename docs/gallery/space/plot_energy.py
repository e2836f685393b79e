"""
Where the light goes
====================

The power of a lamp is shared among reflected, refracted and absorbed light. How much goes where, is
drawn in the order of travel.
"""

import optipath as op

path = op.load_preset("coated-metal")
ax = op.plots.energy(path)
ax.figure

# %%
# Varnish over metal is a loop: light goes to and fro between the surface and the metal, and all
# rounds are summed up. Towards grazing incidence the surface alone reflects most of it.

ax = op.plots.energy(path, theta="85 deg")
ax.figure

# %%
# An isolator: light comes through, and what is mirrored behind it does not come back.

ax = op.plots.energy(op.load_preset("faraday-isolator"))
ax.figure
