import numpy as np
import pytest

import optipath as op
from tables import rows

pytest.importorskip("yaml")

TABLE = """
REFERENCES: "A. Author, <i>J. Opt.</i> <b>1</b>, 2 (1990)"
DATA:
  - type: tabulated nk
    data: |
        0.4 1.6 0.1
        0.5 1.5 0.2
        0.6 1.4 0.4
"""

FORMULA = """
DATA:
  - type: formula 2
    wavelength_range: 0.3 2.5
    coefficients: 0 1.03961212 0.00600069867 0.231792344 0.0200179144 1.01046945 103.560653
  - type: tabulated k
    data: |
        0.4 0.001
        0.6 0.003
"""


@pytest.fixture
def written(tmp_path):
    def write(text):
        file = tmp_path / "mine.yml"
        file.write_text(text, "utf-8")
        return file

    return write


def refusal(file, **given):
    with pytest.raises(op.MaterialError) as caught:
        op.Material.from_yaml(file, **given)
    return str(caught.value)


def test_tables_and_formulas_are_one_material_where_all_are_known(written):
    there = op.Material.from_yaml(written(TABLE)).at("550 nm")
    assert np.allclose([there.n, there.k], [1.45, 0.3], rtol=1e-14)
    found = op.Material.from_yaml(written(FORMULA))
    assert found.span == (0.4e-6, 0.6e-6)
    there = found.at("587.6 nm")
    # Catalogues of glass have n = 1.5168 at the yellow line of helium.
    assert abs(there.n - 1.5168) < 1e-5
    assert abs(there.k - 0.002876) < 1e-12
    later = FORMULA + "  - type: tabulated nk\n    data: |\n        0.4 1.6 0\n        0.6 1.8 0\n"
    there = op.Material.from_yaml(written(later)).at("500 nm")
    assert np.allclose([there.n, there.k], [1.7, 0.0], atol=1e-14)
    rows = "DATA:\n  - type: tabulated nk\n    data: |\n        0.6 1.4 0.4\n"
    rows += "        0.4 1.6 0.1\n        0.5 1.5 0.2\n        0.5 1.5 0.2\n"
    label = op.Material.from_yaml(written(TABLE))
    assert op.Material.from_yaml(written(rows)) == label
    file = written(TABLE)
    assert repr(op.Material.from_yaml(file)) == "Material 'mine.yml', 400 nm .. 600 nm"
    with pytest.raises(op.ValueFault, match=r"within 400 nm .. 600 nm, for which mine.yml is"):
        op.Material.from_yaml(file, wavelength="700 nm")
    text = "DATA:\n  - type: tabulated n\n    data: |\n        0.4 1.6\n        0.6 1.5\n"
    assert "mine.yml has no k" in refusal(written(text))
    assert op.Material.from_yaml(written(text), k=0.0).at("500 nm") == op.Material(1.55)


def of_row(row):
    return TABLE.replace("0.6 1.4 0.4", row)


def of_data(entry):
    return f"DATA:\n - type: {entry}"


