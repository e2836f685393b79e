"""Curves through samples, and columns of numbers by wavelength that are read from files."""

import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optipath.errors import ValueFault
from optipath.materials.material import Material
from optipath.materials.tables import Tabulated
from optipath.values.columns import read_columns
from tables import rows

PLACES = np.array([188e-9, 300e-9, 310e-9, 500e-9, 1.2e-6])
N = np.array([1.3, 1.8, 1.7, 0.9, 0.2])
K = np.array([1.1, 1.9, 1.9, 2.2, 8.0])
FINE = np.linspace(PLACES[0], PLACES[-1], 1001)


def table(interpolation="linear", extrapolate="", n=N, k=K):
    names = {"interpolation": interpolation, "extrapolate": extrapolate}
    return Tabulated("gold", ("n", "k"), PLACES, [n, k], **names)


def rising(count):
    steps = st.lists(st.floats(1e-10, 1e-6), min_size=count, max_size=count)
    return steps.map(lambda each: 1e-7 + np.cumsum(each))


@rows("interpolation", ["linear", "monotone"])
def test_samples_are_exact_and_a_wavelength_comes_to_the_same_bits_alone(interpolation):
    curve = table(interpolation)
    assert np.array_equal(curve.evaluated(PLACES), [N, K])
    alone = [curve.evaluated(wavelength)[1] for wavelength in FINE[::3]]
    assert np.array_equal(curve.evaluated(FINE[::3])[1], alone)
    # Between samples it is a straight line.
    expected = [np.interp(FINE, PLACES, column) for column in (N, K)]
    np.testing.assert_allclose(table().evaluated(FINE), expected, rtol=3e-15)
    assert np.all(table(n=np.full(5, 1.1)).evaluated(FINE)[0] == 1.1)


@pytest.mark.parametrize("extrapolate", ["", "nearest", "linear"])
def test_monotone_curves_are_those_of_scipy(extrapolate):
    oracle = pytest.importorskip("scipy.interpolate").PchipInterpolator
    found = table("monotone", extrapolate).evaluated(FINE)
    np.testing.assert_allclose(found, oracle(PLACES, [N, K], axis=1)(FINE), rtol=1e-13)


@given(rising(7), st.lists(st.floats(-5.0, 5.0), min_size=7, max_size=7))
def test_monotone_curves_stay_between_their_samples(places, values):
    curve = Tabulated("x", ("value",), places, [values], interpolation="monotone")
    for at in range(6):
        between = np.linspace(places[at], places[at + 1], 31)
        (found,) = curve.evaluated(between)
        low, high = sorted(values[at : at + 2])
        assert np.all((found >= low - 1e-13) & (found <= high + 1e-13))


@rows("interpolation", ["linear", "monotone"])
def test_slopes_by_jax_are_those_of_differences(jax, interpolation):
    curve = table(interpolation)
    slope = jax.grad(lambda w: curve.numbers(jax.numpy, w)[1])
    for wavelength in (2e-7, 2.9e-7, 3.02e-7, 3.05e-7, 4.9e-7, 1.1e-6):
        step = 1e-13
        ahead, back = [curve.evaluated(wavelength + s)[1] for s in (step, -step)]
        expected = (ahead - back) / (2.0 * step)
        assert float(slope(wavelength)) == pytest.approx(float(expected), rel=1e-5, abs=10.0)


