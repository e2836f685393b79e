"""Elements, parameters, multiples and frames as they are written in files and read back."""

import tomllib

import numpy as np
import pytest

import optipath as op
from optipath.paths.drawing import draw
from optipath.paths.files.reader import read
from paths import chain
from tables import rows
from wired import read as loaded
from wired import read_back, wired


class OddlyNamed(op.Element, kind="oddly-named"):
    """A filter whose fields are called like what functions of the library take."""

    left: op.fields.Fraction
    what: op.fields.Fraction = 1.0
    function: op.fields.Fraction = 1.0

    @staticmethod
    def mueller_rows(xp, left, what, function):
        t = left * what * function
        return (t, 0, 0, 0), (0, t, 0, 0), (0, 0, t, 0), (0, 0, 0, t)


D, N, L, P = op.Parameter("d"), op.Parameter("n"), op.Parameter("l", 1e-3), op.Parameter
QUARTZ = op.Crystal.named("quartz").rotatory_power
MIRROR, SLAB = op.Mirror(-0.5 + 0.25j, 0.1), op.Medium(0.1, 50.0, rotation=np.radians(1000.0))
PLATE = op.Waveplate("1 mm", 0.009, "550 nm")
ELEMENTS = [
    *(op.Mirror(), op.Mirror(-0.97 + 0.12j, 0.92 - 0.26j, azimuth=0.3), op.Depolarizer(0.3)),
    op.Mirror(np.array([-0.9 + 0.1j, 0.3j]), -P("r", 0.5 - 0.5j)),
    *(op.Mirror(np.array([-0.9, 0.3]), P("r", np.array([0.5, r]))) for r in (0.5j, 0.25)),
    *(op.Interface(np.array([0.17, 3.15]), 0.3), op.LayerStack([1.0, 1.5, 0.2 + 3.0j], 0.3)),
    op.LayerStack([1.0, np.array([1.5, 1.6]), np.array([0.17, 3.15])], 0.3),
    *(op.Diattenuator(0.9, P("least"), angle=0.2, azimuth=0.1), op.FaradayRotator(-0.3)),
    op.Medium(0.2, 0.7, rotation=-np.radians(66.5)),
    op.Medium(P("l", 1e-3, minimum=0.0), 12.3, retardance=97.3, angle=0.1),
    op.Medium(L, 12.3, retardance=97.3, azimuth=0.2),
    op.FaradayRotator(verdet=-1.0, field=-P("b", "5 mT", unit="mT"), length=0.02),
    *(op.CircularPolarizer("left", 0.9, P("leakage")), op.CircularDiattenuator(0.9, 0.1)),
    op.Waveplate(P("d", "1 mm"), 0.0091, np.array([5e-7, 6e-7]), 0.1, azimuth=0.2),
    op.Medium(0.1, P("a", [1.0, 2.0], unit="1/m"), rotation=P("b")),
    op.CircularDiattenuator(0.9, P("l", 0.1)),
    op.Retarder(op.tabulated(["500 nm", "600 nm"], ["95 deg", "100 deg"])),
    # A length that is called wavelength keeps its lack of a range.
    op.Waveplate("1 mm", 0.009, P("wavelength", "500 nm")),
    *(op.CircularDiattenuator([0.9, 0.8], [0.1, 0.2]), OddlyNamed(0.5, 0.25, 0.75)),
]
WRITTEN = [
    (MIRROR, "r_s = { re = -0.5, im = 0.25 }"),
    (op.Mirror(0.1, P("r", 0.5j)), "default = { re = 0.0, im = 0.5 }"),
    (op.Medium(P("l", 0.2, unit="dm")), 'default = "2 dm"'),
    # Multiples with an offset, and crystals by their names.
    (op.Polarizer(2 * D + "10 deg"), '{ parameter = "d", scale = 2.0, offset = "10 deg" }'),
    *((op.Polarizer(D + 0.5), '{ parameter = "d", offset = '), (op.Polarizer(-D), '"-$d"')),
    (op.Mirror(-N / 2, 0.3), '{ parameter = "n", scale = -0.5 }'),
    (op.Medium(D + "2 mm"), 'offset = "2 mm" }'),
    (op.LayerStack([1.5, 2 * N], 0.3), '[1.5, { parameter = "n", scale = 2.0 }]'),
    (op.Interface(op.Material(1.5, N / 4), 0.3), 'k = { parameter = "n", scale = 0.25 } }'),
    (op.Waveplate.quarter("550 nm", "calcite", order=2), 'crystal = "calcite"'),
    (op.Medium("1 mm", dextrorotation=QUARTZ), 'crystal = "quartz"'),
]


