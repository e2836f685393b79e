import numpy as np
import pytest

import optipath as op
from optipath.surfaces.hemispheres.pixel_mask import PixelMask

LIGHT = np.array([[np.nan, 1.0], [2.0, 9.0]])


def test_brightness_is_over_the_mean_of_the_pixels_that_there_are():
    bright = PixelMask(brighter_than=0.5).bright(LIGHT)  # The mean is 4.
    np.testing.assert_array_equal(bright, [[False, False], [False, True]])
    assert PixelMask(brighter_than=0.3).bright(LIGHT).sum() == 2


def test_a_difference_is_known_by_its_share_or_by_itself():
    mask = PixelMask(noise=0.2, known_to=0.001)
    known = mask.known(np.array([-0.1, 0.1, 0.0, 0.1]), np.array([0.019, 0.021, 0.001, np.nan]))
    np.testing.assert_array_equal(known, [True, False, True, False])


def test_any_noise_leaves_out_what_is_no_number_only():
    known = PixelMask(noise=None).known(np.array([np.nan, 0.1]), np.array([0.0, np.nan]))
    np.testing.assert_array_equal(known, [False, True])


def test_all_thresholds_that_are_none_are_told_at_once():
    with pytest.raises(op.SurfaceError) as caught:
        PixelMask(-1.0, noise=True, known_to=np.inf)
    assert [fault.split()[0] for fault in caught.value.faults] == [
        "brighter_than",
        "known_to",
        "noise",
    ]
