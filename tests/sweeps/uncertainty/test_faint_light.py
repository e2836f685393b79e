import numpy as np

import optipath as op
from tables import rows

METHODS = ["monte-carlo", "differences"]


def lamp():
    return op.Source(op.Parameter("i")) >> op.Polarizer(op.Parameter("a")) >> op.Detector()


@rows("method", METHODS)
@rows("size", [1e-300, 1e-160, 1e155, 1e300])
def test_faint_and_bright_light_is_as_uncertain_as_any(method, size):
    given = {"a": (0.3, 0.01), "method": method}
    plain = lamp().propagate(i=(1.0, 0.01), **given)
    found = lamp().propagate(i=(size, 0.01 * size), **given)
    np.testing.assert_allclose(found.uncertainty / size, plain.uncertainty, rtol=1e-6, atol=1e-12)
    np.testing.assert_allclose(found.shares[:4], plain.shares[:4], atol=1e-6)
    np.testing.assert_allclose(found.mean / size, plain.mean, rtol=1e-12, atol=1e-15)


def test_light_that_is_nearly_absorbed_is_uncertain_by_the_length_of_the_absorber():
    medium = op.Medium(length=op.Parameter("L"), absorption="100 1/cm")
    path = op.Source(1) >> medium >> op.Detector()
    found = path.propagate(L=("4 cm", "1 um"), method="monte-carlo")
    # exp(-a L) varies by a s = 100 / cm x 1 um = 1 %.
    np.testing.assert_allclose(found.uncertainty[0] / found.light.stokes[0], 0.01, rtol=0.03)
