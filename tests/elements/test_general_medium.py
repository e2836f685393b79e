"""Media that do everything at once, against exponentials of 4 x 4 matrices in many digits."""

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import optipath as op
from chains import ENGINES
from paths import chain
from tables import rows, slow
from wired import read_back

pytestmark = pytest.mark.filterwarnings("ignore::optipath.errors.AngleWarning")

STATE = [1.0, 0.5, 0.6, 0.4]
RATES = ("dichroism", "circular_dichroism", "retardance", "rotation", "depolarization")


def generator(absorption=0.0, *, angle=0.0, dichroic_angle=None, **rates):
    """What a medium does per length, written for nothing else."""
    linear, circular, retardance, rotation, depolarization = (
        mpmath.mpf(rates.get(name, 0.0)) for name in RATES
    )
    axis = angle if dichroic_angle is None else dichroic_angle
    fast, dichroic = (
        (mpmath.cos(2 * mpmath.mpf(a)), mpmath.sin(2 * mpmath.mpf(a))) for a in (angle, axis)
    )
    p1, p2, p3 = linear * dichroic[0], linear * dichroic[1], circular
    q1, q2, q3 = retardance * fast[0], retardance * fast[1], 2 * rotation
    a = mpmath.mpf(absorption)
    d = a + depolarization
    return mpmath.matrix(
        [[-a, p1, p2, p3], [p1, -d, -q3, q2], [p2, q3, -d, -q1], [p3, -q2, q1, -d]]
    )


def exact(length=1.0, **given):
    return mpmath.expm(mpmath.mpf(length) * generator(**given), method="taylor")


def error(found, wanted):
    """The largest error of an entry, as a share of that of unpolarised light."""
    return max(
        float(abs(mpmath.mpf(float(found[i, j])) - wanted[i, j]) / wanted[0, 0])
        for i in range(4)
        for j in range(4)
    )


@pytest.fixture(autouse=True)
def many_digits():
    with mpmath.workdps(60):
        yield


def passive(rates):
    return float(np.hypot(rates.get("dichroism", 0.0), rates.get("circular_dichroism", 0.0)))


def check_against_exponential(rates, tolerance=1e-13):
    rates = {"absorption": passive(rates), **rates}
    assert error(op.Medium(1.0, **rates).mueller().matrix, exact(**rates)) < tolerance


@rows("names", [RATES[:4], RATES, RATES[:3], ("dichroism", "depolarization")])
@rows("seed", range(3))
def test_any_medium_is_the_exponential_to_13_digits(names, seed):
    rng = np.random.default_rng(seed)
    for _ in range(4):
        sizes = 10.0 ** rng.uniform(-12.0, np.log10(50.0), len(names))
        rates = dict(zip(names, (sizes * rng.choice([-1, 1], len(names))).tolist(), strict=True))
        if "depolarization" in rates:
            rates["depolarization"] = abs(rates["depolarization"])
        angles = dict(zip(("angle", "dichroic_angle"), rng.uniform(-3, 3, 2).tolist(), strict=True))
        check_against_exponential(rates | angles)


SPECIAL = {
    "parallel": {"dichroism": 3.0, "retardance": 7.0, "circular_dichroism": 1.5, "rotation": 1.75},
    "across": {"dichroism": 3.0, "retardance": 7.0, "dichroic_angle": np.pi / 4},
    "nilpotent": {"dichroism": 5.0, "retardance": 5.0, "dichroic_angle": np.pi / 4},
    "nearly nilpotent": {"dichroism": 50.0, "rotation": 25.0 * (1 + 1e-9)},
    "of circular axes": {"circular_dichroism": 20.0, "rotation": 8.0},
    "of one axis": {"dichroism": 20.0, "retardance": 8.0, "angle": 0.3},
    "nothing but depolarising": {"depolarization": 5.0},
    "retarding and depolarising": {"retardance": 30.0, "rotation": 20.0, "depolarization": 5.0},
    "all at their most": dict.fromkeys(RATES, 50.0) | {"rotation": 25.0, "angle": 0.2},
}


