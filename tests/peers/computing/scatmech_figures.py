"""Figures of SCATMECH by pySCATMECH: pip install pySCATMECH (it compiles SCATMECH)."""

import numpy as np
import setups
from pySCATMECH.fresnel import FilmStack, OpticalFunction
from pySCATMECH.mueller import JonesStokes, MuellerDiattenuator, MuellerRetarder


def asked(n, k, incidence, outside=1.0):
    media = OpticalFunction(complex(outside)), OpticalFunction(complex(n, k))
    # The wavelength is 0.5; "12i": the angle is that in the medium in front.
    return incidence, 0.5, *media, "12i"


def circular(clockwise):
    # Its page of conventions calls (1, i) left-handed, which is counter-clockwise.
    return JonesStokes([1.0, -1j if clockwise else 1j]) / 2


def elliptical(azimuth, ellipticity, clockwise):
    across = (-1j if clockwise else 1j) * np.sin(ellipticity)
    c, s = np.cos(azimuth), np.sin(azimuth)
    return JonesStokes(np.array([[c, -s], [s, c]]) @ [np.cos(ellipticity), across])


def psi_delta(**setup):
    light = FilmStack().R(*asked(**setup)) @ JonesStokes([1.0, 1.0])
    return [light.psi(), light.delta()]


answers = {
    "reflection": lambda **setup: FilmStack().R(*asked(**setup)),
    "transmission": lambda **setup: FilmStack().T(*asked(**setup)),
    # What it calls diattenuation is what is let through across the axis.
    "polarizer": lambda angle: MuellerDiattenuator(diatten=0.0, angle=angle),
    "retarder": lambda retardance, angle: MuellerRetarder(phase=retardance, angle=angle),
}
answers |= {"circular": circular, "elliptical": elliptical, "psi_delta": psi_delta}
# It agrees with tmm and pypolar to some parts in 1e9.
setups.write("scatmech", "pySCATMECH", __file__, 1e-8, answers)
