"""What is given by a wrong name, as a word, as None or as a complex number, and what is told."""

import numpy as np
import pytest

import optipath as op
from paths import chain


def fault(action, *given, **values):
    with pytest.raises(op.OptipathError) as error:
        action(*given, **values)
    return str(error.value)


def npgr026(**values):
    return op.load_preset("npgr026", **values)


@pytest.mark.parametrize("option", ["method", "model", "engine", "dtype", "tolerance"])
def test_an_option_of_a_composer_is_told_where_it_belongs(option):
    for action in (npgr026().trace, npgr026().bind, npgr026):
        assert f"write Composer({option}=...).compose(path)" in fault(action, **{option: "x"})


def test_a_case_is_told_where_it_belongs():
    for told in (
        fault(npgr026().trace, case=7),
        fault(npgr026().bind, case=8),
        fault(npgr026, cas=8),
    ):
        assert told.endswith("is no parameter of the path; write load_preset(..., case=...)")
    assert "case must be a name or a number, not True" in fault(npgr026, case=True)


def test_the_other_part_of_a_complex_index_is_told_by_its_name():
    for action in (npgr026().trace, npgr026().bind, npgr026):
        for index in (1.2 + 2j, "1.2+2j"):
            assert fault(action, n1=index).endswith("give k by k1")
    # A Material that is bound gives both.
    assert fault(npgr026().trace, n1=op.Material(1.2, 2.0)).endswith("give k by k1")
    known = chain([op.Interface(op.Material(op.Parameter("n", 1.5, minimum=0.0), 0.5), 0.3)])
    assert "k is 0.5 where the path is built" in fault(known.bind, n=1.2 + 2j)


def test_none_is_no_value_but_a_word_may_leave_an_element_out():
    assert "filter='none' leaves its element out" in fault(npgr026, filter=None)
    assert fault(npgr026, delta=None) == ("parameter 'delta' is None, which is no value; give one")


def test_a_parameter_that_stands_as_an_axis_takes_the_names_of_axes():
    path = chain([op.Polarizer(op.Parameter("d"))], [1.0, 1.0, 0.0, 0.0])
    assert path.trace(d="horizontal").intensity == 1.0
    # Malus, at 0, 90 and 45 degrees.
    found = path.trace(d=["horizontal", "vertical", "45 deg"]).intensity
    np.testing.assert_allclose(found, [1.0, 0.0, 0.5], atol=1e-15)
    assert path.bind(d="diagonal").trace().intensity == pytest.approx(0.5)
    own = chain([op.Polarizer(op.Parameter("d", words={"vertical": 0.0}))], [1.0, 1.0, 0.0, 0.0])
    assert own.trace(d="vertical").intensity == 1.0
    for words in ("off", ["off", "none"]):
        told = fault(npgr026().trace, filter=words)
        assert told.endswith("none, antidiagonal, or give an angle such as '45 deg'")
    with pytest.raises(op.ValueFault, match=r"antidiagonal, or give an angle such as '45 deg'$"):
        op.Polarizer("pi/4")
    turned = chain([op.Rotator(op.Parameter("d"))])
    assert "knows no word 'vertical'" in fault(turned.trace, d="vertical")


def test_a_word_for_another_direction_is_never_offered():
    for word in ("antidiagonal", "antidiagonl"):
        told = fault(op.Parameter, "d", word, "deg", words={"diagonal": "45 deg"})
        assert told.endswith("; write '-45 deg' for the axis 'antidiagonal'")
    assert fault(op.Parameter, "d", "half", "deg").endswith("give an angle such as '45 deg'")
    two_faces = op.PathGraph()
    two_faces.add("X1", op.Interface(1.5, 0.3))
    two_faces.add("E", op.Detector())
    for port in ("refracted", "refraced"):
        told = fault(two_faces.connect, f"X1.{port}", "E")
        assert told.endswith("does not exist; there are: X1.reflected, X1.transmitted")


def test_a_path_is_a_collection_of_the_names_of_its_nodes():
    path = npgr026()
    assert "X1" in path
    assert "polarizer" not in path
    assert [*path] == ["L", "P", "X2", "X1", "E"]
    assert (len(path), len(op.PathGraph())) == (5, 0)


def test_a_place_that_a_node_cannot_be_moved_to_is_named():
    path = npgr026()
    path.add("camera", op.Detector())
    path.connect("P", "camera", tap=True)
    told = fault(path.bind, place="eye")
    assert told.startswith("'P' cannot be moved to place='eye': several links meet at 'P'")


def test_a_parameter_of_two_dimensions_is_told_with_both():
    d = op.Parameter("d")
    assert fault((op.Source(d) >> op.Polarizer(d) >> op.Detector()).check) == (
        "parameter 'd' is a real number of 0 or more at source.intensity, and a real angle at "
        "polarizer.angle; use two names"
    )


def test_a_negative_is_told_as_one_in_few_digits():
    path = chain([op.Interface(1.5, -op.Parameter("t"))])
    told = fault(path.trace, t=0.3)
    assert ".incidence, as -t) is -17.1887 deg; give" in told


def test_digits_that_tell_a_number_from_its_limit_are_kept():
    assert "is 1.0000000000002; give" in fault(op.Attenuator, 1.0000000000002)
    assert "is 1.12346; give" in fault(op.Attenuator, 1.12345678901234)


def test_a_range_that_begins_with_its_upper_end_is_told_in_its_unit():
    assert "the range 90 deg .. 0 deg;" in fault(
        op.Parameter, "p", minimum="90 deg", maximum="0 deg"
    )


def test_a_text_that_is_typed_is_no_step_of_a_fit():
    path = chain([op.Interface(1.5, op.Parameter("d"))])
    assert "bounds=" not in fault(path.trace, d="100 deg")
    assert "bounds=" in fault(path.trace, d=-0.1)


def test_a_path_without_a_source_is_told_to_add_one():
    path = op.PathGraph()
    path.add("eye", op.Detector())
    assert "add one, such as Source()" in fault(path.check)
