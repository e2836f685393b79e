"""When polarisation matters: how wrong two reflections are without it, over the angle.

    pip install "optipath[chart]"
    python examples/when_polarization_matters.py docs/polarization.png

Unpolarised light meets two surfaces of one material, the second turned by 90 degrees about the
light: the exact intensity beside that of the scalar model, and its certificate.
"""

import io
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import optipath as op
from optipath.values.files import write_file

# n and k at 582 nm: the metals by Johnson & Christy (Phys. Rev. B 6, 4370, 1972, and 9, 5056,
# 1974), glass as N-BK7.
MATERIALS = {
    "silver": (0.05, 3.858),
    "gold": (0.29, 2.863),
    "copper": (0.70, 2.704),
    "iron": (2.94, 2.99),
    "glass": (1.517, 0.0),
}
DEGREES = np.linspace(0.0, 89.0, 179)


def two_surfaces(n, k):
    """Return what polarisation does behind two surfaces, for each angle of incidence."""
    angles = {"delta": np.radians(DEGREES), "phi": np.radians(DEGREES), "rho": np.pi / 2}
    return op.polarization(op.load_preset("npgr026", n1=n, k1=k, n2=n, k2=k), **angles)


def rows():
    """Return for each material n / k and the largest difference up to 89 degrees."""
    for name, (n, k) in MATERIALS.items():
        found = two_surfaces(n, k)
        yield name, n / k if k else np.inf, float(np.max(np.abs(found.difference)))


def draw(file):
    """Draw the difference of every material, and what its certificate allows."""
    figure, axes = plt.subplots(figsize=(7.0, 4.2), layout="constrained")
    for name, (n, k) in MATERIALS.items():
        found = two_surfaces(n, k)
        (line,) = axes.semilogy(DEGREES, np.maximum(100 * np.abs(found.difference), 1e-6))
        axes.semilogy(DEGREES, 100 * found.certificate.error, ":", color=line.get_color())
        text = f"{name}, n/k = {n / k:.2g}" if k else f"{name}, k = 0"
        line.set_label(text)
    axes.set(xlabel="angle of incidence at both surfaces (degrees)", xlim=(0, 89))
    axes.set(ylabel="error of the scalar intensity (%)", ylim=(1e-4, 1e5))
    axes.set_title("Two reflections, planes of incidence crossed; dotted: the certificate")
    axes.legend(loc="upper left", ncols=2, fontsize="small")
    axes.grid(visible=True, alpha=0.3)
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=120, format=Path(file).suffix[1:] or None)
    write_file(Path(file), drawn.getvalue())  # A picture that is there already stays till then.


if __name__ == "__main__":
    for name, ratio, largest in rows():
        print(f"{name:8} n/k = {ratio:<8.2g} up to {100 * largest:.3g} %")
    if len(sys.argv) > 1:
        draw(sys.argv[1])