@rows("name", SPECIAL)
def test_special_directions_are_the_exponential_too(name):
    check_against_exponential(SPECIAL[name])


@rows("size", [1e-12, 1e-8, 1e-4, 1e-2])
def test_small_products_keep_the_digits_of_every_entry(size):
    sizes = dict(zip(RATES, (size * np.array([3.0, 2.0, 5.0, 4.0, 1.0])).tolist(), strict=True))
    for names in (RATES, RATES[:4]):
        rates = {name: sizes[name] for name in names} | {"angle": 0.2, "dichroic_angle": 1.0}
        found = op.Medium(1.0, passive(sizes), **rates).mueller().matrix
        wanted = np.array(exact(absorption=passive(sizes), **rates).tolist(), float)
        np.testing.assert_allclose(found, wanted, rtol=2e-13, atol=1e-16)


@rows("retardance", [1e3, 1e4])
def test_large_retardances_are_right_to_the_rounding_of_their_phase(retardance):
    rates = {"retardance": retardance, "rotation": 2.0, "dichroism": 1.0, "dichroic_angle": 0.4}
    check_against_exponential(rates, 4e-16 * retardance)


@rows("size", [1e100, 1e200])
def test_whatever_is_finite_gives_no_nan(size):
    for rates in ({"retardance": size}, {"dichroism": size}, {"circular_dichroism": size}):
        medium = op.Medium(1.0, size, rotation=1.0, **rates)
        assert np.all(np.isfinite(medium.mueller().matrix))


def parameters(names):
    return {name: op.Parameter(name) for name in names}


ALONE = [
    {},
    {"rotation": 2.0},
    {"retardance": 2.0, "angle": 0.3},
    {"dichroism": 2.0, "angle": 0.3},
    {"dichroism": 2.0, "retardance": -3.0, "angle": 0.3},
    {"circular_dichroism": 1.0, "rotation": 2.0},
    {"retardance": np.pi / 2},
]


@rows("rates", ALONE)
@rows("depolarizes", [False, True])
def test_zeros_given_as_parameters_change_nothing(rates, depolarizes):
    names = (*RATES[:4], *RATES[4:][:depolarizes], "angle")
    given_rates = {name: rates.get(name, 0.0) for name in names}
    path = chain([op.Medium(1.0, 2.0, **parameters(names))], STATE)
    found = path.trace(**given_rates).stokes
    wanted = chain([op.Medium(1.0, 2.0, **rates)], STATE).trace().stokes
    # Where nothing depolarises, an ulp or two.
    atol = (4e-15 if depolarizes else 5e-16) * wanted[0]
    np.testing.assert_allclose(found, wanted, rtol=0, atol=atol)


def agrees(engine, dtype, names):
    names = (*names, "angle", "dichroic_angle")
    drawn = np.random.default_rng(3).uniform(0.0, 4.0, (len(names), 3000))
    values = dict(zip(names, drawn, strict=True))
    path = chain([op.Medium(1.0, 6.0, **parameters(names))], STATE)
    found = np.asarray(op.Composer(engine=engine, dtype=dtype).compose(path).run(**values).stokes)
    wanted = chain([op.Medium(1.0, 6.0, **values)], STATE).trace().stokes
    atol = 3e-6 if "float32" in (dtype, found.dtype.name) else 1e-14
    np.testing.assert_allclose((found - wanted) / wanted[..., :1], 0.0, rtol=0, atol=atol)


@rows("names", [RATES[:4], RATES])
def test_precisions_agree(names):
    for dtype in ("float32", "float64"):
        agrees("numpy", dtype, names)


@pytest.mark.slow
@rows("engine", ENGINES)
@rows("dtype", ["float32", "float64"])
@rows("names", [RATES[:4], RATES])
def test_every_engine_agrees_in_every_precision(engine, dtype, names):
    agrees(engine, dtype, names)


rate = st.floats(-50.0, 50.0) | st.sampled_from([0.0, 1e-12, 1e-200, 30.0])


