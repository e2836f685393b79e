"""Columns of numbers by wavelength, read from files."""

import numpy as np
import pytest

from optipath.errors import ValueFault
from optipath.values.curves.csv_columns import read_columns

NK = ["n", "k"]


@pytest.fixture
def read(tmp_path):
    def read(text, names=NK, **options):
        file = tmp_path / "gold.csv"
        file.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_columns(file, names, **options)

    return read


@pytest.mark.parametrize(
    "text",
    [
        "wavelength (nm),n,k\n500,0.97,1.87\n521,0.62,2.08\n",
        "# Johnson and Christy\n\nwavelength_nm; n; k\n500; 0.97; 1.87\n# more\n521; 0.62; 2.08",
        "k\tn\twl [um]\tnote\n1.87\t0.97\t0.5\ta\n2.08\t0.62\t0.521\tb\n",
        "Wavelength (\u00b5m),N,K\r\n0.5,0.97,1.87\r\n0.521,0.62,2.08\r\n",
        "\ufeff\u03bb (nm), n (-), k ()\n500,0.97,1.87\n521,0.62,2.08\n",
    ],
)
def test_columns_are_found_by_their_names_and_units(read, text):
    found = read(text)
    assert found.title == "gold"
    assert found.wavelengths.tolist() == [5e-7, 5.21e-7]
    assert found.columns["n"].tolist() == [0.97, 0.62]
    assert found.columns["k"].tolist() == [1.87, 2.08]


@pytest.mark.parametrize(
    ("head", "cell"),
    [("energy (eV)", "2.4"), ("wavenumber (1/cm)", "19357.305"), ("frequency (THz)", "580.317")],
)
def test_a_photon_energy_a_wave_number_or_a_frequency_is_a_wavelength(read, head, cell):
    found = read(f"{head},n\n{cell},1.5\n", ["n"])
    assert found.wavelengths[0] == pytest.approx(516.6e-9, rel=1e-5)


@pytest.mark.parametrize(
    ("head", "cell"),
    [(f"wavelength {unit}", "4000.1") for unit in ("(A)", "[\u00c5]", "(Angstrom)", "(angstroms)")]
    + [("wl_Angstrom", "4000.1"), ("wavelength (nm)", "400.01")],
)
def test_an_angstrom_is_a_tenth_of_a_nanometre_to_the_bit(read, head, cell):
    assert read(f"{head},n\n{cell},1.5\n", ["n"]).wavelengths[0] == 400.01e-9


@pytest.mark.parametrize("head", ["E [eV]", "E (eV)", "energy (eV)", "photon energy (eV)"])
def test_a_photon_energy_has_several_names(read, head):
    found = read(f"{head},n\n2,1.5\n", ["n"])
    assert found.wavelengths[0] == pytest.approx(619.92e-9, rel=1e-5)


def test_an_e_without_a_unit_of_energies_is_no_axis(read):
    found = read("wavelength (nm),o,e,n_A\n500,1.5,1.6,1.7\n", ["e", "n_A"])
    assert {name: column[0] for name, column in found.columns.items()} == {"e": 1.6, "n_A": 1.7}
    assert read("E,n\n2,1\n", ["n"], unit="eV").wavelengths[0] > 6e-7


EXPORTED = "wl,n\n0.1879,1.28\n0.1916,1.32\n\nwl,k\n0.1879,1.188\n0.1916,1.203\n"


def test_blocks_one_below_the_other_are_read_as_one_table(read):
    found = read(EXPORTED, unit="um")
    assert found.wavelengths.tolist() == [187.9e-9, 191.6e-9]
    assert found.columns["n"].tolist() == [1.28, 1.32]
    assert found.columns["k"].tolist() == [1.188, 1.203]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (EXPORTED, "line 1: 'wl' has no unit; write 'wl (um)', or give unit='um'"),
        (
            EXPORTED.replace("0.1916,1.203", "0.2,1"),
            "line 7 has the wavelength 0.2, and line 3 0.1916; write one table, with a line for",
        ),
        (
            EXPORTED + "0.2,1\n",
            "the block of k that begins in line 5 has 3 wavelengths, and the first 2; write one",
        ),
    ],
)
def test_blocks_that_do_not_fit_are_told_with_their_lines(read, text, words):
    with pytest.raises(ValueFault) as fault:
        read(text, unit="" if text == EXPORTED else "um")
    assert f"gold.csv: {words}" in str(fault.value)


def test_numbers_below_0_are_told_with_their_lines_and_all_else(read):
    with pytest.raises(ValueFault) as fault:
        read("wl (nm),n,k\n400,-1,-0.1\n500,nan,1\n", not_negative={"n": "", "k": " (so)"})
    assert fault.value.faults == (
        "line 2: n is -1; give none below 0",
        "line 2: k is -0.1; give none below 0 (so)",
        "line 3: n is nan; write a number, or leave the line out",
    )


