"""Light added up over its wavelengths, against closed forms and exact sums."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import optipath as op
from dispersive import GRID, line, on_line
from tables import rows

NM = 1e-9
EVEN = np.arange(380.0, 701.0, 40.0) * NM


def light_of(intensity, wavelengths, dop=0.0, **given):
    stokes = np.zeros((*np.shape(intensity), 4))
    stokes[..., 0] = intensity
    stokes[..., 2] = dop * stokes[..., 0]
    return op.Light(stokes, wavelength=wavelengths, **given)


@settings(max_examples=200)
@given(
    st.lists(st.floats(300.0, 900.0), min_size=2, max_size=60, unique_by=lambda x: round(x, 3)),
    st.booleans(),
)
def test_a_constant_spectrum_comes_to_the_width(wavelengths, falls):
    grid = np.sort(wavelengths)
    ordered = (grid[::-1] if falls else grid) * NM
    found = light_of(np.ones(len(grid)), ordered, dop=0.5).integrate().stokes
    # The wavelengths have a rounding of their own, which their difference keeps.
    slack = 1e-15 * (grid[-1] - grid[0]) + 4e-16 * grid[-1]
    np.testing.assert_allclose(found, (grid[-1] - grid[0]) * np.array([1, 0, 0.5, 0]), atol=slack)


def test_what_is_linear_comes_to_its_mean_times_the_width():
    grid = np.linspace(380.0, 780.0, 1001)
    assert abs(light_of(np.ones(1001), grid * NM).integrate().S0 / 400.0 - 1.0) < 1e-15
    found = (op.Source(line(0.2, 0.9)) >> op.Detector()).trace(wavelength=GRID).integrate()
    np.testing.assert_allclose(found.stokes, [0.55 * 300.0, 0, 0, 0], rtol=1e-14)


def test_sums_are_as_exact_as_those_of_python_and_the_same_alone_and_in_batches_to_the_last_bit(
    rng,
):
    grid, values = np.sort(rng.uniform(380.0, 780.0, 500)) * NM, rng.uniform(0.0, 1.0, 500)
    expected = math.fsum(0.5 * np.diff(grid * 1e9) * (values[:-1] + values[1:]))
    np.testing.assert_allclose(light_of(values, grid).integrate().S0, expected, rtol=1e-15 * 4)
    values = rng.uniform(0.0, 1.0, (5, 300, 3))
    grid = np.linspace(380.0, 780.0, 300) * NM
    lights = light_of(values, grid[:, None], dop=0.3)
    together = lights.integrate()
    assert together.shape == (5, 3)
    for i, j in [(0, 0), (2, 1), (4, 2)]:
        alone = light_of(values[i, :, j], grid, dop=0.3).integrate()
        assert np.array_equal(alone.stokes, together[i, j].stokes)
        assert np.array_equal(lights[i, :, j].integrate().stokes, alone.stokes)


@settings(max_examples=100)
@given(st.integers(0, 2**32 - 1))
def test_integrated_light_is_light(seed):
    rng = np.random.default_rng(seed)
    direction = rng.normal(size=(50, 3))
    if seed % 2:
        direction[:] = direction[0]
    direction /= np.linalg.norm(direction, axis=-1, keepdims=True)
    s0 = 10.0 ** rng.uniform(-300.0, 300.0, 50)
    stokes = np.concatenate([s0[:, None], s0[:, None] * direction], axis=-1)
    light = op.Light(stokes, wavelength=np.linspace(400.0, 700.0, 50) * NM)
    assert light.integrate().dop <= 1.0 + 4e-16


def test_faint_and_dark_light_is_added_up():
    values = np.array([1.0, 3.0, 2.0])
    grid = np.array([400.0, 500.0, 700.0]) * NM
    faint = light_of(1e-300 * values, grid).integrate()
    np.testing.assert_allclose(faint.intensity, 1e-300 * (50.0 + 150.0 * 3.0 + 200.0), rtol=1e-14)
    stokes = [[s0, np.nan, np.nan, np.nan] for s0 in (0.0, 1e-300, 0.0)]
    light = op.Light(stokes, wavelength=[4e-7, 5e-7, 6e-7])
    assert light.integrate().log10_intensity == pytest.approx(-298.0)


@rows("dtype", ["f4", "f8"])
def test_the_precision_stays(dtype):
    light = op.Light(np.ones((3, 4), dtype) * np.eye(4, dtype=dtype)[0], wavelength=EVEN[:3])
    assert light.integrate().stokes.dtype == light.stokes.dtype == dtype


def test_edges_and_responses_weigh_what_is_added_up():
    light = light_of([1.0, 2.0, 4.0], ["400 nm", "500 nm", "600 nm"], dop=1.0)
    found = light.integrate(edges=["350 nm", "480 nm", "510 nm", "700 nm"])
    np.testing.assert_allclose(found.S0, 130.0 + 2 * 30.0 + 4 * 190.0, rtol=1e-14)
    rising = op.Spectrum.sampled(["400 nm", "600 nm"], [0.0, 1.0])
    for response in ([0.0, 0.5, 1.0], np.array([0.0, 0.5, 1.0]), rising):
        found = light.integrate(response=response)
        np.testing.assert_allclose(found.stokes, [300.0, 0, 300.0, 0], rtol=1e-12)
    assert light.integrate(response=2.0).intensity == pytest.approx(900.0, rel=1e-14)
    values = on_line(0.2, 0.9, GRID)
    found = light_of(values, GRID).integrate().S0
    np.testing.assert_allclose(found, values @ [30.0, 75.0, 120.0, 75.0], rtol=1e-14)


@rows(
    "power",
    [
        op.Spectrum.line("500 nm"),
        op.Spectrum.histogram(["400 nm", "600 nm"], [1.0]),
        op.Spectrum.constant(1.0) + op.Spectrum.line("500 nm"),
        op.Spectrum.line("500 nm").at(op.Wavelength()),
    ],
)
def test_a_response_that_is_power_is_refused_as_a_detector_refuses_it(power):
    light = light_of([1.0, 2.0, 4.0], ["400 nm", "500 nm", "600 nm"])
    with pytest.raises(op.errors.ValueFault) as of_detector:
        op.Detector(response=power)
    with pytest.raises(op.errors.ValueFault) as found:
        light.integrate(response=power)
    assert str(found.value) == str(of_detector.value).replace("Detector r", "the r")


@rows(
    "shape, wavelength, expected",
    [
        *[((), 5e-7, ()), ((1,), [5e-7], ()), ((3,), 5e-7, (3,)), ((3,), [5e-7] * 3, (3,))],
        *[((3, 1), [5e-7], (3,)), ((1, 3), [[5e-7]], (3,))],
    ],
)
def test_light_of_one_wavelength_fills_one_bin(shape, wavelength, expected):
    light = light_of(np.full(shape, 2.0), wavelength, dop=0.5)
    for edges in (["490 nm", "520 nm"], ["520 nm", "490 nm"]):
        found = light.integrate(edges=edges).stokes
        every = np.broadcast_to([60.0, 0, 30.0, 0], [*expected, 4])
        np.testing.assert_allclose(found, every, rtol=1e-14, strict=True)
    assert light.integrate(response=0.5, edges=edges).intensity == pytest.approx(30.0, rel=1e-14)
    with pytest.raises(op.errors.ValueFault, match="bin 0 is from 400 nm to 450 nm"):
        light.integrate(edges=["400 nm", "450 nm"])


@rows("grid", [EVEN, EVEN[::-1], np.array([400.0, 401, 450, 640, 700]) * NM])
def test_a_line_keeps_its_power(grid):
    path = op.Source(2.5, spectrum=op.Spectrum.line("633 nm")) >> op.Detector()
    np.testing.assert_allclose(path.trace(wavelength=grid).integrate().S0, 2.5, rtol=1e-14)


def test_frames_stay_and_those_that_differ_by_wavelength_are_refused():
    frame = op.Frame().turned(0.3)
    light = op.Light(np.eye(4)[[0, 0, 0]], frame, wavelength=EVEN[:3])
    assert light.integrate().frame == frame
    stokes, frame = np.ones((2, 3, 1)) * [1.0, 0.5, 0, 0], op.Frame().turned([[0.0], [0.5]])
    light = op.Light(stokes, frame, wavelength=EVEN[:3])
    assert light.integrate().frame == op.Frame().turned([0.0, 0.5])
    light = op.Light(stokes[0], op.Frame().turned([0.0, 0.2, 0.4]), wavelength=EVEN[:3])
    with pytest.raises(op.errors.LightError, match=r"a frame of its own.*light\.in_frame\(frame\)"):
        light.integrate()
    assert light.in_frame(op.Frame()).integrate().dop < 0.5


@rows(
    "light, sentence",
    [
        (op.Light([[1, 0, 0, 0]] * 3), "light of no known wavelengths has no spectrum"),
        (op.Light(np.zeros((0, 4)), wavelength=np.zeros(0)), "vary along no axis"),
        (light_of([1.0, 1.0], 5e-7), "wavelengths vary along no axis"),
        (light_of([1.0, 1.0, 1.0], [5e-7, 6e-7, 5e-7]), "wavelengths of the light neither rise"),
        (light_of([1.0, 1.0, 1.0], [5e-7, 6e-7, 6e-7]), "wavelengths of the light neither rise"),
        (light_of(np.eye(2), [[5e-7, 6e-7], [4e-7, 5e-7]]), r"axes 0 and 1 .* \(2, 2\)"),
    ],
)
def test_light_that_is_no_spectrum_is_refused(light, sentence):
    with pytest.raises(op.errors.LightError, match=sentence):
        light.integrate()


@rows(
    "given, sentence",
    [
        ({"response": [1.0, 2.0]}, r"the response has the shape \(2,\), and there are 3"),
        ({"response": [1.0, -2.0, 1.0]}, "the response is -2"),
        ({"response": [1.0, np.nan, 1.0]}, "the response is nan"),
        ({"response": ["a", "b", "c"]}, "the response: .a. is not a quantity"),
        ({"edges": [4e-7, 5e-7]}, "3 wavelengths have 4 edges of bins"),
        ({"edges": [3e-7, 4.1e-7, 4.2e-7, 7e-7]}, "bin 1 is from 410 nm to 420 nm, and its wave"),
        ({"edges": [[4e-7], [4e-7, 5e-7]]}, "rows of unequal lengths"),
        ({"edges": [400, 500, 600, 700]}, "for nanometres write '400 nm'"),
    ],
)
def test_a_response_or_edges_that_do_not_fit_are_refused(given, sentence):
    light = light_of([1.0, 2.0, 4.0], np.array([400.0, 500.0, 600.0]) * NM)
    with pytest.raises(op.OptipathError, match=sentence):
        light.integrate(**given)


def test_noise_of_light_that_has_cancelled_goes_along():
    crossed = op.Polarizer(0.3) >> op.Polarizer(0.3 + np.pi / 2)
    path = op.Source(line(0.5, 1.0)) >> crossed >> op.Detector()
    dark = path.trace(wavelength=GRID).integrate()
    assert dark.noise >= dark.S0
    assert np.isnan(dark.dop)


def test_slopes_by_jax_are_those_of_the_closed_form_but_wavelengths_are_not_traced(jax, jacobian):
    lamp, filtered = op.Source(stokes=[1, 1, 0, 0]), op.Attenuator(line(0.2, 0.9))
    path = lamp >> filtered >> op.Polarizer(op.Parameter("a")) >> op.Detector()

    def power(a, w=1.0):
        return path.trace(a=a, wavelength=w * GRID).integrate().intensity

    np.testing.assert_allclose(power(0.3), 165.0 * np.cos(0.3) ** 2, rtol=1e-14)
    np.testing.assert_allclose(jacobian(power)(0.3), -165.0 * np.sin(0.6), rtol=1e-12)
    with pytest.raises(op.errors.ParameterError, match="wavelengths that light is added up over"):
        jax.jacfwd(power, argnums=1)(0.3, 1.0)
