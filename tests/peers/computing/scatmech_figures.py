"""Figures of SCATMECH by pySCATMECH: pip install pySCATMECH (it compiles SCATMECH)."""

import numpy as np
import setups
from pySCATMECH.fresnel import FilmStack, OpticalFunction
from pySCATMECH.mueller import JonesStokes, MuellerDiattenuator, MuellerRetarder

WAVELENGTH = 0.5


def asked(setup):
    n, k, outside, angle = setups.incidence(setup)
    media = OpticalFunction(complex(outside)), OpticalFunction(complex(n, k))
    # "12i": the angle is that in the medium in front.
    return angle, WAVELENGTH, *media, "12i"


def polarizer(setup):
    # What it calls diattenuation is what is let through across the axis.
    return MuellerDiattenuator(diatten=0.0, angle=np.radians(setup["angle"]))


def retarder(setup):
    angles = np.radians(setup["retardance"]), np.radians(setup["angle"])
    return MuellerRetarder(phase=angles[0], angle=angles[1])


def circular(setup):
    # Its page of conventions calls (1, i) left-handed, which is counter-clockwise.
    return JonesStokes([1.0, -1j if setup["clockwise"] else 1j]) / 2


def ellipse(setup):
    azimuth, ellipticity = np.radians(setup["azimuth"]), np.radians(setup["ellipticity"])
    across = (-1j if setup["clockwise"] else 1j) * np.sin(ellipticity)
    c, s = np.cos(azimuth), np.sin(azimuth)
    return JonesStokes(np.array([[c, -s], [s, c]]) @ [np.cos(ellipticity), across])


def angles(setup):
    light = FilmStack().R(*asked(setup)) @ JonesStokes([1.0, 1.0])
    return [light.psi(), light.delta()]


setups.write(
    "scatmech",
    "pySCATMECH",
    __file__,
    1e-8,  # It agrees with tmm and pypolar to some parts in 1e9.
    reflection=lambda setup: FilmStack().R(*asked(setup)),
    transmission=lambda setup: FilmStack().T(*asked(setup)),
    polarizer=polarizer,
    retarder=retarder,
    circular=circular,
    elliptical=ellipse,
    psi_delta=angles,
)
