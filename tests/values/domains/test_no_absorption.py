"""Media that must not absorb, and what is said of those that do."""

import re

import pytest

import optipath as op
from tables import rows

GRID = [4e-7, 5e-7, 6e-7]
ABSORBING = op.Material.tabulated(GRID, 1.5, [1e-8, 2e-8, 3e-8], name="glass")
PARTLY = op.Material.tabulated(GRID, 1.5, [0.0, 2e-8, 3e-8], name="glass")
CONSTANT = op.Material(1.5, 1e-8)


def layer(medium):
    return op.LayerStack([1.0, medium, 1.0], 0.3)


def front(medium):
    return op.LayerStack([medium, 1.5, 1.0], 0.3)


def way(medium):
    down = [[0, 0, 3], [0, 0, 2], [0, 0, 0]]
    return op.path_from_vertices(down, [medium], events="T")


PLACES = pytest.mark.parametrize("place", [layer, front, way])
CURE = "take the medium without its k, such as Material(glass.n)"


@PLACES
@rows("medium", [ABSORBING, CONSTANT])
def test_a_medium_that_absorbs_everywhere_is_refused_when_it_is_placed(place, medium):
    with pytest.raises(op.OptipathError, match=re.escape(CURE)) as refused:
        place(medium)
    assert "another wavelength" not in str(refused.value)


@PLACES
@rows("medium", [ABSORBING, CONSTANT])
def test_the_cure_of_a_medium_that_absorbs_works(place, medium):
    assert place(op.Material(medium.n)) is not None


def test_a_medium_that_absorbs_at_some_wavelengths_is_refused_there_with_the_same_cure():
    path = op.Source() >> front(PARTLY) >> op.Detector()
    assert path.trace(wavelength="400 nm").intensity > 0.0
    with pytest.raises(op.ParameterError, match=r"k of glass at 500 nm is 2e-08, and") as refused:
        path.trace(wavelength="500 nm")
    assert str(refused.value).endswith(CURE)


def test_a_table_has_not_the_reason_of_the_formula_beside_it(tmp_path):
    page = tmp_path / "page.yml"
    page.write_text(
        "DATA:\n"
        "  - type: formula 1\n"
        "    wavelength_range: 0.4 0.6\n"
        "    coefficients: 0 1.0 0.01\n"
        "  - type: tabulated k\n"
        "    data: |\n"
        "      0.4 0\n"
        "      0.5 1e-8\n"
        "      0.6 1e-8\n"
    )
    path = op.Source() >> front(op.Material.from_yaml(page)) >> op.Detector()
    with pytest.raises(op.ParameterError) as refused:
        path.trace(wavelength="500 nm")
    assert "formula" not in str(refused.value)
