"""A wavelength without a default takes over what others of its name say."""

import numpy as np
import pytest

import optipath as op
from tables import rows

PAINT = (["400 nm", "600 nm"], [1.5, 1.7], [0.1, 0.3])
GREEN = op.Wavelength(default="500 nm", minimum="450 nm", maximum="550 nm", help="colour")


def path_of(*wavelengths):
    path = op.Source()
    for number, wavelength in enumerate(wavelengths):
        paint = op.Material.tabulated(*PAINT, name="paint", wavelength=wavelength)
        path = path >> op.Interface(paint, 0.3, azimuth=0.1 * number)
    return path >> op.Detector()


@rows("wavelengths", [(op.Wavelength(), GREEN), (GREEN, op.Wavelength())])
def test_a_bare_wavelength_takes_over_default_range_and_help(wavelengths):
    path = path_of(*wavelengths)
    found = path.parameters["wavelength"]
    assert (found.default, found.minimum, found.help) == (5e-7, 4.5e-7, "colour")
    assert path.trace() == path.trace(wavelength="500 nm")
    assert path.trace() == path_of(GREEN, GREEN).trace()
    with pytest.raises(op.ParameterError, match="outside its range"):
        path.trace(wavelength="560 nm")


def test_a_bare_wavelength_takes_over_that_of_a_plate():
    free = op.Parameter("wavelength", "500 nm")
    path = path_of(op.Wavelength())
    plate = op.Source() >> op.Waveplate("1 um", 0.01, free) >> op.Detector()
    joined = op.Source() >> op.Waveplate("1 um", 0.01, free) >> path.element("interface")
    joined = joined >> op.Detector()
    assert joined.parameters["wavelength"].default == 5e-7
    assert plate.parameters["wavelength"] == joined.parameters["wavelength"]
    np.testing.assert_array_equal(joined.trace().stokes, path.trace(wavelength="500 nm").stokes)


def test_wavelengths_that_say_different_things_are_refused():
    red = op.Wavelength(default="590 nm")
    with pytest.raises(op.PathError, match=r"'wavelength' .* differs from the one of that name"):
        path_of(GREEN, red).trace()
    with pytest.raises(op.ParameterError) as caught:
        path_of(op.Wavelength()).bind(wavelength="700 nm")
    (fault,) = caught.value.faults
    assert "700 nm" in fault
    assert "for which paint is known" in fault
    turn = op.Parameter("wavelength", "50 deg")
    path = path_of(op.Wavelength()).element("interface")
    with pytest.raises(op.OptipathError, match="use one Parameter, or two names"):
        (op.Source() >> path >> op.Rotator(turn) >> op.Detector()).trace()