def test_a_unit_may_be_given_where_the_file_has_none(read):
    assert read("wavelength,n\n500,1\n", ["n"], unit="nm").wavelengths.tolist() == [5e-7]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "gold.csv: it is empty; write a line for each wavelength"),
        ("# nothing\n", "it is empty"),
        ("wavelength (nm),n,k\n", "line 1 is the only one"),
        (
            "wavelength (nm),n\n500,1\n",
            "line 1 names no column 'k'; there are: n; or ask for k=0.0",
        ),
        ("wavelength (nm),nn,k\n500,1,1\n", "line 1 names no column 'n'; there are: nn, k"),
        ("x,n,k\n500,1,1\n", "line 1 names no column of wavelengths, but x, n and k; begin with"),
        ("500,1,1\n510,1,1\n", "line 1 has numbers, and no names of columns; begin with a line"),
        ("wavelength,n,k\n516,1,1\n", "line 1: 'wavelength' has no unit; write 'wavelength (nm)'"),
        ("wavelength (mn),n,k\n516,1,1\n", "the unit 'mn' of 'wavelength' is unknown"),
        ("energy (nm),n,k\n516,1,1\n", "the unit 'nm' of 'energy' is unknown"),
        (
            "wavelength (m),n,k\n516,1,1\n",
            "line 2: the wavelength is 516 metres, which",
        ),
        ("wl (nm),energy (eV),n,k\n516,2.4,1,1\n", "has 'wl (nm)' and 'energy (eV)'; keep one"),
        ("wavelength (nm),n,n,k\n516,1,1,1\n", "line 1 has 2 columns 'n'; keep one"),
        ("wavelength (nm),n,k\n500,nan,1\n", "line 2: n is nan; write a number"),
        ("wavelength (nm),n,k\n500,,1\n", "line 2: n is empty; write one"),
        ("wavelength (nm);n;k\n500;1,5;1\n", "line 2: n is '1,5', which is no number"),
        ("wavelength (nm),n,k\n500,1\n", "line 2 has 2 values, and the first line 3 names"),
        ("wavelength (nm),n,k\n500,1,5,1\n", "line 2 has 4 values, and the first line 3 names"),
        ("wavelength (nm),n,k\n-5,1,1\n", "line 2: the wavelength is -5; give numbers above 0"),
        ("wavelength (nm),n,k\nred,1,1\n", "line 2: 'red nm' is not a quantity"),
        (
            "wavelength (nm),n,k\n500,1,1\n\n600,1,1\n550,1,1\n",
            "line 5: the wavelengths of the lines before rise, and from line 4 to this one they",
        ),
        (
            "wavelength (nm),n,k\n500,1,1\n600,1,1\n500,1,1\n",
            "line 4 has the wavelength of line 2; write each once",
        ),
        (b"wavelength (nm),n,k\n\xff\xfe,1,1\n", "it cannot be read: it is no text in UTF-8"),
    ],
)
def test_what_is_wrong_with_a_file_is_told_with_the_line(read, text, words):
    with pytest.raises(ValueFault) as fault:
        read(text, cures={"k": "ask for k=0.0"})
    assert words in str(fault.value)
    assert len(fault.value.faults) == 1


def test_all_faults_are_told_at_once(read):
    with pytest.raises(ValueFault) as fault:
        read("wavelength (nm),n,k\n500,nan,x\n600,1\n700,1,1\n0,1,1\n")
    assert [sentence[:6] for sentence in fault.value.faults] == ["line 2"] * 2 + [
        "line 3",
        "line 5",
    ]


@pytest.mark.parametrize("last", ["400,1,1", "500,1,1"])
def test_the_order_of_sound_lines_is_told_with_what_is_wrong_with_others(read, last):
    with pytest.raises(ValueFault) as fault:
        read(f"wavelength (nm),n,k\n500,1,1\n600,1,1\n700,nan,1\n{last}\n")
    assert [sentence[:6] for sentence in fault.value.faults] == ["line 4", "line 5"]


def test_a_thousand_faults_are_counted(read):
    with pytest.raises(ValueFault) as fault:
        read("wavelength (nm),n,k\n" + "1,nan,1\n" * 1000)
    assert len(fault.value.faults) == 13
    assert fault.value.faults[-1] == "and 988 more"


def test_a_file_that_is_not_there_is_told(tmp_path):
    with pytest.raises(ValueFault, match=r"silver\.csv: there is no such file; look at its name"):
        read_columns(tmp_path / "silver.csv", NK)
    with pytest.raises(ValueFault, match="it cannot be read"):
        read_columns(tmp_path, NK)


def test_falling_wavelengths_stay_as_they_are(read):
    found = read("energy (eV),n\n1,1\n2,2\n", ["n"])
    assert np.all(np.diff(found.wavelengths) < 0.0)
