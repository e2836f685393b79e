"""Runs of plain floats at one wavelength after the other."""

import numpy as np
import pytest

import optipath as op
from optipath.values.curves.curve_value import curve_values
from spectral_paths import Ramps, wavelengths

N = Ramps(1.2, 2.4, 1.3e-7)


def plan_of(default=None):
    (n,) = curve_values(N, op.Wavelength(default=default))
    path = op.Source() >> op.Interface(op.Material(n), op.Parameter("theta")) >> op.Detector()
    plan = path.compose()
    for _ in range(6):
        plan.run(wavelength=5e-7, theta=0.3)
    return plan


def test_each_wavelength_by_number_word_or_default_has_its_own_light():
    plan = plan_of()
    for wavelength in (*wavelengths(7).tolist(), 5e-7, 5e-7):
        (n,) = N.evaluated(wavelength)
        r = (1.0 - n) / (1.0 + n)
        light = plan.run(wavelength=wavelength, theta=0.0)
        assert np.allclose(light.intensity, r * r, rtol=1e-14)
    plan = plan_of(default=6e-7)
    at_default = plan.run(theta=0.3).stokes
    assert np.array_equal(at_default, plan.run(wavelength=6e-7, theta=0.3).stokes)
    assert not np.array_equal(at_default, plan.run(wavelength=5e-7, theta=0.3).stokes)
    plan = plan_of()
    in_words = plan.run(wavelength="500 nm", theta=0.3).stokes
    assert np.array_equal(in_words, plan.run(wavelength=500e-9, theta=0.3).stokes)


def test_wavelengths_and_curves_out_of_range_are_named():
    plan = plan_of()
    with pytest.raises(op.ParameterError, match="for which ramps is known"):
        plan.run(wavelength=2e-5, theta=0.3)
    with pytest.raises(op.ParameterError, match="'wavelength' has no value"):
        plan.run(theta=0.3)
    assert plan.run(wavelength=5e-7, theta=0.3).intensity > 0.0
    path = panes((3.5e-7, 9e-7), (1e-7, 9e-7), (4e-7, 8e-7))
    for run in (path.trace, path.bind):
        with pytest.raises(op.OptipathError) as refused:
            run(wavelength="200 nm").compose()
        faults = refused.value.faults
        known = ["300 nm .. 830 nm, for which illuminant D65", "350 nm .. 900 nm", "400 nm .. 800"]
        assert len(faults) == 3
        assert all(part in fault for part, fault in zip(known, faults, strict=True))
    with pytest.raises(op.OptipathError, match="can have no value: glass 0 is known within 350 nm"):
        panes((3.5e-7, 4e-7), (4.5e-7, 9e-7)).compose()
    assert panes((3.5e-7, 4e-7), (4e-7, 9e-7)).trace(wavelength="400 nm").intensity > 0.0


def panes(*spans):
    path = op.Source(spectrum=op.Spectrum.illuminant("D65"))
    for place, span in enumerate(spans):
        glass = op.Material.tabulated(list(span), [1.5, 1.6], [0.0, 0.1], name=f"glass {place}")
        path = path >> op.Interface(glass, 0.3)
    return path >> op.Detector()
