"""Spectra, arithmetic with them, and what they are between their samples and beyond them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.materials.illuminants import grid_widths
from optipath.paths.files.spectrum_tables import spectrum_of, spectrum_table
from tables import rows
from wired import read_back

SI = {"h": 6.62607015e-34, "c": 299792458.0, "k": 1.380649e-23}
STEFAN_BOLTZMANN = 2 * math.pi**5 * SI["k"] ** 4 / (15 * SI["h"] ** 3 * SI["c"] ** 2)
HC_EV_NM = SI["h"] * SI["c"] / 1.602176634e-19 * 1e9
THREE = np.array([400e-9, 500e-9, 600e-9])
sampled, histogram, line, led = (
    getattr(op.Spectrum, make) for make in ("sampled", "histogram", "line", "led")
)


def test_samples_are_joined_by_lines_and_powers_spread_over_bins_or_counted_once():
    lamp = op.Spectrum(["400 nm", "500 nm", "700 nm"], [1.0, 3.0, 0.0], name="lamp")
    assert lamp == sampled(["400 nm", "500 nm", "700 nm"], [1.0, 3.0, 0.0], name="lamp")
    np.testing.assert_allclose(lamp.at([450e-9, 500e-9, 600e-9]), [2.0, 3.0, 1.5], rtol=1e-14)
    assert lamp.power() == pytest.approx(200.0 + 300.0, rel=1e-14)
    assert lamp.power("450 nm", "600 nm") == pytest.approx(125.0 + 225.0, rel=1e-14)
    lamp = sampled([4e-7, 5e-7], [1.0, 3.0])
    assert sampled([5e-7, 4e-7], [3.0, 1.0]) == lamp
    np.testing.assert_array_equal(lamp.values, [1.0, 3.0])
    with pytest.raises(
        op.errors.ValueFault, match=r"has no powers; ask for those of spectrum.rebin"
    ):
        lamp.powers  # noqa: B018
    with pytest.raises(op.errors.ValueFault, match=r"has no values; .* spectrum.resample"):
        lamp.rebin([4e-7, 5e-7]).values  # noqa: B018
    lamp = histogram(["400 nm", "500 nm", "700 nm"], [10.0, 40.0])
    found = lamp.at(["400 nm", "499 nm", "500 nm", "700 nm"])
    np.testing.assert_allclose(found, [0.1, 0.1, 0.2, 0.2], rtol=1e-12)
    assert lamp.power() == pytest.approx(50.0, rel=1e-14)
    assert histogram(["700 nm", "500 nm", "400 nm"], [40.0, 10.0]) == lamp
    lamp = op.Spectrum.constant(1.0) + line("500 nm", 2.0)
    parts = [lamp.power("400 nm", "500 nm"), lamp.power("500 nm", "600 nm")]
    assert parts == pytest.approx([100.0, 102.0], rel=1e-13)
    assert lamp.power("400 nm", "600 nm") == pytest.approx(sum(parts), rel=1e-13)
    laser = line("500 nm", 2.0)
    assert [laser.power(high="500 nm"), laser.power("500 nm"), laser.power()] == [0.0, 2.0, 2.0]


@rows("temperature", [300.0, 2856.0, 5772.0])
def test_black_body_radiates_by_stefan_and_boltzmann_wien_and_planck(temperature):
    lamp = op.Spectrum.black_body(temperature)
    # What is beyond 1 mm is (15 / pi^4) x^3 / 3 of all, x = h c / (L k T).
    x = SI["h"] * SI["c"] / (1e-3 * SI["k"] * temperature)
    beyond = 15 / math.pi**4 * (x**3 / 3 - x**4 / 8 + x**5 / 60)
    whole = STEFAN_BOLTZMANN * temperature**4 / math.pi
    expected = whole * (1.0 - beyond)
    assert lamp.power(1e-9, 1e-3) == pytest.approx(expected, rel=1e-6 * beyond + 1e-13)
    assert (0.3 * lamp).power() == pytest.approx(0.3 * whole, rel=1e-14)
    # By Wien's law, and by Planck's in many digits.
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
def test_a_width_of_a_diode_is_that_between_its_edges_and_whole_powers_are_those_of_terms(
    peak, width, low, high
):
    assert led(peak, width).kind.width * 1e9 == pytest.approx(high - low, rel=1e-12)
    diode = led("530 nm", "30 nm", power=2.0)
    assert diode.power() == 2.0
    assert diode.power("200 nm", "900 nm") == pytest.approx(2.0, rel=1e-13)
    at_peak, below, above = diode.at(["530 nm", "515 nm", "545 nm"])
    assert [below / at_peak, above / at_peak] == pytest.approx([0.5, 0.5], rel=1e-12)
    lamp = sampled(["400 nm", "500 nm"], [1.0, 3.0], outside=0.0)
    body = op.Spectrum.black_body(300.0)
    whole = lamp + body + line("633 nm", 5.0)
    assert whole.power() == pytest.approx(205.0 + body.power(), rel=1e-14)


@rows("name", ["A", "D65", "E"])
def test_illuminants_agree_with_colour_science(name):
    # When it is imported, it changes how NumPy prints.
    with np.printoptions():
        colour = pytest.importorskip("colour")
    table = colour.SDS_ILLUMINANTS[name]
    places = np.arange(360, 781, 5)
    expected = [table[float(place)] for place in places]
    found = op.Spectrum.illuminant(name).at(places * 1e-9)
    # The table of A has six digits, our A is its formula.
    np.testing.assert_allclose(found, expected, rtol=0 if name != "A" else 5e-6, atol=1e-12)
    # In the infrared, D65 is daylight by its components.
    series = colour.sd_CIE_illuminant_D_series(np.array([0.31272, 0.32903]))
    places = np.arange(780, 831, 5)
    expected = np.array([series[float(place)] for place in places])
    found = op.Spectrum.illuminant("D65").at(places * 1e-9)
    # Components of daylight are rounded in another place, by 0.15 %, alike everywhere here.
    np.testing.assert_allclose(found / found[0], expected / expected[0], rtol=1e-4)


@rows(
    "place, grid",
    [
        *(("633 nm", np.linspace(380, 700, 9)[::step]) for step in (1, -1)),
        ("633 nm", np.array([380.0, 381.0, 500.0, 640.0, 700.0])),
        *(("633 nm", np.array([633.0, 700.0])), ("633 nm", np.array([500.0, 633.0]))),
        ("550 nm", np.array([400.0, 500.0, 600.0])),
    ],
)
def test_a_line_keeps_its_power_on_any_grid(place, grid):
    density = line(place, power=2.5).at(grid * 1e-9)
    assert np.count_nonzero(density) == 1
    assert np.dot(density, grid_widths(grid * 1e-9)) == pytest.approx(2.5, rel=1e-15)


def test_spectra_beyond_their_range_are_an_error_or_0_where_that_is_said():
    for make, known in ((sampled, [1.0, 3.0]), (histogram, [1.0])):
        with pytest.raises(op.errors.ValueFault, match=r"400 nm .. 500 nm.*give outside=0.0"):
            make(PAIR, known).at("550 nm")
        np.testing.assert_array_equal(make(PAIR, known, outside=0.0).at([3e-7, 6e-7]), 0.0)
    for name in ("A", "D65", "E"):
        assert op.Spectrum.illuminant(name).at("560 nm") == pytest.approx(100.0, rel=1e-14)
    # 830 * 1e-9 is the number above 830e-9, and the end of a range is within it by its rounding.
    daylight = op.Spectrum.illuminant("D65")
    assert daylight.at(830 * 1e-9) == 60.3125
    assert sampled(["300 nm", "830 nm"], [1.0, 2.0], outside=0.0).at(830 * 1e-9) == 2.0
    path = op.Source(spectrum=daylight) >> op.Detector()
    assert path.trace(wavelength=np.array([300, 830]) * 1e-9).intensity[1] == 60.3125


def test_a_file_has_samples_by_the_name_of_their_column(tmp_path):
    file = tmp_path / "lamp.csv"
    file.write_text("# measured\nwavelength (nm); Power; noise\n400; 1; 0\n600; 3; 0\n")
    lamp = op.Spectrum.from_csv(file)
    assert lamp == sampled(["400 nm", "600 nm"], [1.0, 3.0], name="lamp")
    with pytest.raises(op.errors.ValueFault, match=r"lamp.csv.*'?respons"):
        op.Spectrum.from_csv(file, "response")
    file.write_text("wavelength (nm), power\n400, -1\n500, 1")
    told = r"value of lamp is -1 at 0; give numbers of 0 or more"
    with pytest.raises(op.errors.ValueFault, match=told):
        op.Spectrum.from_csv(file)


PLACES = op.wavelengths("400 nm", "700 nm", "50 nm")
LAMP = sampled(PLACES, np.linspace(1.0, 4.0, 7))
FINE = LAMP.resample(op.wavelengths("400 nm", "700 nm", "5 nm"))
BINS, LASER, LED = histogram(PLACES, np.arange(6.0)), line("633 nm", 2.0), led("530 nm", "30 nm")
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


def test_sums_keep_bins_and_lines_and_products_are_those_of_samples_and_of_values_at_lines():
    np.testing.assert_array_equal((BINS + BINS).powers, 2.0 * BINS.powers)
    both = LAMP + LASER
    assert both.power() == pytest.approx(LAMP.power() + 2.0, rel=1e-14)
    assert both.rebin(PLACES).powers.sum() == pytest.approx(both.power(), rel=1e-14)
    assert sum([LAMP, LED, LASER]) == LAMP + LED + LASER
    assert line("633 nm") == line(633e-9)
    assert op.Spectrum.illuminant("A") != op.Spectrum.illuminant("E")
    np.testing.assert_array_equal((LAMP * LAMP).values, LAMP.values**2)
    at_fine = LED.at(FINE.wavelengths)
    np.testing.assert_allclose((FINE * LED).values, FINE.values * at_fine, rtol=1e-15)
    np.testing.assert_allclose((FINE * LED / FINE).values, at_fine, rtol=1e-14)
    np.testing.assert_allclose((1.0 / LAMP).values, 1.0 / LAMP.values, rtol=1e-15)
    seen = LASER * LAMP
    assert seen.power() == pytest.approx(2.0 * float(LAMP.at("633 nm")), rel=1e-14)
    expected = seen.power() + (FINE * LED).power()
    assert (FINE * (LASER + LED)).power() == pytest.approx(expected, rel=1e-13)


PAIR, TWO, SAME = [4e-7, 5e-7], histogram(THREE, [1.0, 4.0]), [4e-7, 4e-7]
ULTRAVIOLET = sampled([2e-7, 3e-7], [1.0, 1.0])
REFUSED = [
    (lambda: led("2 eV", "4 eV"), r"'4 eV' around a peak at 619.92.* nm reaches down to 0"),
    (lambda: led("2 eV", "30"), "'30' has no unit"),
    (lambda: led("2 eV", "0 nm"), "give a width above 0"),
    (lambda: led("2 eV", 30), "such as '30 nm'"),
    (lambda: op.Spectrum(1.0), "use Spectrum.sampled"),
    (lambda: op.Spectrum([1, 2]), "is not made of"),
    (lambda: op.Spectrum(THREE, [1.0, 2.0]), "3 wavelengths and 2"),
    (lambda: op.Spectrum(THREE, THREE, outside="near"), "'nearest' and 'linear'"),
    (lambda: sampled(PAIR, [1.0, -1.0]), "is -1 at 1; give numbers of 0 or more"),
    (lambda: sampled([400.0, 500.0], [1.0, 1.0]), "nanometres write '400 nm'"),
    (lambda: sampled(SAME, [1.0, 1.0]), "as at 400 nm"),
    *((lambda: sampled(PAIR, [1.0, np.nan]), "nan"), (lambda: sampled(PAIR, None), "value")),
    (lambda: sampled(PAIR, [1.0, 1.0], outside=1.0), "give 0.0 where"),
    (lambda: histogram(PAIR, [1.0, 1.0]), "give 1 powers"),
    (lambda: histogram(PAIR, [1.0], outside="linear"), "leave it out"),
    (lambda: histogram(SAME, [1.0]), "rise or fall throughout"),
    (lambda: histogram(500e-9, 1.0), "rise or fall throughout"),
    (lambda: line(633), "wavelength of a line .* below 0.1 m"),
    (lambda: line("633 nm", -1.0), "power of a line is -1"),
    (lambda: line(["633 nm"]), "give one number"),
    (lambda: line("633 nm", op.Parameter("p")), "power of a line cannot be parameter 'p'"),
    (lambda: op.Spectrum.black_body(0.0), "temperature of a black body"),
    (lambda: op.Spectrum.illuminant("D56"), "there are: A, D65, E"),
    (lambda: op.Spectrum.constant(-1.0), "constant spectrum is -1"),
    (lambda: op.Spectrum.constant(1.0).power(), "give two ends"),
    (lambda: TWO.rebin(PAIR), "a power of 4 beyond the bins.*outside='drop'"),
    (lambda: LASER.rebin(PAIR), "a power of 2 beyond"),
    (lambda: TWO.rebin([4e-7, 7e-7]), r"400 nm .. 600 nm"),
    (lambda: LASER.resample([5e-7, 6e-7]), r"spectrum.rebin\(edges\)"),
    (lambda: LAMP.resample([3e-7, 5e-7], outside=0.0), "where the spectrum is made"),
    (lambda: BINS * LASER, "a histogram is power in bins or"),
    (lambda: LASER * LASER, "the line at 633 nm is power in bins or at single"),
    (lambda: LASER / LAMP, r"spectrum.rebin\(edges\)"),
    (lambda: LAMP / LASER, "cannot be divided"),
    (lambda: BINS * LAMP, r"spectrum.resample\(op.wavelengths"),
    (lambda: LED * LED, "have no samples"),
    (lambda: LAMP / (0.0 * LAMP), "is 0 at 400 nm, where nothing can be divided"),
    (lambda: LAMP * -1.0, "give a real number of 0 or more"),
    *((lambda: LAMP / 0.0, "a divisor of"), (lambda: np.ones(2) * LAMP, "give one number")),
    (lambda: LAMP * 1e308 * 10.0, "inf at"),
    (lambda: LAMP + ULTRAVIOLET, "no wavelength in common; give outside=0.0"),
    (lambda: LAMP * ULTRAVIOLET, "no wavelength in common"),
    (lambda: LASER - LED, r"difference of the line at 633 nm is no spectrum.*\.at\("),
    *((lambda one=one: one - LED, "is no spectrum") for one in (1.0, np.ones(2))),
    (lambda: -LED, "difference of the diode at 530 nm is no spectrum, .* below 0"),
    (lambda: LED + 1.5, r"add a spectrum, such as Spectrum.constant\(1.5\)"),
    (lambda: 1 + LED, "is no spectrum; add a spectrum"),
    (lambda: LED + "a lamp", r"'a lamp' is no spectrum; add a spectrum"),
    (lambda: np.ones(2) + LED, "is no spectrum; add a spectrum"),
]


@rows("make, sentence", REFUSED)
def test_what_is_no_spectrum_and_what_does_not_fit_one_is_refused_with_the_cure(make, sentence):
    with pytest.raises((op.errors.ValueFault, op.errors.UnitError), match=sentence):
        make()


@st.composite
def edges(draw, least=350.0, most=800.0):
    inner = draw(st.lists(st.floats(least + 1e-3, most - 1e-3), max_size=30, unique=True))
    places = np.unique([least, *np.round(inner, 6), most])
    return places * 1e-9


@given(edges(), edges(), st.integers(0, 2**32 - 1), st.floats(350.0, 800.0))
def test_other_bins_get_what_overlaps_and_keep_all_power(old, new, seed, place):
    powers = np.random.default_rng(seed).uniform(0.0, 10.0, old.size - 1)
    found = histogram(old, powers).rebin(new).powers
    assert found.sum() == pytest.approx(powers.sum(), rel=1e-14)
    low = np.maximum(old[:-1, None], new[None, :-1])
    high = np.minimum(old[1:, None], new[None, 1:])
    expected = powers @ (np.maximum(high - low, 0.0) / np.diff(old)[:, None])
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)
    of_line = line(place * 1e-9, power=3.0).rebin(new).powers
    assert sorted(of_line)[-1] == of_line.sum() == 3.0


def test_bins_have_the_integrals_of_lines_and_of_error_functions_and_samples_keep_values():
    lamp = sampled(THREE, [0.0, 2.0, 0.0])
    found = lamp.rebin([4e-7, 4.5e-7, 5.5e-7, 6e-7]).powers
    np.testing.assert_allclose(found, [25.0, 150.0, 25.0], rtol=1e-12)
    places = op.wavelengths("480 nm", "580 nm", "10 nm")
    np.testing.assert_array_equal(LED.resample(places).values, LED.at(places))
    special = pytest.importorskip("scipy.special")
    places = np.array([500.0, 520.0, 530.0, 600.0])
    sigma = 30.0 / (2.0 * np.sqrt(2.0 * np.log(2.0)))
    expected = np.diff(special.ndtr((places - 530.0) / sigma))
    np.testing.assert_allclose(LED.rebin(places * 1e-9).powers, expected, rtol=1e-12)


def test_what_is_beyond_new_bins_may_be_dropped_and_what_is_beyond_old_ones_be_0():
    assert TWO.rebin(PAIR, outside="drop").powers == pytest.approx([1.0])
    assert LASER.rebin(PAIR, outside="drop").powers == [0.0]
    wider = histogram(PAIR, [1.0], outside=0.0).rebin([3e-7, 5e-7, 6e-7])
    assert wider.powers == pytest.approx([1.0, 0.0])
    # Now it is known that nothing else is there.
    assert wider.at("700 nm") == 0.0
    known = sampled(PAIR, [1.0, 3.0], outside=0.0)
    assert known.resample([3e-7, 5e-7], outside=0.0).values.tolist() == [0.0, 3.0]


FAR = np.array([300e-9, 380e-9, 450e-9, 700e-9])


@rows(
    "outside, values, expected",
    [
        (0.0, [2.0, 1.0, 3.0], [0.0, 0.0, 1.5, 0.0]),
        ("nearest", [2.0, 1.0, 3.0], [2.0, 2.0, 1.5, 3.0]),
        ("linear", [2.0, 1.0, 3.0], [3.0, 2.2, 1.5, 5.0]),
        ("linear", [0.5, 1.0, 0.2], [0.0, 0.4, 0.75, 0.0]),
    ],
)
def test_what_a_sampled_spectrum_is_beyond_its_samples(outside, values, expected, tmp_path):
    lamp = op.Spectrum(THREE, values, outside=outside, name="lamp")
    assert spectrum_of(spectrum_table(lamp)) == lamp
    np.testing.assert_allclose(lamp.at(FAR), expected, rtol=1e-12, atol=1e-12)
    path = read_back(op.Source(spectrum=lamp) >> op.Detector(), tmp_path)
    found = path.trace(wavelength=FAR).intensity
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)
    with pytest.raises(op.OptipathError, match="outside='nearest'"):
        op.Spectrum(THREE, values).at(FAR)


def test_what_goes_on_beyond_samples_is_computed_with_and_products_have_the_samples_of_both():
    first = op.Spectrum(THREE, [0.5, 1.0, 0.2], outside="linear")
    # It is 0 from 625 nm on.
    assert first.power("600 nm", "900 nm") == pytest.approx(0.5 * 25 * 0.2, rel=1e-9)
    with pytest.raises(op.errors.ValueFault, match="does not end"):
        first.power()
    far = np.array([300e-9, 700e-9, 900e-9])
    second = op.Spectrum(THREE, [1.0, 1.0, 1.5], outside="linear")
    np.testing.assert_allclose((first + second).at(far), first.at(far) + second.at(far))
    np.testing.assert_allclose((2 * first).at(far), 2 * first.at(far))
    np.testing.assert_allclose((first * op.Spectrum.constant(3)).at(far), 3 * first.at(far))
    # A product has the samples of both.
    lamp = op.Spectrum(["400 nm", "500 nm", "700 nm"], [1.0, 2.0, 0.0])
    glass = op.Spectrum(["450 nm", "600 nm", "800 nm"], [0.2, 0.8, 0.4])
    seen = lamp * glass
    np.testing.assert_allclose(seen.wavelengths * 1e9, [450, 500, 600, 700])
    np.testing.assert_allclose(seen.values, [0.3, 0.8, 0.8, 0.0], rtol=1e-12, atol=1e-12)
    # Trapezoids.
    assert seen.power() == pytest.approx(50 * 0.55 + 100 * 0.8 + 100 * 0.4, rel=1e-12)
    ratio = glass / op.Spectrum(["400 nm", "700 nm"], [1.0, 4.0])
    np.testing.assert_allclose(ratio.at("600 nm"), 0.8 / 3.0, rtol=1e-12)
    first, second = ([f"{low} nm", f"{low + 50} nm"] for low in (400, 500))
    dark = op.Spectrum(first, [1, 1], outside=0.0) * op.Spectrum(second, [1, 1], outside=0.0)
    assert dark.at("520 nm") == 0.0


@rows(
    "one, other, at, expected",
    [
        (0.0, 0.0, "500 nm", [0.0, 2.0 * 4.0, 0.0]),
        ("nearest", "nearest", "450 nm", [1.0 * 3.0, 1.5 * 3.0, 2.0 * 6.0]),
        ("nearest", 0.0, "500 nm", [0.0, 2.0 * 4.0, 0.0]),
        *((one, "nearest", "", []) for one in (None, "linear")),
    ],
)
def test_a_product_is_known_beyond_samples_where_both_say_so(one, other, at, expected):
    first = op.Spectrum(["400 nm", "500 nm"], [1.0, 2.0], outside=one)
    second = op.Spectrum(["450 nm", "600 nm"], [3.0, 6.0], outside=other)
    for seen in (first * second, second * first):
        if at:
            np.testing.assert_allclose(seen.at(["350 nm", at, "700 nm"]), expected, rtol=1e-12)
        else:
            with pytest.raises(op.OptipathError, match="is known"):
                seen.at("700 nm")


def test_a_diode_between_coarse_samples_keeps_its_power():
    coarse = op.Spectrum(["380 nm", "550 nm", "700 nm"], [0.1, 0.9, 0.3])
    # A straight line from 0.1 at 380 nm to 0.9 at 550 nm, by what is even around 450 nm.
    expected = 0.1 + 0.8 * 70.0 / 170.0
    for width in ("20 nm", "1 nm", "0.001 nm"):
        diode = led("450 nm", width)
        for seen in (coarse * diode, diode * coarse, (diode + op.Spectrum.constant(0)) * coarse):
            assert seen.power() == pytest.approx(expected, rel=1e-5)
    far = coarse * led("900 nm", "20 nm")
    np.testing.assert_array_equal(far.wavelengths, coarse.wavelengths)
