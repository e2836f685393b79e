"""Light carried with an exponent."""

import numpy as np
import pytest

from optipath.kernels.carriers.scaled_carrier import ScaledCarrier
from optipath.kernels.carriers.structures import SCALE
from optipath.kernels.numbers.primitives import NUMPY
from tables import rows


class _Emptied:
    """A loop from which light comes as it arrives."""

    def count(self, _):
        return 4

    def lights(self, arriving):
        return dict(arriving)


@rows("dtype", [np.float32, np.float64, np.longdouble])
def test_exponents_of_dark_light_stay_integers_of_the_size_that_frexp_gives(dtype):
    # NumPy from 2.5 refuses integers that do not fit the others.
    way = ScaledCarrier(NUMPY)
    intensity = np.array([0.0, 1.0, 1e-30], dtype)
    dark = np.zeros(3, dtype)
    state = way.emit((intensity, dark, dark, dark))
    states = [
        way.act(SCALE, (np.zeros(3, dtype),), state),
        way.add(state, way.act(SCALE, (np.zeros(3, dtype),), state)),
        way.meet(_Emptied(), {0: state})[0],
    ]
    smallest = np.frexp(intensity)[1].dtype
    assert [exponent.dtype for _, exponent in states] == [smallest] * 3


def test_faint_light_that_meets_none_at_all_in_a_loop_keeps_its_digits():
    way = ScaledCarrier(NUMPY)
    dark = np.zeros(1)
    faint = way.emit((np.ones(1), dark, dark, dark))
    for _ in range(9):
        faint = way.act(SCALE, (np.full(1, 1e-300),), faint)
    arriving = {0: faint, 1: way.emit((dark, dark, dark, dark))}
    components, exponent = way.read(way.meet(_Emptied(), arriving)[0])
    assert np.log10(components[0]) + exponent * np.log10(2.0) == pytest.approx(-2700.0, abs=1e-9)
