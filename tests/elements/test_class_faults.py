"""Classes of elements that cannot be are refused when they are made, with the cure."""

from typing import ClassVar

import numpy as np
import pytest

import optipath as op
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


def test_a_field_of_true_and_false_is_one_or_zero():
    own = make(
        annotations={"on": bool},
        mueller_rows=staticmethod(lambda _, on: [[on * x for x in row] for row in halves(_)]),
    )
    assert [own(on).mueller().matrix[0, 0] for on in (True, False)] == [0.5, 0.0]
    with pytest.raises(op.ValueFault, match="give True or False"):
        own(0.5)


def test_an_angle_of_ones_own_may_have_the_name_of_an_axis():
    own = make(
        annotations={"angle": op.Axis},
        mueller_rows=staticmethod(
            lambda xp, angle: [[xp.sin(angle) * x for x in row] for row in halves(xp)]
        ),
    )
    assert own("vertical").mueller().matrix[0, 0] == 0.5