@settings(max_examples=25, deadline=None)
@given(st.tuples(rate, rate, rate, rate), rate.map(abs), st.floats(0, 3), st.floats(0, 3))
def test_no_light_leaves_brighter_or_polarised_by_more_than_all(rates, depolarization, one, other):
    rates = dict(zip(RATES, (*rates, depolarization), strict=True))
    medium = op.Medium(1.0, passive(rates) * (1 + 1e-15), **rates, angle=one, dichroic_angle=other)
    matrix = medium.mueller()
    assert matrix.is_physical()
    states = np.array([[1, 0, 0, 0], [1, 1, 0, 0], [1, -1, 0, 0], [1, 0, 0.6, -0.8]])
    light = chain([medium], states).trace()
    assert np.all(light.S0 <= 1.0 + 1e-14)
    # What nearly cancels has the rounding of what it cancelled from.
    rounding = 1e-14 * np.maximum(1.0, matrix.matrix[0, 0] / np.maximum(light.S0, 1e-300))
    assert not np.any(light.dop > 1.0 + rounding)


@settings(max_examples=30, deadline=None)
@given(st.tuples(rate, rate, rate, rate), st.floats(0, 3), st.floats(0, 3))
def test_two_halves_are_the_whole(rates, one, other):
    rates = dict(zip(RATES[:4], rates, strict=True))
    angles = {"angle": one, "dichroic_angle": other}
    half, whole = (
        op.Medium(l, passive(rates) + 0.1, **rates, **angles).mueller() for l in (0.5, 1.0)
    )
    scale = whole.matrix[0, 0] + half.matrix[0, 0] ** 2
    np.testing.assert_allclose((half @ half).matrix, whole.matrix, rtol=0, atol=2e-13 * scale)


@rows("turn", [0.3, -1.2])
def test_a_turned_medium_is_the_same_in_its_own_frame(turn):
    rates = dict(zip(RATES, (3.0, 2.0, 5.0, 4.0, 1.0), strict=True))
    turned = chain(
        [op.Medium(1.0, 4.0, **rates, angle=0.2, dichroic_angle=1.0, azimuth=turn)], STATE
    )
    axes = {"angle": 0.2 + turn, "dichroic_angle": 1.0 + turn}
    whole = chain([op.Medium(1.0, 4.0, **rates, **axes), op.Rotator(-turn)], STATE)
    np.testing.assert_allclose(turned.trace().stokes, whole.trace().stokes, rtol=0, atol=1e-15)


def test_light_is_absorbed_along_the_axes_that_the_docstring_says():
    linear = op.Medium(0.5, 3.0, dichroism=2.0, dichroic_angle="90 deg")
    circular = op.Medium(0.5, 3.0, circular_dichroism=2.0)
    dense = op.Medium(1.0, 100.0, dichroism=100.0), op.Medium(1.0, 100.0, circular_dichroism=100.0)
    for elements, state, depth, rtol in (
        ([linear], [1, -1, 0, 0], 0.5, 1e-15),
        ([linear], [1, 1, 0, 0], 2.5, 1e-15),
        ([circular], [1, 0, 0, 1], 0.5, 1e-15),
        ([circular], [1, 0, 0, -1], 2.5, 1e-15),
        ([dense[0], op.Polarizer("vertical")], [1, -1, 0, 0], 200.0, 1e-13),
        ([dense[1]], [1, 0, 0, -1], 200.0, 1e-13),
    ):
        light = chain(elements, state).trace()
        assert light.intensity == pytest.approx(np.exp(-depth), rel=rtol, abs=0)
        assert state[3] * light.S0 == light.S3


@rows(
    "rates",
    [
        {"dichroism": 2.0, "retardance": 3.0, "angle": 0.4},
        {"circular_dichroism": 2.0, "rotation": 3.0},
        {"dichroism": 2.0, "dichroic_angle": 0.4},
    ],
)
def test_what_commutes_is_composed_with_jones_columns_too(rates):
    path = chain([op.Medium(0.4, 5.0, **rates)], STATE)
    jones = op.Composer(composing="jones").compose(path).run().stokes
    np.testing.assert_allclose(jones, path.trace().stokes, rtol=0, atol=1e-15)


