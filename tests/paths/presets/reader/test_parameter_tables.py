"""A declared wavelength: its unit, its default and its range."""

import pytest

import optipath as op

TEXT = """
format = 1
[parameters.wavelength]
{declared}
[elements.lamp]
kind = "source"
[elements.metal]
kind = "interface"
index = {{ cauchy = {{ coefficients = [1.5, 0.01] }} }}
incidence = "30 deg"
[elements.eye]
kind = "detector"
[[links]]
from = "lamp.out"
to = "metal.in"
[[links]]
from = "metal.reflected"
to = "eye.in"
"""
# h c in eV nm, CODATA 2018.
HC = 1239.841984e-9


@pytest.fixture
def declared(tmp_path):
    def of(text):
        file = tmp_path / "path.toml"
        file.write_text(TEXT.format(declared=text), "utf-8")
        return op.load_preset(file).parameters["wavelength"]

    return of


@pytest.mark.parametrize(
    ("text", "metres"),
    [('default = "2.4 eV"', HC / 2.4), ('default = "516 nm"', 516e-9), ('help = "light"', None)],
)
def test_a_wavelength_needs_no_unit_of_its_own(declared, text, metres):
    found = declared(text)
    assert (type(found), found.unit) == (op.Wavelength, "nm")
    assert found.default == (metres and pytest.approx(metres, rel=1e-9))


@pytest.mark.parametrize("unit", ["", 'unit = "nm"'])
def test_a_range_of_photon_energies_is_one_of_wavelengths(declared, unit):
    found = declared(f'{unit}\nrange = ["2.0 eV", "3.0 eV"]')
    limits = [found.minimum, found.maximum]
    assert limits == pytest.approx([HC / 3.0, HC / 2.0], rel=1e-9)
    assert limits == [(one := op.Wavelength(minimum="2 eV", maximum="3 eV")).minimum, one.maximum]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("default = 516", "default: 516 has no unit, but a length is asked for; write '516 nm'"),
        ("range = [400, 700]", "range: 400 has no unit"),
        ('default = "30 deg"', "is in nm, but '30 deg' is an angle; let them agree"),
        ('default = "2.4 ev"', "did you mean 'eV'?"),
        ('unit = "eV"\ndefault = 2.4', "leave unit out, and write values as texts with it, such"),
        ('range = ["700 nm", "400 nm"]', "begin with the lower end"),
    ],
)
def test_what_is_no_wavelength_is_refused_with_its_cure(declared, text, sentence):
    with pytest.raises(op.OptipathError) as caught:
        declared(text)
    assert sentence in str(caught.value)
