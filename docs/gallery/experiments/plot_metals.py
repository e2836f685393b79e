"""
What metals reflect
===================

Dielectrics have an angle at which light along p is not reflected at all. Metals reflect much of
everything; p goes through a shallow minimum, and their phases make linear light elliptical.
Materials are asked for by name (``pip install "optipath[materials]"``).
"""

import numpy as np
from matplotlib.figure import Figure

import optipath as op

WAVELENGTH = "589 nm"
angles = np.linspace(0, 90, 361)
cos, sin = np.cos(np.radians(angles)), np.sin(np.radians(angles))
materials = {"BK7 glass": "BK7", "gold": "gold", "copper": "copper", "silver": "silver"}

figure = Figure(figsize=(7, 5.6), layout="constrained")
panels = figure.subplots(2, 2, sharex=True, sharey=True)
for ax, (title, name) in zip(panels.flat, materials.items(), strict=True):
    material = op.Material.named(name).at(WAVELENGTH)
    found = op.fresnel_amplitudes(material, cos, sin)
    ax.plot(angles, abs(found.r_s) ** 2, label="s, across the plane of incidence")
    ax.plot(angles, abs(found.r_p) ** 2, "--", label="p, within it")
    ax.set_title(f"{title}: n = {material.n:.3f}, k = {material.k:.3f}", fontsize="medium")
panels[0, 0].legend(fontsize="small")
panels[0, 0].set(xlim=(0, 90), ylim=(0, 1.02), xticks=range(0, 91, 15))
figure.supxlabel("angle of incidence (deg)", fontsize="medium")
figure.supylabel("reflected share of the power", fontsize="medium")
figure

# %%
# Diagonal light becomes elliptical. It is most so at the principal angle, where p lags a quarter
# wave behind s.

figure = Figure(figsize=(6.4, 3.6), layout="constrained")
ax = figure.subplots()
for title, name in materials.items():
    mirror = op.Interface(op.Material.named(name).at(WAVELENGTH), np.radians(angles))
    light = mirror @ op.Light([1.0, 0.0, 1.0, 0.0])
    ax.plot(angles, light.docp, label=title)
ax.set(xlabel="angle of incidence (deg)", ylabel="degree of circular polarisation")
ax.set(xlim=(0, 90), xticks=range(0, 91, 15))
ax.legend()
figure
