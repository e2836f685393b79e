"""Figures of tmm: pip install tmm. It has amplitudes, psi and Delta, and no Stokes vectors.

Of absorbing layers, and of faces lit from within one, there are powers: lengths and the wavelength
are in nanometres, angles in degrees; the media in front and behind do not absorb, but for one metal
behind.
"""

import numpy as np
import setups
import tmm

WAVELENGTH = 500.0


def asked(n, k, incidence, outside=1.0):
    return [outside, complex(n, k)], [np.inf, np.inf], incidence, WAVELENGTH


def amplitudes(**setup):
    """Return r_s and r_p, each as a real and an imaginary part."""
    found = (complex(tmm.coh_tmm(way, *asked(**setup))["r"]) for way in "sp")
    return [[r.real, r.imag] for r in found]


def psi_delta(**setup):
    found = tmm.ellips(*asked(**setup))
    return [found["psi"], found["Delta"]]


SIX = [[1.4, 1e-3], [1.9, 2e-3], [1.2, 1e-4], [2.5, 1e-2], [1.7, 0.0], [1.5, 5e-3]]
STACKS = {
    "tinted pane": ([[1.5, 1e-6]], [2e6], 0.0),
    "tinted pane, oblique": ([[1.5, 1e-5]], [2e5], 60.0),
    "k = 1e-2": ([[1.5, 1e-2]], [2e3], 45.0),
    "k = 0.2": ([[1.5, 0.2]], [150.0], 70.0),
    "three layers": ([[1.5, 1e-4], [2.0, 3e-5], [1.3, 0.0]], [5e2, 1.5e3, 1e3], 40.0),
    "six layers, near grazing": (SIX, [1e3, 2e3, 5e3, 4e2, 1e3, 3e3], 85.0),
    "on a metal": ([[1.5, 1e-3], [2.1, 3e-3]], [4e3, 2e3], 55.0, {"substrate": [0.2, 3.4]}),
    "out of glass": ([[1.6, 2e-3], [1.5, 1e-3]], [2e3, 3e3], 35.0, {"front": 1.7}),
}
"""Indices, lengths and the incidence, and what is not air in front or behind."""

FACES = {
    "tinted glass into air": ([1.5, 1e-3], [1.0, 0.0], 40.0),
    "k = 0.2 into air": ([1.5, 0.2], [1.0, 0.0], 70.0),
    "k = 0.2 into k = 0.1": ([1.5, 0.2], [2.0, 0.1], 30.0),
    "k = 0.05 onto a metal": ([1.3, 0.05], [0.2, 3.4], 60.0),
}
"""Media in front and behind; the incidence is in air, from which a parallel face has refracted."""


def named(setups_by_name, *keys):
    """Return setups with a name, by the keys of what they have; in the last there may be more."""
    return [
        {"name": name, **dict(zip(keys, given, strict=False)), **dict(*given[len(keys) :])}
        for name, given in setups_by_name.items()
    ]


def shares(indices, lengths, incidence, front=1.0, substrate=(1.0, 0.0)):
    """Return R, what each layer absorbs, and T; along s, and then along p."""
    media = [front, *(complex(*index) for index in indices), complex(*substrate)]
    thick = [np.inf, *lengths, np.inf]
    found = []
    for way in "sp":
        stack = tmm.inc_tmm(way, media, thick, "i" * len(media), incidence, WAVELENGTH)
        _, *absorbed, _ = tmm.inc_absorp_in_each_layer(stack)
        found.append([float(share) for share in (stack["R"], *absorbed, stack["T"])])
    return found


def powers(front, behind, incidence):
    """Return R and T; along s, and then along p."""
    media = [1.0, complex(*front), complex(*behind)]
    face = (*media[1:], *tmm.list_snell(media, incidence)[1:])
    return [[float(tmm.interface_R(p, *face)), float(tmm.interface_T(p, *face))] for p in "sp"]


setups.write("tmm", "tmm", __file__, 1e-12, vars())
stacks = named(STACKS, "indices", "lengths", "incidence")
found = {
    "shares": setups.asked(stacks, shares, "shares"),
    "powers": setups.asked(named(FACES, "front", "behind", "incidence"), powers, "powers"),
}
setups.write_file("stacks/tmm", "tmm", __file__, precision=1e-12, **found)
