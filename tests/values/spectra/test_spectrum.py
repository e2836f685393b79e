"""Spectra, and arithmetic with them."""

from __future__ import annotations

import math

import numpy as np
import pytest

import optipath as op
from optipath.values.spectra.grid_bins import grid_widths
from tables import rows

SI = {"h": 6.62607015e-34, "c": 299792458.0, "k": 1.380649e-23}
STEFAN_BOLTZMANN = 2 * math.pi**5 * SI["k"] ** 4 / (15 * SI["h"] ** 3 * SI["c"] ** 2)
GRID = np.linspace(380e-9, 700e-9, 9)


@pytest.fixture(scope="module")
def colour():
    # When it is imported, it changes how NumPy prints.
    with np.printoptions():
        return pytest.importorskip("colour")


def test_samples_are_joined_by_straight_lines_and_may_fall():
    lamp = op.Spectrum.sampled(["400 nm", "500 nm", "700 nm"], [1.0, 3.0, 0.0])
    np.testing.assert_allclose(lamp.at([450e-9, 500e-9, 600e-9]), [2.0, 3.0, 1.5], rtol=1e-14)
    assert lamp.power() == pytest.approx(200.0 + 300.0, rel=1e-14)
    assert lamp.power("450 nm", "600 nm") == pytest.approx(125.0 + 225.0, rel=1e-14)
    rising = op.Spectrum.sampled([4e-7, 5e-7], [1.0, 3.0])
    assert op.Spectrum.sampled([5e-7, 4e-7], [3.0, 1.0]) == rising
    lamp = op.Spectrum.sampled([4e-7, 5e-7], [1.0, 3.0])
    np.testing.assert_array_equal(lamp.values, [1.0, 3.0])
    with pytest.raises(op.ValueFault, match=r"has no powers; ask for those of spectrum.rebin"):
        lamp.powers  # noqa: B018
    with pytest.raises(op.ValueFault, match=r"has no values; .* spectrum.resample"):
        lamp.rebin([4e-7, 5e-7]).values  # noqa: B018


def test_histograms_and_lines_have_their_power_spread_over_bins_or_counted_once():
    lamp = op.Spectrum.histogram(["400 nm", "500 nm", "700 nm"], [10.0, 40.0])
    found = lamp.at(["400 nm", "499 nm", "500 nm", "700 nm"])
    np.testing.assert_allclose(found, [0.1, 0.1, 0.2, 0.2], rtol=1e-12)
    assert lamp.power() == pytest.approx(50.0, rel=1e-14)
    turned = op.Spectrum.histogram(["700 nm", "500 nm", "400 nm"], [40.0, 10.0])
    assert turned == lamp
    lamp = op.Spectrum.constant(1.0) + op.Spectrum.line("500 nm", 2.0)
    parts = [lamp.power("400 nm", "500 nm"), lamp.power("500 nm", "600 nm")]
    assert parts == pytest.approx([100.0, 102.0], rel=1e-13)
    assert lamp.power("400 nm", "600 nm") == pytest.approx(sum(parts), rel=1e-13)
    laser = op.Spectrum.line("500 nm", 2.0)
    assert [laser.power(high="500 nm"), laser.power("500 nm"), laser.power()] == [0.0, 2.0, 2.0]


@rows("temperature", [300.0, 2856.0, 5772.0])
def test_black_body_radiates_by_stefan_and_boltzmann(temperature):
    lamp = op.Spectrum.black_body(temperature)
    # What is beyond 1 mm is (15 / pi^4) x^3 / 3 of all, x = h c / (L k T).
    x = SI["h"] * SI["c"] / (1e-3 * SI["k"] * temperature)
    beyond = 15 / math.pi**4 * (x**3 / 3 - x**4 / 8 + x**5 / 60)
    whole = STEFAN_BOLTZMANN * temperature**4 / math.pi
    expected = whole * (1.0 - beyond)
    assert lamp.power(1e-9, 1e-3) == pytest.approx(expected, rel=1e-6 * beyond + 1e-13)
    assert (0.3 * lamp).power() == pytest.approx(0.3 * whole, rel=1e-14)


