"""Classes and rows of elements of a user's own: the same numbers in every run, or a sentence."""

from dataclasses import InitVar, field
from typing import ClassVar

import numpy as np
import pytest

import optipath as op
from chains import ENGINES
from optipath.elements.coupling import Coupling
from optipath.kernels.carriers.structures import SCALE
from optipath.kernels.catalog import ATTENUATOR
from optipath.kernels.kernel import Kernel
from optipath.kernels.primitives import FLOAT
from optipath.values.domains import Domain
from optipath.values.operands import Operation
from optipath.values.use import Use
from tables import rows


def times(share):
    """The rows of a grey filter."""
    return [[share * (row == column) for column in range(4)] for row in range(4)]


def make(function=lambda *_: times(0.5), kind="", annotations=(), **body):
    """A class of elements with such rows and such a body."""
    body = {"mueller_rows": staticmethod(function), **body, "__annotations__": dict(annotations)}
    return type("Own", (op.Element,), body, kind=kind)


@rows(
    "given, told",
    [
        ({"kind": 3}, "kind of element class Own must be a text, not 3"),
        ({"mueller_rows": np.eye(4)}, "must be a static method that returns the rows"),
        ({"mueller_rows": classmethod(times)}, "put @staticmethod before it"),
        ({"mueller_rows": lambda self: self}, "put @staticmethod before it"),
        ({"annotations": {"kind": op.fields.Real}}, r"field 'kind'.*class Name\(op.Element, kind="),
        ({"annotations": {"outputs": op.fields.Real}}, "'outputs'.*Own.*write outputs: ClassVar"),
        (
            {"annotations": {"uses": op.fields.Real}},
            "'uses'.*every element has; .* give it another name",
        ),
        ({"annotations": {"physical": bool}}, "'physical'.*write physical: ClassVar"),
        ({"annotations": {"physical": "bool"}}, "'physical'.*write physical: ClassVar"),
        ({"inputs": "in"}, "^inputs of element class Own must be names of ports"),
        ({"outputs": 3}, "^outputs of element class Own must be names of ports"),
        ({"outputs": ("in", "out")}, "has several ports 'in'; give each a name of its own"),
        ({"mirrored": ("angel",)}, "names 'angel', which is no field of it"),
        ({"mirrored": ("azimuth",)}, "names 'azimuth', whose links say how it is turned"),
        ({"mirrored": (1,)}, r"must be names of fields, not \(1,\)"),
    ],
)
def test_classes_that_no_element_can_have_are_refused_when_they_are_made(given, told):
    with pytest.raises(op.errors.PathError, match=told):
        make(**given)


def dimmed_by_what_is_kept():
    """An element that keeps a share besides its fields."""
    shares = [0.5, 0.25]

    def init(self):
        op.Element.__post_init__(self)
        vars(self)["share"] = shares.pop()

    def couplings(self):
        emitted = Kernel("kept", SCALE, lambda _: lambda share: (share,))
        return (Coupling("in", "out", (Operation(emitted, (self.share,)),)),)

    return type("Own", (op.Element,), {"__post_init__": init, "couplings": couplings})


def left_at_a_default():
    """An element one of whose values is never given."""
    body = {"share": field(default=0.5, init=False), "__annotations__": {"share": float}}
    body["mueller_rows"] = staticmethod(lambda _, share: times(share))
    return type("Own", (op.Element,), body)


@rows("own, share", [(dimmed_by_what_is_kept(), 0.125), (left_at_a_default(), 0.25)])
def test_two_elements_of_equal_fields_do_what_each_keeps(own, share):
    path = op.Source() >> own() >> own() >> op.Detector("intensity")
    assert path.trace().intensity == share


def test_a_class_that_is_not_physical_says_so_for_all_its_elements():
    assert make(annotations={"physical": ClassVar[bool]}, physical=False).domains() == {}


LENGTHS = {"thickness": op.fields.Length, "absorption": op.fields.Absorption}


def test_values_come_in_the_order_of_the_fields_and_may_have_any_names():
    with pytest.raises(
        op.errors.PathError, match=r"takes absorption and thickness, but .* the order of"
    ):
        make(lambda _, absorption, thickness: times(absorption * thickness), annotations=LENGTHS)
    for function in (
        lambda _, thickness, absorption: times(25 * absorption * thickness),
        lambda _, a, b: times(25 * a * b),
        lambda *values: times(25 * values[1] * values[2]),
    ):
        own = make(function, annotations=LENGTHS)
        assert own(0.1, 0.2).mueller().matrix[0, 0] == pytest.approx(0.5)


