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
# Two of them, and colours: what two panes of glass reflect, one after the other, when the second is
# turned. At the cross, both stand at Brewster's angle, and there is nothing.

panes = op.load_preset("two-panes")
ax = op.plots.quantity_map(panes, "incidence1", "turn", "S0", x_values="0 deg:80 deg:121")
ax.figure

# %%
# How far the light is polarised that is left, if the second pane stands at 30 degrees: where both
# panes polarise by as much, one across the other, not at all.

ax = op.plots.quantity_map(panes, "incidence1", "turn", "DoP", incidence2="30 deg")
ax.figure
