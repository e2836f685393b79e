import inspect

import pytest

from optipath.kernels.carriers.bounds_carrier import BoundsCarrier
from optipath.kernels.carriers.carrier import Carrier
from optipath.kernels.carriers.intensity_carrier import IntensityCarrier
from optipath.kernels.carriers.jones_carrier import JonesCarrier
from optipath.kernels.carriers.matrix_carrier import MatrixCarrier
from optipath.kernels.carriers.scaled_carrier import ScaledCarrier
from optipath.kernels.carriers.stokes_carrier import StokesCarrier
from optipath.kernels.numbers.primitives import FLOAT
from tables import rows

ALL = [
    StokesCarrier,
    ScaledCarrier,
    JonesCarrier,
    MatrixCarrier,
    IntensityCarrier,
    BoundsCarrier,
]


@rows("carrier", ALL)
def test_every_carrier_keeps_the_contract(carrier):
    for name in ("emit", "act", "add", "meet", "read"):
        promised = inspect.signature(getattr(Carrier, name)).parameters
        assert list(inspect.signature(getattr(carrier, name)).parameters) == list(promised)


@rows("carrier", [JonesCarrier, IntensityCarrier, BoundsCarrier])
def test_a_carrier_that_goes_through_no_loop_says_so(carrier):
    with pytest.raises(NotImplementedError, match=f"{carrier.__name__} carries no light"):
        carrier(FLOAT).meet(None, {})