def test_fields_may_be_true_or_false_and_angles_have_the_name_of_an_axis():
    own = make(lambda _, on: times(0.5 * on), annotations={"on": bool})
    assert [own(on).mueller().matrix[0, 0] for on in (True, False)] == [0.5, 0.0]
    with pytest.raises(op.errors.ValueFault, match="give True or False"):
        own(0.5)
    own = make(lambda xp, angle: times(0.5 * xp.sin(angle)), annotations={"angle": op.fields.Axis})
    assert own("vertical").mueller().matrix[0, 0] == 0.5


def plan_of(function, engine="auto", dtype="float64", state=(1.0, 0.5, 0.2, 0.1)):
    """The plan of a path with an element of such rows."""
    own = make(function, annotations={"a": op.fields.Real})
    path = op.Source(stokes=state) >> own(op.Parameter("a")) >> op.Detector()
    return op.Composer(engine=engine, dtype=dtype).compose(path)


def plan_of_share(function, *options):
    return plan_of(lambda xp, a: times(function(xp, a)), *options)


LOOK_UPS = [
    lambda _, a: {0.4: 0.5}.get(a, 0.2),
    lambda _, a: 0.5 if a in {0.4} else 0.2,
    lambda _, a: {"0.4": 0.5}.get(f"{a}", 0.2),
]


@rows("look_up", LOOK_UPS)
def test_a_value_that_is_looked_up_is_found_in_every_run(look_up):
    plan = plan_of_share(look_up)
    assert [plan.run(a=0.4).S0 for _ in range(6)] == [0.5] * 6


@rows("engine", ENGINES)
def test_looking_up_many_values_is_told_with_the_cure(engine):
    with pytest.raises(op.errors.PathError, match="unhashable"):
        plan_of_share(LOOK_UPS[0], engine).run(a=np.linspace(0.1, 1.0, 3))


def test_numbers_that_are_scaled_and_scaled_back_are_the_same_in_every_run():
    def root(xp, a):
        power = xp.scaling(a)
        return 0.1 * xp.ldexp(xp.ldexp(a, -power), power)

    plan = plan_of_share(root)
    assert [plan.run(a=1.3).S0 for _ in range(6)] == [0.13] * 6
    np.testing.assert_array_equal(plan.run(a=[0.5, 1.3, 6.0]).S0, [0.05, 0.13, 0.1 * 6.0])


NEGATIONS = [
    lambda xp, a: 0.2 + 0.3 * ~(xp.maximum(a, 0.0) > 1.0),
    lambda xp, a: xp.where(~((a > 0.5) & ~(a < 1.0)), 0.5, 0.2),
]


@rows("engine", ENGINES)
@rows("share", NEGATIONS)
def test_what_is_not_so_is_the_same_in_every_run_and_for_many(share, engine):
    plan = plan_of_share(share, engine)
    values, expected = [1.3, 1.3, 1.3, 0.3, 1.3, 0.3], [0.2, 0.2, 0.2, 0.5, 0.2, 0.5]
    assert [plan.run(a=value).S0 for value in values] == expected
    np.testing.assert_array_equal(plan.run(a=values).S0, expected)


def test_kernels_of_ones_own_are_told_where_numbers_lack_what_they_ask():
    kernel = Kernel("edge", SCALE, lambda xp: lambda a: (xp.where(~(a > 1.0), 0.5, 0.2),))
    assert [kernel.made_for(FLOAT)(a) for a in (0.3, 1.3)] == [(0.5,), (0.2,)]
    with pytest.raises(op.errors.PathError, match="no attribute 'conj'"):
        plan_of_share(lambda _, a: a * (0.3 + 0.1j).conj().real).run(a=0.3)
    with pytest.raises(
        op.errors.PathError, match=r"the complex entry \[0\]\[0\] = \(0\.3\+5e-08j\)"
    ):
        plan_of_share(lambda _, a: 0.3 + 1e-7j * a).run(a=0.5)


@rows("function", [lambda _, a: a * np.eye(4), lambda _, a: [a * row for row in np.eye(4)]])
@rows("engine", ENGINES)
def test_arrays_of_rows_are_for_one_path_since_four_paths_look_the_same(function, engine):
    plan, own = plan_of(function, engine), make(function, annotations={"a": op.fields.Real})
    np.testing.assert_allclose(plan.run(a=0.4).stokes, [0.4, 0.2, 0.08, 0.04])
    for act in (plan.run, plan.mueller, lambda a: own(a).mueller()):
        with pytest.raises(
            op.errors.PathError, match=r"an array of shape \(4.* for many paths; return f"
        ):
            act(a=[0.5, 0.4, 0.3, 0.25])


