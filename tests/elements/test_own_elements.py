"""Elements of a user's own: what they may compute with, what is looked at, and what is told."""

import math
import re
import warnings
from dataclasses import fields
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

import chains
import optipath as op
from optipath.kernels.carriers.structures import FULL
from optipath.kernels.kernel import Kernel
from optipath.kernels.primitives import Primitives
from paths import chain
from tables import rows, slow_except

STATE = [1.0, 0.5, 0.4, 0.3]
ENGINES = ["auto", *chains.ENGINES]
EYE = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))
GIVEN = [0.3, np.linspace(0.1, 1.0, 3), np.linspace(0.1, 1.0, 3000)]
X = op.Parameter("x")


def own(name, mueller_rows, quantity=op.fields.Angle):
    """A class of elements of one number, with such rows."""
    body = {"a": 0.3, "__annotations__": {"a": quantity}}
    return type(name, (op.Element,), {**body, "mueller_rows": staticmethod(mueller_rows)})


def retards(xp, a):
    """The rows of a retarder, by the complex amplitudes that it lets through."""
    p, q = xp.exp(0.5j * a), xp.exp(-0.5j * a)
    even, odd = p * p.conjugate(), xp.sqrt(-1.0 + 0.0j) * xp.sin(1j * a) * 0.0
    c, s = 0.5 * (p / q + q / p), (p / q - q / p) / 2j
    return (even, odd, 0, 0), (odd, even, 0, 0), (0, 0, c, -s), (0, 0, s, c)


def of_numpy(*_):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", PendingDeprecationWarning)
        return np.matrix(np.diag([1.0, 0.5, 0.5, 0.5]))


def in_place(xp, a):
    a += 1.0
    return times(xp.cos(a))


def times(share):
    return [[share * (row == column) for column in range(4)] for row in range(4)]


Phase = own("Phase", retards)
Array = own("Array", lambda _, a: np.diag([1.0, a, a, a]), op.fields.Fraction)
OneMatrix = own("OneMatrix", of_numpy, op.fields.Fraction)
Branch = own("Branch", lambda _, a: EYE if a > 0.0 else [[0] * 4] * 4)
Maths = own("Maths", lambda _, a: times(math.cos(a)))
Misspelt = own("Misspelt", lambda xp, a: ((xp.coss(a), 0, 0, 0), *EYE[1:]))
Divides = own("Divides", lambda *_: ((1 / 0, 0, 0, 0), *EYE[1:]))
ThreeRows = own("ThreeRows", lambda *_: EYE[:3])
Words = own("Words", lambda *_: (("1", 0, 0, 0), *EYE[1:]))
Imaginary = own("Imaginary", lambda xp, a: (EYE[0], (0, xp.exp(1j * a), 0, 0), *EYE[2:]))
Missing = own("Missing", lambda *_: {}["rows"])
Amplifier = own("Amplifier", lambda *_: np.diag([3, 3, 4, 5]).tolist())
Growing = own("Growing", lambda xp, a: times(xp.exp(a)), float)
Rounded = own("Rounded", lambda _, a: times(0.5 + 0 * round(a)))
InPlace = own("InPlace", in_place)
Longer = own("Longer", lambda *_: times(np.ones(3)))


class OwnKernel(op.Element):
    share: float = 0.5

    @staticmethod
    def factory(_):
        return lambda share: [share * (n % 5 == 0) for n in range(16)]

    def couplings(self):
        kernel = Kernel("own", FULL, self.factory)
        return (op.Coupling("in", "out", (op.Operation(kernel, (self.share,)),)),)


class BrokenKernel(OwnKernel):
    @staticmethod
    def factory(_):
        return lambda share: [share.no_such_thing] * 16


class WrongCouplings(op.Element):
    def couplings(self):
        return self.angel


class NoCouplings(op.Element):
    def couplings(self):
        return [1.5]


class Measured(Amplifier):
    physical: ClassVar[bool] = False


def asked(element_class, value, engine="auto"):
    """What a path gives for one value, known beforehand and given."""
    composer = op.Composer(engine=engine)
    known, given = (chain([element_class(one)], STATE) for one in (value, X))
    yield lambda: composer.compose(known).run().stokes
    yield lambda: composer.compose(given).run(x=value).stokes


@pytest.mark.parametrize("engine", slow_except(["auto", "numpy"], ENGINES))
@rows("value", GIVEN)
def test_complex_numbers_inside_rows_work_for_one_path_as_for_arrays(value, engine):
    expected = chain([op.Retarder(value)], STATE).trace().stokes
    for run in asked(Phase, value, engine):
        np.testing.assert_allclose(run(), expected, atol=1e-15)


