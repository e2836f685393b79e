"""Classes and rows of elements of a user's own: the same numbers in every run, or a sentence."""

from typing import ClassVar

import numpy as np
import pytest

import optipath as op
from chains import ENGINES
from optipath.kernels.carriers.kernel import Kernel
from optipath.kernels.carriers.structures import SCALE
from optipath.kernels.numbers.primitives import FLOAT
from tables import rows


def halves(_):
    return [[0.5 * (row == column) for column in range(4)] for row in range(4)]


def make(kind="", annotations=(), **body):
    """A class of elements with such a body."""
    body = {"mueller_rows": staticmethod(halves), **body, "__annotations__": dict(annotations)}
    return type("Own", (op.Element,), body, kind=kind)


@rows("kind", [3, ["a"]])
def test_a_kind_that_is_no_text_is_refused(kind):
    with pytest.raises(op.PathError, match="kind of element class Own must be a text, not"):
        make(kind)


@rows(
    "function, cure",
    [
        ([[1, 0, 0, 0]] * 4, "make it a static method that returns the rows"),
        (np.eye(4), "make it a static method that returns the rows"),
        (classmethod(halves), "put @staticmethod .* of @classmethod"),
    ],
)
def test_rows_that_are_no_static_method_are_refused(function, cure):
    with pytest.raises(op.PathError, match=f"^mueller_rows of element class Own is .*{cure}"):
        make(mueller_rows=function)


@rows(
    "field, cure",
    [
        ("kind", r"write class Name\(op.Element, kind="),
        ("outputs", "write outputs: ClassVar"),
        ("uses", "every element has; give it another name"),
    ],
)
def test_fields_called_like_what_every_element_has_are_refused(field, cure):
    with pytest.raises(op.PathError, match=f"field '{field}' of element class Own.*{cure}"):
        make(annotations={field: op.Real})


@rows("annotation", [bool, "bool"])
def test_a_class_that_is_not_physical_says_so_for_all_its_elements(annotation):
    with pytest.raises(op.PathError, match=r"'physical'.*write physical: ClassVar\[bool\]"):
        make(annotations={"physical": annotation}, physical=False)
    assert make(annotations={"physical": ClassVar[bool]}, physical=False).domains() == {}


@rows("which, ports", [("inputs", "in"), ("outputs", 3), ("natural", property(lambda _: "out"))])
def test_ports_that_are_no_names_are_refused(which, ports):
    with pytest.raises(op.PathError, match=f"^{which} of element class Own must be the name"):
        make(**{which: ports})


LENGTHS = {"thickness": op.Length, "absorption": op.Absorption}


def test_values_in_another_order_than_that_of_the_fields_are_refused():
    with pytest.raises(op.PathError, match=r"takes absorption and thickness, but .* the order of"):
        make(
            annotations=LENGTHS,
            mueller_rows=staticmethod(
                lambda _, absorption, thickness: halves(absorption * thickness)
            ),
        )


@rows(
    "function",
    [
        lambda _, thickness, absorption: halves(absorption * thickness),
        lambda _, a, b: halves(a * b),
        lambda *values: halves(values),
    ],
)
def test_values_in_the_order_of_the_fields_may_have_any_names(function):
    own = make(annotations=LENGTHS, mueller_rows=staticmethod(function))
    assert own(0.1, 0.2).mueller().matrix[0, 0] == 0.5


def test_fields_may_be_true_or_false_and_angles_have_the_name_of_an_axis():
    own = make(
        annotations={"on": bool},
        mueller_rows=staticmethod(lambda _, on: [[on * x for x in row] for row in halves(_)]),
    )
    assert [own(on).mueller().matrix[0, 0] for on in (True, False)] == [0.5, 0.0]
    with pytest.raises(op.ValueFault, match="give True or False"):
        own(0.5)
    own = make(
        annotations={"angle": op.Axis},
        mueller_rows=staticmethod(
            lambda xp, angle: [[xp.sin(angle) * x for x in row] for row in halves(xp)]
        ),
    )
    assert own("vertical").mueller().matrix[0, 0] == 0.5


def times_one(share):
    """The rows of a grey filter."""
    return [[share * (row == column) for column in range(4)] for row in range(4)]


def element(function, quantity=op.Real):
    """An element that lets through the share that a function gives."""

    class Filter(op.Element):
        a: quantity = 1.0

        @staticmethod
        def mueller_rows(xp, a):
            return times_one(function(xp, a))

    return Filter


def plan_of(element_class, engine="auto", dtype="float64", state=(1.0, 0.5, 0.2, 0.1)):
    path = op.Source(stokes=state) >> element_class(op.Parameter("a")) >> op.Detector()
    return op.Composer(engine=engine, dtype=dtype).compose(path)


LOOK_UPS = [
    lambda _, a: {0.4: 0.5}.get(a, 0.2),
    lambda _, a: 0.5 if a in {0.4} else 0.2,
    lambda _, a: {"0.4": 0.5}.get(f"{a}", 0.2),
]


