import mpmath
import numpy as np
import pytest

import optipath as op
from chains import ENGINES
from paths import chain
from tables import rows

STATE = (1.0, 0.3, 0.5, 0.6)
D, N, W = (op.Parameter(name) for name in "dnw")


def exact_cos_sin(thickness, birefringence, wavelength):
    """Cosine and sine of the retardance of these very floats, in 50 digits."""
    with mpmath.workdps(50):
        path = mpmath.mpf(thickness) * mpmath.mpf(birefringence)
        retardance = 2 * mpmath.pi * path / mpmath.mpf(wavelength)
        return float(mpmath.cos(retardance)), float(mpmath.sin(retardance))


def plates(seed, count, turns):
    """Plates of many orders, four in ten of a whole number of quarter waves but for rounding."""
    rng = np.random.default_rng(seed)
    birefringence = rng.uniform(0.001, 0.3, count) * rng.choice([-1, 1], count)
    wavelength = rng.uniform(3e-7, 2e-6, count)
    orders = turns * 10.0 ** rng.uniform(-4, 0, count)
    orders = np.where(rng.random(count) < 0.4, np.ceil(4 * orders) / 4, orders)
    thickness = np.minimum(orders * wavelength / np.abs(birefringence), 1e3)
    return thickness, birefringence, wavelength


@rows("turns", [5.0, 5e3, 1e8])
@rows("engine", ENGINES)
def test_cosine_and_sine_of_a_thick_plate_have_all_digits(engine, turns):
    given = plates(1, 1500, turns)
    path = chain([op.Waveplate(D, N, W)], (1.0, 0.0, 0.0, 1.0))
    plan = op.Composer(engine=engine).compose(path)
    found = [plan.run(**dict(zip("dnw", given, strict=True))).stokes for _ in range(2)][1]
    exact = np.array([exact_cos_sin(*map(float, one)) for one in zip(*given, strict=True)])
    # Light of S3 > 0 becomes (1, 0, -sin, cos).
    np.testing.assert_allclose(found[:, 3], exact[:, 0], rtol=0, atol=5e-16)
    np.testing.assert_allclose(found[:, 2], -exact[:, 1], rtol=0, atol=5e-16)


def test_one_plate_has_the_digits_of_many():
    given = plates(2, 40, 5e3)
    path = chain([op.Waveplate(D, N, W, 0.2, 0.1)], STATE)
    several = path.trace(**dict(zip("dnw", given, strict=True))).stokes
    for place, one in enumerate(zip(*given, strict=True)):
        alone = path.trace(**dict(zip("dnw", map(float, one), strict=True))).stokes
        np.testing.assert_allclose(alone, several[place], rtol=0, atol=4e-16)


def test_a_plate_is_the_retarder_of_its_retardance():
    plate = op.Waveplate(2e-5, 0.0091, 5.89e-7, 0.3, 0.2)
    retarder = op.Retarder(2 * np.pi * 2e-5 * 0.0091 / 5.89e-7, 0.3, 0.2)
    found, wanted = (chain([element], STATE).trace().stokes for element in (plate, retarder))
    np.testing.assert_allclose(found, wanted, rtol=0, atol=6e-16)


def test_plates_of_quarter_and_half_a_wave_are_exact():
    quarter = op.Waveplate(0.25e-6 / 0.01, 0.01, 1e-6).mueller().matrix
    np.testing.assert_array_equal(quarter[2:, 2:], [[0.0, -1.0], [1.0, 0.0]])
    half = op.Waveplate(0.5e-6 / 0.01, 0.01, 1e-6).mueller().matrix
    np.testing.assert_array_equal(half[2:, 2:], [[-1.0, 0.0], [0.0, -1.0]])


def test_a_plate_of_no_thickness_or_no_birefringence_does_nothing():
    for plate in (op.Waveplate(0.0, 0.1, 5e-7), op.Waveplate(1e-3, 0.0, 5e-7, 0.3)):
        np.testing.assert_allclose(plate.mueller().matrix, np.eye(4), rtol=0, atol=3e-16)


def test_of_no_wavelengths_there_is_no_light():
    assert chain([op.Waveplate(0.0, 0.1, np.zeros(0))]).trace().shape == (0,)


def test_a_negative_birefringence_makes_the_axis_the_slow_one():
    negative = op.Waveplate(1.3e-6, -0.172, 5.89e-7, 0.3).mueller().matrix
    positive = op.Waveplate(1.3e-6, 0.172, 5.89e-7, 0.3 + np.pi / 2).mueller().matrix
    np.testing.assert_allclose(negative, positive, rtol=0, atol=1e-15)


def test_light_at_45_degrees_becomes_s3_above_0_behind_a_quarter_wave():
    light = chain([op.Waveplate("10.25 um", "0.1", "100 nm")], (1.0, 0.0, 1.0, 0.0)).trace()
    assert pytest.approx(1.0, abs=1e-15) == light.S3


def test_no_light_becomes_more_polarised_than_wholly():
    given = plates(3, 20000, 1e4)
    path = chain([op.Waveplate(D, N, W, 0.3)], (1.0, 0.6, 0.0, 0.8))
    light = path.trace(**dict(zip("dnw", given, strict=True)))
    assert np.max(np.linalg.norm(light.stokes[:, 1:], axis=-1)) <= 1.0 + 1e-15


def test_in_single_precision_it_has_the_digits_of_its_numbers():
    given = [np.float32(part) for part in plates(4, 2000, 2.0)]
    path = chain([op.Waveplate(D, N, W)], STATE)
    names = dict(zip("dnw", given, strict=True))
    found = op.Composer(dtype="float32").compose(path).run(**names).stokes
    exact = path.trace(**{name: part.astype(float) for name, part in names.items()}).stokes
    np.testing.assert_allclose(found, exact, rtol=0, atol=4e-6)


@rows(
    "given, fault",
    [
        ((1e-3, 0.01, 589.0), r"wavelength is 5.89e\+11 nm; give a real wavelength within"),
        ((1e-3, 17.0, 5e-7), "birefringence is 17; give a real birefringence within -10 .. 10"),
        ((1e4, 0.01, 5e-7), "thickness is .*; give a real length within 0 mm .. 1000000 mm"),
        ((-1e-3, 0.01, 5e-7), "thickness is -1 mm"),
        ((1e-3, 0.01, 0.0), "wavelength is 0 nm"),
    ],
)
def test_values_that_no_plate_has_are_refused(given, fault):
    with pytest.raises(op.ValueFault, match=fault):
        op.Waveplate(*given)
