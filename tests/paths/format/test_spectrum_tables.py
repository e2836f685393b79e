"""Spectra in preset files."""

from __future__ import annotations

import numpy as np
import pytest

import optipath as op
from optipath.paths.format.spectrum_tables import spectrum_of, spectrum_table


def loaded(text, folder):
    file = folder / "path.toml"
    file.write_text(text, "utf-8")
    return op.load_preset(file)


PLACES = op.wavelengths("380 nm", "700 nm", "40 nm")
SPECTRA = [
    op.Spectrum.sampled(PLACES, np.arange(9.0), outside=0.0, name="a lamp"),
    op.Spectrum.sampled(PLACES / 3.0, np.arange(9.0)),
    op.Spectrum.sampled(PLACES / 1e3, np.arange(9.0)),
    op.Spectrum.histogram(PLACES, np.arange(8.0)),
    op.Spectrum.line("633 nm", 2.0),
    op.Spectrum.line("633 nm", 2.0, outside=0.0) + op.Spectrum.line("532 nm"),
    op.Spectrum.led("530 nm", "30 nm", 3.0),
    0.5 * op.Spectrum.black_body(2856.0),
    op.Spectrum.illuminant("D65") / 100.0,
    op.Spectrum.constant(0.3),
    op.Spectrum.illuminant("A") + op.Spectrum.line("633 nm") + op.Spectrum.constant(1.0),
]


@pytest.mark.parametrize("spectrum", SPECTRA)
def test_what_is_written_is_read_as_the_same_spectrum(spectrum, tmp_path):
    assert spectrum_of(spectrum_table(spectrum)) == spectrum
    path = op.Source(spectrum=spectrum) >> op.Detector(response=op.Spectrum.led("5e-7 m", "1e-7 m"))
    again = loaded(path.to_toml(), tmp_path)
    assert again == path
    if spectrum.span[0] <= PLACES[0] and PLACES[-1] <= spectrum.span[1]:
        found = again.trace(wavelength=PLACES).stokes
        np.testing.assert_array_equal(found, path.trace(wavelength=PLACES).stokes)


def path_with(table, folder):
    return loaded(
        f'format = 1\n[elements.lamp]\nkind = "source"\nspectrum = {table}\n'
        '[elements.eye]\nkind = "detector"\n[[links]]\nfrom = "lamp.out"\nto = "eye.in"\n',
        folder,
    )


@pytest.mark.parametrize(
    ("table", "value"),
    [
        ('{ illuminant = "A" }', 100.0),
        ('{ wavelengths = [500, 600], unit = "nm", values = [1, 3] }', 2.2),
        ('{ edges = ["500 nm", "600 nm"], powers = [10.0] }', 0.1),
        ("{ constant = 2.5, scale = 2 }", 5.0),
        ('{ sum = [{ constant = 2 }, { led = "560 nm", width = "1 nm", power = 0 }] }', 2.0),
        ("2.5", 2.5),
    ],
)
def test_tables_stand_for_spectra(table, value, tmp_path):
    given = {} if table == "2.5" else {"wavelength": "560 nm"}
    assert path_with(table, tmp_path).trace(**given).intensity == pytest.approx(value, rel=1e-12)


def test_a_width_in_electronvolts_is_taken_at_the_peak_in_files_as_well():
    found = spectrum_of({"led": "2 eV", "width": "0.1 eV"})
    assert found == op.Spectrum.led("2 eV", "0.1 eV")
    assert spectrum_of(spectrum_table(found)) == found


@pytest.mark.parametrize(
    ("table", "sentence"),
    [
        ('{ iluminant = "A" }', "did you mean 'illuminant'"),
        ("{ colour = 3 }", "a table of a spectrum needs one of the keys 'wavelengths', 'edges'"),
        ('{ illuminant = "D50" }', "there are: A, D65, E"),
        ('{ line = "633 nm", led = "5 nm" }', r"write \{ sum"),
        ("{ line = 633 }", '"633 nm"'),
        ('{ line = "633 nm", pwer = 3 }', "did you mean 'power'"),
        ('{ led = "530 nm" }', "needs 'width'"),
        ("{ wavelengths = [500, 600], values = [1, 2] }", 'add unit = "nm"'),
        ('{ wavelengths = [500, 600], unit = "nm" }', "needs 'values'"),
        (
            '{ wavelengths = [400, 500], unit = "um", values = [1, 2] }',
            r"wavelengths: the wavelengths are 400 um .. 500 um, which are most likely nm",
        ),
        ('{ edges = [0.4, 0.5], unit = "nm", powers = [1] }', "which are most likely um"),
        (
            '{ edges = ["500 nm"], powers = [] }',
            "must be a list with a number for each wavelength or bin",
        ),
        ("{ sum = 3 }", "a list of tables"),
        ('"D65"', r"'D65' is no spectrum by itself; write \{ illuminant = \"D65\" \}"),
        ('"633 nm"', r"write \{ line = \"633 nm\" \}"),
        ('{ sum = ["A"] }', r"write \{ illuminant = \"A\" \}"),
        (
            '{ line = ["633 nm", "500 nm"], power = [1, 2] }',
            r'\{ sum = \[\{ line = "633 nm" \}, \.\.\.\] \}',
        ),
        ("{ black_body = [300, 400, 500, 600] }", r"\{ black_body = 300 \}, \.\.\.\] \}"),
        ("{ sum = [{ black_body = -3 }] }", "temperature of a black body"),
    ],
)
def test_faults_of_tables_are_told(table, sentence, tmp_path):
    with pytest.raises(op.OptipathError, match=sentence) as caught:
        path_with(table, tmp_path)
    assert "lamp.spectrum" in str(caught.value)
