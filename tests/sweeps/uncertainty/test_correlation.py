import pytest

import optipath as op
from tables import rows


def refused(correlation):
    path = op.load_preset("npgr026")
    with pytest.raises(op.ParameterError) as fault:
        path.propagate(
            n1=(1.5, 0.1),
            k1=(0.2, 0.1),
            n2=(1.5, 0.1),
            correlation=correlation,
            method="differences",
        )
    return fault.value.faults


@rows(
    "correlation, words",
    [
        ({("n1", "k2"): 0.1}, "names 'k2', which has no uncertainty here"),
        ({("n1", "n1"): 1.0}, 'is of pairs of parameters, such as {("n1", "k1"): 0.3}'),
        ({"n1": 1.0}, "is of pairs of parameters"),
        ({("n1", "k1"): 1.1}, "give a number within -1 .. 1"),
        ({("n1", "k1"): "much"}, "give a number within -1 .. 1"),
        ({("n1", "k1"): 0.1, ("k1", "n1"): 0.1}, "is given twice"),
        ([0.3], "must be a mapping"),
    ],
)
def test_what_is_no_correlation_is_refused(correlation, words):
    (fault,) = refused(correlation)
    assert words in fault


def test_every_wrong_pair_is_told():
    assert len(refused({("n1", "k2"): 0.1, ("n1", "k1"): 2.0})) == 2


def test_coefficients_that_no_values_can_have_together_are_refused():
    # 1, -1 and 1: what goes with n1 and against k1 cannot go with both.
    (fault,) = refused({("n1", "k1"): -0.9, ("n1", "n2"): 0.9, ("k1", "n2"): 0.9})
    assert "has the eigenvalue -0.8" in fault


@rows("method", ["differences", "monte-carlo"])
def test_what_is_wholly_correlated_may_cancel(method):
    # Two turns against each other: only their sum is seen.
    path = (
        op.Source(stokes=[1, 1, 0, 0])
        >> op.Rotator(op.Parameter("a"))
        >> op.Rotator(op.Parameter("b"))
        >> op.Polarizer(0.3)
        >> op.Detector()
    )
    found = path.propagate(
        a=(0.2, 0.01), b=(0.4, 0.01), correlation={("a", "b"): -1.0}, method=method
    )
    assert found.uncertainty_of("S0") < 1e-9
    alone = path.propagate(a=(0.2, 0.01), b=0.4, method=method)
    assert alone.uncertainty_of("S0") > 1e-3
