r"""
Malus's law
===========

Light that a polariser has made linear passes a second one, turned by an angle :math:`\alpha`
against the first:

.. math:: I = I_0 \cos^2 \alpha

A path is elements in a row. What is left open is a parameter, which takes one value or many.
"""

import numpy as np
from matplotlib.figure import Figure

import optipath as op

turn = op.Parameter("turn")
path = op.Source() >> op.Polarizer("0 deg") >> op.Polarizer(turn) >> op.Detector()
angles = np.linspace(0, 180, 181)
light = path.trace(turn=np.radians(angles))

figure = Figure(figsize=(6.4, 4), layout="constrained")
ax = figure.subplots()
ax.plot(angles, light.intensity, label="two polarisers")

# %%
# The first polariser has taken half of the light already. A third one between two that are crossed
# lets light through again: what reaches the eye is :math:`\tfrac{1}{8} \sin^2 2\alpha`.

between = op.Source() >> op.Polarizer("0 deg") >> op.Polarizer(turn) >> op.Polarizer("90 deg")
light = (between >> op.Detector()).trace(turn=np.radians(angles))

ax.plot(angles, light.intensity, "--", label="between two crossed ones")
ax.set(xlabel="angle of the polariser (deg)", ylabel="intensity, over that of the lamp")
ax.set(xlim=(0, 180), xticks=range(0, 181, 30), ylim=(0, None))
ax.legend()
figure
