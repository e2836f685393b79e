"""Where each method holds, and where it is known to fail: what the published tables say."""

import re
from pathlib import Path

import mpmath
import numpy as np
import pytest

import optipath as op
from optipath.kernels.catalog import REFLECTION
from optipath.kernels.primitives import NUMPY
from optipath.lab import boundary_reference as reference
from optipath.lab.errors import errors, in_ulp, interface_errors, matrix_numbers
from optipath.lab.many_digits import WORKING_DIGITS, exactly
from optipath.lab.regions import REGIONS, Samples
from optipath.lab.tables import COMPONENTS, is_near_double_zero, worst
from tables import rows

NAMES = {region.name: region for region in REGIONS}
DTYPES, METHODS = ["float64", "float32"], ["stable", "compensated"]
STABLE = REFLECTION.by_method("stable")
SIDES = [("reflection", name) for name in COMPONENTS] + [("transmission", name) for name in "ABC"]
MORE = pytest.mark.parametrize("count", [8, pytest.param(200, marks=pytest.mark.report)])

# The regions, and the largest error in ulp*, where the two older methods keep some digits.
HOLDS = {
    "amplitude": {"exactly 90 deg": 0, "k = 0, n > 1": 1e4, "tiny k, n > 1": 1e5, "metals": 1e5},
    "textbook": {"k = 0, total reflection": 1e3, "metals": 1e5},
}
# Normwise against A they fail in fewer.
NEAR_1 = ["n near 1, k = 0", "n near 1, k like n - 1", "n near 1, grazing", "extreme magnitudes"]
FAILS_NORMWISE = {
    "amplitude": NEAR_1,
    "textbook": [
        *(*NEAR_1, "near Brewster's angle", "tiny k, n > 1", "tiny k, total reflection"),
        *("tiny k, near the critical angle", "n near 0"),
    ],
}
PROMISED = (Path(__file__).parents[2] / "docs" / "accuracy.md").read_text("utf-8")
LIMIT, REFLECTED, NEAR_ZERO, BEHIND = (
    float(re.search(words, PROMISED)[1])
    for words in (
        r"at most (\d+)\s+ulp\\\*",
        r"at most (\d+) in what\s+is reflected",
        r"at most (\d+)\s+ulp of A",
        r"at most (\d+) there",
    )
)

# n, k, cos, sin: what long searches have found.
WORST = {
    "A": [
        (1.0641431714948457, 3.113678997804891e-05, 0.9722861568260702, 0.2337939888970426),
        (2.0740418264658604, 0.0, 0.9608304777085012, 0.2771367768926624),
        (1.2830834110274376, 6.178512325468385e-06, 0.9646250331905168, 0.2636257675990615),
    ],
    "B": [(1.1552136909878887, 1.2407485732736555e-09, 0.1414662140878837, 0.9899430843597227)],
    "C": [
        (1.063452154168725, 0.00783686325068119, 0.9999994892706652, 0.001010672255929513),
        (1.4256925187996294, 4.079344985209431e-07, 0.9975234773170552, 0.07033428894423017),
        (1.0008827984893427, 0.0003034788925163268, 0.9995118506623178, 0.031241965136468892),
        (0.5738301014705668, 0.0, 0.7042918633291331, 0.709910537496365),
    ],
    "S": [(2.229876357287204, 0.19867469621615875, 0.24075602395248014, 0.9705856669715419)],
}
WORST_IN_FLOAT32 = [
    (1.031729817390442, 0.0001831289118854329, 0.9968290925025940, 0.07957191020250320),
    (1.1320353746414185, 0.0004058231133967638, 0.9594302177429199, 0.28194624185562134),
    (1.3993197679519653, 0.002874102909117937, 0.24654033780097961, 0.9691325426101685),
    (1.0000293254852295, 1.9644691207076903e-08, 0.0019110689172521234, 0.999998152256012),
]
DOUBLE_ZERO = [
    (0.41421356237309503, 0.0, 0.8408964152537144, 0.5411961001461972),
    (0.44999033470313743, 3.62208537643414e-08, 0.8213097285328537, 0.5704825412028753),
    (0.35365035291299557, 0.00025339490749982214, 0.8601638073672927, 0.5100178668393911),
]
# n1, n, k and n0, cos, sin: behind parallel boundaries, the angle being that in n0.
BEHIND_OTHERS = np.array([
    [2.0261381022640785, 2.742142717630609, 9.29737246074837e-08],
    [1.8510023294314717, 6.123233995736766e-17, 1.0],
    [2.368217050354512, 2.3851138892994634, 0.06452034499520387],
    [1.112659689344535, 0.03465757343495069, 0.9993992458490255],
    [2.5011725876129507, 2.5011725754388956, 2.1048366941156151e-10],
    [2.019826501631907, 0.11979504449739578, 0.9927986438920366],
]).reshape(3, 6)  # fmt: skip


