import numpy as np
import pytest

from optipath.surfaces.hemispheres.part_sums import PartSums

SHAPE = (6, 1, 4, 4, 2, 17)
MIRROR = np.diag([1.0, 1.0, -1.0, -1.0])


def drawn(seed=1, shape=SHAPE):
    random = np.random.default_rng(seed)
    photons = random.integers(50, 90, shape[0])
    return PartSums(random.normal(size=shape), np.ones(shape[1:4], int), photons)


def test_a_mean_of_equal_parts_has_the_error_of_a_mean():
    parts = drawn()._replace(photons=np.full(6, 70))
    value, error = parts.estimate(lambda light: light)
    each = parts.sums / 70
    assert np.allclose(value, each.mean(axis=0), rtol=1e-12)
    assert np.allclose(error, each.std(axis=0, ddof=1) / np.sqrt(6), rtol=1e-9)


def test_parts_without_photons_do_not_count():
    parts = drawn()
    more = PartSums(
        np.concatenate([parts.sums, np.zeros((3, *SHAPE[1:]))]),
        parts.counts,
        np.append(parts.photons, [0, 0, 0]),
    )
    for found, expected in zip(more.estimate(np.exp), parts.estimate(np.exp), strict=True):
        assert np.allclose(found, expected, rtol=1e-13)


def test_one_part_says_nothing_of_the_error():
    _, error = drawn(shape=(1, *SHAPE[1:])).estimate(lambda light: light)
    assert np.all(np.isnan(error))


def test_the_error_of_a_ratio_is_that_of_its_linear_part():
    random = np.random.default_rng(3)
    sums = 1000.0 + random.normal(size=SHAPE)
    parts = PartSums(sums, np.ones(SHAPE[1:4], int), np.full(6, 100))
    _, error = parts.estimate(lambda light: light[..., 1] / light[..., 0])
    a, b = sums[..., 0], sums[..., 1]
    ratio = b.mean(axis=0) / a.mean(axis=0)
    linear = (b - ratio * a) / a.mean(axis=0)
    assert np.allclose(error, linear.std(axis=0, ddof=1) / np.sqrt(6), rtol=1e-2)


def test_mirror_images_are_those_of_mueller_matrices():
    parts = drawn()
    found = parts.mirrored().sums
    matrices = parts.sums[..., :16].reshape(*SHAPE[:-1], 4, 4)
    images = MIRROR @ matrices[:, :, ::-1] @ MIRROR
    assert np.allclose(found[..., :16], (0.5 * (matrices + images)).reshape(*SHAPE[:-1], 16))
    assert np.allclose(
        found[..., 16], 0.5 * (parts.sums[..., 16] + parts.sums[:, :, ::-1][..., 16])
    )


@pytest.mark.parametrize("numbers", [1, 16, 17])
def test_the_mirror_image_of_a_mirror_image_changes_nothing(numbers):
    parts = drawn(shape=(*SHAPE[:-1], numbers))
    once = parts.mirrored()
    assert np.allclose(once.mirrored().sums, once.sums, rtol=1e-15)


def test_sums_are_added_in_place():
    one, other = drawn(1), drawn(2)
    expected = one.sums + other.sums, one.counts + other.counts, one.photons + other.photons
    one.add(other)
    for found, value in zip(one, expected, strict=True):
        assert np.array_equal(found, value)