@rows("element, written", [*((element, "") for element in ELEMENTS), *WRITTEN])
def test_an_element_is_written_and_read_back_and_drawn(element, written, tmp_path):
    path = chain([element], [1.0, 1.0, 0.0, 0.0])
    assert written in path.to_toml()
    again = read_back(path, tmp_path)
    assert again == path
    assert element.kind in draw(path)
    if "crystal" in written:
        light = [one.trace(wavelength="500 nm").stokes.tolist() for one in (path, again)]
        assert light[0] == light[1]


def test_amplitudes_links_and_cases_take_numbers_without_a_part_multiples_and_axes(tmp_path):
    text = chain([op.Mirror(-0.5 + 0.25j, 1.0)]).to_toml()
    text = text.replace("re = -0.5, im = 0.25", "re = -0.5")
    assert loaded(text, tmp_path) == chain([op.Mirror(-0.5, 1.0)])
    share = '{ parameter = "share", scale = 2, offset = -0.25 }'
    text = affine_text(share=share, azimuth='{ parameter = "d", scale = 3 }')
    path = loaded(text, tmp_path)
    assert path.trace().intensity == pytest.approx(0.375)
    np.testing.assert_allclose(path.trace(share=0.25).intensity, 0.125)
    crossed = op.Source(100, [1, 1, 0, 0]) >> op.Polarizer(P("a", 0.3)) >> op.Detector()
    text = crossed.to_toml() + '[cases.x]\nvalues = { a = ["vertical", "45 deg", "horizontal"] }\n'
    path = read(tomllib.loads(text))
    # Malus, at 90, 45 and 0 degrees.
    shares = path.with_defaults(**path.cases["x"].values).trace().intensity / 100.0
    np.testing.assert_allclose(shares, [0.0, 0.5, 1.0], atol=1e-15)
    with pytest.raises(op.OptipathError, match=r"diagonal, or give an angle such as '45 deg'$"):
        read(tomllib.loads(text.replace("vertical", "upright")))


def test_a_pair_of_numbers_for_an_index_is_refused(tmp_path):
    given = chain([op.Interface(1.5, 0.3)]).to_toml().replace("index = 1.5", "index = PAIR")
    with pytest.raises(
        op.errors.PathError, match=r"write \{ n = 0\.17, k = 3\.15 \} for one index, \{ n ="
    ):
        loaded(given.replace("PAIR", "[0.17, 3.15]"), tmp_path)
    one = loaded(given.replace("PAIR", "{ n = 0.17, k = 3.15 }"), tmp_path).trace()
    assert one == chain([op.Interface(op.Material(0.17, 3.15), 0.3)]).trace()
    text = given.replace("PAIR", "{ n = [0.17, 3.15] }")
    assert loaded(text, tmp_path).to_toml() == text
    assert loaded(text, tmp_path).trace().shape == (2,)


AFFINE = """
format = 1
parameters.d = { default = "20 deg", unit = "deg" }
parameters.share = { default = 0.5 }
elements.lamp = { kind = "source" }
elements.filter = { kind = "polarizer", angle = VALUE }
elements.grey = { kind = "attenuator", transmittance = SHARE }
elements.eye = { kind = "detector" }
links = [
    { from = "lamp.out", to = "filter.in", azimuth = AZIMUTH },
    { from = "filter.out", to = "grey.in" },
    { from = "grey.out", to = "eye.in" },
]
"""


def affine_text(value='"$d"', share='"$share"', azimuth='"0 deg"'):
    return AFFINE.replace("VALUE", value).replace("SHARE", share).replace("AZIMUTH", azimuth)


@rows(
    "value, degrees",
    [
        *(('"$d"', 20.0), ('"-$d"', -20.0), ('{ parameter = "d" }', 20.0)),
        ('{ parameter = "d", scale = 2, offset = "10 deg" }', 50.0),
        ('{ parameter = "d", scale = -0.5 }', -10.0),
        ('{ parameter = "d", offset = "-0.1 rad" }', 20.0 - np.degrees(0.1)),
    ],
)
def test_a_table_stands_for_a_multiple_with_an_offset(value, degrees, tmp_path):
    path = loaded(affine_text(value), tmp_path)
    # What a linear polariser lets through of unpolarised light is along its axis.
    half = np.radians(2 * degrees)
    expected = 0.25 * np.array([1.0, np.cos(half), np.sin(half), 0.0])
    np.testing.assert_allclose(path.trace().stokes, expected, rtol=1e-12, atol=1e-15)
    assert read_back(path, tmp_path) == path
    assert read_back(path, tmp_path).compose() == path.compose()