def test_matrices_and_every_run_know_complex_rows():
    path = chain([Phase(X)], STATE)
    first, *others = [path.trace(x=0.3).stokes for _ in range(8)]
    np.testing.assert_array_equal(others, [first] * 7)
    expected = op.Retarder(0.3).mueller().matrix
    for found in (path.mueller(x=0.3), Phase(0.3).mueller()):
        np.testing.assert_allclose(found.matrix, expected, atol=1e-15)


@rows("engine", ["auto", "numpy", "numba"])
def test_rows_may_be_a_matrix_of_numpy_for_one_path_which_is_given_plain_numbers(engine):
    for run in (*asked(Array, 0.5, engine), *asked(OneMatrix, 0.5, engine)):
        np.testing.assert_allclose(run(), [1.0, 0.25, 0.2, 0.15])
    plan = op.Composer(engine=engine).compose(chain([Rounded(X)]))
    for angle in (0.3, np.float64(0.3), np.array(0.3)):
        assert plan.run(x=angle).S0 == 0.5


@rows(
    "element_class, expected",
    [
        (Array, "Array raises ValueError: .*return the rows as tuples"),
        (Branch, r"Branch raises ValueError: .*choose by xp.where\(condition, yes, no\) in place"),
        (Maths, r"Maths raises TypeError: .*call xp.cos, xp.sqrt, ... in place of the functions"),
        (Imaginary, r"Imaginary gives the complex entry \[1\]\[1\]"),
    ],
)
def test_what_is_not_for_arrays_is_told_with_its_class_and_the_cure(element_class, expected):
    for run in asked(element_class, GIVEN[1]):
        with pytest.raises(op.errors.PathError, match=f"^mueller_rows of element class {expected}"):
            run()


@pytest.mark.parametrize("element_class", [Branch, Maths])
def test_what_is_not_for_values_that_jax_traces_is_told_with_its_class(element_class):
    pytest.importorskip("jax")
    plan = op.Composer(engine="jax").compose(chain([element_class(X)]))
    told = rf"class {element_class.__name__} raises .*; (choose|call)"
    with pytest.raises(op.errors.PathError, match=told):
        plan.run(x=0.3)


@rows("engine", ENGINES)
@rows("value", GIVEN)
@rows(
    "element_class, expected, cause",
    [
        (Misspelt, "calls xp.coss, which does not exist; did you mean 'cos'", AttributeError),
        (Divides, "raises ZeroDivisionError: division by zero", ZeroDivisionError),
        (ThreeRows, "must return four rows of four entries, not", type(None)),
        (Words, "gives the entry '1'; give numbers", type(None)),
        (Missing, "raises KeyError: 'rows'", KeyError),
    ],
)
def test_whatever_rows_raise_is_an_error_of_the_library(
    element_class, expected, cause, value, engine
):
    what = f"mueller_rows of element class {element_class.__name__} {expected}"
    for run in asked(element_class, value, engine):
        with pytest.raises(op.errors.PathError, match=what) as told:
            run()
        assert isinstance(told.value.__cause__, cause)


@rows(
    "element_class, expected",
    [
        (WrongCouplings, r"couplings\(\) of element class WrongCouplings raises AttributeError: "),
        (NoCouplings, r"\(\) of element class NoCouplings gives 1.5; return a tuple of op"),
        (BrokenKernel, "kernel 'own' raises AttributeError: .*no_such_thing"),
    ],
)
def test_whatever_couplings_and_their_kernels_raise_is_an_error_of_the_library(
    element_class, expected
):
    for act in (chain([element_class()]).trace, element_class().mueller):
        with pytest.raises(op.errors.PathError, match=expected):
            act()


@rows("error", [KeyboardInterrupt, MemoryError])
def test_an_interruption_stays_what_it_is(error):
    def interrupted(*_):
        raise error

    with pytest.raises(error):
        chain([own("Interrupted", interrupted)(0.3)]).trace()


def test_an_own_element_that_amplifies_is_found_when_its_path_is_checked():
    with pytest.raises(op.errors.PathError) as told:
        chain([Amplifier(0.3)]).check()
    for part in ("'e0'", "class Amplifier", "a=0.3", "(3, 0, 0, 0)", "physical: ClassVar[bool]"):
        assert part in str(told.value)


@rows("engine", ENGINES)
@rows("value", GIVEN)
def test_an_own_element_that_amplifies_is_found_with_its_first_values(value, engine):
    plan = op.Composer(engine=engine).compose(chain([Amplifier(X)]))
    ask = [lambda: plan.run(x=value), lambda: plan.mueller(x=value)]
    for act in ask if engine == "jax" else [*ask, lambda: list(plan.stream(100, x=value))]:
        with pytest.raises(
            op.errors.ParameterError, match=r"^at x = .*: 'e0' \(element class Amplif"
        ):
            act()


