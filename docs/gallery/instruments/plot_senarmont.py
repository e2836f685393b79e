"""
Senarmont's compensator, on the sphere
======================================

How much does a sample retard light? Senarmont's way needs a quarter-wave plate and an analyser that
is turned. On the sphere of Poincaré a plate turns light about its axis, and one sees at once why it
works.
"""

import numpy as np

import optipath as op

sample = np.arange(0, 61, 2)
plate = np.arange(2, 91, 2)
behind_sample = op.Retarder(np.radians(sample), "45 deg") @ op.Light([1, 1, 0, 0])
behind_plate = op.Retarder(np.radians(plate)) @ behind_sample[-1]
light = op.Light(np.concatenate([behind_sample.stokes, behind_plate.stokes]))
retardance = np.concatenate([sample, sample[-1] + plate])
ax = op.plots.poincare(light, by=retardance, label="retardance on the way (deg)")
ax.figure

# %%
# The sample, of 60 degrees here, takes horizontal light along a meridian, as far as it retards. The
# quarter-wave plate turns that arc down to the equator: light is linear again, and its direction
# has turned by half the retardance of the sample. The analyser finds where it is dark.

path = op.load_preset("senarmont")
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
