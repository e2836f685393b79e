r"""
Stress made visible
===================

A disc of plastic is squeezed between two points, from above and from below. Stress makes it
birefringent, by :math:`C (\sigma_1 - \sigma_2)`, with axes along the principal directions of the
stress (M. M. Frocht, *Photoelasticity*, vol. 2, 1948, ch. 4). Between crossed polarisers its
colours are lines of equal stress.
"""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle

import optipath as op

THICKNESS = 6e-3  # of the disc, whose radius is 1
MIDDLE = 3 * 589e-9 / THICKNESS  # the birefringence in the middle: three waves at 589 nm


def stress(x, y):
    """Return the difference of the principal stresses, 1 in the middle, and their direction."""
    above, below = x**2 + (1 - y) ** 2, x**2 + (1 + y) ** 2
    xx = 0.5 - (1 - y) * x**2 / above**2 - (1 + y) * x**2 / below**2
    yy = 0.5 - (1 - y) ** 3 / above**2 - (1 + y) ** 3 / below**2
    xy = (1 - y) ** 2 * x / above**2 - (1 + y) ** 2 * x / below**2
    return np.hypot(xx - yy, 2 * xy) / 2, np.arctan2(2 * xy, xx - yy) / 2


def disc(pixels):
    """Return the disc, a wave plate in each pixel, an even number of them."""
    difference, axis = stress(*np.meshgrid(*2 * [np.linspace(-1, 1, pixels)]))
    # Behind rows and columns there is an axis for wavelengths.
    birefringence, axis = MIDDLE * difference[..., np.newaxis], axis[..., np.newaxis]
    return op.Waveplate(THICKNESS, birefringence, op.Wavelength(), axis)


def show(ax, image, **how):
    """Draw pixels of the disc, and none beside it."""
    drawn = ax.imshow(image, origin="lower", extent=(-1, 1, -1, 1), **how)
    drawn.set_clip_path(Circle((0, 0), 1, transform=ax.transData))
    ax.set_axis_off()


# %%
# Crossed polarisers show two patterns at once in light of one wavelength: dark lines where the disc
# retards by whole waves, and a dark cross where the axes of the stress lie along those of the
# polarisers. Between quarter-wave plates, in circular light, the cross is gone.

plate = disc(300)
crossed = op.Source() >> op.Polarizer("0 deg") >> plate >> op.Polarizer("90 deg") >> op.Detector()
circular = (
    op.Source()
    >> op.Polarizer("0 deg")
    >> op.Retarder("90 deg", "45 deg")
    >> plate
    >> op.Retarder("90 deg", "-45 deg")
    >> op.Polarizer("90 deg")
    >> op.Detector()
)

figure = Figure(figsize=(7, 3.8), layout="constrained")
names = "crossed polarisers", "quarter-wave plates besides"
for ax, path, name in zip(figure.subplots(1, 2), (crossed, circular), names, strict=True):
    intensity = path.trace(wavelength=["589 nm"]).intensity[..., 0]
    show(ax, intensity, cmap="gray", vmin=0, vmax=0.5)
    ax.set_title(name)
figure

# %%
# In daylight each wavelength has lines of its own; together they are the colours of stressed
# plastic.

daylight = op.Spectrum.illuminant("D65")
wavelength = op.wavelengths("380 nm", "780 nm", "10 nm")
plate = disc(160)
lamp = op.Source(spectrum=daylight) >> op.Polarizer("0 deg")
light = (lamp >> plate >> op.Polarizer("90 deg") >> op.Detector()).trace(wavelength=wavelength)
white = (lamp >> op.Detector()).trace(wavelength=wavelength)
colours = light.to_srgb(white=white, out_of_gamut="clip").values

figure = Figure(figsize=(4.4, 4.4), layout="constrained")
show(figure.subplots(), colours, interpolation="bicubic")
figure
