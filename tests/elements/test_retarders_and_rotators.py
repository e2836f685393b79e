"""Wave plates, elliptical retarders and Faraday rotators."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from chains import ENGINES, by_engine
from paths import chain
from tables import rows, slow
from wired import read, read_back

STATE = [1.0, 0.5, 0.6, 0.4]

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


@by_engine
@rows("turns", [5.0, 5e3, 1e8])
def test_cosine_and_sine_of_a_thick_plate_have_all_digits(engine, turns):
    given = plates(1, 1500, turns)
    path = chain([op.Waveplate(D, N, W)], (1.0, 0.0, 0.0, 1.0))
    plan = op.Composer(engine=engine).compose(path)
    found = [plan.run(**dict(zip("dnw", given, strict=True))).stokes for _ in range(2)][1]
    exact = np.array([exact_cos_sin(*map(float, one)) for one in zip(*given, strict=True)])
    # Light of S3 > 0 becomes (1, 0, -sin, cos).
    np.testing.assert_allclose(np.asarray(found)[:, [3, 2]], exact * [1, -1], rtol=0, atol=5e-16)


def test_one_plate_has_the_digits_of_many_and_of_its_retardance():
    given = plates(2, 40, 5e3)
    path = chain([op.Waveplate(D, N, W, 0.2, 0.1)], STATE)
    several = path.trace(**dict(zip("dnw", given, strict=True))).stokes
    for place, one in enumerate(zip(*given, strict=True)):
        alone = path.trace(**dict(zip("dnw", map(float, one), strict=True))).stokes
        np.testing.assert_allclose(alone, several[place], rtol=0, atol=4e-16)
    plate = op.Waveplate(2e-5, 0.0091, 5.89e-7, 0.3, 0.2)
    retarder = op.Retarder(2 * np.pi * 2e-5 * 0.0091 / 5.89e-7, 0.3, 0.2)
    found, wanted = (chain([element], STATE).trace().stokes for element in (plate, retarder))
    np.testing.assert_allclose(found, wanted, rtol=0, atol=6e-16)
    given = [np.float32(part) for part in plates(4, 2000, 2.0)]
    path = chain([op.Waveplate(D, N, W)], STATE)
    names = dict(zip("dnw", given, strict=True))
    found = op.Composer(dtype="float32").compose(path).run(**names).stokes
    exact = path.trace(**{name: part.astype(float) for name, part in names.items()}).stokes
    np.testing.assert_allclose(found, exact, rtol=0, atol=4e-6)


def test_plates_of_quarter_half_and_no_wave_are_exact():
    for share, turn in ((0.25, [[0.0, -1.0], [1.0, 0.0]]), (0.5, [[-1.0, 0.0], [0.0, -1.0]])):
        matrix = op.Waveplate(share * 1e-6 / 0.01, 0.01, 1e-6).mueller().matrix
        np.testing.assert_array_equal(matrix[2:, 2:], turn)
    for plate in (op.Waveplate(0.0, 0.1, 5e-7), op.Waveplate(1e-3, 0.0, 5e-7, 0.3)):
        np.testing.assert_allclose(plate.mueller().matrix, np.eye(4), rtol=0, atol=3e-16)
    assert chain([op.Waveplate(0.0, 0.1, np.zeros(0))]).trace().shape == (0,)


def test_the_axis_is_the_fast_one_or_of_a_negative_birefringence_the_slow_one():
    light = chain([op.Waveplate("10.25 um", "0.1", "100 nm")], (1.0, 0.0, 1.0, 0.0)).trace()
    assert pytest.approx(1.0, abs=1e-15) == light.S3
    negative = op.Waveplate(1.3e-6, -0.172, 5.89e-7, 0.3).mueller().matrix
    positive = op.Waveplate(1.3e-6, 0.172, 5.89e-7, 0.3 + np.pi / 2).mueller().matrix
    np.testing.assert_allclose(negative, positive, rtol=0, atol=1e-15)


def test_no_light_becomes_more_polarised_than_wholly():
    given = plates(3, 20000, 1e4)
    path = chain([op.Waveplate(D, N, W, 0.3)], (1.0, 0.6, 0.0, 0.8))
    light = path.trace(**dict(zip("dnw", given, strict=True)))
    assert np.max(np.linalg.norm(light.stokes[:, 1:], axis=-1)) <= 1.0 + 1e-15


@rows(
    "make, fault",
    [
        (lambda: op.Waveplate(1e-3, 0.01, 589.0), r"wavelength is 5.89e\+11 nm; give a real wave"),
        (lambda: op.Waveplate(1e-3, 17.0, 5e-7), "birefringence is 17; .* within -10 .. 10"),
        (lambda: op.Waveplate(1e4, 0.01, 5e-7), "thickness is .* within 0 mm .. 1000000 mm"),
        (lambda: op.Waveplate(-1e-3, 0.01, 5e-7), "thickness is -1 mm"),
        (lambda: op.Waveplate(1e-3, 0.01, 0.0), "wavelength is 0 nm"),
        (lambda: op.Waveplate.quarter("550 nm", order=-1), "order is -1; give how many whole wav"),
        (lambda: op.Waveplate.quarter("550 nm", order=0.5), "order is 0.5"),
        (lambda: op.Waveplate.quarter(550), "for nanometres write '550 nm'"),
        (lambda: op.Waveplate.quarter(["500 nm", "600 nm"]), "give one number"),
        (lambda: op.Waveplate.quarter("550 nm", "quarz"), "did you mean 'quartz'"),
        (lambda: op.Waveplate.quarter("550 nm", 0), "a birefringence of 0 at 550 nm"),
        (lambda: op.Waveplate.quarter("550 nm", None), "give a name such as 'quartz'"),
    ],
)
def test_plates_that_cannot_be_are_refused(make, fault):
    with pytest.raises(op.OptipathError, match=fault):
        make()


def behind(plate, wavelength):
    path = op.Source(stokes=[1.0, 0.0, 1.0, 0.0]) >> plate >> op.Detector()
    return path.trace(wavelength=wavelength).stokes


@rows("order", [0, 1, 20])
@rows("crystal", ["quartz", "calcite", "magnesium fluoride", "sapphire", 0.0091, -0.17])
def test_plates_are_a_quarter_and_a_half_wave_with_the_fast_axis_at_their_angle(crystal, order):
    for made, expected in (
        (op.Waveplate.quarter, [1, 0, 0, 1]),
        (op.Waveplate.half, [1, 0, -1, 0]),
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


def rotation(vector):
    """The rotation of the sphere about a vector by the right-hand rule, in 50 digits."""
    x, y, z = map(mpmath.mpf, vector)
    with mpmath.workdps(50):
        turns = mpmath.matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        return np.array(mpmath.expm(turns, method="taylor").tolist(), dtype=float)


def matrix_of(vector):
    """The matrix of a retarder whose vector is not known to lie along an axis."""
    path = chain([op.EllipticalRetarder(D, N, W)], STATE)
    return path.mueller(**dict(zip("dnw", vector, strict=True))).matrix


@rows("size", [1e-12, 1e-6, 0.3, 1.0, 3.0, 50.0])
@rows("seed", range(4))
def test_it_turns_the_sphere_about_its_vector(seed, size):
    vector = size * np.random.default_rng(seed).normal(size=3)
    found = op.EllipticalRetarder(*map("{} rad".format, vector)).mueller().matrix
    atol = 1e-15 + 4e-16 * np.linalg.norm(vector)
    np.testing.assert_allclose(found[1:, 1:], rotation(vector), rtol=0, atol=atol)
    np.testing.assert_array_equal([found[0], found[:, 0]], [[1.0, 0.0, 0.0, 0.0]] * 2)


@rows("retardance", [0.7, np.pi / 2, np.pi, -2.0])
@rows("angle", [0.0, 0.3, 0.4, np.pi / 4, -1.1])
def test_one_along_an_axis_is_a_linear_retarder_or_a_rotator_and_to_the_bit_if_known(
    retardance, angle
):
    pair = op.EllipticalRetarder(retardance, azimuth=0.3), op.Retarder(retardance, azimuth=0.3)
    known, linear = (chain([one], STATE).trace().stokes for one in pair)
    np.testing.assert_array_equal(known, linear)
    vector = retardance * np.cos(2 * angle), retardance * np.sin(2 * angle), 0.0
    wanted = op.Retarder(retardance, angle).mueller().matrix
    np.testing.assert_allclose(matrix_of(vector), wanted, rtol=0, atol=7e-16)
    # One of S3 alone is a rotator of half the angle.
    wanted = op.Rotator(angle).mueller().matrix
    np.testing.assert_allclose(matrix_of((0.0, 0.0, 2 * angle)), wanted, rtol=0, atol=3e-16)
    np.testing.assert_array_equal(op.EllipticalRetarder(s3=2 * angle).mueller().matrix, wanted)


def test_the_state_along_the_vector_is_the_fast_one():
    # What is fast gains less phase: light half of it leads, as behind a quarter-wave plate.
    fast = np.array([0.48, 0.6, 0.64])
    plate = op.EllipticalRetarder(*(np.pi / 2 * fast)).mueller()
    np.testing.assert_allclose((plate @ op.Light([1, *fast])).stokes, [1, *fast], atol=4e-16)
    across = np.cross(fast, [0.0, 0.0, 1.0])
    across /= np.linalg.norm(across)
    found = (plate @ op.Light([1, *across])).stokes[1:]
    np.testing.assert_allclose(found, np.cross(fast, across), rtol=0, atol=4e-16)


@pytest.mark.parametrize(
    ("engine", "dtype"),
    [
        *(("numpy", dtype) for dtype in ("float32", "float64")),
        *(slow((engine, dtype)) for engine in ENGINES[1:] for dtype in ("float32", "float64")),
    ],
)
def test_every_engine_and_precision_agrees(engine, dtype):
    values = np.random.default_rng(1).uniform(-3.0, 3.0, (3, 3000))
    path = chain([op.EllipticalRetarder(*map(op.Parameter, "dnw"), azimuth=0.2)], STATE)
    plan = op.Composer(engine=engine, dtype=dtype).compose(path)
    found = np.asarray(plan.run(**dict(zip("dnw", values, strict=True))).stokes)
    wanted = chain([op.EllipticalRetarder(*values, azimuth=0.2)], STATE).trace().stokes
    atol = 2e-6 if "float32" in (dtype, found.dtype.name) else 4e-15
    np.testing.assert_allclose(found, wanted, rtol=0, atol=atol)


@given(st.lists(st.floats(-6.0, 6.0), min_size=3, max_size=3).map(np.array))
def test_the_opposite_vector_undoes_it_and_no_light_is_lost(vector):
    there, back = (op.EllipticalRetarder(*v).mueller().matrix for v in (vector, -vector))
    np.testing.assert_allclose(back @ there, np.eye(4), rtol=0, atol=2e-15)


@pytest.mark.filterwarnings("ignore::optipath.errors.AngleWarning")
def test_angles_in_degrees_are_warned_of_and_what_cannot_be_is_refused():
    with pytest.warns(
        op.errors.AngleWarning, match="EllipticalRetarder s2 is a plain number beyond 2 pi"
    ):
        op.EllipticalRetarder(s2=90)
    with pytest.raises(op.errors.ValueFault, match=r"s1 is 1.7e\+308"):
        op.EllipticalRetarder(1.7e308, 1.7e308, 1.7e308)
    assert np.all(np.isfinite(op.EllipticalRetarder(1e15, 1e15, -1e15).mueller().matrix))
    with pytest.raises(op.errors.ComposerError, match="and no Jones matrix"):
        op.Composer(composing="jones").compose(chain([op.EllipticalRetarder(0.1, 0.2, 0.3)], STATE))


def test_three_numbers_of_the_first_component_are_of_three_paths(tmp_path):
    several = np.array([0.1, 0.2, 0.3])
    path = chain([op.EllipticalRetarder(several, 0.2)], STATE)
    of_values = chain([op.EllipticalRetarder(op.Parameter("v"), 0.2)], STATE)
    for light in (
        chain([op.EllipticalRetarder([*several], 0.2)], STATE).trace(),
        of_values.trace(v=[*several]),
        read_back(path, tmp_path).trace(),
    ):
        np.testing.assert_allclose(light.stokes, path.trace().stokes)


V, B, L = (op.Parameter(name) for name in "vbl")


def turned(angle):
    """Light of the state, its axis turned from x towards y."""
    c, s = np.cos(2 * angle), np.sin(2 * angle)
    s0, s1, s2, s3 = STATE
    return np.stack([s0 + 0 * c, s1 * c - s2 * s, s1 * s + s2 * c, s3 + 0 * c], axis=-1)


@by_engine
def test_light_turns_from_x_towards_y_by_verdet_constant_times_field_and_length(engine):
    light = chain([op.FaradayRotator(0.3)], STATE).trace()
    np.testing.assert_allclose(light.stokes, turned(0.3), rtol=0, atol=4e-16)
    rng = np.random.default_rng(3)
    v, b, length = rng.uniform(-200, 200, 500), rng.uniform(-2, 2, 500), rng.uniform(0, 0.1, 500)
    path = chain([op.FaradayRotator(verdet=V, field=B, length=L)], STATE)
    found = op.Composer(engine=engine).compose(path).run(v=v, b=b, l=length).stokes
    np.testing.assert_allclose(found, turned(v * b * length), rtol=0, atol=5e-14)


def test_light_along_the_field_in_what_has_a_positive_verdet_constant_turns_counter_clockwise():
    """Hecht, Optics, sec. 8.11.2: to who looks at the source, as seen by angles in space."""
    rod = op.FaradayRotator(verdet=4.0, field=0.5, length=0.2)
    for z in [(0, 0, 1), (0, 0.6, -0.8)]:
        frame = op.Frame.from_direction(z, (1, 0, 0))
        light = rod.mueller(frame_in=frame) @ op.Light([1.0, 1.0, 0.0, 0.0], frame)
        axis = np.cos(light.aop) * light.frame.x + np.sin(light.aop) * light.frame.y
        # Counter-clockwise of up is left, which is facing cross up, as who faces -z has it.
        left = np.cross(frame.z, frame.x)
        assert np.arctan2(axis @ left, axis @ frame.x) == pytest.approx(0.4, abs=1e-15)


def test_on_the_way_back_from_a_mirror_the_turns_add_up_where_the_field_is_seen_reversed():
    there, back = (op.FaradayRotator(verdet=-134.0, field=b, length=0.02) for b in (0.1, -0.1))
    light = chain([there, op.Mirror(), back], (1.0, 1.0, 0.0, 0.0)).trace()
    turn = -2 * 134.0 * 0.1 * 0.02
    # In the frame behind the mirror, y is the other way.
    expected = [1.0, np.cos(2 * turn), -np.sin(2 * turn), 0.0]
    np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=3e-16)


@rows(
    "given, fault",
    [
        ({}, "angle is missing; give the angle alone, or verdet, field and length"),
        ({"field": 1.0}, r"verdet is missing.*\n.*length is missing"),
        ({"angle": op.Parameter("a"), "field": B}, "angle is given beside field; give the angle"),
        ({"verdet": 2.0, "field": B, "length": -0.1}, "length is -100 mm; give a real length"),
        ({"verdet": "2 rad", "field": B, "length": L}, "'2 rad' is no Verdet constant; use one of"),
        ({"verdet": 1.0, "field": "2 tesla", "length": L}, "there are: T, mT, G, kG"),
        ({"verdet": 1.0, "field": 1e7, "length": L}, "field is 1e.07 T; give a real magnetic"),
    ],
)
def test_what_is_given_is_the_angle_or_all_of_the_product(given, fault):
    with pytest.raises(op.OptipathError, match=fault):
        op.FaradayRotator(**given)


def test_units_of_verdet_constants_and_fields_are_those_of_tables():
    """0.12 min/(Oe cm), as makers of TGG write it, is 34.9 rad/(T m)."""
    rod = op.FaradayRotator(verdet="0.12 arcmin/(G cm)", field="5 kG", length="2 cm")
    assert rod.verdet == pytest.approx(np.radians(0.12 / 60) * 1e4 * 100, rel=1e-15)
    assert rod == op.FaradayRotator(verdet=rod.verdet, field=0.5, length=0.02)
    rod = op.FaradayRotator(verdet="2 deg/(T cm)", field=1, length=1)
    assert rod.verdet == pytest.approx(np.radians(200.0), rel=1e-15)


def test_a_file_is_told_by_its_node_which_values_are_missing(tmp_path):
    path = chain([op.FaradayRotator(verdet=1.0, field="10 mT", length=L)])
    assert read_back(path, tmp_path) == path
    assert 'verdet = "1 rad/(T m)"' in path.to_toml()
    with pytest.raises(op.OptipathError, match=r"e0\.field is missing; give the angle alone"):
        read(path.to_toml().replace('field = "0.01 T"\n', ""), tmp_path)
