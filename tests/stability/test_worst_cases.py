"""What searches find is no worse than what is promised; OPTIPATH_SEARCH_GENERATIONS searches on."""

import os
import re
from pathlib import Path

import mpmath
import numpy as np
import pytest

from optipath.kernels.catalogue import REFLECTION
from optipath.kernels.numbers.primitives import NUMPY
from optipath.lab.accuracy import reference
from optipath.lab.accuracy.error_measures import errors, in_ulp
from optipath.lab.accuracy.interface_errors import matrix_numbers
from optipath.lab.accuracy.many_digits import WORKING_DIGITS, exactly
from optipath.lab.accuracy.regions import REGIONS, Samples
from optipath.lab.accuracy.worst_cases import COMPONENTS, is_near_double_zero, worst

GENERATIONS = int(os.environ.get("OPTIPATH_SEARCH_GENERATIONS", "2"))
NAMES = {region.name: region for region in REGIONS}
SIDES = [("reflection", name) for name in COMPONENTS] + [("transmission", name) for name in "ABC"]
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
# n1, n, k, n0, cos, sin: behind parallel boundaries, the angle being that in n0.
BEHIND_OTHERS = [
    (
        2.0261381022640785,
        2.742142717630609,
        9.29737246074837e-08,
        1.8510023294314717,
        6.123233995736766e-17,
        1.0,
    ),
    (
        2.368217050354512,
        2.3851138892994634,
        0.06452034499520387,
        1.112659689344535,
        0.03465757343495069,
        0.9993992458490255,
    ),
    (
        2.5011725876129507,
        2.5011725754388956,
        2.1048366941156151e-10,
        2.019826501631907,
        0.11979504449739578,
        0.9927986438920366,
    ),
]


def exactly_reflected(n, k, cos, sin):
    with mpmath.workdps(WORKING_DIGITS):
        return reference.reflection(*map(exactly, (n, k, cos, sin)))


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_stable_holds_in_the_worst_cases_that_a_search_finds(name, dtype):
    for what, component in SIDES:
        limit = NEAR_ZERO if component == "C near 0" else LIMIT
        found = worst("stable", NAMES[name], component, what, dtype, generations=GENERATIONS)
        assert found.error <= limit, (what, component, found)


@pytest.mark.parametrize("name", NAMES)
def test_compensated_holds_in_the_worst_cases_that_a_search_finds(name):
    for component in ("A", "C"):
        found = worst("compensated", NAMES[name], component, generations=GENERATIONS // 2)
        assert found.error <= 1.5, (component, found)


def test_the_worst_cases_of_float32_are_within_the_promised_limit():
    for given in np.array(WORST_IN_FLOAT32, np.float32):
        found = matrix_numbers(REFLECTION.by_method("stable"), Samples(*given[:, None]))
        off = errors(found, [exactly_reflected(*given)], "float32").componentwise
        assert off.max() <= REFLECTED, (given, off)


@pytest.mark.parametrize("component", WORST)
def test_the_worst_cases_of_long_searches_are_within_the_promised_limit(component):
    for given in WORST[component]:
        found = matrix_numbers(REFLECTION.by_method("stable"), Samples(*np.array(given)[:, None]))
        off = errors(found, [exactly_reflected(*given)], "float64").componentwise[0]
        assert off["ABCS".index(component)] <= REFLECTED


def test_where_c_has_a_double_zero_it_is_right_in_units_of_a():
    for given in DOUBLE_ZERO:
        exact = exactly_reflected(*given)
        found = matrix_numbers(REFLECTION.by_method("stable"), Samples(*np.array(given)[:, None]))
        with mpmath.workdps(WORKING_DIGITS):
            assert is_near_double_zero(exact.values[0], exact.values[2], exact.conditions[2])
            off = abs(exactly(found[0, 2]) - exact.values[2])
            assert in_ulp(off, exact.values[0], "float64") <= NEAR_ZERO


@pytest.mark.parametrize("given", BEHIND_OTHERS)
def test_behind_parallel_boundaries_the_worst_cases_are_within_their_limit(given):
    n1, n, k, n0, cos, sin = map(np.float64, given)
    Fs, Fp, B, C, S = REFLECTION.by_method("stable").made_for(NUMPY)(*map(np.float64, given))
    with mpmath.workdps(WORKING_DIGITS):
        m1, m, absorbed, m0, c0, s0 = map(exactly, (n1, n, k, n0, cos, sin))
        c0, s0 = (part / mpmath.hypot(c0, s0) for part in (c0, s0))
        s1 = m0 * s0 / m1
        c1 = mpmath.sqrt(1 - s1 * s1)
        exact = reference.reflection(m, absorbed, c1, s1, m1)
        # d ln tan = d ln sin / cos^2, and the sines are in proportion.
        conditions = [float(x * c0**2 / c1**2) for x in exact.conditions]
        found = np.array([[min(Fs, Fp) + B, B, C, S]])
        off = errors(found, [(exact.values, conditions)], "float64").componentwise
    assert off.max() <= BEHIND
