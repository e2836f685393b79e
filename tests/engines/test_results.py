"""Evaluations that are given what others come to, such as an index out of a wavelength."""

from typing import ClassVar

import numpy as np
import pytest

import optipath as op
from optipath.elements.coupling import Coupling
from optipath.engines.program import Evaluation, Program, Reading, Result, Step, execute
from optipath.engines.symbols import SYMBOLIC, Recorder
from optipath.kernels.carriers.carrier import StokesCarrier
from optipath.kernels.catalog import REFLECTION, UNPOLARIZED
from optipath.kernels.kernel import Kernel
from optipath.kernels.primitives import FLOAT, NUMPY
from optipath.values.operands import Operand, Operation
from tables import rows, slow

CALLS = []


def cauchy(xp):
    """Make (A, B, wavelength) -> (n, k) of glass, and count how often that is asked for."""
    del xp

    def index(a, b, wavelength):
        CALLS.append(wavelength)
        return a + b / (wavelength * wavelength), 0.0 * wavelength

    return index


CAUCHY = Kernel("Cauchy", None, cauchy)
REFLECTED = REFLECTION.by_method("stable")
COSINE, SINE = 0.8, 0.6
GIVEN = [1.5, 0.004, 1.0, COSINE, SINE]


def by_hand(reflections=1):
    """Unpolarised light, reflected by glass of some wavelength: the last operand."""
    glass = Evaluation(CAUCHY, (0, 1, 5))
    reflected = Evaluation(REFLECTED, (2, Result(1, 0), Result(1, 1), 3, 4))
    # Light comes from glass on the way back, so that both evaluations take one index.
    back = Evaluation(REFLECTED, (Result(1, 0), 2, Result(1, 1), 3, 4))
    steps = [Step("lamp.out", (), 0), Step("glass.reflected", (0,), 2), Step("back", (1,), 3)]
    return Program(
        operands=tuple(map(Operand, (*GIVEN, op.Parameter("wavelength")))),
        evaluations=(Evaluation(UNPOLARIZED, (2,)), glass, reflected, back),
        steps=tuple(steps[: reflections + 1]),
        sources={"lamp": (0, op.Frame())},
        detectors={"eye": Reading(reflections, op.Frame())},
        dumps={},
    )


def wanted(wavelength):
    glass = op.Interface(1.5 + 0.004 / wavelength**2, float(np.arctan2(SINE, COSINE)))
    return glass.mueller().matrix[..., 0]


def test_floats_and_arrays_are_given_what_an_earlier_evaluation_comes_to_once():
    found, _ = execute(by_hand(), [*GIVEN, 0.5], StokesCarrier(FLOAT))[1]
    np.testing.assert_allclose(found, wanted(0.5), rtol=1e-14, atol=1e-17)
    several = np.array([0.4, 0.5, 0.7])
    found, _ = execute(by_hand(), [*GIVEN, several], StokesCarrier(NUMPY))[1]
    np.testing.assert_allclose(np.stack(found[:2], -1), wanted(several)[:, :2], rtol=1e-14)
    CALLS.clear()
    execute(by_hand(reflections=2), [*GIVEN, 0.5], StokesCarrier(FLOAT))
    assert CALLS == [0.5]
    program = by_hand()
    assert set(program.passed_to[2]) == {0, 1, 2, 3, 4, 5}
    assert [set(takes) for takes in program.takes] == [set(), set(), {1}, {1}]


def test_formulas_record_it_as_if_it_stood_in_the_kernel():
    recorder = Recorder(np.dtype(np.float64))
    length = recorder.input("wavelength")
    operands = [*map(np.float64, GIVEN), length]
    execute(by_hand(), operands, StokesCarrier(SYMBOLIC))
    count = len(recorder.symbols)
    index = cauchy(SYMBOLIC)(operands[0], operands[1], length)
    kernel, given = REFLECTED.specialised((operands[2], *index, *operands[3:5]), lambda _: True)
    Fs, *_ = kernel.made_for(SYMBOLIC)(*given)
    assert Fs.index < count == len(recorder.symbols)


class Glass(op.Element, kind="example-dispersive-glass"):
    """An element of one's own whose index comes from a wavelength."""

    outputs: ClassVar[tuple[str, ...]] = ("reflected",)
    natural: ClassVar[str] = "reflected"
    straight: ClassVar[bool] = False

    wavelength: float
    azimuth: float = 0.0

    def couplings(self):
        index = Operation(CAUCHY, (1.5, 0.004, self.wavelength)).results(2)
        operation = Operation(REFLECTION, (1.0, *index, COSINE, SINE))
        return (Coupling("in", "reflected", (operation,), reflects=True),)


def dispersive(wavelength):
    return op.Source() >> Glass(wavelength) >> Glass(wavelength, 0.4) >> op.Detector()


def plain(wavelength):
    index, incidence = 1.5 + 0.004 / wavelength**2, np.arctan2(0.6, 0.8)
    panes = op.Interface(index, incidence) >> op.Interface(index, incidence, azimuth=0.4)
    return (op.Source() >> panes >> op.Detector()).trace()


@rows("options", [{}, {"model": "full"}, {"composing": "jones"}])
@pytest.mark.parametrize("engine", ["numpy", slow("numba")])
def test_elements_may_be_given_an_index_out_of_a_wavelength(engine, options):
    plan = op.Composer(engine=engine, **options).compose(dispersive(op.Parameter("wavelength")))
    for lengths in (0.5, np.linspace(0.4, 0.7, 5), np.linspace(0.4, 0.7, 3000)):
        found = plan.run(wavelength=lengths).stokes
        np.testing.assert_allclose(found, plain(lengths).stokes, rtol=1e-13, atol=1e-17)


def test_indices_that_are_known_and_matrices_take_it_too():
    plan = dispersive(0.5).compose()
    assert plan.run().intensity == pytest.approx(plain(0.5).intensity, rel=1e-14)
    assert not any(plan.program.takes)
    np.testing.assert_allclose(Glass(0.5).mueller().matrix[:, 0], wanted(0.5), rtol=1e-14)
    plan = dispersive(op.Parameter("wavelength")).compose()
    counts = plan.evaluations(wavelength=np.array([0.4, 0.5]))
    assert counts["example-dispersive-glass.reflected"] == 2
    assert plan.paths(wavelength=0.5)[0].light.intensity == pytest.approx(plain(0.5).intensity)


def table(xp):
    """Make a wavelength -> six numbers, by what no formula can be made of."""
    del xp
    return lambda wavelength: (0.0,) * 4 + (1.5 + 0.004 / float(wavelength) ** 2, 0.0)


class Tabulated(Glass, kind="example-tabulated-glass"):
    """Glass whose index is looked up by a kernel of one's own, among other results."""

    def couplings(self):
        *_, n, k = Operation(Kernel("table", None, table), (self.wavelength,)).results(6)
        operation = Operation(REFLECTION, (1.0, n, k, COSINE, SINE))
        return (Coupling("in", "reflected", (operation,), reflects=True),)


def test_results_of_kernels_that_take_no_symbols_are_unknown_when_composing():
    path = op.Source() >> Tabulated(op.Parameter("length")) >> op.Detector()
    np.testing.assert_allclose(path.trace(length=0.5).stokes, wanted(0.5), rtol=1e-14, atol=1e-17)
