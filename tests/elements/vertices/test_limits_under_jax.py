"""Limits that single precision cannot hold are held by what it can."""

import numpy as np
import pytest

from optipath.elements.vertices.vertex_domain import legs_fit
from optipath.values.domains.indices import LIT_INDEX, OUTSIDE
from optipath.values.domains.wavelengths import WAVELENGTH

jax = pytest.importorskip("jax")


@pytest.mark.filterwarnings("error")
def test_numbers_of_single_precision_are_checked_without_a_word():
    points = np.array([[0, 0, 0], [0, 0, 0], [0, 0, 1]], np.float32)
    assert jax.jit(legs_fit)(points).tolist() == [False, True]
    for domain in (WAVELENGTH, OUTSIDE, LIT_INDEX):
        for number, allowed in ((0.0, False), (0.5, True)):
            assert bool(jax.jit(domain.allows)(np.float32(number))) is allowed
