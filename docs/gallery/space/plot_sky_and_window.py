"""
The sky in a window
===================

A window mirrors the sky, and behind it there is a room. Photographers turn a polarising filter
until the mirror image is gone. How well that works depends on the angle at which they look, and on
the sky, which is polarised itself.
"""

import numpy as np
from matplotlib.figure import Figure

import optipath as op

path = op.load_preset("sky-and-window")
print(path)

# %%
# What the camera sees of the sky alone, and of the room alone, for every angle of the filter. The
# room's light comes through the pane, and the pane lets its light along p through best: the angle
# that takes the sky away is the one that keeps the room.

axis = np.linspace(0, 180, 181)
turned = {"filter": np.radians(axis)}
sky = path.trace(theta="56 deg", room=0, **turned)
room = path.trace(theta="56 deg", sky=0, **turned)

figure = Figure(figsize=(6.4, 3.6), layout="constrained")
ax = figure.subplots()
ax.plot(axis, sky.intensity, label="the sky, mirrored")
ax.plot(axis, room.intensity, label="the room behind")
ax.set(xlabel="axis of the filter, from s of the pane (deg)", ylabel="intensity")
ax.set(xlim=(0, 180), xticks=range(0, 181, 30), ylim=(0, None))
ax.legend()
figure

# %%
# The share of the room in all that the camera sees, for every angle of the filter and of the pane:
# parameters are given as arrays that broadcast.

theta = np.radians(np.linspace(0, 85, 171))[:, np.newaxis]
both = path.trace(theta=theta, **turned).intensity
share = path.trace(theta=theta, sky=0, **turned).intensity / both

figure = Figure(figsize=(6.4, 4), layout="constrained")
ax = figure.subplots()
drawn = ax.pcolormesh(axis, np.degrees(theta[:, 0]), share, cmap="viridis", vmin=0, vmax=1)
figure.colorbar(drawn, label="share of the room")
ax.set(xlabel="axis of the filter, from s of the pane (deg)", ylabel="angle of incidence (deg)")
ax.set(xticks=range(0, 181, 30))
figure
