"""Sources with a spectrum, responses, and values that follow from the wavelength."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

import optipath as op
from chains import ENGINES, by_engine
from dispersive import GRID as PLACES
from dispersive import line, on_line
from optipath.elements.coupling import KINDS
from optipath.lab.path_reference import exact_stokes
from optipath.materials.illuminants import grid_widths
from tables import rows, slow
from wired import wired

GRID = op.wavelengths("380 nm", "700 nm", "40 nm")
LASER = op.Spectrum.line("633 nm", power=2.0)
LED = op.Spectrum.led("550 nm", "100 nm")
SMOOTH = [
    op.Spectrum.sampled(["300 nm", "500 nm", "800 nm"], [1.0, 2.0, 0.5]),
    op.Spectrum.histogram(np.linspace(300e-9, 800e-9, 11), np.arange(10.0)),
    op.Spectrum.black_body(3000.0),
    op.Spectrum.illuminant("A"),
    op.Spectrum.illuminant("D65"),
    op.Spectrum.constant(3.0),
    LED,
]


STATE = [1.0, 0.5, 0.3, 0.0]


def seen(spectrum, response=None, stokes=None):
    return (
        op.Source(2.0, stokes, spectrum=spectrum)
        >> op.Polarizer(op.Parameter("angle", 0.3))
        >> op.Detector(response=response)
    )


@by_engine
@rows("spectrum", [*SMOOTH, LASER, SMOOTH[0] + 3.0 * LASER])
def test_light_is_multiplied_by_spectrum_and_response(spectrum, engine):
    path, plain = (seen(one, two, STATE) for one, two in ((spectrum, LED), (None, None)))
    expected = (spectrum.at(GRID) * LED.at(GRID))[:, None] * plain.trace().stokes
    plan = op.Composer(engine=engine).compose(path)
    for _ in range(3):
        np.testing.assert_allclose(plan.run(wavelength=GRID).stokes, expected, rtol=1e-14)
    if spectrum in SMOOTH:
        for options in ({"model": "full"}, {"composing": "jones"}):
            found = op.Composer(**options).compose(path).run(wavelength=GRID).stokes
            np.testing.assert_allclose(found, expected, rtol=1e-14, atol=1e-16)
        together = path.trace(wavelength=GRID).stokes
        alone = [path.trace(wavelength=place).stokes for place in GRID]
        np.testing.assert_array_equal(together, alone)


@by_engine
@rows("grid", [GRID, GRID[::-1], np.array([400.0, 630.0, 640.0, 641.0, 700.0]) * 1e-9])
def test_a_line_keeps_its_power_on_any_grid(grid, engine):
    plan = op.Composer(engine=engine).compose(seen(LASER))
    light = plan.run(wavelength=grid)
    # Half of an intensity of 2 by a power of 2 is behind the polariser.
    assert np.dot(light.intensity, grid_widths(grid)) == pytest.approx(2.0, rel=1e-14)


def test_a_line_keeps_its_power_along_other_axes_and_in_streams():
    plan, angles = seen(LASER).compose(), np.linspace(0.0, 1.0, 7)
    grid = np.linspace(600e-9, 700e-9, 50)
    light = plan.run(wavelength=grid[:, None], angle=angles)
    np.testing.assert_allclose(grid_widths(grid) @ light.intensity, 2.0, rtol=1e-14)
    parts = list(plan.stream(60, wavelength=grid[:, None], angle=angles))
    assert len(parts) > 1
    whole = np.concatenate([part.light.intensity.reshape(-1) for part in parts])
    np.testing.assert_array_equal(whole, light.intensity.reshape(-1))


@rows(
    "wavelength, sentence",
    [
        (GRID[:1], "no row of two or more"),
        (np.r_[GRID, GRID[-1:]], "neither rise nor fall"),
        (GRID[[0, 4, 2]], "neither rise nor fall"),
        (GRID[:8].reshape(2, 4), r"of shape \(2, 4\)"),
        (np.tile(GRID[:4], (2, 1)), "along one axis"),
        ([], "no row of two or more"),
        (GRID[:4], "give some around it"),
    ],
)
def test_what_is_no_grid_for_a_line_is_refused(wavelength, sentence):
    with pytest.raises(op.errors.ParameterError, match=sentence):
        seen(LASER).trace(wavelength=wavelength)


def test_a_line_may_be_left_out_or_wait_for_its_grid():
    dark = seen(op.Spectrum.line("633 nm", outside=0.0)).trace(wavelength=GRID[:4])
    np.testing.assert_array_equal(dark.intensity, 0.0)
    wavelength = op.Wavelength(default="500 nm")
    path = op.Source(spectrum=LASER.at(wavelength)) >> op.Detector()
    assert path.trace(wavelength=GRID).intensity[6] == pytest.approx(2.0 / 40.0, rel=1e-14)
    with pytest.raises(op.errors.ParameterError, match="no row of two or more"):
        path.trace()
    path, other = seen(SMOOTH[0] + LASER, LED), seen(SMOOTH[0], LED)
    bound = path.bind(wavelength=GRID)
    np.testing.assert_array_equal(bound.trace().stokes, path.trace(wavelength=GRID).stokes)
    assert other.bind(wavelength=5e-7).trace() == other.trace(wavelength=5e-7)
    path = seen(op.Spectrum.sampled(["400 nm", "500 nm"], [1.0, 2.0], name="the lamp"))
    with pytest.raises(op.errors.ParameterError, match=r"source.spectrum.*the lamp.*outside=0.0"):
        path.trace(wavelength="600 nm")
    assert repr(op.Source(spectrum=LASER)).endswith("spectrum=<the line at 633 nm, by wavelength>)")
    with pytest.raises(op.errors.ValueFault, match="not <class"):
        op.Attenuator(op.Parameter)


def test_a_response_may_be_a_number_of_any_size_and_no_power():
    plain, seven = op.Source(3.0) >> op.Detector(), op.Source(3.0) >> op.Detector(response=7.0)
    for engine in ENGINES:
        assert op.Composer(engine=engine).compose(seven).run().intensity == 21.0
    np.testing.assert_allclose(seven.mueller().matrix, 7.0 * plain.mueller().matrix)
    with pytest.raises(op.errors.ValueFault, match="Detector response is -1"):
        op.Detector(response=-1.0)
    for power in (LASER, SMOOTH[1], LED + LASER):
        with pytest.raises(op.errors.ValueFault, match="which is power and no response"):
            op.Detector(response=power)


def test_the_reference_in_many_digits_has_spectra_and_responses():
    path = seen(SMOOTH[2], LED, STATE)
    (exact,) = exact_stokes(path, wavelength=5.2e-7).values()
    found = path.trace(wavelength=5.2e-7).stokes
    np.testing.assert_allclose(found, [float(part) for part in exact], rtol=1e-14)


@rows("spectrum", [SMOOTH[2], LED])
def test_slopes_in_the_wavelength_are_those_of_the_spectrum(spectrum, jacobian):
    plan = op.Composer(engine="jax").compose(seen(spectrum, LED))
    slope_at = jacobian(lambda w: plan.run(wavelength=w).intensity)
    for place in (4.23e-7, 5.517e-7):
        step = 1e-12
        less, here, more = (spectrum.at(w) * LED.at(w) for w in (place - step, place, place + step))
        expected = pytest.approx((more - less) / (2.0 * step), rel=1e-5, abs=1e-6 * here / place)
        assert float(slope_at(place)) == expected


def test_a_line_is_not_for_wavelengths_that_jax_traces(jax):
    plan = op.Composer(engine="jax").compose(seen(LASER))
    with pytest.raises(op.errors.ParameterError, match="traced by JAX"):
        jax.jit(lambda w: plan.run(wavelength=w).stokes)(jax.numpy.asarray(GRID))


@rows(
    "spectrum, sentence",
    [
        ("d65", r"'d65' is no spectrum .* write op.Spectrum.illuminant\(\"D65\"\)"),
        ("633 nm", r"'633 nm' is no spectrum by itself; write op.Spectrum.line\(\"633 nm\"\)"),
        ("red", "'red' is not a quantity"),
        (op.Spectrum, r"spectrum is the class Spectrum; give one of it, op.Spectrum.illuminant"),
    ],
)
def test_what_is_no_spectrum_is_told_with_the_one_that_was_meant(spectrum, sentence):
    with pytest.raises(op.OptipathError, match=sentence):
        op.Source(spectrum=spectrum)


POINTS = np.array([[0, 0, 0], [0, 0, 2.0], [0.1, 0.2, 4], [0.5, -1.0, 2.2]])

DICHROIC = {"dichroism": 4.0, "dichroic_angle": 0.8, "circular_dichroism": -3.0}
GENERAL = op.Medium(0.1, 9.0, 2.0, 7.0, 0.3, 0.2, **DICHROIC, depolarization=5.0)
TINT = op.Material(1.5, 1e-6)
TINTED = op.LayerStack([1.0, TINT, 1.7], 0.7, 0.2, lengths=[1e-3], wavelength=5e-7)

ELEMENTS = [
    op.Attenuator(0.3),
    op.BeamSplitter(0.3, 0.2),
    op.CircularDiattenuator(0.8, 0.3),
    op.CircularPolarizer("left", 0.9, 0.1),
    op.Depolarizer(0.3),
    op.Diattenuator(0.8, 0.3, 0.4, 0.2),
    op.EllipticalRetarder(0.4, -0.7, 1.1, 0.2),
    op.FaradayRotator(0.4),
    op.FaradayRotator(verdet=-134.0, field=-0.2, length=0.02),
    op.Interface(1.5, 1.1, 1.2, 0.3),
    op.Interface(op.Material(3.0, 0.2), 1.1, 1.3),
    op.Interface(1.5, 1.1, op.Material(1.2, 0.01), incidence_in=1.0),
    op.LayerStack([1.0, 1.5, 1.7], 0.7),
    TINTED,
    GENERAL,
    replace(GENERAL, rotation=0.0, dextrorotation=2.0),
    op.Medium(0.1, 2.0),
    op.Medium(0.1, retardance=2.0),
    op.Medium(0.1, rotation=2.0),
    op.Mirror(-0.9, 0.8, 0.2),
    op.Polarizer(0.3, 0.2, 0.9, 0.2),
    op.PolarizingBeamSplitter(1000.0, 20.0, 0.2),
    op.RefractingVertex(1.5, POINTS, 1),
    op.Retarder(0.4, 0.3, 0.2),
    op.Rotator(0.3),
    op.Source(2.0),
    op.SpecularVertex(op.Material(0.2, 3.0), POINTS, 1),
    op.SpecularVertex(0.2, op.VerticesByAngles((0.3, 0.7), (0.4,)), 1),
    op.Vertex(op.Material(1.5, 0.0), POINTS, 1, 1.1, events=[0, 0]),
    op.Waveplate(1e-5, 0.009, 5.89e-7, 0.3, 0.2),
]

WITHOUT = {op.Combiner, op.Detector, op.Dump, op.MuellerElement}
"""Those that take no number, or several in one."""


def with_value(whole, place, value):
    """Put a value at a place such as ``indices[1].n`` of an element."""
    if not place:
        return value
    name, number, rest = re.fullmatch(r"\.?(\w*)(?:\[(\d+)\])?(.*)", place).groups()
    if not name:
        several = list(whole)
        several[int(number)] = with_value(several[int(number)], rest, value)
        return several
    inner = f"[{number}]{rest}" if number else rest
    return replace(whole, **{name: with_value(getattr(whole, name), inner, value)})


def places():
    for element in ELEMENTS:
        for name, value, domain in element.quantities():
            if isinstance(value, float) and value and not domain.tail:
                yield element, name, value, domain


def path_of(element, way):
    if isinstance(element, op.Source):
        return element >> op.Detector()
    lamp = op.Source(2.0, [1.0, 0.3, -0.4, 0.5])
    nodes = {"lamp": lamp, "it": element, "eye": op.Detector()}
    return wired(nodes, f"lamp -> it.{way.enters}, it.{way.leaves} -> eye")


def test_every_element_that_takes_a_number_is_looked_at():
    of_library = {known for known in KINDS.values() if known.__module__.startswith("optipath.")}
    assert {type(element) for element in ELEMENTS} | WITHOUT == of_library


@pytest.mark.parametrize("most", [1, slow(9)])
@rows("element, name, value, domain", [*places()])
def test_light_is_that_of_the_numbers_at_each_wavelength(element, name, value, domain, most):
    # Some numbers may not grow, others may not shrink.
    last = next(v for v in (0.98 * value, 1.02 * value) if np.all(domain.allows(np.asarray(v))))
    dispersive = with_value(element, name, line(value, last))
    for way in element.couplings()[:most] or (None,):
        numbers = on_line(value, last, PLACES)
        expected = [
            path_of(with_value(element, name, float(number)), way).trace().stokes
            for number in numbers
        ]
        path = path_of(dispersive, way)
        alone = [path.trace(wavelength=float(one)).stokes for one in PLACES[1:3]]
        np.testing.assert_allclose(alone, expected[1:3], rtol=1e-14, atol=4e-16)
        batch = op.Composer(engine="numpy").compose(path).run(wavelength=PLACES).stokes
        np.testing.assert_allclose(batch, expected, rtol=1e-13, atol=1e-15)