def test_rows_may_be_generators_and_arrays_where_other_elements_have_many_values():
    plan = plan_of(lambda _, a: ((a * (i == j) for j in range(4)) for i in range(4)))
    for value in (0.5, [0.5, 0.4, 0.3, 0.25]):
        expected = np.multiply.outer(value, [1.0, 0.5, 0.2, 0.1])
        np.testing.assert_allclose(plan.run(a=value).stokes, expected)
    own = make(lambda _, a: a * np.eye(4), annotations={"a": op.fields.Real})
    path = op.Source(8.0) >> own(op.Parameter("a")) >> op.Attenuator(op.Parameter("t"))
    light = (path >> op.Detector()).trace(a=0.5, t=[1.0, 0.5, 0.25, 0.125, 0.0])
    np.testing.assert_array_equal(light.S0, [4.0, 2.0, 1.0, 0.5, 0.0])


@rows("engine", ENGINES)
def test_imaginary_parts_are_dropped_that_are_0_in_the_precision_of_the_values(engine):
    def share(xp, a):
        z = xp.exp(1j * a)
        return 0.3 * z * z.conjugate() * np.complex128(1)

    plan = plan_of_share(share, engine, "float32", (1.0, 0.0, 0.0, 0.0))
    np.testing.assert_allclose(plan.run(a=np.linspace(0.0, 3.0, 50)).S0, 0.3, rtol=1e-6)


ANGLES = [0.01 * place for place in range(16)]


@rows(
    "function, share",
    [
        (lambda _, a: times(float(np.mean([a, 0.5]))), lambda a: (a + 0.5) / 2.0),
        (lambda _, a: times(0.9 if a > 0.05 else 0.4), lambda a: 0.9 if a > 0.05 else 0.4),
        (lambda xp, a: np.array(times(float(xp.cos(a)))), np.cos),
    ],
)
def test_rows_for_one_path_are_asked_one_by_one_in_a_long_path_too(function, share):
    own = make(function, annotations={"angle": op.fields.Angle})
    path = op.Source(1.0)
    for angle in ANGLES:
        path = path >> own(angle)
    expected = np.prod([share(angle) for angle in ANGLES])
    assert (path >> op.Detector()).trace().intensity == pytest.approx(expected, rel=1e-14)


def test_complex_rows_of_a_jones_matrix_serve_long_paths():
    class Rotating(op.Element):
        angle: op.fields.Angle = 0.0

        @staticmethod
        def jones_rows(xp, angle):
            return (xp.exp(1j * angle), 0), (0, xp.exp(-1j * angle))

    path = op.Source(1.0, stokes=(1.0, 0.0, 1.0, 0.0))
    for angle in ANGLES:
        path = path >> Rotating(angle)
    total = 2.0 * sum(ANGLES)
    light = (path >> op.Detector()).trace()
    expected = [0.0, np.cos(total), -np.sin(total)]
    np.testing.assert_allclose(light.stokes[1:], expected, rtol=0, atol=1e-14)


def test_elements_that_keep_more_than_their_fields_are_not_taken_for_each_other():
    class Shutter(op.Element):
        share: op.fields.Fraction = 0.5
        mode: InitVar[str] = "open"

        def __post_init__(self, mode):
            super().__post_init__()
            object.__setattr__(self, mode, 0.5)

        def couplings(self):
            share = self.share * (1.0 if hasattr(self, "open") else 0.1)
            return (Coupling("in", "out", (Operation(ATTENUATOR, (share,)),)),)

    path = op.Source(1.0) >> Shutter(0.5) >> Shutter(0.5, "shut") >> op.Detector()
    assert path.trace().intensity == pytest.approx(0.5 * 0.05, rel=1e-15)


def test_an_element_says_what_its_values_must_be_where_light_enters():
    class Window(op.Element):
        share: op.fields.Fraction = 0.5

        def uses_entered(self, owner, port):
            assert port == "in"
            return [Use(f"{owner}.share", self.share, Domain("number", minimum=0.0, maximum=0.4))]

        @staticmethod
        def mueller_rows(_, share):
            return times(share)

    assert (op.Source(1.0) >> Window(0.3) >> op.Detector()).trace().intensity == 0.3
    with pytest.raises(op.errors.PathError, match=r"share is 0.5; give .* 0 .. 0.4"):
        (op.Source(1.0) >> Window(0.5) >> op.Detector()).compose()


def test_what_one_step_comes_to_is_known_to_the_next():
    half = Kernel("half", SCALE, lambda _: lambda share: (0.5 * share,))

    class Twice(op.Element):
        share: op.fields.Fraction = 0.5

        def couplings(self):
            first = Operation(half, (self.share,))
            second = Operation(half, first.results(1))
            return (Coupling("in", "out", (first, second)),)

    path = op.Source(1.0) >> Twice(0.4) >> Twice(0.8) >> op.Detector()
    assert path.trace().intensity == pytest.approx(0.2 * 0.1 * 0.4 * 0.2, rel=1e-15)
    assert len(path.compose().program.steps) == 2