def test_first_and_known_values_and_kernels_of_ones_own_are_looked_at():
    plan = op.Composer().compose(chain([Amplifier(op.Parameter("x", unit="deg"))]))
    with pytest.raises(op.errors.ParameterError, match=r"^at x = 22\.5 deg: 'e0'"):
        plan.run(x="22.5 deg")
    shares = np.full(1000, -0.1)
    shares[567] = 0.7
    with pytest.raises(op.errors.PathError, match=r"makes light up to 2\.01375\d+ times as bright"):
        chain([Growing(shares)]).check()
    assert chain([OwnKernel(0.5)]).trace().intensity == 0.5
    with pytest.raises(op.errors.PathError, match=r"class OwnKernel, .* 2 times as bright"):
        chain([OwnKernel(2.0)]).check()
    with pytest.raises(
        op.errors.ParameterError, match=r"at x = 2: .*class OwnKernel.* 2 times as bright"
    ):
        chain([OwnKernel(X)]).trace(x=2.0)


@rows("engine", ENGINES)
def test_the_first_and_the_last_path_of_an_array_are_looked_at(engine):
    plan = op.Composer(engine=engine).compose(chain([Growing(X)]))
    plan.run(x=np.linspace(-1.0, 0.0, 1000))
    with pytest.raises(op.errors.ParameterError, match=r"at x = 0\.1: 'e0'"):
        plan.run(x=np.linspace(-50.0, 0.1, 1001))


def test_what_says_it_is_not_physical_is_taken_and_other_values_are_not_looked_at():
    np.testing.assert_allclose(chain([Measured(0.3)], STATE).trace().stokes, [3.0, 1.5, 1.6, 1.5])
    light = chain([Measured(X)], STATE).trace(x=GIVEN[2])
    np.testing.assert_allclose(light.stokes, np.tile([3.0, 1.5, 1.6, 1.5], (3000, 1)))
    light = op.Mueller(np.diag([3.0, 3.0, 4.0, 5.0])) @ op.Light(STATE)
    np.testing.assert_allclose(light.stokes, [3.0, 1.5, 1.6, 1.5])
    assert chain([op.Polarizer(X)]).compose().own_ways == ()
    assert len(chain([Growing(X)]).compose().own_ways) == 1
    jax = pytest.importorskip("jax")
    plan = op.Composer(dtype="float32").compose(chain([Amplifier(X)], STATE))
    found = jax.jit(lambda x: plan.run(x=x).stokes)(0.3)
    np.testing.assert_allclose(found, [3.0, 1.5, 1.6, 1.5], rtol=1e-6)


@rows(
    "name, written",
    [
        ("tan", "xp.sin(x) / xp.cos(x)"),
        ("abs", "xp.absolute(x)"),
        ("arctan2", "xp.atan2(y, x)"),
    ],
)
def test_what_xp_lacks_is_written_by_what_it_has(name, written):
    lacking = own("Lacking", lambda xp, a: getattr(xp, name)(a))
    with pytest.raises(op.errors.PathError, match=re.escape(f"does not exist; write {written}")):
        lacking().mueller()


def test_arguments_are_the_callers_and_entries_as_many_as_the_paths():
    path, angles = chain([InPlace(X)]), np.zeros(100)
    with pytest.raises(
        op.errors.PathError, match=r"InPlace raises .* a = a \+ 1, in place of a \+= 1"
    ):
        path.trace(x=angles)
    assert not angles.any()
    assert pytest.approx(math.cos(1.0)) == path.trace(x=0.0).S0
    path = chain([Longer(X)])
    with pytest.raises(
        op.errors.PathError, match=r"of shape \(3,\) for paths of shape \(\); compute"
    ):
        path.trace(x=0.1)
    with pytest.raises(
        op.errors.PathError, match=r"an entry of shape \(3,\) for paths of shape \(5,\)"
    ):
        path.trace(x=np.zeros(5))
    with pytest.raises(op.errors.PathError, match=r"for paths of shape \(\)"):
        Longer().mueller()


@rows(
    "use",
    [
        lambda gain: gain @ op.Light(STATE),
        lambda gain: gain @ op.Polarizer(),
        lambda gain: op.Polarizer() @ gain,
        lambda gain: gain.mueller(),
    ],
)
@rows("value", [5.0, [5.0, 3.0], op.Parameter("c", 5.0, bound=True)])
def test_what_no_light_can_do_is_refused_of_an_element_alone_too(use, value):
    with pytest.raises(
        op.errors.PathError, match=r"class Amplifier.* is unphysical.*physical.*= False"
    ):
        use(Amplifier(value))
    use(Measured(value))


PAGE = Path(__file__).parents[2] / "docs" / "own-elements.md"


def test_the_page_lists_every_function_of_xp_and_no_other():
    section = PAGE.read_text("utf-8").partition("## The functions of `xp`")[2].partition("##")[0]
    rows = [line.split("|")[1] for line in section.splitlines() if line.startswith("| `")]
    listed = [name for row in rows for name in re.findall(r"`(\w+)", row)]
    assert sorted(listed) == sorted(field.name for field in fields(Primitives))
