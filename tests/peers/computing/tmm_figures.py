"""Figures of tmm: pip install tmm. It has amplitudes, psi and Delta, and no Stokes vectors.

Of absorbing layers, and of faces lit from within one, there are powers: lengths and the wavelength
are in nanometres, angles in degrees; the media in front and behind do not absorb, but for one metal
behind.
"""

import numpy as np
import setups
import tmm

WAVELENGTH = 500.0
THICK = [np.inf, np.inf]


def asked(setup):
    n, k, outside, angle = setups.incidence(setup)
    return [outside, complex(n, k)], THICK, angle, WAVELENGTH


def amplitudes(setup):
    """Return r_s and r_p, each as a real and an imaginary part."""
    found = (complex(tmm.coh_tmm(way, *asked(setup))["r"]) for way in "sp")
    return [[r.real, r.imag] for r in found]


def angles(setup):
    found = tmm.ellips(*asked(setup))
    return [found["psi"], found["Delta"]]


def stack(name, indices, lengths, incidence, **more):
    given = {"name": name, "indices": indices, "lengths": lengths, "incidence": incidence}
    return given | more


def face(name, front, behind, incidence):
    """The incidence is that in air, from which a parallel face has refracted the light."""
    return {"name": name, "front": front, "behind": behind, "incidence": incidence}


SIX = [[1.4, 1e-3], [1.9, 2e-3], [1.2, 1e-4], [2.5, 1e-2], [1.7, 0.0], [1.5, 5e-3]]
STACKS = (
    stack("tinted pane", [[1.5, 1e-6]], [2e6], 0.0),
    stack("tinted pane, oblique", [[1.5, 1e-5]], [2e5], 60.0),
    stack("k = 1e-2", [[1.5, 1e-2]], [2e3], 45.0),
    stack("k = 0.2", [[1.5, 0.2]], [150.0], 70.0),
    stack("three layers", [[1.5, 1e-4], [2.0, 3e-5], [1.3, 0.0]], [5e2, 1.5e3, 1e3], 40.0),
    stack("six layers, near grazing", SIX, [1e3, 2e3, 5e3, 4e2, 1e3, 3e3], 85.0),
    stack("on a metal", [[1.5, 1e-3], [2.1, 3e-3]], [4e3, 2e3], 55.0, substrate=[0.2, 3.4]),
    stack("out of glass", [[1.6, 2e-3], [1.5, 1e-3]], [2e3, 3e3], 35.0, front=1.7),
)
FACES = (
    face("tinted glass into air", [1.5, 1e-3], [1.0, 0.0], 40.0),
    face("k = 0.2 into air", [1.5, 0.2], [1.0, 0.0], 70.0),
    face("k = 0.2 into k = 0.1", [1.5, 0.2], [2.0, 0.1], 30.0),
    face("k = 0.05 onto a metal", [1.3, 0.05], [0.2, 3.4], 60.0),
)


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


setups.write("tmm", "tmm", __file__, 1e-12, amplitudes=amplitudes, psi_delta=angles)
found = {
    "shares": setups.asked(STACKS, shares, "shares"),
    "powers": setups.asked(FACES, powers, "powers"),
}
setups.write("stacks/tmm", "tmm", __file__, 1e-12, **found)