def test_whole_powers_of_sums_and_of_diodes_are_those_of_their_terms():
    led = op.Spectrum.led("530 nm", "30 nm", power=2.0)
    assert led.power() == 2.0
    assert led.power("200 nm", "900 nm") == pytest.approx(2.0, rel=1e-13)
    peak, low, high = led.at(["530 nm", "515 nm", "545 nm"])
    assert [low / peak, high / peak] == pytest.approx([0.5, 0.5], rel=1e-12)
    lamp = op.Spectrum.sampled(["400 nm", "500 nm"], [1.0, 3.0], outside=0.0)
    body = op.Spectrum.black_body(300.0)
    whole = lamp + body + op.Spectrum.line("633 nm", 5.0)
    assert whole.power() == pytest.approx(205.0 + body.power(), rel=1e-14)


def test_black_body_peaks_by_wiens_law_and_agrees_with_planck_in_many_digits():
    lamp, peak = op.Spectrum.black_body(5000.0), 2.897771955e-3 / 5000.0
    around = lamp.at(peak * np.array([0.9999, 1.0, 1.0001]))
    assert around[1] > max(around[0], around[2])
    mpmath = pytest.importorskip("mpmath")
    with mpmath.workdps(50):
        h, c, k = [mpmath.mpf(SI[name]) for name in "hck"]
        for place in (1e-7, 5.5e-7, 1e-4):
            w = mpmath.mpf(place)
            expected = 2 * h * c**2 / w**5 / mpmath.expm1(h * c / (w * k * 3000)) / 10**9
            found = float(op.Spectrum.black_body(3000).at(place))
            assert found == pytest.approx(float(expected), rel=1e-13)


HC_EV_NM = SI["h"] * SI["c"] / 1.602176634e-19 * 1e9


@rows(
    "peak, width, low, high",
    [
        ("2 eV", "0.1 eV", HC_EV_NM / 2.05, HC_EV_NM / 1.95),
        ("2 eV", "100 meV", HC_EV_NM / 2.05, HC_EV_NM / 1.95),
        ("500 nm", "1000 1/cm", 1e7 / 20500, 1e7 / 19500),
        ("600 THz", "20 THz", SI["c"] / 610e3, SI["c"] / 590e3),
        ("500 nm", "30 nm", 485.0, 515.0),
    ],
)
def test_a_width_of_a_diode_is_that_between_its_edges_in_the_unit_given(peak, width, low, high):
    led = op.Spectrum.led(peak, width)
    assert led.kind.width * 1e9 == pytest.approx(high - low, rel=1e-12)


@rows("name", ["A", "D65", "E"])
def test_illuminants_agree_with_colour_science(name, colour):
    table = colour.SDS_ILLUMINANTS[name]
    places = np.arange(360, 781, 5)
    expected = [table[float(place)] for place in places]
    found = op.Spectrum.illuminant(name).at(places * 1e-9)
    # The table of A has six digits, our A is its formula.
    np.testing.assert_allclose(found, expected, rtol=0 if name != "A" else 5e-6, atol=1e-12)


def test_illuminants_are_100_at_560_nm():
    for name in ("A", "D65", "E"):
        assert op.Spectrum.illuminant(name).at("560 nm") == pytest.approx(100.0, rel=1e-14)


def test_d65_in_the_infrared_is_daylight_by_its_components(colour):
    series = colour.sd_CIE_illuminant_D_series(np.array([0.31272, 0.32903]))
    places = np.arange(780, 831, 5)
    expected = np.array([series[float(place)] for place in places])
    found = op.Spectrum.illuminant("D65").at(places * 1e-9)
    # Components of daylight are rounded in another place, by 0.15 %, alike everywhere here.
    np.testing.assert_allclose(found / found[0], expected / expected[0], rtol=1e-4)


@rows(
    "place, grid",
    [
        ("633 nm", GRID),
        ("633 nm", GRID[::-1]),
        ("633 nm", np.array([380.0, 381.0, 500.0, 640.0, 700.0]) * 1e-9),
        ("633 nm", np.array([633.0, 700.0]) * 1e-9),
        ("633 nm", np.array([500.0, 633.0]) * 1e-9),
        ("550 nm", np.array([400.0, 500.0, 600.0]) * 1e-9),
    ],
)
def test_a_line_keeps_its_power_on_any_grid(place, grid):
    density = op.Spectrum.line(place, power=2.5).at(grid)
    assert np.count_nonzero(density) == 1
    assert np.dot(density, grid_widths(grid)) == pytest.approx(2.5, rel=1e-15)


