import numpy as np
import pytest

import optipath as op
from optipath.values.precision import precision, precision_name
from tables import rows

LONG = np.finfo(np.longdouble).eps < np.finfo(np.float64).eps


class WithDtype:
    """What NumPy asks for a dtype, as scalar types of other libraries are."""

    def __init__(self, dtype):
        self.dtype = dtype


@rows("given", ["float32", "f4", "f", "single", np.float32, np.dtype("f4")])
def test_single_precision_goes_by_every_name_that_numpy_has_for_it(given):
    assert op.Composer(dtype=given) == op.Composer(dtype="float32")
    plan = op.Composer(dtype=given).compose(op.load_preset("malus"))
    assert plan.dtype == "float32"
    assert plan.run().stokes.dtype == np.float32
    assert op.fresnel_reflection(1.5, 1.0, 0.0, dtype=given)[0].dtype == np.float32
    assert op.fresnel_transmission(1.5, 1.0, 0.0, dtype=given)[0].dtype == np.float32


@rows("given", [float, "float", "f8", "double", "d", np.float64, np.dtype(float)])
def test_double_precision_goes_by_every_name_that_numpy_and_python_have_for_it(given):
    assert op.Composer(dtype=given).dtype == "float64"
    assert op.fresnel_reflection(1.5, 1.0, 0.0, dtype=given)[0].dtype == np.float64


@pytest.mark.skipif(not LONG, reason="longdouble is float64 here")
@pytest.mark.parametrize("given", [np.longdouble, "g", "longdouble", np.dtype(np.longdouble)])
def test_longdouble_goes_by_every_name_that_numpy_has_for_it(given):
    assert precision_name(given) == "longdouble"
    with pytest.raises(op.ComposerError, match="jax' has no longdouble"):
        op.Composer(dtype=given, engine="jax")


def test_what_has_a_dtype_of_its_own_goes_by_that():
    assert precision(WithDtype(np.dtype("f4"))) == np.float32


OTHER_ORDER = np.dtype("f8").newbyteorder()
ODD = [int, "f2", np.float16, complex, "c8", "i4", bool, str, None, "", "f4,f4", "f4,{", "x", 4]
ODD += [[], np.floating, OTHER_ORDER, np.ones(3), WithDtype(3)]


@rows("given", ODD)
def test_any_other_dtype_is_refused_and_the_three_are_named(given):
    with pytest.raises(
        op.ComposerError, match=r"is unknown; give 'float64', 'float32' or 'longdouble'"
    ):
        op.Composer(dtype=given)
    with pytest.raises(op.ComposerError, match="dtype"):
        op.fresnel_reflection(1.5, 1.0, 0.0, dtype=given)
