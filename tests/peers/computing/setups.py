"""What every software is asked for, and how its answers are written.

Angles are in degrees, azimuths from the x axis of the software towards its y axis. `clockwise`
is as seen by who looks at the source.
"""

import json
import re
from importlib.metadata import version
from pathlib import Path

import numpy as np

FIGURES = Path(__file__).parents[1] / "figures"

INTERFACES = (
    {"name": "dielectric below Brewster's angle", "n": 1.5, "k": 0.0, "incidence": 30.0},
    {"name": "dielectric above Brewster's angle", "n": 1.5, "k": 0.0, "incidence": 75.0},
    {"name": "metal", "n": 0.2, "k": 3.4, "incidence": 50.0},
    {"name": "metal near grazing", "n": 1.12, "k": 2.16, "incidence": 85.0},
    {"name": "total reflection", "n": 1.0, "k": 0.0, "incidence": 60.0, "outside": 1.5},
    {"name": "from glass into air", "n": 1.0, "k": 0.0, "incidence": 20.0, "outside": 1.5},
)
TRANSPARENT = tuple(s for s in INTERFACES if not s["k"] and s["name"] != "total reflection")
POLARIZERS = ({"angle": 30.0}, {"angle": -70.0})
PLATES = ((90.0, 20.0), (90.0, 0.0), (35.0, -50.0))
RETARDERS = tuple({"retardance": retardance, "angle": angle} for retardance, angle in PLATES)
CIRCULAR = ({"clockwise": True}, {"clockwise": False})
ELLIPSES = (
    {"azimuth": 25.0, "ellipticity": 15.0, "clockwise": True},
    {"azimuth": -60.0, "ellipticity": 35.0, "clockwise": False},
)


def incidence(setup):
    """Return (n, k, n of the medium in front, angle of incidence in radians)."""
    return setup["n"], setup["k"], setup.get("outside", 1.0), np.radians(setup["incidence"])


KINDS = {
    "reflection": (INTERFACES, "mueller"),
    "normalized_reflection": (INTERFACES, "mueller"),
    "transmission": (TRANSPARENT, "mueller"),
    "polarizer": (POLARIZERS, "mueller"),
    "retarder": (RETARDERS, "mueller"),
    "turned_frame": (({"angle": 25.0},), "mueller"),
    "circular": (CIRCULAR, "stokes"),
    "elliptical": (ELLIPSES, "stokes"),
    "reflected_at_45": (INTERFACES, "stokes"),
    "amplitudes": (INTERFACES, "r"),
    "psi_delta": (INTERFACES, "angles"),
}
"""What is asked for, and what the answers are called, by the kind of figures."""


def asked(setups, answer, what):
    """Return the setups, each with what the software answers; those with None are left out."""
    answers = [(setup, answer(setup)) for setup in setups]
    return [{**setup, what: plain(found)} for setup, found in answers if found is not None]


def plain(value):
    return value if isinstance(value, float) else np.asarray(value, np.float64).tolist()


def write(convention, package, script, precision, **answers):
    """Write the figures of a convention, with how they were made; kinds by what answers them."""
    figures = {
        kind: asked(KINDS[kind][0], answer, KINDS[kind][1]) if callable(answer) else answer
        for kind, answer in answers.items()
    }
    write_file(convention, package, script, precision=precision, **figures)


def write_file(name, package, script, **content):
    """Write what software computes, with how it was made."""
    made_by = f"python tests/peers/computing/{Path(script).name}"
    made = {"software": f"{package} {version(package)}", "made by": made_by}
    text = json.dumps({**made, **content}, indent=1)
    # One row of a matrix in a line.
    text = re.sub(r"\[\s+([-\d][^][]*?)\s+\]", lambda row: f"[{' '.join(row[1].split())}]", text)
    (FIGURES / f"{name}.json").write_text(text + "\n", encoding="utf-8")