def test_beyond_its_samples_it_is_the_nearest_one_or_the_line_goes_on():
    beyond = np.array([100e-9, 2e-6])
    assert np.array_equal(table(extrapolate="nearest").evaluated(beyond)[0], N[[0, -1]])
    n, _ = table(extrapolate="linear").evaluated(beyond)
    ends = [1.3 - 88.0 * 0.5 / 112.0, 0.2 - 800.0 * 0.7 / 700.0]
    np.testing.assert_allclose(n, ends, rtol=1e-13)
    assert table().span == (188e-9, 1.2e-6)
    assert table(extrapolate="linear").span == (0.0, np.inf)
    curve = Tabulated("line", ("n",), [633e-9], [[1.5]], extrapolate="nearest")
    assert curve.evaluated([500e-9, 633e-9, 700e-9])[0].tolist() == [1.5] * 3
    oracle = pytest.importorskip("scipy.interpolate").PchipInterpolator(PLACES, K)
    _, k = table("monotone", "linear").evaluated(2e-6)
    assert float(k) == pytest.approx(8.0 + 0.8e-6 * oracle(1.2e-6, 1), rel=1e-12)
    # Equal samples are equal curves, whether they rise or fall.
    assert Tabulated("gold", ("n", "k"), PLACES[::-1], [N[::-1], K[::-1]]) == table()
    energies = Tabulated("x", ("n",), ["2 eV", "3 eV"], [[1.0, 2.0]])
    assert energies.evaluated(energies.wavelengths)[0].tolist() == [2.0, 1.0]
    assert (table(), hash(table())) == (table(), hash(table()))
    assert table().digest != table("monotone").digest
    assert pickle.loads(pickle.dumps(table())) == table()


@rows(
    "wavelengths, n, words",
    [
        ([500, 600], [1, 2], "500 metres, which is no wavelength of light"),
        ([5e-7, 5e-7], [1, 2], "throughout, as at 500 nm"),
        ([5e-7, 7e-7, 6e-7], [1, 2, 3], "neither rise nor fall throughout"),
        ([5e-7, np.nan], [1, 2], "wavelengths of gold is nan at 1"),
        ([5e-7, 6e-7], [1, np.nan], "n of gold is nan at 1"),
        ([5e-7, 6e-7], [1, 2, 3], "has 2 wavelengths and 3 of n"),
        ([-1.0, 6e-7], [1, 2], "give a wavelength above 0"),
        (["5 kg", 6e-7], [1, 2], "unit 'kg' of '5 kg' is unknown"),
        ([], [], "row of real numbers, not of shape (0,)"),
        ([5e-7], ["red"], "n of gold: 'red'"),
        ([5e-7, 6e-7], [1, 2j], "n of gold is complex; give a real number"),
    ],
)
def test_samples_that_are_wrong_are_refused_in_words_all_at_once(wavelengths, n, words):
    with pytest.raises(ValueFault) as fault:
        Tabulated("gold", ("n",), wavelengths, [n])
    assert words in str(fault.value)
    with pytest.raises(ValueFault) as fault:
        Tabulated("gold", ("n",), [np.nan], [[np.inf]], interpolation="cubic", extrapolate="no")
    assert len(fault.value.faults) == 4


NK = ["n", "k"]
NM, UM = "wavelength (nm),n,k\n", "wavelength (um),n,k\n"
WL = "wl (um),n\n0.5,1\n"


@pytest.fixture
def read(tmp_path):
    def read(text, names=NK, **options):
        file = tmp_path / "gold.csv"
        file.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_columns(file, names, **options)

    return read


@rows(
    "text",
    [
        NM + "500,0.97,1.87\n521,0.62,2.08\n",
        "# Johnson and Christy\n\nwavelength_nm; n; k\n500; 0.97; 1.87\n# more\n521; 0.62; 2.08",
        "k\tn\twl [um]\tnote\n1.87\t0.97\t0.5\ta\n2.08\t0.62\t0.521\tb\n",
        "Wavelength (\u00b5m),N,K\r\n0.5,0.97,1.87\r\n0.521,0.62,2.08\r\n",
        "\ufeff\u03bb (nm), n (-), k ()\n500,0.97,1.87\n521,0.62,2.08\n",
        "wavelength,n,k\n500 nm,0.97,1.87\n0.521 um,0.62,2.08\n",
        NM + "500 nm,0.97,1.87\n521,0.62,2.08\n",
        '"wavelength (nm)",n,"k"\n"500","0.97",1.87\n521,0.62,"2.08"\n',
        "wavelength (angstrom),n,k\n5000,0.97,1.87\n5210,0.62,2.08\n",
        "\u03bb (\u00c5),n,k\n5000,0.97,1.87\n5210,0.62,2.08\n",
        "wl (um),n\n0.5,0.97\n0.521,0.62\n\nwl (um),k\n0.5,1.87\n0.521,2.08\n",
    ],
)
def test_columns_are_found_by_their_names_and_units(read, text):
    found = read(text)
    assert found.title == "gold"
    assert found.wavelengths.tolist() == [5e-7, 5.21e-7]
    assert found.columns["n"].tolist() == [0.97, 0.62]
    assert found.columns["k"].tolist() == [1.87, 2.08]


