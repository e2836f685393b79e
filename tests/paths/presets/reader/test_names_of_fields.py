"""Fields of elements may be called like anything that the reader has names for."""

import pytest

import optipath as op


class OddlyNamed(op.Element, kind="oddly-named"):
    """A filter whose fields are called like what functions of the library take."""

    left: op.Fraction
    what: op.Fraction = 1.0
    function: op.Fraction = 1.0

    @staticmethod
    def mueller_rows(xp, left, what, function):
        t = left * what * function
        return (t, 0, 0, 0), (0, t, 0, 0), (0, 0, t, 0), (0, 0, 0, t)


@pytest.mark.parametrize(
    "element",
    [
        op.CircularDiattenuator(0.9, 0.1),
        op.CircularDiattenuator(0.9, op.Parameter("l", 0.1)),
        op.CircularDiattenuator([0.9, 0.8], [0.1, 0.2]),
        OddlyNamed(0.5, 0.25, 0.75),
    ],
)
def test_an_element_comes_out_of_a_file_as_it_went_in(element, tmp_path):
    path = op.Source() >> element >> op.Detector()
    file = tmp_path / "path.toml"
    file.write_text(path.to_toml(), encoding="utf-8")
    assert op.load_preset(file) == path
