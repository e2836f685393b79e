"""One text for several values: ranges, lists, and columns of files."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.values.counted_ranges import texts_of_range
from optipath.values.several_texts import several_texts
from optipath.values.units import parse_quantity
from tables import rows

DELTA = op.Parameter("delta", unit="deg")
NUMBER = op.Parameter("n")


def test_a_range_in_degrees_has_the_very_angles_that_are_given_one_by_one():
    texts = several_texts(DELTA, "0:90:91")
    found = [parse_quantity(text, "angle", "deg") for text in texts]
    assert found == [parse_quantity(f"{whole} deg", "angle") for whole in range(91)]


def test_a_range_in_hundredths_has_the_decimals_that_one_writes():
    found = [float(text) for text in several_texts(NUMBER, "0:1:101")]
    assert found == [float(f"{part // 100}.{part % 100:02}") for part in range(101)]


def test_a_range_of_nanometres_has_the_very_wavelengths_that_are_given_one_by_one():
    texts = several_texts(op.Wavelength(), "400 nm:700 nm:61")
    found = [parse_quantity(text, "length") for text in texts]
    assert found == [parse_quantity(f"{400 + 5 * step} nm", "length") for step in range(61)]


def test_a_range_may_fall_and_its_ends_are_as_they_are_written():
    assert several_texts(DELTA, "90.0 deg:-1e1 deg:3") == ["90.0 deg", "40.0 deg", "-1e1 deg"]


def test_a_range_of_one_value_begins_where_it_ends():
    assert several_texts(DELTA, "5 deg:5 deg:1") == ["5 deg"]


@given(st.integers(-(10**9), 10**9), st.integers(0, 10**6), st.integers(2, 200))
def test_whole_steps_are_whole_numbers(start, step, count):
    texts = texts_of_range(f"{start}:{start + step * (count - 1)}:{count}")
    assert [float(text) for text in texts] == [start + step * at for at in range(count)]


@given(st.floats(allow_nan=False, allow_infinity=False), st.floats(-1e9, 1e9), st.integers(2, 50))
def test_a_range_never_turns_and_stays_between_its_ends(start, stop, count):
    values = [float(text) for text in texts_of_range(f"{start!r}:{stop!r}:{count}")]
    assert len(values) == count
    assert (values[0], values[-1]) == (start, stop)
    assert values == sorted(values, reverse=start > stop)


def test_a_list_has_its_texts_one_by_one():
    assert several_texts(DELTA, "10 deg,0.5 rad, horizontal") == ["10 deg", "0.5 rad", "horizontal"]
    assert several_texts(DELTA, "10,20,30") == ["10", "20", "30"]


@rows("text", ["30 deg", "horizontal", "0.5", "-1e-3 rad", "30 degs"])
def test_a_single_value_is_no_list(text):
    assert several_texts(DELTA, text) is None


@rows("text", ["1000:1", "1:50", "inf"])
def test_a_ratio_to_one_is_a_single_number(text):
    assert several_texts(NUMBER, text) is None


def test_a_ratio_that_may_be_a_range_without_a_count_is_asked_about():
    with pytest.raises(op.ParameterError, match=r"may be the ratio 0\.75, or a range") as caught:
        several_texts(NUMBER, "1.2:1.6")
    assert "write '0.75', or '1.2:1.6:11' for eleven" in str(caught.value)
    assert len(several_texts(NUMBER, "1.2:1.6:11")) == 11


@rows(
    "text, told, cure",
    [
        ("0 deg:90 deg", "does not say how many values", "0 deg:90 deg:11"),
        ("0:90:0.5", "for steps of 0.5", "0:90:181"),
        ("90:0:-1", "for steps of 1", "90:0:91"),
        ("0:90:1", "counts one value from 0 to 90", "0:90:2"),
        ("400:700:61 nm", "'61 nm' of '400:700:61 nm' is no count", "400 nm:700 nm:61"),
        ("0:90 deg:91", "a unit at one end alone", "0 deg:90 deg:91"),
        ("0,5:1:11", "a number with a comma", "0.5:1:11"),
        ("10,20 deg", "may be a number with a comma, or two", "10 deg, 20 deg"),
        ("10,20", "may be a number with a comma, or two", "10, 20"),
    ],
)
def test_what_is_wrong_is_told_with_a_cure_that_works(text, told, cure):
    with pytest.raises(op.ParameterError, match=r"^parameter 'delta': ") as caught:
        several_texts(DELTA, text)
    assert told in str(caught.value)
    assert f"'{cure}'" in str(caught.value)
    assert len(several_texts(DELTA, cure)) > 1


@rows(
    "text, told",
    [
        ("0:90:0", "counts no values"),
        ("0:90:nan", "is no count, which is a whole number"),
        ("0::3", "is no range; write start:stop:count"),
        ("1:2:3:4", "is no range; write start:stop:count"),
        ("a:b:3", "'a' of 'a:b:3' is no number with a unit"),
        ("0 deg:1 rad:3", "are in deg and in rad"),
        ("0:1:1000000000", "a text stands for 1000000 at most"),
        ("1e-999999999:1:3", "beyond the numbers that floats are"),
        ("0:90:91,120", "'0:90:91' is in a list, and a range stands alone"),
        ("10,,20", "has nothing between two commas"),
        ("1,000,000", "may be thousands"),
    ],
)
def test_what_is_wrong_is_told(text, told):
    with pytest.raises(op.ParameterError, match=r"^parameter 'delta': ") as caught:
        several_texts(DELTA, text)
    assert told in str(caught.value)


def test_a_file_that_is_not_there_is_told_with_its_name():
    with pytest.raises(op.ParameterError, match=r"^nowhere\.csv: there is no such file"):
        several_texts(DELTA, "@nowhere.csv")


def written(folder, text):
    file = folder / "angles.csv"
    file.write_text(text, "utf-8")
    return f"@{file}"


def test_a_file_gives_the_column_of_the_parameter_with_its_unit(tmp_path):
    text = "rho [rad]; delta (deg)\n# measured\n0.1; 10\n0.2; 20.5\n"
    assert several_texts(DELTA, written(tmp_path, text)) == ["10 deg", "20.5 deg"]


def test_a_file_of_one_column_may_call_it_otherwise(tmp_path):
    assert several_texts(DELTA, written(tmp_path, "angle_mrad\n10\n")) == ["10 mrad"]


def test_cells_of_a_file_may_have_units_and_words(tmp_path):
    polarizer = op.Parameter("filter", unit="deg", words={"horizontal": 0.0}, optional=True)
    text = written(tmp_path, "filter\nnone\nhorizontal\n30 deg\n")
    assert several_texts(polarizer, text) == ["none", "horizontal", "30 deg"]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "it is empty"),
        ("10\n20\n", "line 1 has numbers or nothing for names of columns"),
        ("delta\n", "line 1 is the only one"),
        ("rho,phi\n1,2\n", "of the columns rho and phi, none is called 'delta'"),
        ("detla,phi\n1,2\n", "; did you mean 'detla'?"),
        ("delta,delta\n1,2\n", "line 1 names 'delta' twice"),
        ("delta\n1,2\n", "line 2 has 2 values, and line 1 has 1 names"),
        ("delta,rho\n1,\n", "line 2 has an empty cell"),
        ("delta (deg)\n1 rad\n", "line 2: '1 rad' is not in deg"),
    ],
)
def test_what_is_wrong_in_a_file_is_told_with_its_name(tmp_path, text, told):
    with pytest.raises(op.OptipathError, match=r"angles\.csv: ") as caught:
        several_texts(DELTA, written(tmp_path, text))
    assert told in str(caught.value)


def test_the_first_of_several_words_is_not_taken_for_a_name(tmp_path):
    polarizer = op.Parameter("filter", words={"horizontal": 0.0, "vertical": 1.5})
    with pytest.raises(op.ParameterError, match="begin with the line 'filter'"):
        several_texts(polarizer, written(tmp_path, "horizontal\nvertical\n"))
