r"""
Malus's law
===========

Light that a polariser has made linear passes a second one, turned by an angle :math:`\alpha`, with

.. math:: I = I_0 \cos^2 \alpha .

"""

import numpy as np
from matplotlib.figure import Figure

import optipath as op

path = op.Source() >> op.Polarizer() >> op.Polarizer(op.Parameter("angle")) >> op.Detector()
angle = np.radians(np.linspace(0, 180, 181))
light = path.trace(angle=angle)

figure = Figure(figsize=(6, 4), layout="constrained")
ax = figure.subplots()
ax.plot(np.degrees(angle), light.intensity)
figure
