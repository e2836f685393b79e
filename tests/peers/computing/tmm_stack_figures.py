"""Figures of tmm for absorbing layers, and for faces lit from within one: pip install tmm.

Lengths and the wavelength are in nanometres, angles in degrees; the media in front and behind do
not absorb, but for one metal behind.
"""

import numpy as np
import setups
import tmm

WAVELENGTH = 500.0

STACKS = (
    {"name": "tinted pane", "indices": [[1.5, 1e-6]], "lengths": [2e6], "incidence": 0.0},
    {"name": "tinted pane, oblique", "indices": [[1.5, 1e-5]], "lengths": [2e5], "incidence": 60.0},
    {"name": "k = 1e-2", "indices": [[1.5, 1e-2]], "lengths": [2e3], "incidence": 45.0},
    {"name": "k = 0.2", "indices": [[1.5, 0.2]], "lengths": [150.0], "incidence": 70.0},
    {
        "name": "three layers",
        "indices": [[1.5, 1e-4], [2.0, 3e-5], [1.3, 0.0]],
        "lengths": [5e2, 1.5e3, 1e3],
        "incidence": 40.0,
    },
    {
        "name": "six layers, near grazing",
        "indices": [[1.4, 1e-3], [1.9, 2e-3], [1.2, 1e-4], [2.5, 1e-2], [1.7, 0.0], [1.5, 5e-3]],
        "lengths": [1e3, 2e3, 5e3, 4e2, 1e3, 3e3],
        "incidence": 85.0,
    },
    {
        "name": "on a metal",
        "indices": [[1.5, 1e-3], [2.1, 3e-3]],
        "lengths": [4e3, 2e3],
        "incidence": 55.0,
        "substrate": [0.2, 3.4],
    },
    {
        "name": "out of glass",
        "indices": [[1.6, 2e-3], [1.5, 1e-3]],
        "lengths": [2e3, 3e3],
        "incidence": 35.0,
        "front": 1.7,
    },
)

FACES = (
    {
        "name": "tinted glass into air",
        "front": [1.5, 1e-3],
        "behind": [1.0, 0.0],
        "incidence": 40.0,
    },
    {"name": "k = 0.2 into air", "front": [1.5, 0.2], "behind": [1.0, 0.0], "incidence": 70.0},
    {"name": "k = 0.2 into k = 0.1", "front": [1.5, 0.2], "behind": [2.0, 0.1], "incidence": 30.0},
    {
        "name": "k = 0.05 onto a metal",
        "front": [1.3, 0.05],
        "behind": [0.2, 3.4],
        "incidence": 60.0,
    },
)
"""The incidence is that in air, from which a parallel face has refracted the light."""


def shares(setup):
    """Return R, what each layer absorbs, and T; along s, and then along p."""
    layers = [complex(*index) for index in setup["indices"]]
    media = [setup.get("front", 1.0), *layers, complex(*setup.get("substrate", [1.0, 0.0]))]
    lengths = [np.inf, *setup["lengths"], np.inf]
    coherence = "i" * len(media)
    found = []
    for way in "sp":
        angle = np.radians(setup["incidence"])
        stack = tmm.inc_tmm(way, media, lengths, coherence, angle, WAVELENGTH)
        _, *absorbed, _ = tmm.inc_absorp_in_each_layer(stack)
        found.append([float(share) for share in (stack["R"], *absorbed, stack["T"])])
    return found


def powers(setup):
    """Return R and T; along s, and then along p."""
    media = [1.0, complex(*setup["front"]), complex(*setup["behind"])]
    angles = tmm.list_snell(media, np.radians(setup["incidence"]))[1:]
    face = (*media[1:], *angles)
    return [[float(tmm.interface_R(p, *face)), float(tmm.interface_T(p, *face))] for p in "sp"]


setups.write(
    "stacks/tmm",
    "tmm",
    __file__,
    1e-12,
    shares=setups.asked(STACKS, shares, "shares"),
    powers=setups.asked(FACES, powers, "powers"),
)