def test_spectra_beyond_their_range_are_an_error_or_0_where_that_is_said():
    samples, bins = ([4e-7, 5e-7], [1.0, 3.0]), ([4e-7, 5e-7], [1.0])
    for make, known in ((op.Spectrum.sampled, samples), (op.Spectrum.histogram, bins)):
        with pytest.raises(op.ValueFault, match=r"400 nm .. 500 nm.*give outside=0.0"):
            make(*known).at("550 nm")
        np.testing.assert_array_equal(make(*known, outside=0.0).at([3e-7, 6e-7]), 0.0)
    # 830 * 1e-9 is the number above 830e-9, and the end of a range is within it by its rounding.
    assert op.Spectrum.illuminant("D65").at(830 * 1e-9) == 60.3125
    lamp = op.Spectrum.sampled(["300 nm", "830 nm"], [1.0, 2.0], outside=0.0)
    assert lamp.at(830 * 1e-9) == 2.0
    path = op.Source(spectrum=op.Spectrum.illuminant("D65")) >> op.Detector()
    assert path.trace(wavelength=np.array([300, 830]) * 1e-9).intensity[1] == 60.3125


def test_a_file_has_samples_by_the_name_of_their_column(tmp_path):
    file = tmp_path / "lamp.csv"
    file.write_text("# measured\nwavelength (nm); Power; noise\n400; 1; 0\n600; 3; 0\n")
    lamp = op.Spectrum.from_csv(file)
    assert lamp == op.Spectrum.sampled(["400 nm", "600 nm"], [1.0, 3.0], name="lamp")
    with pytest.raises(op.ValueFault, match=r"lamp.csv.*'?respons"):
        op.Spectrum.from_csv(file, "response")
    file.write_text("wavelength (nm), power\n400, -1\n500, 1")
    with pytest.raises(
        op.ValueFault,
        match=r"lamp.csv: line 2: power is -1; write none below 0, such as 0 for what",
    ):
        op.Spectrum.from_csv(file)


PLACES = op.wavelengths("400 nm", "700 nm", "50 nm")
LAMP = op.Spectrum.sampled(PLACES, np.linspace(1.0, 4.0, 7))
FINE = LAMP.resample(op.wavelengths("400 nm", "700 nm", "5 nm"))
BINS = op.Spectrum.histogram(PLACES, np.arange(6.0))
LASER = op.Spectrum.line("633 nm", 2.0)
LED = op.Spectrum.led("530 nm", "30 nm")
KINDS = [LAMP, BINS, LED, op.Spectrum.black_body(3000.0), op.Spectrum.illuminant("A")]
BETWEEN = np.linspace(405e-9, 695e-9, 17)


@rows("spectrum", [*KINDS, LASER, LAMP + LASER, op.Spectrum.constant(3.0)])
def test_sums_are_sums_at_each_wavelength_and_multiples_have_as_much_more_power(spectrum):
    for other in KINDS if spectrum in KINDS else []:
        expected = spectrum.at(BETWEEN) + other.at(BETWEEN)
        np.testing.assert_allclose((spectrum + other).at(BETWEEN), expected, rtol=1e-14)
    whole = spectrum.power("400 nm", "700 nm")
    for multiple in (2.5 * spectrum, spectrum * 2.5, spectrum / 0.4):
        assert multiple.power("400 nm", "700 nm") == pytest.approx(2.5 * whole, rel=1e-13)


def test_sums_keep_bins_and_lines_and_are_those_of_lists():
    np.testing.assert_array_equal((BINS + BINS).powers, 2.0 * BINS.powers)
    both = LAMP + LASER
    assert both.power() == pytest.approx(LAMP.power() + 2.0, rel=1e-14)
    assert both.rebin(PLACES).powers.sum() == pytest.approx(both.power(), rel=1e-14)
    assert sum([LAMP, LED, LASER]) == LAMP + LED + LASER
    assert op.Spectrum.line("633 nm") == op.Spectrum.line(633e-9)
    assert op.Spectrum.illuminant("A") != op.Spectrum.illuminant("E")


def test_products_are_those_of_samples_and_of_values_at_lines():
    np.testing.assert_array_equal((LAMP * LAMP).values, LAMP.values**2)
    at_fine = LED.at(FINE.wavelengths)
    np.testing.assert_allclose((FINE * LED).values, FINE.values * at_fine, rtol=1e-15)
    np.testing.assert_allclose((FINE * LED / FINE).values, at_fine, rtol=1e-14)
    np.testing.assert_allclose((1.0 / LAMP).values, 1.0 / LAMP.values, rtol=1e-15)
    seen = LASER * LAMP
    assert seen.power() == pytest.approx(2.0 * float(LAMP.at("633 nm")), rel=1e-14)
    assert (FINE * (LASER + LED)).power() == pytest.approx(
        seen.power() + (FINE * LED).power(), rel=1e-13
    )


