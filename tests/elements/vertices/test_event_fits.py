"""What is told quickly of events at a vertex is what their kernel says."""

import numpy as np

from optipath.elements.vertices.event_fits import EventFits
from optipath.kernels.catalogue import EVENT_AT_VERTEX
from optipath.kernels.geometry.events import Event
from optipath.kernels.numbers.primitives import NUMPY


def test_light_can_go_so_where_the_kernel_has_an_angle_or_the_chain_has_ended():
    rng = np.random.default_rng(1)
    count = 4000
    event = rng.integers(0, 4, count).astype(float)
    n1, n2 = rng.choice([1.0, 1.2, 1.5, 2.4], (2, count))
    k = rng.choice([0.0, 0.0, 0.0, 1.0], count)
    scale = 10.0 ** rng.choice([-80, -70, -69.9, 0, 0, 0, 69.9, 70, 80], count)
    start, leg, turn = rng.normal(size=(3, 3, count)) * scale
    here = start + leg
    points = np.concatenate([start, here, here + leg + rng.uniform(0, 1, count) * turn])
    points[rng.integers(0, 9, 50), rng.integers(0, count, 50)] = np.nan
    given = event, n1, n2, k
    with np.errstate(all="ignore"):
        found = EventFits((), "vertex1").fits(np, *given, *points)
        cos = EVENT_AT_VERTEX.made_for(NUMPY)(n1, n2, k, event, *points)[2]
    np.testing.assert_array_equal(found, ~np.isnan(cos) | (event == Event.BEHIND))
    assert 0.3 < np.mean(found) < 0.9