@MORE
@rows("method, limit", [("stable", 10.0), ("compensated", 1.5)])
@rows("dtype", [*DTYPES, "longdouble"])
@rows("name", NAMES)
def test_each_component_of_what_is_reflected_holds(name, dtype, method, limit, count):
    # Where a longdouble has no digits of its own, it is float64.
    count = min(count, 50) if dtype == "longdouble" else count
    assert interface_errors(method, NAMES[name], dtype, count).componentwise.max() <= limit


@MORE
@rows("method, limit_a, limit_c", [("stable", 8, 5), ("compensated", 1.5, 1.5)])
@rows("dtype", DTYPES)
@rows("name", NAMES)
def test_what_is_let_through_holds(name, dtype, method, limit_a, limit_c, count):
    region = NAMES[name]
    off = interface_errors(method, region, dtype, count, what="transmission").componentwise
    lossless = region.samples(len(off), dtype).k == 0.0
    assert off[:, :2].max() <= limit_a
    assert off[lossless, 2].max(initial=0.0) <= limit_c
    assert off[lossless, 3].max(initial=0.0) == 0.0


FEW = ["k = 0, total reflection", "metals", "near Brewster's angle", "n near 0"]


@pytest.mark.parametrize("names", [FEW, pytest.param([*NAMES], marks=pytest.mark.report)])
@rows("method", HOLDS)
def test_the_older_methods_hold_and_fail_where_they_are_known_to(method, names):
    for name in names:
        off = interface_errors(method, NAMES[name])
        most = HOLDS[method].get(name)
        assert (off.componentwise.max() <= (1e5 if most is None else most)) == (most is not None), (
            name
        )
        fails = name in FAILS_NORMWISE[method]
        assert (off.normwise.max() <= (1e5 if fails else 1e3)) != fails, name


def assert_can_be(numbers):
    A, B, _, _ = numbers
    assert np.all(np.isfinite(numbers))
    assert np.all((A >= 0.0) & (A <= 1.0))
    assert np.all(np.abs(B) <= A)


@rows("dtype", DTYPES)
@rows("method", METHODS)
@rows("name", NAMES)
def test_no_result_is_one_that_cannot_be(name, method, dtype):
    count = 20_000 if method == "stable" else 2_000
    found = matrix_numbers(REFLECTION.by_method(method), NAMES[name].samples(count, dtype))
    assert found.dtype == dtype
    A, B, C, S = found.T.astype(np.longdouble)
    assert_can_be(found.T)
    assert not np.any(np.signbit(found[:, [0, 1, 3]]))
    # A reflection does not depolarise.
    rest = (A - B) * (A + B) - C * C - S * S
    lit = 1e3 * np.finfo(dtype).tiny < A
    assert np.all(np.abs(rest[lit]) <= 10 * np.finfo(dtype).eps * A[lit] ** 2)


@rows("dtype", DTYPES)
@rows("method", METHODS)
def test_total_reflection_and_that_of_exactly_grazing_light_are_total_to_the_last_bit(
    method, dtype
):
    kernel = REFLECTION.by_method(method)
    found = matrix_numbers(kernel, NAMES["k = 0, total reflection"].samples(5000, dtype))
    np.testing.assert_array_equal(found[:, :2], np.broadcast_to([1.0, 0.0], (5000, 2)))
    for name in ("generic", "metals", "index of 1e3 to 1e8", "n near 0", "extreme magnitudes"):
        samples = NAMES[name].samples(500, dtype)
        samples = samples._replace(cos=np.zeros_like(samples.n), sin=np.ones_like(samples.n))
        found = matrix_numbers(kernel, samples)
        np.testing.assert_array_equal(found, np.broadcast_to([1, 0, 1, 0], found.shape))


@rows("method", METHODS)
@rows("least", [-0.0, 5e-324, 1e-310])
def test_a_negative_zero_and_denormals_change_no_sign(method, least):
    kernel = REFLECTION.by_method(method)
    for name in ("generic", "k = 0, total reflection", "near the critical angle"):
        samples = NAMES[name].samples(500)
        with_zero = matrix_numbers(kernel, samples._replace(k=np.zeros_like(samples.n)))
        found = matrix_numbers(kernel, samples._replace(k=np.full_like(samples.n, least)))
        np.testing.assert_array_equal(np.sign(found[:, [0, 2]]), np.sign(with_zero[:, [0, 2]]))
        assert not np.any(np.signbit(found[:, [0, 1, 3]]))


