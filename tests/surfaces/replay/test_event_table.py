"""Events of a photon as a table."""

import numpy as np

from optipath.surfaces.replay.event_table import event_table
from optipath.surfaces.replay.photon_event import PhotonEvent


def event(n2, *, reflected):
    up, down = np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.6, -0.8])
    return PhotonEvent(
        layer=1,
        facet=(3, 4, 0),
        position=np.zeros(3),
        on_mesh=np.array([1.25, -1e-9, 12.0]),
        normal=up,
        direction=down,
        onwards=down,
        cos=0.8,
        sin=0.6,
        turn=-1e-9,
        reflected=reflected,
        probability=0.25,
        n1=1.0,
        n2=n2,
    )


def test_columns_stand_under_their_heads_without_a_sign_of_zero():
    met = [event(1.5, reflected=False), event(0.5 + 2.1j, reflected=True)]
    expected = """\
   layer                    media   incidence       turn  probability      x      y       z
1      1  refracted       1 | 1.5  36.870 deg  0.000 deg     0.250000  1.250  0.000  12.000
2      1  reflected  1 | 0.5+2.1j  36.870 deg  0.000 deg     0.250000  1.250  0.000  12.000"""
    assert event_table(met) == expected


def test_a_base_of_several_wavelengths_has_no_single_index():
    line = event_table([event(np.array([0.5 + 2.1j, 0.4 + 2.4j]), reflected=True)]).splitlines()[1]
    assert line.split()[3:8] == ["1", "|", "n", "+", "ik"]
