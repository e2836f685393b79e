import numpy as np
import pytest

from optipath.lab.accuracy.regions import REGIONS


def test_regions_have_names_of_their_own():
    assert len({region.name for region in REGIONS}) == len(REGIONS)


@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize("region", REGIONS, ids=lambda region: region.name)
def test_samples_are_boundaries_and_angles(region, dtype):
    samples = region.samples(500, dtype)
    assert all(part.shape == (500,) and part.dtype == dtype for part in samples)
    assert np.all(np.isfinite(samples))
    assert np.all((samples.n >= 0) & (samples.k >= 0))
    wide = np.array([samples.cos, samples.sin], dtype=float)
    assert np.all((wide >= 0) & (wide <= 1))
    np.testing.assert_allclose(np.hypot(*wide), 1.0, rtol=0, atol=2 * np.finfo(dtype).eps)


def test_samples_are_the_same_every_time_and_others_for_another_seed():
    region = REGIONS[0]
    np.testing.assert_array_equal(region.samples(9).n, region.samples(9).n)
    assert not np.array_equal(region.samples(9).n, region.samples(9, seed=1).n)


def test_samples_lie_where_their_region_says():
    by_name = {region.name: region.samples(500) for region in REGIONS}
    total = by_name["k = 0, total reflection"]
    assert np.all(total.sin > total.n)
    grazing = np.degrees(by_name["grazing"].cos)
    assert grazing.min() < 1e-11
    assert grazing.max() <= 0.1
    brewster = by_name["near Brewster's angle"]
    off = np.abs(brewster.incidence - np.arctan(brewster.n))
    assert off.min() < 1e-10
    assert off.max() <= 0.11
    extreme = by_name["extreme magnitudes"]
    size = np.abs(extreme.n + 1j * extreme.k)
    assert np.all((size < 1e-162) | (size > 1e140))