REFUSED = [
    (
        of_row("0.4 1.7 0.1"),
        "mine.yml has the wavelength 400 nm twice, in the rows 1 and 3; give each",
    ),
    (of_row("0 1.7 0.1"), "row 3 of mine.yml has the wavelength 0; give lengths above 0"),
    (of_row("-0.4 1.7 0.1"), "row 3 of mine.yml has the wavelength -0.4; give lengths above 0"),
    (of_row("nan 1.7 0.1"), "has no numbers in row 3, 'nan 1.7 0.1'"),
    (of_row("0.6 1_7 0.1"), "has no numbers in row 3, '0.6 1_7 0.1'"),
    ("", "it has no list DATA of tables and formulas"),
    ("DATA: 3", "it has no list DATA"),
    (of_data("x"), "entry 1 of DATA is of type 'x'; give 'tabulated nk'"),
    (of_data("tabulated n2\n   data: 0.4 1"), "is of type 'tabulated n2'"),
    (of_data("tabulated nk"), "('tabulated nk') has no 'data'; give rows of wave"),
    (of_data("tabulated nk\n   data: |\n     0.4 1"), "has 2 numbers in row 1, '0.4 1'"),
    (of_data("tabulated n\n   data: |\n     0.4 x"), "has no numbers in row 1, '0.4 x'"),
    (of_data("formula 10\n   coefficients: 1"), "no numbers under 'wavelength_range'"),
    (of_data("formula 1\n   range: 1 a"), "has no numbers under 'range', but '1 a'"),
    (FORMULA.replace("formula 2", "formula 12"), "by formula 12; there are the formulas 1, 2"),
    (FORMULA.replace("0.3 2.5", "2.5 0.3"), "two rising numbers, in micrometres"),
    (FORMULA.replace("103.560653", ""), "6 coefficients, which formula 2 cannot have"),
    (FORMULA.replace("103.560653", "nan"), "has no numbers under 'coefficients'"),
    (TABLE.replace("0.5 1.5 0.2", "0.4 1.5 0.2"), "mine.yml has the wavelength 400 nm twice"),
    (TABLE.replace("0.5 1.5 0.2", "0.5 nan 0.2"), "no numbers in row 2, '0.5 nan 0.2'"),
    (TABLE.replace("nk", "k").replace(" 1.6 ", " "), "has 3 numbers in row 2"),
    (TABLE.replace("0.5 1.5", "0.5e999999999999 1.5"), "has no numbers in row 2"),
    (TABLE.replace("0.5 1.5", "0.5 sNaN"), "has no numbers in row 2"),
    (FORMULA.replace("2.5\n", "1e999\n"), "has no numbers under 'wavelength_range'"),
    ("DATA: [", "is no YAML at line "),
    ("DATA: " + "[" * 100_000, "is no YAML: it is nested too deeply"),
    ("DATA: " + "{a: " * 100_000, "is no YAML: it is nested too deeply"),
    ("DATA: !!python/object/apply:os.getcwd []", "it has no list DATA"),
]


@rows("text, told", REFUSED)
def test_a_faulty_file_is_refused_in_words(written, text, told):
    found = refusal(written(text))
    assert told in found
    assert "mine.yml" in found


def test_all_faults_of_a_file_are_told_at_once(written):
    told = refusal(written(TABLE + "        0.5 1 1\n        0 1 1\n        0.4 2 2\n"))
    assert told.startswith("3 faults:")
    assert "500 nm twice, in the rows 2 and 4" in told
    # Each of 40 lists holds the one before twice.
    lists = ["a0: &a0 [x, x]", *[f"a{i}: &a{i} [*a{i - 1}, *a{i - 1}]" for i in range(1, 40)]]
    text = "\n".join([*lists, "REFERENCES: *a39", "DATA:", " - type: *a39", " - data: *a39"])
    assert "2 faults" in refusal(written(text))
    text = "DATA:\n - type: x\n - type: tabulated nk\n   data: |\n     0.4 1\n     b 1 0\n"
    with pytest.raises(op.MaterialError) as caught:
        op.Material.from_yaml(written(text))
    assert len(caught.value.faults) == 3


def test_numbers_that_nothing_has_are_refused_where_they_are(written):
    file = written(TABLE.replace("1.4 0.4", "1.4 -0.4"))
    assert op.Material.from_yaml(file, wavelength="450 nm").k > 0.0
    with pytest.raises(op.ValueFault, match=r"k is -0\.4"):
        op.Material.from_yaml(file, wavelength="600 nm")
    path = op.Source(1) >> op.Interface(op.Material.from_yaml(file), 0.1) >> op.Detector()
    with pytest.raises(op.OptipathError, match=r"k of mine.yml at 600 nm is -0.4"):
        path.trace(wavelength="600 nm")


def test_a_file_that_is_not_there_or_no_text_is_told(tmp_path):
    assert "cannot be read: No such file" in refusal(tmp_path / "none.yml")
    file = tmp_path / "mine.yml"
    file.write_bytes(b"\xff\xfe\xfa")
    assert "is no text in UTF-8" in refusal(file)