@rows(
    "rates, kernels",
    [
        ({"absorption": 1.0}, ["absorption"]),
        ({"rotation": 1.0}, ["rotation"]),
        ({"retardance": 1.0}, ["retardance"]),
        ({"absorption": 2.0, "dichroism": 1.0}, ["absorption beside dichroism", "dichroism"]),
        ({"depolarization": 1.0, "rotation": 2.0}, ["depolarisation", "rotation"]),
    ],
)
def test_what_is_not_there_costs_nothing(rates, kernels):
    (coupling,) = op.Medium(1.0, **rates).couplings()
    names = [operation.kernel.name for operation in coupling.operations]
    assert [name.removesuffix(" along the way") for name in names] == kernels


def test_too_much_dichroism_is_refused_and_the_cure_works():
    for absorption in (0.5, np.array([2.0, 0.5])):
        with pytest.raises(
            op.errors.ValueFault, match=r"would amplify .* an absorption of 0\.01 1/cm"
        ):
            op.Medium(1.0, absorption, dichroism=0.6, circular_dichroism=0.8)
    op.Medium(1.0, "0.01 1/cm", dichroism=0.6, circular_dichroism=0.8)
    path = chain([op.Medium(1.0, op.Parameter("a"), dichroism=op.Parameter("d"))], STATE)
    path.trace(a=1.0, d=[0.5, 1.0])
    with pytest.raises(op.errors.ParameterError, match=r"parameter 'd'.*\(at 1, of 2 paths\)"):
        path.trace(a=1.0, d=[0.5, 1.5])
    rates = {"dichroism": 100.0, "retardance": 120.0, "depolarization": 10.0}
    with pytest.raises(op.errors.ValueFault, match="put several Media, each a part of it"):
        op.Medium(1.0, 100.0, **rates)
    several = chain([op.Medium(0.25, 100.0, **rates)] * 4, STATE).trace()
    assert several.dop <= 1.0


def test_a_general_medium_is_written_to_a_file_and_read_back(tmp_path):
    parts = {"retardance": 3.0, "rotation": 2.0, "depolarization": 1.0, "angle": 0.1}
    dichroism = {"dichroism": op.Parameter("d", 40.0), "circular_dichroism": -5.0}
    path = chain([op.Medium(0.01, 50.0, **parts, **dichroism, dichroic_angle=0.3)], STATE)
    assert read_back(path, tmp_path) == path


NAMES = ("absorption", "dichroism", "circular_dichroism", "retardance", "rotation")


def exact_slopes(**given):
    """By the exponential of a matrix of blocks (Van Loan, IEEE Trans. 23, 395 (1978))."""
    whole, found = generator(**given, dichroic_angle=0.3), []
    for name in given:
        step = generator(**{name: 1.0}, dichroic_angle=0.3)
        blocks = mpmath.zeros(8)
        for i in range(4):
            for j in range(4):
                blocks[i, j] = blocks[i + 4, j + 4] = whole[i, j]
                blocks[i, j + 4] = step[i, j]
        slope = mpmath.expm(blocks, method="taylor")[:4, 4:]
        found.append([float(part) for part in slope * mpmath.matrix(STATE)])
    return np.array(found).T


POINTS = {
    "anywhere": (4.0, 2.0, 1.0, 3.0, -1.5),
    "at no effect at all": (1.0, 0.0, 0.0, 0.0, 0.0),
    "without dichroism": (1.0, 0.0, 0.0, 2.0, 0.7),
    "without retardance": (3.0, 1.0, -2.0, 0.0, 0.0),
    "linear dichroism alone": (3.0, 2.0, 0.0, 0.0, 0.0),
    "both parallel": (3.0, 2.0, 0.0, 4.0, 0.0),
    "both of one size": (3.0, 2.0, 0.0, 2.0, 0.0),
    "across, of one size": (3.0, 2.0, 0.0, 0.0, 1.0),
    "at the least absorption": (2.0, 2.0, 0.0, 0.3, 0.0),
    "tiny": (1.0, 1e-9, 2e-9, 3e-9, 4e-9),
    "large": (50.0, 30.0, 20.0, 50.0, 25.0),
}