def test_units_and_tables_are_read_as_files_have_them(read):
    for head in (
        "energy (eV),n\n2.4",
        "wavenumber (1/cm),n\n19357.305",
        "frequency (THz),n\n580.317",
    ):
        assert read(f"{head},1.5\n", ["n"]).wavelengths[0] == pytest.approx(516.6e-9, rel=1e-5)
    # As refractiveindex.info writes files.
    text = "wl,n\n0.5,1.5\n0.6,1.4\nwl,k\n0.5,2\n0.6,3\n"
    assert read(text, unit="um").columns["k"].tolist() == [2.0, 3.0]
    assert [*read(text, ["n"], unit="um").columns] == ["n"]
    assert read("wavelength,n\n500,1\n", ["n"], unit="nm").wavelengths.tolist() == [5e-7]
    found = read("energy (eV),n\n1,1\n2,2\n", ["n"])
    assert np.all(np.diff(found.wavelengths) < 0.0)


@rows(
    "text, least",
    [
        ("wavelength,n\n400 um,1\n500 um,1\n", 400e-6),
        ("wavelength (nm),n\n0.4 nm,1\n0.5 nm,1\n", 0.4e-9),
        ("wavelength (mm),n\n0.4,1\n0.5,1\n", 400e-6),
        ("wavelength (um),n\n0.2,1\n500,1\n", 0.2e-6),
        ("wavelength (nm),n\n400000,1\n500000,1\n", 400e-6),
        ("energy (eV),n\n400,1\n500,1\n", 4.135667696923859e-15 * 299792458.0 / 400.0),
        ("frequency (THz),n\n0.4,1\n0.5,1\n", 299792458.0 / 0.4e12),
    ],
)
def test_the_far_infrared_and_x_rays_can_be_said(read, text, least):
    assert read(text, ["n"]).wavelengths[0] == pytest.approx(least, rel=1e-14)


