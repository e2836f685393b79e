"""
Senarmont's compensator, on the sphere
======================================

How much does a sample retard light? Senarmont's way needs a quarter-wave plate and an analyser that
is turned. On the sphere of Poincaré each element is a turn, and one sees at once why it works.
"""

import numpy as np

import optipath as op

path = op.load_preset("senarmont")
ax = op.plots.poincare_path(path)
ax.figure

# %%
# The sample takes linear light along a meridian, as far as it retards. The quarter-wave plate lays
# that arc down on the equator: light is linear again, at half the retardance. The analyser finds
# where it is dark.

analyzer = np.linspace(90, 180, 91)
for retardance in ("20 deg", "60 deg", "100 deg"):
    light = path.trace(retardance=retardance, analyzer=np.radians(analyzer))
    dark = analyzer[light.intensity.argmin()]
    print(f"a sample of {retardance}: dark at {dark:.0f} deg, which is 90 deg and half of it")

# %%
# The Mueller matrix of the sample and the plate together.

both = op.Retarder("90 deg") @ op.Retarder("60 deg", angle="45 deg")
ax = op.plots.mueller(both)
ax.figure
