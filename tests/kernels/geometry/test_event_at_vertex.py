import math

import numpy as np

from optipath.kernels.catalogue import EVENT_AT_VERTEX, INCIDENCE, REFRACTION
from optipath.kernels.geometry.events import Event
from optipath.kernels.numbers.primitives import FLOAT, NUMPY
from tables import rows

AROUND = (0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0, -2.0)
NOWHERE = (math.nan,) * 3
met = EVENT_AT_VERTEX.made_for(FLOAT)


def test_the_angle_is_that_of_what_happens_and_points_behind_the_end_are_not_looked_at():
    reflected = met(1.0, 1.5, 0.0, Event.REFLECTS, *AROUND)
    assert reflected == (1.0, 1.5, *INCIDENCE.made_for(FLOAT)(*AROUND))
    refracted = met(1.0, 1.5, 0.0, Event.REFRACTS, *AROUND)
    assert refracted == REFRACTION.made_for(FLOAT)(1.0, 1.5, *AROUND)
    events = Event.REFLECTS, Event.BEHIND, Event.BEHIND
    points = np.float64([*AROUND, *NOWHERE, math.inf, 0.0, 1e200])
    with np.errstate(all="ignore"):
        found = EVENT_AT_VERTEX.made_for(NUMPY)(np.float64(1.0), 1.5, 0.0, *events, *points)
    np.testing.assert_allclose(found, (1.0, 1.5, 0.0, 1.0), rtol=0, atol=1e-15)


@rows(
    "k, event, points",
    [
        (0.0, Event.CANNOT, AROUND),
        (0.5, Event.REFRACTS, AROUND),
        (0.0, Event.REFLECTS, (*AROUND[:6], *AROUND[3:6])),
        (0.0, Event.REFRACTS, (*AROUND[:6], *NOWHERE)),
        (0.0, Event.REFRACTS, (*AROUND[:6], 0.0, 1.0, 2.0)),
    ],
)
def test_what_cannot_be_has_no_angle(k, event, points):
    with np.errstate(all="ignore"):
        *_, c, _ = EVENT_AT_VERTEX.made_for(NUMPY)(*map(np.float64, (1.0, 1.5, k, event, *points)))
    assert np.isnan(c)
