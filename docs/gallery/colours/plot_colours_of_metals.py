"""
Why gold is yellow and copper is red
====================================

Metals reflect some wavelengths more than others: light, summed up over what the eye sees, has a
colour. Towards grazing incidence all metals become white.
"""

import numpy as np
from matplotlib.figure import Figure

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
    share = light.intensity / white.intensity
    ax.plot(1e9 * wavelength, share, color="#222222", linewidth=6)
    ax.plot(1e9 * wavelength, share, color=colour, linewidth=4.5, label=name)
ax.set(xlabel="wavelength (nm)", ylabel="reflected at normal incidence", ylim=(0, 1.03))
ax.legend(loc="lower right", ncols=2)
figure

# %%
# Each line has the colour of its metal. Here they are, polished, at every angle of incidence:

degrees = np.arange(0, 90, 2)
figure = Figure(figsize=(6.4, 3), layout="constrained")
ax = figure.subplots()
angles = np.radians(degrees)[:, np.newaxis]
image = [
    reflected(metal, angles).to_srgb(white=white, out_of_gamut="clip").values
    for metal in metals.values()
]
ax.imshow(image, extent=(0, 90, len(names), 0), aspect="auto")
ax.set_yticks(np.arange(len(names)) + 0.5, names)
ax.set(xlabel="angle of incidence (deg)", xticks=range(0, 91, 15))
figure