@rows("look_up", LOOK_UPS)
def test_a_value_that_is_looked_up_is_found_in_every_run(look_up):
    plan = plan_of(element(look_up))
    assert [plan.run(a=0.4).S0 for _ in range(6)] == [0.5] * 6


@rows("engine", ENGINES)
def test_looking_up_many_values_is_told_with_the_cure(engine):
    plan = plan_of(element(LOOK_UPS[0]), engine)
    with pytest.raises(op.PathError, match=r"unhashable.*; choose by xp\.where\(.* a look-up"):
        plan.run(a=np.linspace(0.1, 1.0, 3))


def test_numbers_that_are_scaled_and_scaled_back_are_the_same_in_every_run():
    def root(xp, a):
        power = xp.scaling(a)
        return 0.1 * xp.ldexp(xp.ldexp(a, -power), power)

    plan = plan_of(element(root))
    for _ in range(6):
        assert plan.run(a=1.3).S0 == 0.13
    np.testing.assert_array_equal(plan.run(a=[0.5, 1.3, 6.0]).S0, [0.05, 0.13, 0.1 * 6.0])


NEGATIONS = [
    lambda xp, a: 0.2 + 0.3 * ~(xp.maximum(a, 0.0) > 1.0),
    lambda xp, a: xp.where(~((a > 0.5) & ~(a < 1.0)), 0.5, 0.2),
]


@rows("engine", ENGINES)
@rows("share", NEGATIONS)
def test_what_is_not_so_is_the_same_in_every_run_and_for_many(share, engine):
    plan = plan_of(element(share), engine)
    values = [1.3, 1.3, 1.3, 0.3, 1.3, 0.3]
    expected = [0.2, 0.2, 0.2, 0.5, 0.2, 0.5]
    assert [plan.run(a=value).S0 for value in values] == expected
    np.testing.assert_array_equal(plan.run(a=values).S0, expected)


def test_kernels_of_ones_own_are_told_where_numbers_lack_what_they_ask():
    kernel = Kernel("edge", SCALE, lambda xp: lambda a: (xp.where(~(a > 1.0), 0.5, 0.2),))
    assert [kernel.made_for(FLOAT)(a) for a in (0.3, 1.3)] == [(0.5,), (0.2,)]
    with pytest.raises(op.PathError, match=r"'conj'; write z\.conjugate\(\)"):
        plan_of(element(lambda _, a: a * (0.3 + 0.1j).conj().real)).run(a=0.3)
    with pytest.raises(op.PathError, match=r"the complex entry \[0\]\[0\] = \(0\.3\+5e-08j\)"):
        plan_of(element(lambda _, a: 0.3 + 1e-7j * a)).run(a=0.5)


@rows("rows", [lambda a: a * np.eye(4), lambda a: [a * row for row in np.eye(4)]])
@rows("engine", ENGINES)
def test_arrays_of_rows_are_for_one_path_since_four_paths_look_the_same(rows, engine):
    class Filter(op.Element):
        a: op.Real = 1.0

        @staticmethod
        def mueller_rows(xp, a):
            return rows(a)

    plan = plan_of(Filter, engine)
    np.testing.assert_allclose(plan.run(a=0.4).stokes, [0.4, 0.2, 0.08, 0.04])
    for act in (plan.run, plan.mueller, lambda a: Filter(a).mueller()):
        with pytest.raises(op.PathError, match=r"an array of shape \(4.* for many paths; return f"):
            act(a=[0.5, 0.4, 0.3, 0.25])


@rows("value", [0.5, [0.5, 0.4, 0.3, 0.25]])
def test_rows_may_be_generators_one_within_the_other(value):
    class Filter(op.Element):
        a: op.Real = 1.0

        @staticmethod
        def mueller_rows(xp, a):
            return ((a * (row == column) for column in range(4)) for row in range(4))

    light = plan_of(Filter).run(a=value)
    np.testing.assert_allclose(light.stokes, np.multiply.outer(value, [1.0, 0.5, 0.2, 0.1]))


def test_an_array_of_rows_will_do_where_other_elements_have_many_values():
    class Filter(op.Element):
        a: op.Real = 1.0

        @staticmethod
        def mueller_rows(xp, a):
            return a * np.eye(4)

    path = op.Source(8.0) >> Filter(op.Parameter("a")) >> op.Attenuator(op.Parameter("t"))
    light = (path >> op.Detector()).trace(a=0.5, t=[1.0, 0.5, 0.25, 0.125, 0.0])
    np.testing.assert_array_equal(light.S0, [4.0, 2.0, 1.0, 0.5, 0.0])


@rows("engine", ENGINES)
def test_imaginary_parts_are_dropped_that_are_0_in_the_precision_of_the_values(engine):
    def share(xp, a):
        z = xp.exp(1j * a)
        return 0.3 * z * z.conjugate() * np.complex128(1)

    plan = plan_of(element(share), engine, "float32", (1.0, 0.0, 0.0, 0.0))
    np.testing.assert_allclose(plan.run(a=np.linspace(0.0, 3.0, 50)).S0, 0.3, rtol=1e-6)
