r"""
The colours of a soap film
==========================

The two faces of a film send back waves that interfere. optipath adds up intensities, so a thin film
is one mirror whose amplitudes are those of Airy's sum over all rounds,

.. math::

  r = r_1 \frac{1 - e^{2 i \beta}}{1 - r_1^2 e^{2 i \beta}}, \qquad
  \beta = \frac{2 \pi n d \cos \theta_2}{\lambda},

with :math:`r_1` of the front face by Fresnel's equations, for s and for p.
"""

import numpy as np
from matplotlib.figure import Figure

import optipath as op

SOAP = 1.33
daylight = op.Spectrum.illuminant("D65")
wavelength = op.wavelengths("380 nm", "780 nm", "5 nm")
thickness = np.linspace(0, 1.5e-6, 301)[:, np.newaxis]


def film(incidence):
    """Return the mirror that a film is, for each thickness and wavelength."""
    cos, sin = np.cos(incidence), np.sin(incidence)
    face = op.fresnel_amplitudes(SOAP, cos, sin)
    phase = 2 * np.pi * np.sqrt(SOAP**2 - sin**2) * thickness / wavelength
    turn = np.exp(2j * phase)
    return op.Mirror(*(r * (1 - turn) / (1 - r**2 * turn) for r in (face.r_s, face.r_p)))


def colours(incidence, axis=None):
    """Return the colours of the film, in daylight, beside a white that reflects 12 %."""
    path = op.Source(spectrum=daylight) >> film(incidence)
    if axis is not None:
        path = path >> op.Polarizer(axis)
    light = (path >> op.Detector()).trace(wavelength=wavelength)
    lamp = (op.Source(spectrum=daylight) >> op.Detector()).trace(wavelength=wavelength)
    return light.to_srgb(white=0.12 * lamp, out_of_gamut="scale").values


# %%
# The thinnest film is black: the waves from its faces have opposite signs. Towards grazing
# incidence the colours move to thicker films, as :math:`\cos \theta_2` falls.

degrees = np.arange(0, 61, 3)
image = np.array([colours(np.radians(each)) for each in degrees])

figure = Figure(figsize=(7, 3.6), layout="constrained")
ax = figure.subplots()
ax.imshow(image, extent=(0, 1500, 61.5, -1.5), aspect="auto", interpolation="bicubic")
ax.set(xlabel="thickness of the film (nm)", ylabel="angle of incidence (deg)")
figure

# %%
# At Brewster's angle light along p is not reflected: through a polariser that lets p through, the
# film is dark at all thicknesses.

brewster = np.arctan(SOAP)
figure = Figure(figsize=(7, 2.6), layout="constrained")
for ax, axis in zip(figure.subplots(2, sharex=True), ("horizontal", "vertical"), strict=True):
    ax.imshow(colours(brewster, axis)[np.newaxis], extent=(0, 1500, 0, 1), aspect="auto")
    ax.set(yticks=[], ylabel={"horizontal": "along s", "vertical": "along p"}[axis])
ax.set(xlabel="thickness of the film (nm)")
figure
