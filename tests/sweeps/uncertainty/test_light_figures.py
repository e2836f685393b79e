import numpy as np

import optipath as op
from optipath.sweeps.labels.light_quantities import QUANTITIES
from optipath.sweeps.uncertainty.light_figures import difference, figures_of, gradients_of
from tables import rows


def test_every_quantity_has_its_gradient():
    light = op.Light([[1.0, 0.1, 0.2, 0.3], [2.0, -0.3, 0.1, 0.0]])
    assert figures_of(light).shape == (2, len(QUANTITIES))
    assert gradients_of(light).shape == (2, len(QUANTITIES), 4)


@rows(
    "stokes", [[1.0, 0.1, 0.2, 0.3], [2.0, -0.3, 0.1, -0.5], [1.0, 0.6, 0.8, 0.0], [3.0, 0, 1, 1]]
)
@rows("scale", [1.0, 1e-100])
def test_gradients_are_what_small_changes_do(stokes, scale):
    step = 1e-6
    for place in range(4):
        by = step * np.eye(4)[place]
        ends = [op.Light((stokes + s * by) * scale, physical=False) for s in (1.0, -1.0)]
        slope = difference(*map(figures_of, ends)) / (2.0 * step * scale)
        found = gradients_of(op.Light(np.multiply(stokes, scale)))[:, place]
        np.testing.assert_allclose(found * scale, slope * scale, atol=1e-8)


def test_angles_differ_by_the_shorter_way_round():
    ends = [op.Light([1.0, -1.0, s, 0.0], physical=False) for s in (1e-3, -1e-3)]
    apart = difference(*map(figures_of, ends))
    np.testing.assert_allclose(apart[6], -1e-3, rtol=1e-5)
