r"""
Fresnel's rhomb
===============

Total reflection in glass changes the phase between light along p and light along s. Twice by 45
degrees is a quarter wave: in a rhomb, two reflections make circular light out of linear light, with
no crystal at all (A. Fresnel, 1823).
"""

import numpy as np
from matplotlib.figure import Figure

import optipath as op

angles = np.linspace(38, 89, 300)

figure = Figure(figsize=(6.4, 4), layout="constrained")
ax = figure.subplots()
for n in (1.45, 1.4966, 1.51, 1.6):
    face = op.Interface(1.0, np.radians(angles), outside=n)
    _, delta = face.mueller().ellipsometric_angles()
    total = n * np.sin(np.radians(angles)) > 1
    ax.plot(angles[total], np.degrees(delta[total]), label=f"n = {n}")
ax.axhline(45, color="#8a8a8a", linewidth=1)
ax.set(xlabel="angle of incidence, in the glass (deg)", ylabel="phase between p and s (deg)")
ax.legend()
figure

# %%
# Glass of n = 1.4966 reaches 45 degrees at one angle alone; denser glass has two. The preset has n
# = 1.51 and the upper one, 54.6 degrees:

light = op.load_preset("fresnel-rhomb").trace()
print(f"ellipticity {light.ellipticity:.4f}, handedness {light.handedness}")

# %%
# Between its two angles light is all but circular: a rhomb need not stand exactly.

found = op.load_preset("fresnel-rhomb").trace(incidence=np.radians(angles))

figure = Figure(figsize=(6.4, 3), layout="constrained")
ax = figure.subplots()
ax.plot(angles, np.abs(found.docp))
ax.set(xlabel="angle of incidence (deg)", ylabel="degree of circular polarisation", ylim=(0, 1.02))
figure