@rows("dtype", DTYPES)
@rows("method", METHODS)
@rows("what", ["reflection", "transmission"])
def test_no_index_and_no_angle_makes_what_cannot_be(what, method, dtype):
    """Indices and angles over all the range that floats have, and 0 and 90 degrees exactly."""
    count, reach = 20_000, {"float64": 300, "float32": 36}[dtype]
    rng = np.random.default_rng(7)
    phase = rng.choice([0.0, 0.3, 0.8, 1.5, np.pi / 2], count)
    index = 10 ** rng.uniform(-reach, reach, count) * (np.cos(phase) + 1j * np.sin(phase))
    small = rng.choice([0.0, 1.0], count) * 10 ** rng.uniform(-reach, 0, count)
    angle = np.where(rng.random(count) < 0.5, small, rng.uniform(0, np.pi / 2, count))
    c, s = np.cos(angle), np.sin(angle)
    turned = rng.random(count) < 0.5
    c, s = np.where(turned, s, c), np.where(turned, c, s)
    function = {"reflection": op.fresnel_reflection, "transmission": op.fresnel_transmission}[what]
    found = np.array(function(index, c, s, method, dtype)).astype(float)
    assert_can_be(found)
    assert not np.any((found == 0.0) & np.signbit(found))
    if what == "reflection":
        grazing = c == 0.0
        assert grazing.sum() > 1000
        np.testing.assert_array_equal(found[:, grazing].T - [1, 0, 1, 0], 0.0)


def test_a_boundary_of_equal_media_lets_all_the_light_through_and_reflects_none():
    angle = np.linspace(0, np.pi / 2, 5000)
    given = 1.0, np.cos(angle), np.sin(angle)
    A, B, C, _ = op.fresnel_transmission(*given)
    assert np.all(A <= 1.0)
    np.testing.assert_allclose([A, C], 1.0, rtol=1e-15)
    np.testing.assert_array_equal(B, 0.0)
    assert np.max(np.abs(op.fresnel_reflection(*given))) <= 1e-15


def exactly_reflected(n, k, cos, sin):
    with mpmath.workdps(WORKING_DIGITS):
        return reference.reflection(*map(exactly, (n, k, cos, sin)))


@pytest.mark.parametrize(
    ("generations", "names"),
    [(2, FEW), pytest.param(250, [*NAMES], marks=pytest.mark.report)],
)
@rows("dtype", DTYPES)
def test_the_worst_cases_that_a_search_finds_hold(dtype, generations, names):
    for name in names:
        for what, component in SIDES:
            limit = NEAR_ZERO if component == "C near 0" else LIMIT
            found = worst("stable", NAMES[name], component, what, dtype, generations=generations)
            assert found.error <= limit, (name, what, component, found)
        for component in "AC" if dtype == "float64" else "":
            found = worst("compensated", NAMES[name], component, generations=generations // 2)
            assert found.error <= 1.5, (name, component, found)


@rows(
    "given, dtype, component",
    [
        *((given, "float64", component) for component, all_ in WORST.items() for given in all_),
        *((given, "float32", "ABCS") for given in WORST_IN_FLOAT32),
    ],
)
def test_the_worst_cases_of_long_searches_are_within_the_promised_limit(given, dtype, component):
    given = np.array(given, dtype)
    found = matrix_numbers(STABLE, Samples(*given[:, None]))
    off = errors(found, [exactly_reflected(*given)], dtype).componentwise[0]
    assert all(off["ABCS".index(letter)] <= REFLECTED for letter in component)


@rows("given", DOUBLE_ZERO)
def test_where_c_has_a_double_zero_it_is_right_in_units_of_a(given):
    exact = exactly_reflected(*given)
    found = matrix_numbers(STABLE, Samples(*np.array(given)[:, None]))
    with mpmath.workdps(WORKING_DIGITS):
        assert is_near_double_zero(exact.values[0], exact.values[2], exact.conditions[2])
        off = abs(exactly(found[0, 2]) - exact.values[2])
        assert in_ulp(off, exact.values[0], "float64") <= NEAR_ZERO


@rows("given", BEHIND_OTHERS)
def test_behind_parallel_boundaries_the_worst_cases_are_within_their_limit(given):
    numbers = [*map(np.float64, given)]
    Fs, Fp, B, C, S = STABLE.made_for(NUMPY)(*numbers)
    with mpmath.workdps(WORKING_DIGITS):
        m1, m, absorbed, m0, c0, s0 = map(exactly, numbers)
        c0, s0 = (part / mpmath.hypot(c0, s0) for part in (c0, s0))
        s1 = m0 * s0 / m1
        c1 = mpmath.sqrt(1 - s1 * s1)
        exact = reference.reflection(m, absorbed, c1, s1, m1)
        # d ln tan = d ln sin / cos^2, and the sines are in proportion.
        conditions = [float(x * c0**2 / c1**2) for x in exact.conditions]
        found = np.array([[min(Fs, Fp) + B, B, C, S]])
        off = errors(found, [(exact.values, conditions)], "float64").componentwise
    assert off.max() <= BEHIND
