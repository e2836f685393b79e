"""
The n and k of a metal, by a fit
================================

Light polarised at 45 degrees is reflected at several angles, and its Stokes vectors are measured,
with noise. Which index of refraction gives such light? A path is a function of its parameters, and
SciPy's least squares finds them.
"""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patheffects import Normal, Stroke
from scipy.optimize import least_squares

import optipath as op

incidence = np.radians(np.arange(40, 85, 5))
metal = op.Material(op.Parameter("n"), op.Parameter("k"))
path = op.Source(stokes=[1, 0, 1, 0]) >> op.Interface(metal, incidence) >> op.Detector()

TRUE = {"n": 0.608, "k": 2.12}
random = np.random.default_rng(1)
measured = path.trace(**TRUE).stokes + random.normal(scale=0.01, size=(len(incidence), 4))


def misfit(index):
    """Return what is left of the measurement beside the light of an index."""
    return (path.trace(n=index[0], k=index[1]).stokes - measured).ravel()


found = least_squares(misfit, x0=[1.0, 1.0], bounds=([0, 0], [np.inf, np.inf]))
spread = np.sqrt(2 * found.cost / (found.fun.size - 2))
errors = spread * np.sqrt(np.diag(np.linalg.inv(found.jac.T @ found.jac)))
for name, value, error in zip(TRUE, found.x, errors, strict=True):
    print(f"{name} = {value:.3f} +- {error:.3f}, in truth {TRUE[name]}")

# %%
# The points are the measurement, the lines are the light of the index that was found.

fine = np.radians(np.linspace(35, 88, 200))
lines = op.Source(stokes=[1, 0, 1, 0]) >> op.Interface(complex(*found.x), fine) >> op.Detector()

figure = Figure(figsize=(6.4, 4), layout="constrained")
ax = figure.subplots()
for component, (points, line) in enumerate(zip(measured.T, lines.trace().stokes.T, strict=True)):
    (drawn,) = ax.plot(np.degrees(fine), line, label=f"S{component}")
    ax.plot(np.degrees(incidence), points, "o", color=drawn.get_color())
ax.set(xlabel="angle of incidence (deg)", ylabel="Stokes vector")
ax.legend(ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1))
figure

# %%
# How well the angles of a measurement tell n from k: around the minimum, the sum of squares is a
# valley aslant: a larger n goes with a larger k.

n, k = np.meshgrid(np.linspace(0.4, 0.8, 81), np.linspace(1.9, 2.35, 91))
light = path.trace(n=n[..., np.newaxis], k=k[..., np.newaxis])
squares = ((light.stokes - measured) ** 2).sum(axis=(-1, -2))

figure = Figure(figsize=(5, 4), layout="constrained")
ax = figure.subplots()
drawn = ax.contourf(n, k, squares / spread**2, levels=20, cmap="viridis_r")
figure.colorbar(drawn, label="sum of squares, over the variance")
rim = [Stroke(linewidth=4, foreground="white"), Normal()]
ax.errorbar(*found.x, *errors[::-1], "o", color="black", label="found", path_effects=rim)
ax.plot(*TRUE.values(), "+", color="#D55E00", markersize=12, zorder=4, label="true")
ax.set(xlabel="n", ylabel="k")
ax.legend()
figure
