"""What every software is asked for, and how its answers are written.

Angles are in degrees, and in radians where the software is asked; azimuths are from its x axis
towards its y axis. `clockwise` is as seen by who looks at the source.
"""

import json
import re
from importlib.metadata import version
from pathlib import Path

import numpy as np

FIGURES = Path(__file__).parents[1] / "figures"

INTERFACES = [
    {"name": "dielectric below Brewster's angle", "n": 1.5, "k": 0.0, "incidence": 30.0},
    {"name": "dielectric above Brewster's angle", "n": 1.5, "k": 0.0, "incidence": 75.0},
    {"name": "metal", "n": 0.2, "k": 3.4, "incidence": 50.0},
    {"name": "metal near grazing", "n": 1.12, "k": 2.16, "incidence": 85.0},
    {"name": "total reflection", "n": 1.0, "k": 0.0, "incidence": 60.0, "outside": 1.5},
    {"name": "from glass into air", "n": 1.0, "k": 0.0, "incidence": 20.0, "outside": 1.5},
]
PLATES = ((90.0, 20.0), (90.0, 0.0), (35.0, -50.0))
ELLIPSES = [
    {"azimuth": 25.0, "ellipticity": 15.0, "clockwise": True},
    {"azimuth": -60.0, "ellipticity": 35.0, "clockwise": False},
]
SETUPS = {
    "transmission": [s for s in INTERFACES if not s["k"] and s["name"] != "total reflection"],
    "polarizer": [{"angle": 30.0}, {"angle": -70.0}],
    "retarder": [{"retardance": retardance, "angle": angle} for retardance, angle in PLATES],
    "turned_frame": [{"angle": 25.0}],
    "circular": [{"clockwise": True}, {"clockwise": False}],
    "elliptical": ELLIPSES,
}
"""What is asked for, by the kind of figures; of all others, interfaces."""

CALLED = {"amplitudes": "r", "psi_delta": "angles", "reflected_at_45": "stokes"}
CALLED |= {"circular": "stokes", "elliptical": "stokes"}
CALLED |= {"reflection": "mueller", "normalized_reflection": "mueller", "transmission": "mueller"}
CALLED |= {"polarizer": "mueller", "retarder": "mueller", "turned_frame": "mueller"}
"""What the answers are called, by the kind of figures."""


DEGREES = ("incidence", "angle", "retardance", "azimuth", "ellipticity")


def given(setup):
    """Return a setup without its name, with angles in radians; in front is air where it is open."""
    named = {name: value for name, value in setup.items() if name != "name"}
    return {name: np.radians(v) if name in DEGREES else v for name, v in named.items()}


def asked(setups, answer, what):
    """Return the setups, each with what the software answers; those with None are left out."""
    answers = [(setup, answer(**given(setup))) for setup in setups]
    kept = [(setup, found) for setup, found in answers if found is not None]
    return [{**setup, what: np.asarray(found, np.float64).tolist()} for setup, found in kept]


def write(convention, package, script, precision, answers):
    """Write the figures of a convention, with how they were made, by functions called as kinds."""
    figures = {
        kind: asked(SETUPS.get(kind, INTERFACES), answers[kind], what)
        for kind, what in CALLED.items()
        if kind in answers
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