FEW = ["anywhere", "at no effect at all", "both parallel", "across, of one size"]


@pytest.mark.parametrize(
    ("depolarization", "points"),
    [(None, FEW), *(slow((one, [*POINTS])) for one in (None, 0.0, 1.3))],
)
def test_slopes_are_those_of_the_exponential(jax, depolarization, points):
    more = {} if depolarization is None else {"depolarization": depolarization}
    names = (*NAMES, *more)
    plan = chain([op.Medium(1.0, **parameters(names), dichroic_angle=0.3)], STATE).compose()

    def light(*given):
        return plan.run(**dict(zip(names, given, strict=True))).stokes

    slopes_of = jax.jit(jax.jacfwd(light, argnums=tuple(range(len(names)))))
    for point in points:
        values = dict(zip(NAMES, POINTS[point], strict=True)) | more
        slopes, wanted = np.array(slopes_of(*values.values())).T, exact_slopes(**values)
        atol = 2e-13 * np.max(np.abs(wanted))
        np.testing.assert_allclose(slopes, wanted, rtol=0, atol=atol, err_msg=point)


AT_ZERO = {
    "linear": {"absorption": 1.0, "dichroism": "d"},
    "linear, retarding": {"absorption": 1.0, "dichroism": "d", "retardance": 2.0},
    "circular": {"absorption": 1.0, "circular_dichroism": "d"},
    "circular, rotating": {"absorption": 1.0, "circular_dichroism": "d", "rotation": 0.7},
    "two axes": {"absorption": 1.0, "dichroism": "d", "retardance": 2.0, "dichroic_angle": 0.3},
    "rotating": {"absorption": 1.0, "dichroism": "d", "rotation": 0.7},
    "linear, depolarising": {"absorption": 1.0, "dichroism": "d", "depolarization": 0.4},
    "circular, depolarising": {"absorption": 1.0, "circular_dichroism": "d", "depolarization": 0.4},
    "far": {"absorption": 60.0, "dichroism": "d", "rotation": 0.7},
}


def exact_slope(light, at):
    """By central differences in 60 digits."""
    step = mpmath.mpf(10) ** -20
    found = (light(at + step) - light(at - step)) / (2 * step)
    return [float(part) for part in found]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "together"),
    [
        *((kind, True) for kind in AT_ZERO),
        *((kind, False) for kind in ("two axes", "linear, retarding", "circular")),
    ],
)
def test_slopes_at_no_dichroism_and_no_length_are_right(jax_once, kind, together):
    jax, rates = jax_once, {"dichroic_angle": 0.0, **AT_ZERO[kind]}
    given = {k: op.Parameter("d") if v == "d" else v for k, v in rates.items()}
    plan = chain([op.Medium(op.Parameter("L"), **given)], STATE).compose()

    def light(d, length):
        return plan.run(d=d, L=length).stokes

    def wanted(d, length):
        rates_there = {k: d if v == "d" else v for k, v in rates.items()}
        return exact(length, **rates_there) * mpmath.matrix(STATE)

    points = np.array([[0.0, 1.0], [0.0, 0.0], [0.8, 0.0], [-0.8, 0.0], [-0.8, 1.0]])
    slopes_of = jax.jacfwd(light, argnums=(0, 1))
    if together:
        found = jax.vmap(slopes_of)(*points.T)
    else:
        found = np.swapaxes([slopes_of(*point) for point in points], 0, 1)
    expected = [
        [exact_slope(lambda x, length=length: wanted(x, length), d) for d, length in points],
        [exact_slope(lambda x, d=d: wanted(d, x), length) for d, length in points],
    ]
    atol = 1e-13 * max(1.0, np.abs(expected).max())
    np.testing.assert_allclose(found, expected, rtol=0, atol=atol)