# h c in eV nm, CODATA 2018.
HC = 1239.841984e-9


METAL = "index = { cauchy = { coefficients = [1.5, 0.01] } }"
OF_METAL = chain([op.Interface(1.5, "30 deg")]).to_toml().replace("index = 1.5", METAL)
OF_FIELDS = chain([MIRROR, SLAB, PLATE]).to_toml()


def declaring(text):
    return f"{OF_METAL}\n[parameters.wavelength]\n{text}\n"


def test_a_wavelength_needs_no_unit_of_its_own_and_its_range_may_be_of_photon_energies(tmp_path):
    def declared(text):
        return loaded(declaring(text), tmp_path).parameters["wavelength"]

    for text, metres in (('"2.4 eV"', HC / 2.4), ('"516 nm"', 516e-9)):
        found = declared(f"default = {text}")
        assert (type(found), found.unit) == (op.Wavelength, "nm")
        assert found.default == pytest.approx(metres, rel=1e-9)
    assert declared('help = "light"').default is None
    of_python = op.Wavelength(minimum="2 eV", maximum="3 eV")
    for unit in ("", 'unit = "nm"'):
        found = declared(f'{unit}\nrange = ["2.0 eV", "3.0 eV"]')
        limits = [found.minimum, found.maximum]
        assert limits == pytest.approx([HC / 3.0, HC / 2.0], rel=1e-9)
        assert limits == [of_python.minimum, of_python.maximum]


MULTIPLES = [
    ('{ parameter = "d", scael = 2 }', "key 'scael' is unknown; did you mean 'scale'"),
    ('{ parameter = "dd" }', "parameter 'dd' is not declared; there are: d, share"),
    ('{ parameter = "$d" }', "parameter '$d' is not declared; did you mean 'd'"),
    *(("{ parameter = 3 }", "'parameter' must be a text"), ("{ scale = 2 }", "'parameter' is m")),
    ('{ parameter = "d", scale = 0 }', "a scale other than 0"),
    ('{ parameter = "d", scale = nan }', "finite real numbers"),
    ('{ parameter = "d", scale = [1, 2] }', ".scale: [1, 2] is not a number"),
    ('{ parameter = "d", scale = "2 deg" }', "'2 deg' has the unit 'deg', but a pure number"),
    ('{ parameter = "d", scale = "1j" }', "finite real numbers"),
    ('{ parameter = "d", scale = true }', "true is not a number"),
    ('{ parameter = "d", offset = 10 }', "10 has no unit, but an angle is asked for"),
    ('{ parameter = "d", offset = "10 nm" }', "'10 nm' is no angle"),
    ('{ parameter = "share", offset = "10 deg" }', "parameter 'share'"),
    ('{ crystal = "quartz" }', "gives no angle"),
]
FIELDS = [
    ("re = -0.5, im = 0.25", "im = 0.25", "elements.e0.r_s: 're' is missing"),
    ("re = -0.5, im = 0.25", "n = 1, k = 2", "key 'n' is unknown | key 'k' is unknown"),
    ("re = -0.5, im = 0.25", 're = "$a"', "parameter '$a' is not declared"),
    ("re = -0.5, im = 0.25", "re = 3", "e0.r_s is (3+0j); give"),
    ('"100 mm"', '"100 deg"', "'100 deg' is no length; use one of nm, um"),
    ('"100 mm"', "100", "100 has no unit, but a length is asked for; write '100 mm'"),
    ('"0.5 1/cm"', "0.5", "an inverse length is asked for; write '0.5 1/cm'"),
    ('"1 deg/mm"', '"1 deg"', "'1 deg' is no angle per length; use one of deg/um"),
    ('"0 1/cm"', '"1 1/cm"', "'e1' would amplify some light | give an absorption of 1.41"),
    ("= 0.009", '= { crystal = "quarz" }', "did you mean 'quartz'"),
    ("= 0.009", "= { crystal = 3 }", "'crystal' must be a text, not 3"),
    ("= 0.009", '= { crystal = "quartz", orders = 3 }', "'orders'"),
]
WAVELENGTHS = [
    ("default = 516", "default: 516 has no unit, but a length is asked for; write '516 nm'"),
    ("range = [400, 700]", "range: 400 has no unit"),
    ('default = "30 deg"', "parameter 'wavelength': '30 deg' is no length"),
    ('default = "2.4 ev"', "did you mean 'eV'?"),
    ('unit = "eV"\ndefault = 2.4', "unit 'eV' is unknown; there are: deg"),
    ('range = ["700 nm", "400 nm"]', "begin with the lower end"),
]
FAULTS = [(affine_text(value), told) for value, told in MULTIPLES]
FAULTS += [(OF_FIELDS.replace(old, new), told) for old, new, told in FIELDS]
FAULTS += [(declaring(text), told) for text, told in WAVELENGTHS]