WRONG = [
    ("", "gold.csv: it is empty; write the names of columns, and lines"),
    *(("# nothing\n", "it is empty"), (NM, "line 1 has no names of columns, or is the only one")),
    ("wavelength (nm),n\n500,1\n", "line 1 names no column 'k'; there are: n; or ask for k=0.0"),
    ("wavelength (nm),nn,k\n500,1,1\n", "line 1 names no column 'n'; there are: nn, k"),
    ("x,n,k\n500,1,1\n", "line 1 has 'x', 'n' and 'k'; give one column of wavelengths"),
    ("500,1,1\n510,1,1\n", "line 1 has no names of columns, or is the only one; begin with"),
    ("wavelength,n,k\n516,1,1\n", "line 1: 'wavelength' has no unit; write 'wavelength (nm)'"),
    ("wl,n,k\n0.4,1,1\n400,1,1\n", "write 'wl (nm)', or give unit='nm'"),
    ("energy,n,k\n2.4,1,1\n", "write 'energy (eV)', or give unit='eV'"),
    ("wavelength (mn),n,k\n516,1,1\n", "'mn' is no unit of 'wavelength'; there are: nm, um"),
    ("energy (nm),n,k\n516,1,1\n", "'nm' is no unit of 'energy'; there are: eV"),
    ("wavelength (1/cm),n,k\n516,1,1\n", "'1/cm' is no unit of 'wavelength'; there are: nm"),
    ("wl (eV),n,k\n516,1,1\n", "'eV' is no unit of 'wl'"),
    ("lambda (THz),n,k\n516,1,1\n", "'THz' is no unit of 'lambda'"),
    ("wavelength,n,k\n400 nm,1,1\n500,1,1\n", "line 1: 'wavelength' has no unit"),
    (UM + "400 nm,1,1\n", "line 2: '400 nm' is not in um, as line 1 says"),
    *((NM + f"500,1,{k}\n", "line 2 cannot be read: ") for k in ('"1\n600,1,1', '"1"5')),
    (NM + f"500,1,{'1' * 200_000}\n", "line 2 cannot be read: field larger than field limit"),
    (UM + "400,1,1\n500,1,1\n", "are 400 um .. 500 um, which are most likely nm; give the unit nm"),
    (NM + "0.4,1,1\n0.5,1,1\n", "are 0.4 nm .. 0.5 nm, which are most likely um; give the unit um"),
    (WL + "0.6,1\nwl (um),k\n0.5,1\n", "line 4 begins a second table, of other wavelengths"),
    ("wl (um),n,k\n0.5,1,1\nwl (um),k\n0.5,1\n", "line 3 begins a second table of k; keep"),
    (WL + "wl (um),k\n0.5,x\n", "line 4: k is 'x', which is no number"),
    (WL + "wl (um),n2\n0.5,1\n", "line 1 names no column 'k'"),
    ("wl (nm),energy (eV),n,k\n516,2.4,1,1\n", "has 'wl' and 'energy'; give one column"),
    ("wavelength (nm),n,n,k\n516,1,1,1\n", "line 1 names 'n' twice; keep one"),
    (NM + "500,nan,1\n", "line 2: n is 'nan', which is no number"),
    (NM + "500,,1\n", "line 2: n is '', which is no number; write one"),
    ("wavelength (nm);n;k\n500;1,5;1\n", "line 2: n is '1,5', which is no number"),
    (NM + "500,1_5,1\n", "line 2: n is '1_5', which is no number"),
    *((NM + f"{w},1,1\n", f"line 2: '{w}") for w in ("5_00", "red")),
    (NM + "500,1,\uff11\n", "which is no number; write one, such as 1.5"),
    *(
        (NM + f"500,1{k}\n", f"line 2 has {n} values, and line 1 has")
        for k, n in (("", 2), (",5,1", 4))
    ),
    (NM + "-5,1,1\n", "line 2: the wavelength is -5 nm; give numbers above 0"),
    (NM.encode() + b"\xff\xfe,1,1\n", "it cannot be read: it is no text in UTF-8"),
]


@rows("text, words", WRONG)
def test_what_is_wrong_with_a_file_is_told_with_the_line(read, text, words):
    with pytest.raises(ValueFault) as fault:
        read(text, cures={"k": "; or ask for k=0.0"})
    assert words in str(fault.value)
    assert len(fault.value.faults) == 1


@rows(
    "text, words",
    [
        (NM + "500,-1,1\n", "n of gold is -1 at 500 nm; give none below 0"),
        (NM + "500,1,-1\n", "so that k > 0 absorbs"),
        ("wavelength (m),n,k\n516,1,1\n", "516 metres, which is no wavelength of light"),
        (NM + "500,1,1\n\n600,1,1\n550,1,1\n", "of gold neither rise nor fall throughout"),
        (NM + "500,1,1\n600,1,1\n500,1,1\n", "of gold neither rise nor fall throughout"),
        (NM + "500,1,1\n500,1,1\n", "of gold neither rise nor fall throughout, as at 500 nm"),
    ],
)
def test_numbers_of_a_file_are_judged_as_samples_are(tmp_path, text, words):
    (file := tmp_path / "gold.csv").write_text(text)
    with pytest.raises(ValueFault) as fault:
        Material.from_csv(file)
    assert words in str(fault.value)


def test_all_faults_are_told_at_once_and_files_that_are_missing(read, tmp_path):
    with pytest.raises(ValueFault) as fault:
        read(NM + "".join(f"{length},nan,1\n" for length in range(100, 1100)))
    assert str(fault.value).endswith("and 980 more")
    with pytest.raises(ValueFault, match=r"begin with a line such as 'wavelength \(nm\), power'"):
        read("400,1\n500,2\n", ["power"])
    with pytest.raises(ValueFault, match=r"silver\.csv: it cannot be read: No such file"):
        read_columns(tmp_path / "silver.csv", NK)
    with pytest.raises(ValueFault, match="it cannot be read"):
        read_columns(tmp_path, NK)
