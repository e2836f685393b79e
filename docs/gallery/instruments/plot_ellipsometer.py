r"""
Psi and Delta of an ellipsometer
================================

Reflection changes the ratio of the fields along p and s by :math:`\rho = r_p / r_s = \tan\Psi\,
e^{i\Delta}`. An ellipsometer finds both angles from intensities behind an analyser that turns.
"""

import numpy as np
from matplotlib.figure import Figure

import optipath as op

angles = np.linspace(20, 89.5, 300)
samples = {
    "silicon, 3.882 + 0.019 i": 3.882 + 0.019j,
    "gold, 0.18 + 3.0 i": 0.18 + 3.0j,
    "glass, 1.5": 1.5,
}

figure = Figure(figsize=(6.4, 5), layout="constrained")
upper, lower = figure.subplots(2, sharex=True)
for name, index in samples.items():
    psi, delta = op.Interface(index, np.radians(angles)).mueller().ellipsometric_angles()
    upper.plot(angles, np.degrees(psi), label=name)
    lower.plot(angles, np.degrees(delta))
upper.set(ylabel="Psi (deg)", ylim=(0, 46))
lower.set(ylabel="Delta (deg)", ylim=(-5, 185), yticks=range(0, 181, 45))
lower.set(xlabel="angle of incidence (deg)", xlim=(20, 90))
upper.legend()
figure

# %%
# In the instrument, light passes a polariser, a compensator, the sample and an analyser. The preset
# is that path; its detector ``state`` taps the light in front of the analyser, and ``photometer``
# reads the intensity behind it.

path = op.load_preset("ellipsometer-pcsa", compensator="0 deg", retardance="0 deg")
turned = np.linspace(0, 360, 361)
seen = path.trace_all(theta="70 deg", analyzer=np.radians(turned))["photometer"].intensity

figure = Figure(figsize=(6.4, 3), layout="constrained")
ax = figure.subplots()
ax.plot(turned, seen)
ax.set(xlabel="angle of the analyser, from p (deg)", ylabel="intensity", xlim=(0, 360))
ax.set(xticks=range(0, 361, 45), ylim=(0, None))
figure

# %%
# A Fourier sum over one turn gives :math:`\tan\Psi` and :math:`\cos\Delta` (R. M. A. Azzam and N.
# M. Bashara, *Ellipsometry and Polarized Light*, 1977, sec. 3.10), here with the polariser at 45
# degrees:

turn = np.exp(2j * np.radians(turned[:-1]))
a = 2 * (seen[:-1] * turn).mean() / seen[:-1].mean()
psi = np.arctan(np.sqrt((1 + a.real) / (1 - a.real)))
delta = np.arccos(a.imag / np.sqrt(1 - a.real**2))
true = op.Interface(3.882 + 0.019j, "70 deg").mueller().ellipsometric_angles()
print("by the analyser:", np.degrees([psi, delta]).round(4))
print("of the sample:  ", np.degrees(true).round(4))
