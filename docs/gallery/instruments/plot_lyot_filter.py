"""
Lyot's filter
=============

Four plates of quartz, each twice as thick as the one before, stand at 45 degrees between
polarisers. Each lets through the wavelengths at which it retards by whole waves. One line of the
spectrum passes them all: astronomers look through such filters at the Sun, in the red line of
hydrogen, 656.28 nm.
"""

import numpy as np
from matplotlib.figure import Figure

import optipath as op

THICKNESS = op.load_preset("lyot-filter").parameters["thickness"].default
quartz = op.Crystal.named("quartz").birefringence
wavelength = np.linspace(620e-9, 690e-9, 1401)


def filter_of(plates):
    """Return a filter of one plate after the other, each between polarisers."""
    path = op.Source() >> op.Polarizer()
    for number in range(plates):
        plate = op.Waveplate(THICKNESS * 2**number, quartz, op.Wavelength(), "45 deg")
        path = path >> plate >> op.Polarizer()
    return path >> op.Detector()


figure = Figure(figsize=(6.4, 5), layout="constrained")
rows = figure.subplots(4, sharex=True, sharey=True)
for plates, ax in enumerate(rows, start=1):
    passed = filter_of(plates).trace(wavelength=wavelength).intensity
    ax.fill_between(1e9 * wavelength, passed, color="#0072B2", alpha=0.3)
    ax.plot(1e9 * wavelength, passed, color="#0072B2", linewidth=1)
    ax.set(ylabel=f"{plates} plates" if plates > 1 else "1 plate", ylim=(0, 0.55))
    ax.axvline(656.28, color="#D55E00", linewidth=0.8)
rows[-1].set(xlabel="wavelength (nm)", xlim=(620, 690))
figure.supylabel("intensity, over that of the lamp", fontsize="medium")
figure

# %%
# All four together are the preset ``lyot-filter``. The thickest plate makes the line narrow; the
# others take away the lines beside it, and make it somewhat narrower than the last plate's own.

near = np.linspace(653e-9, 660e-9, 7001)
last = op.Waveplate(8 * THICKNESS, quartz, op.Wavelength(), "45 deg")
alone = op.Source() >> op.Polarizer() >> last >> op.Polarizer() >> op.Detector()
for name, path in (("last plate", alone), ("all four", op.load_preset("lyot-filter"))):
    passed = path.trace(wavelength=near).intensity
    width = 1e9 * np.ptp(near[passed > passed.max() / 2])
    print(f"{name}: {width:.2f} nm wide, at half of the intensity")