ULTRAVIOLET = op.Spectrum.sampled([2e-7, 3e-7], [1.0, 1.0])
REFUSED = [
    (lambda: op.Spectrum.led("2 eV", "4 eV"), r"'4 eV' around a peak at 619.92.* nm reaches down"),
    (lambda: op.Spectrum.led("2 eV", "4 eV"), "nm reaches down to 0"),
    (lambda: op.Spectrum.led("2 eV", "30"), "'30' has no unit"),
    (lambda: op.Spectrum.led("2 eV", "0 nm"), "give a width above 0"),
    (lambda: op.Spectrum.led("2 eV", 30), "write '30 nm'"),
    (lambda: op.Spectrum(1.0), "use Spectrum.sampled"),
    (lambda: op.Spectrum.sampled([4e-7, 5e-7], [1.0, -1.0]), "is -1 at 1; give numbers of 0"),
    (lambda: op.Spectrum.sampled([400.0, 500.0], [1.0, 1.0]), "1e-9"),
    (lambda: op.Spectrum.sampled([4e-7, 4e-7], [1.0, 1.0]), "400 nm twice"),
    (lambda: op.Spectrum.sampled([4e-7, 5e-7], [1.0, np.nan]), "nan"),
    (lambda: op.Spectrum.sampled([4e-7, 5e-7], [1.0, 1.0], outside=1.0), "give 0.0 where"),
    (lambda: op.Spectrum.histogram([4e-7, 5e-7], [1.0, 1.0]), "give 1 powers"),
    (lambda: op.Spectrum.histogram([4e-7, 4e-7], [1.0]), "neither rise nor fall"),
    (lambda: op.Spectrum.line(633), "write '633 nm', or 633e-9"),
    (lambda: op.Spectrum.line("633 nm", -1.0), "power of a line is -1"),
    (lambda: op.Spectrum.line(["633 nm"]), "one wavelength"),
    (lambda: op.Spectrum.line("633 nm", op.Parameter("p")), r"Source\(intensity=...\)"),
    (lambda: op.Spectrum.black_body(0.0), "temperature of a black body"),
    (lambda: op.Spectrum.illuminant("D56"), "there are: A, D65, E"),
    (lambda: op.Spectrum.constant(-1.0), "constant spectrum is -1"),
    (lambda: op.Spectrum.constant(1.0).power(), "give two ends"),
    (lambda: BINS * LASER, "a histogram is power in bins"),
    (lambda: LASER * LASER, "the line at 633 nm is power at single wavelengths"),
    (lambda: LASER / LAMP, r"spectrum.rebin\(edges\)"),
    (lambda: LAMP / LASER, "cannot be divided"),
    (lambda: BINS * LAMP, r"spectrum.resample\(op.wavelengths"),
    (lambda: LED * LED, "have no samples"),
    (lambda: LAMP / (0.0 * LAMP), "is 0 at 400 nm, where nothing can be divided"),
    (lambda: LAMP * -1.0, "give a real number of 0 or more"),
    (lambda: LAMP / 0.0, "a divisor of"),
    (lambda: np.ones(2) * LAMP, "must be one number"),
    (lambda: LAMP * 1e308 * 10.0, "inf at"),
    (lambda: LAMP + ULTRAVIOLET, "no wavelength in common; give outside=0.0"),
    (lambda: LASER - LED, r"power of the line at 633 nm is no spectrum.*\.at\("),
    (lambda: 1.0 - LED, r"power of the diode at 530 nm is no spectrum"),
    (lambda: np.ones(2) - LED, r"is no spectrum"),
    (lambda: -LED, r"difference .* of the diode at 530 nm is no spectrum, .* below 0"),
    (lambda: LED**2, r"power of the diode at 530 nm is no spectrum, .*; compute with its numb"),
    (lambda: 2**LED, r"power of the diode at 530 nm is no spectrum"),
    (lambda: LED + 1.5, r"add a spectrum, such as Spectrum.constant\(1.5\)"),
    (lambda: 1 + LED, r"add a spectrum, such as Spectrum.constant\(1.0\)"),
    (lambda: LED + "a lamp", r"'a lamp' is no spectrum; add a spectrum"),
    (lambda: np.ones(2) + LED, "is no spectrum; add a spectrum"),
]


@rows("make, sentence", REFUSED)
def test_what_is_no_spectrum_and_what_does_not_fit_one_is_refused_with_the_cure(make, sentence):
    with pytest.raises((op.ValueFault, op.UnitError), match=sentence):
        make()
