"""
One line a picture
==================

Every preset has parameters, and each may go along an axis: ``optipath presets`` lists them, and
``print(path.parameters)`` names those of one.
"""

import optipath as op

rhomb = op.load_preset("fresnel-rhomb")
ax = op.plots.curve(rhomb, "incidence", ("ellipticity", "DoP"), values="42 deg:89 deg:400")
ax.figure

# %%
# Two of them, and colours: how much of the light is polarised that two panes of glass have
# reflected.

panes = op.load_preset("two-panes")
ax = op.plots.quantity_map(panes, "incidence1", "turn", "S0", incidence2="56.3 deg")
ax.figure

# %%

ax = op.plots.quantity_map(panes, "incidence1", "turn", "DoP", incidence2="30 deg")
ax.figure
