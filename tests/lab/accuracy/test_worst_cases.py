import numpy as np
import pytest

from optipath.lab.accuracy.regions import REGIONS
from optipath.lab.accuracy.worst_cases import worst

NAMES = {region.name: region for region in REGIONS}


@pytest.mark.parametrize("region", REGIONS, ids=lambda region: region.name)
def test_the_samples_of_a_region_come_of_numbers_within_0_and_1(region):
    random = np.random.default_rng([3, *region.name.encode()])
    units = random.random((region.dimensions, 50))
    for one, other in zip(region.at(units), region.samples(50, seed=3), strict=True):
        np.testing.assert_array_equal(one, other)


def test_a_longer_search_finds_no_less():
    found = [worst("stable", NAMES["metals"], "B", generations=n).error for n in (1, 4, 8)]
    assert found == sorted(found)
    assert found[0] < found[-1]


def test_a_search_finds_more_than_samples_do_and_the_same_every_time():
    first, second = (worst("stable", NAMES["generic"], "A", generations=15) for _ in range(2))
    assert first == second
    assert first.error > 5.0


def test_a_search_finds_a_double_zero_of_c():
    found = worst("stable", NAMES["k = 0, total reflection"], "C near 0", generations=5)
    assert 0.3 < found.n < 0.6
    assert found.error > 0.5


def test_a_component_that_vanishes_has_no_worst_case():
    assert worst("stable", NAMES["exactly normal"], "B", generations=1).error == 0.0
