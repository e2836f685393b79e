"""
Why gold is yellow and copper is red
====================================

Metals reflect some wavelengths more than others: light, summed up over what the eye sees, has a
colour. Towards grazing incidence all metals become white. Materials are asked for by name (``pip
install ".[materials,plot]"``, in a clone of optipath).
"""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patheffects import Normal, Stroke

import optipath as op

daylight = op.Spectrum.illuminant("D65")
wavelength = op.wavelengths("380 nm", "780 nm", "5 nm")
white = (op.Source(spectrum=daylight) >> op.Detector()).trace(wavelength=wavelength)
names = "gold", "copper", "silver", "aluminium", "iron"
metals = {name: op.Material.named(name, wavelength=op.Wavelength()) for name in names}


def reflected(metal, incidence):
    """Return the daylight that a polished metal reflects, by wavelength."""
    path = op.Source(spectrum=daylight) >> op.Interface(metal, incidence) >> op.Detector()
    return path.trace(wavelength=wavelength)


figure = Figure(figsize=(6.4, 3.6), layout="constrained")
ax = figure.subplots()
for name, metal in metals.items():
    light = reflected(metal, 0.0)
    colour = light.to_srgb(white=white, out_of_gamut="clip").hex
    (line,) = ax.plot(1e9 * wavelength, light.intensity / white.intensity, label=name)
    line.set(color=colour, linestyle="-", linewidth=4.5)
    line.set_path_effects([Stroke(linewidth=6, foreground="#222222"), Normal()])
ax.set(xlabel="wavelength (nm)", ylabel="reflected at normal incidence", ylim=(0, 1.03))
ax.legend(loc="lower right", ncols=2)
figure

# %%
# Each line has the colour of its metal. Here they are, polished, at every angle of incidence:

degrees = np.linspace(0, 90, 181)
figure = Figure(figsize=(6.4, 3), layout="constrained")
ax = figure.subplots()
angles = np.radians(degrees)[:, np.newaxis]
image = [
    reflected(metal, angles).to_srgb(white=white, out_of_gamut="clip").values
    for metal in metals.values()
]
ax.imshow(image, extent=(-0.25, 90.25, len(names), 0), aspect="auto")
ax.set_yticks(np.arange(len(names)) + 0.5, names)
ax.set(xlabel="angle of incidence (deg)", xlim=(0, 90), xticks=range(0, 91, 15))
figure
