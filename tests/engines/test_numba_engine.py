import platform

import numpy as np
import pytest

import optipath as op
from optipath.engines.formulas.path_formula import lights_formula
from optipath.kernels.carriers.stokes_carrier import StokesCarrier
from optipath.values.operands import MANY
from paths import chain

numba_helpers = pytest.importorskip("optipath.engines.numba_helpers")
from optipath.engines.machine_code import assembly  # noqa: E402 - needs numba
from optipath.engines.numba_engine import source  # noqa: E402
from tables import rows  # noqa: E402


@pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="reads x86 assembly")
def test_a_path_is_computed_many_at_a_time():
    plan = op.load_preset("npgr026").compose()
    forms = {operand.input_key: MANY for operand in plan.program.operands if not operand.known}
    forms = {key: "absent" if key.part == "present" else form for key, form in forms.items()}
    formula = lights_formula(plan.program, StokesCarrier, "float64", forms, plan.inputs.limits)
    text = assembly(source(formula))
    packed, single = text.count("mulpd"), text.count("mulsd")
    assert packed > 50
    # The rest of a batch that fills no vector is done one by one.
    assert packed >= single / 2


@rows("number", [1.0, 0.75, -3e-310, 5e-324, 1e308, 0.0])
def test_the_exponent_is_that_of_frexp(number):
    assert numba_helpers.exponent(number) == np.frexp(number)[1]


@rows("power", [0, 5, -1070, 900, -3000, 3000])
def test_powers_of_two_are_taken_times_exactly(power):
    with np.errstate(over="ignore", under="ignore"):
        assert numba_helpers.ldexp(0.75, power) == np.ldexp(0.75, power)


def test_what_a_product_loses_is_kept():
    a, b = 1.0 + 2.0**-30, 1.0 - 2.0**-29
    rest = numba_helpers.product_rest(a, b)
    assert rest == float(np.longdouble(a) * np.longdouble(b) - np.longdouble(a * b))


SINGLE = np.linspace(0.1, 1.0, 5, dtype=np.float32)


@rows("kind", [np.float32, np.float16, ">f4", ">f8"])
def test_arrays_of_any_precision_are_read_as_the_numbers_that_they_are(kind):
    plan = op.Composer(engine="numba").compose(op.load_preset("malus"))
    given = SINGLE.astype(kind)
    law = 0.5 * np.cos(given.astype(np.float64)) ** 2
    np.testing.assert_allclose(plan.run(angle=given).intensity, law, rtol=1e-14)
    np.testing.assert_allclose(plan.mueller(angle=given).matrix[:, 0, 0], law, rtol=1e-14)


def test_parts_of_complex_numbers_of_single_precision_are_read_as_what_they_are():
    path = chain([op.Interface(op.Parameter("m"), 0.0)], [1.0, 0.0, 0.0, 0.0])
    m = (1.5 + SINGLE + 1j * SINGLE).astype(np.complex64)
    law = np.abs((m.astype(complex) - 1.0) / (m.astype(complex) + 1.0)) ** 2
    found = op.Composer(engine="numba").compose(path).run(m=m).intensity
    np.testing.assert_allclose(found, law, rtol=1e-13)


@pytest.mark.filterwarnings("ignore::optipath.CoherenceWarning")
def test_whole_numbers_of_one_axis_of_a_grid_are_whole_numbers_along_the_other():
    # Indices are scaled by powers of two, whose exponents depend on the indices alone.
    material = op.Material(op.Parameter("n"), op.Parameter("k"))
    layers = op.LayerStack([1.0, material, 1.5], op.Parameter("t"), lengths=[1e-6], wavelength=5e-7)
    path = op.Source() >> layers >> op.Detector()
    given = {"n": np.array([[1.3], [2.2], [4.5]]), "k": 0.01, "t": np.linspace(0.1, 1.2, 40)}
    by_numpy, by_numba = (
        op.Composer(engine=engine).compose(path).run(**given).stokes
        for engine in ("numpy", "numba")
    )
    assert np.allclose(by_numba, by_numpy, rtol=1e-13, atol=1e-15)
