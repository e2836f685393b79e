"""
What glass and metals reflect
=============================

Glass has an angle at which light along p is not reflected at all. Metals reflect much of
everything: p goes through a shallow minimum, and its phase changes against that of s, so that
linear light becomes elliptical. Materials are asked for by name (``pip install
".[materials,plot]"``, in a clone of optipath).
"""

import numpy as np
from matplotlib.figure import Figure

import optipath as op

ax = op.plots.reflection(1.5)
ax.figure

# %%
# Out of glass into air, light beyond the critical angle is reflected totally.

ax = op.plots.reflection(1.0, outside=1.5)
ax.figure

# %%
# Gold, in green light.

ax = op.plots.reflection("gold", wavelength="516 nm")
ax.figure

# %%
# Diagonal light becomes elliptical. It is most so near the principal angle, where p and s are a
# quarter wave apart.

angles = np.linspace(0, 90, 361)

figure = Figure(figsize=(6.4, 3.6), layout="constrained")
ax = figure.subplots()
for name in ("BK7", "gold", "copper", "silver"):
    material = op.Material.named(name).at("589 nm")
    light = op.Interface(material, np.radians(angles)) @ op.Light([1.0, 0.0, 1.0, 0.0])
    ax.plot(angles, light.docp, label=name)
ax.set(xlabel="angle of incidence (deg)", ylabel="degree of circular polarisation, at 589 nm")
ax.set(xlim=(0, 90), xticks=range(0, 91, 15))
ax.legend()
figure
