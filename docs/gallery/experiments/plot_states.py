"""
Linear, circular, elliptical
============================

The field of polarised light goes along an ellipse. Four numbers say all of it that can be measured:
the Stokes vector, whose last three over the first are a point on the sphere of Poincaré.
"""

import numpy as np

import optipath as op

states = {
    "linear": op.Light([1, 1, 0, 0]),
    "elliptical": op.Light([1, 0.5, 0.5, np.sqrt(0.5)]),
    "circular": op.Light([1, 0, 0, 1]),
    "half polarised": op.Light([1, -0.3, 0, -0.4]),
}
ax = op.plots.ellipse(states)
ax.figure

# %%
# The same as bars. S1 tells horizontal from vertical light, S2 diagonal from antidiagonal light, S3
# the hands.

ax = op.plots.stokes(states)
ax.figure

# %%
# A plate that turns diagonal light into circular light, and on: the retardance grows, and the light
# goes round the sphere, about the axis of the plate.

retardance = np.radians(np.arange(0, 271, 5))
light = op.Retarder(retardance) @ op.Light([1, 0, 1, 0])
ax = op.plots.poincare(light, by=np.degrees(retardance), label="retardance (deg)")
ax.figure

# %%
# A half-wave plate that is turned turns linear light, by twice as much: along the equator, where
# light is linear.

angle = np.radians(np.arange(0, 46, 1.5))
light = op.Retarder("180 deg", angle) @ op.Light([1, 1, 0, 0])
ax = op.plots.poincare(light, by=np.degrees(angle), label="angle of the plate (deg)")
ax.figure
