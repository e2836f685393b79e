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
    with pytest.raises(op.errors.MaterialError) as caught:
        op.Material.from_yaml(file, **given)
    return str(caught.value)


def of_row(row):
    return TABLE.replace("0.6 1.4 0.4", row)


def of_data(kind, *data):
    lines = "".join(f"        {line}\n" for line in data)
    return f"DATA:\n  - type: {kind}\n" + (f"    data: |\n{lines}" if data else "")


def test_tables_and_formulas_are_one_material_where_all_are_known(written):
    there = op.Material.from_yaml(written(TABLE)).at("550 nm")
    assert np.allclose([there.n, there.k], [1.45, 0.3], rtol=1e-14)
    found = op.Material.from_yaml(written(FORMULA))
    assert found.span == (0.4e-6, 0.6e-6)
    there = found.at("587.6 nm")
    # Catalogues of glass have n = 1.5168 at the yellow line of helium.
    assert abs(there.n - 1.5168) < 1e-5
    assert abs(there.k - 0.002876) < 1e-12
    later = FORMULA + of_data("tabulated nk", "0.4 1.6 0", "0.6 1.8 0").removeprefix("DATA:\n")
    there = op.Material.from_yaml(written(later)).at("500 nm")
    assert np.allclose([there.n, there.k], [1.7, 0.0], atol=1e-14)
    label = op.Material.from_yaml(written(TABLE))
    lines = ["0.6 1.4 0.4", "0.4 1.6 0.1", *["0.5 1.5 0.2"] * 2]
    assert op.Material.from_yaml(written(of_data("tabulated nk", *lines))) == label
    file = written(TABLE)
    assert repr(op.Material.from_yaml(file)) == "Material 'mine.yml', 400 nm .. 600 nm"
    with pytest.raises(
        op.errors.ValueFault, match=r"within 400 nm .. 600 nm, for which mine.yml is"
    ):
        op.Material.from_yaml(file, wavelength="700 nm")
    text = of_data("tabulated n", "0.4 1.6", "0.6 1.5")
    assert "mine.yml has no k" in refusal(written(text))
    assert op.Material.from_yaml(written(text), k=0.0).at("500 nm") == op.Material(1.55)


TWICE = "mine.yml neither rise nor fall throughout, as at 400 nm"
REFUSED = [
    (of_row("0.4 1.7 0.1"), TWICE),
    (TABLE.replace("0.5 1.5 0.2", "0.4 1.5 0.2"), TWICE),
    (of_row("0 1.7 0.1"), "wavelengths of mine.yml is 0 nm at 0; give a wavelength above 0"),
    (of_row("-0.4 1.7 0.1"), "wavelengths of mine.yml is -400 nm at 0; give a wavelength above 0"),
    *((of_row(r), f"has '{r}' in row 3; give 3 numbers") for r in ("nan 1.7 0.1", "sNaN 1 1")),
    (of_row("0.6e999999999999 1 1"), "in row 3; give 3 numbers"),
    ("", "it has no list DATA of tables and formulas"),
    *((text, "it has no list DATA") for text in ("DATA: 3", "DATA: !!python/object/apply:os.x []")),
    (of_data("x"), "entry 1 of DATA: is of type 'x'; give 'tabulated nk'"),
    (of_data("tabulated n2", "0.4 1"), "is of type 'tabulated n2'"),
    (of_data("tabulated nk"), "('tabulated nk') has no 'data'; give rows of wave"),
    (of_data("tabulated nk", "0.4 1"), "has '0.4 1' in row 1; give 3 numbers"),
    (of_data("tabulated n", "0.4 x"), "has '0.4 x' in row 1; give 2 numbers"),
    ("DATA:\n - type: formula 10\n   coefficients: 1", "no numbers under 'wavelength_range'"),
    ("DATA:\n - type: formula 1\n   range: 1 a", "has no numbers under 'range', but '1 a'"),
    (FORMULA.replace("formula 2", "formula 12"), "formula 12 cannot have; there are the form"),
    (FORMULA.replace("0.3 2.5", "2.5 0.3"), "two rising numbers, in micrometres"),
    (FORMULA.replace("103.560653", ""), "6 coefficients, which formula 2 cannot have"),
    (FORMULA.replace("103.560653", "nan"), "has no numbers under 'coefficients'"),
    (FORMULA.replace("2.5\n", "1e999\n"), "has no numbers under 'wavelength_range'"),
    (TABLE.replace("nk", "k").replace(" 1.6 ", " "), "in row 2; give 2 numbers"),
    ("DATA: [", "is no YAML at line "),
    ("DATA: " + "{a: " * 100_000, "is no YAML: it is nested too deeply"),
]


@rows("text, told", REFUSED)
def test_a_faulty_file_is_refused_in_words(written, text, told):
    found = refusal(written(text))
    assert told in found
    assert "mine.yml" in found


def test_all_faults_of_a_file_are_told_at_once_and_numbers_where_they_are(written, tmp_path):
    # Each of 40 lists holds the one before twice.
    lists = ["a0: &a0 [x, x]", *[f"a{i}: &a{i} [*a{i - 1}, *a{i - 1}]" for i in range(1, 40)]]
    text = "\n".join([*lists, "REFERENCES: *a39", "DATA:", " - type: *a39", " - data: *a39"])
    assert "2 faults" in refusal(written(text))
    text = of_data("x") + of_data("tabulated nk", "0.4 1", "b 1 0").removeprefix("DATA:\n")
    with pytest.raises(op.errors.MaterialError) as caught:
        op.Material.from_yaml(written(text))
    assert len(caught.value.faults) == 3
    file = written(TABLE.replace("1.4 0.4", "1.4 -0.4"))
    assert op.Material.from_yaml(file, wavelength="450 nm").k > 0.0
    with pytest.raises(op.errors.ValueFault, match=r"k is -0\.4"):
        op.Material.from_yaml(file, wavelength="600 nm")
    path = op.Source(1) >> op.Interface(op.Material.from_yaml(file), 0.1) >> op.Detector()
    with pytest.raises(op.OptipathError, match=r"k of mine.yml at 600 nm is -0.4"):
        path.trace(wavelength="600 nm")
    assert "cannot be read: No such file" in refusal(tmp_path / "none.yml")
    file.write_bytes(b"\xff\xfe\xfa")
    assert "is no text in UTF-8" in refusal(file)
