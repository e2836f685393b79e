"""Wave plates by the wavelength at which they are a quarter or a half wave."""

import numpy as np
import pytest

import optipath as op
from tables import rows

CRYSTALS = ["quartz", "calcite", "magnesium fluoride", "sapphire", 0.0091, -0.17]


def behind(plate, wavelength):
    path = op.Source(stokes=[1.0, 0.0, 1.0, 0.0]) >> plate >> op.Detector()
    return path.trace(wavelength=wavelength).stokes


@rows("order", [0, 1, 20])
@rows("crystal", CRYSTALS)
def test_plates_are_a_quarter_and_a_half_wave_with_the_fast_axis_at_their_angle(crystal, order):
    for made, expected in (
        (op.Waveplate.quarter, [1.0, 0.0, 0.0, 1.0]),
        (op.Waveplate.half, [1.0, 0.0, -1.0, 0.0]),
    ):
        plate = made("550 nm", crystal, order=order)
        np.testing.assert_allclose(behind(plate, "550 nm"), expected, rtol=0, atol=1e-12)


def test_a_compound_plate_retards_as_one_of_zero_order_does():
    thick = op.Waveplate.quarter("550 nm", order=10)
    whole = op.Waveplate.retarding(0.0, "550 nm", order=10, angle="90 deg")
    path = op.Source(stokes=[1.0, 0.0, 1.0, 0.0]) >> thick >> whole >> op.Detector()
    grid = np.linspace(4.5e-7, 6.5e-7, 9)
    zero = behind(op.Waveplate.quarter("550 nm"), grid)
    np.testing.assert_allclose(path.trace(wavelength=grid).stokes, zero, rtol=0, atol=1e-12)


@rows(
    "wrong, said",
    [
        ({"order": -1}, "order is -1; give how many whole waves"),
        ({"order": 0.5}, "order is 0.5"),
        ({"at": 550}, "for nanometres write '550 nm'"),
        ({"at": ["500 nm", "600 nm"]}, "give one number for one plate"),
        ({"crystal": "quarz"}, "did you mean 'quartz'"),
        ({"crystal": 0}, "a birefringence of 0 at 550 nm"),
        ({"crystal": None}, "give a name such as 'quartz'"),
    ],
)
def test_plates_that_cannot_be_are_refused(wrong, said):
    with pytest.raises(op.OptipathError, match=said):
        op.Waveplate.quarter(**{"at": "550 nm", **wrong})