@rows("text, told", FAULTS)
def test_what_is_wrong_with_a_table_a_field_or_a_wavelength_is_told_with_a_cure(
    text, told, tmp_path
):
    assert text != OF_FIELDS
    with pytest.raises(op.OptipathError) as error:
        loaded(text, tmp_path).trace()
    for part in told.split(" | "):
        assert part in str(error.value)


BY_HAND = """
format = 1
description = "a lamp, a mirror, an eye"
parameters.theta = { default = "30 deg", unit = "deg", range = ["0 deg", "90 deg"] }
elements.lamp = { kind = "source" }
elements.mirror = { kind = "interface", index = { n = 1.2, k = 7.0 }, incidence = "$theta" }
elements.eye = { kind = "detector" }
links = [
    { from = "lamp.out", to = "mirror.in" },
    { from = "mirror.reflected", to = "eye.in", azimuth = "10 deg" },
]
cases.steep = { values = { theta = "80 deg" } }
"""


@rows("index", [op.Material(1.2, 7.0), 1.2 + 7.0j])
def test_a_path_built_in_python_equals_the_one_read(index):
    path = op.PathGraph("a lamp, a mirror, an eye", {"steep": op.Case({"theta": np.radians(80.0)})})
    theta = P("theta", np.radians(30.0), unit="deg", minimum=0.0, maximum=np.pi / 2)
    lamp = path.add("lamp", op.Source())
    lamp >> path.add("mirror", op.Interface(index, theta))
    path.add("eye", op.Detector())
    path.connect("mirror.reflected", "eye.in", azimuth=np.radians(10.0))
    found = read(tomllib.loads(BY_HAND))
    assert isinstance(index, complex) or found == path
    assert found.compose() == path.compose()


def sorts_of_values():
    """Paths with numbers of NumPy, arrays, words, notes, frames, and a unit that is not given."""
    tenth, up = np.float64(0.1), {"up": np.float64(0.3)}
    q = P("q", tenth, unit="deg", minimum=np.float64(0.0), words=up)
    m = P("m", default=[1 + 2j, 2 + 1j])
    numbers = op.Source() >> op.Interface(m, q, outside=op.Material(1.2)) >> op.Detector()
    numbers.cases["one"] = op.Case({"q": tenth})
    word = P("a", [0.1, "up"], unit="rad", words={"up": 0.5}, help="é")
    elements = {
        "lamp": op.Source(stokes=[[1.0, 0, 0, 1.0], [1.0, 0, 0, 0]]),
        "turn": op.Rotator(-word),
        "glass": op.Interface(P("m", 1.5 + 0.2j), [0.1, 0.2], outside=1.1),
        "metal": op.Interface([1 + 1j, 2 + 1j], 0.3, 1.1, azimuth=word),
        "any": op.MuellerElement(np.eye(4)),
        "eye": op.Detector(reads="linear"),
    }
    links = "lamp -> turn, turn -> glass, glass -> metal, metal -> any, any -> eye"
    case = op.Case({"a": "up"}, note='a "note"\n')
    words = wired(elements, links, description="all sorts", cases={"one": case})
    frames = op.PathGraph()
    lamp = frames.add("lamp", op.Source(), {"out": op.Frame()})
    lamp >> frames.add("filter", op.Polarizer(), {"in": op.Frame().turned(0.3)}) >> op.Detector()
    unitless = chain([op.Rotator(P("theta", 0.5))])
    assert unitless.parameters["theta"].unit == "deg"
    return [numbers, words, frames, unitless]


@rows("path", sorts_of_values())
def test_all_sorts_of_values_are_written_and_read_back(path):
    assert "np." not in path.to_toml()
    copy = read(tomllib.loads(path.to_toml()))
    assert copy == path
    assert copy.compose() == path.compose()
    np.testing.assert_array_equal(copy.trace().stokes, path.trace().stokes)
