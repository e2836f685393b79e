"""Curves of what a boundary reflects."""

import numpy as np
import pytest
from matplotlib.figure import Figure

import optipath as op
from optipath.errors import OptipathError
from optipath.plots import reflection
from optipath.plots.curves.marked_angles import marked_angles, reflected
from pictures import faults_of
from tables import rows


def marks(index):
    return {each.name: float(np.degrees(each.angle)) for each in marked_angles(index)}


def curves(ax):
    return {line.get_label(): line.get_xydata() for line in ax.get_lines()}


@pytest.fixture(scope="module")
def glass():
    return curves(reflection(1.5))


def test_curves_are_those_of_the_amplitudes(glass):
    for name in ("$R_s$", "$R_p$", "$R$ unpolarised"):
        assert glass[name][0].tolist() == pytest.approx([0.0, 0.04])
        assert glass[name][-1].tolist() == pytest.approx([90.0, 1.0])
    found = curves(reflection(0.6 + 2.1j, outside=1.33))
    x = np.radians(found["$R_s$"][:, 0])
    r_s, r_p, _, _ = op.fresnel_amplitudes(0.6 + 2.1j, np.cos(x), np.sin(x), 1.33)
    np.testing.assert_allclose(found["$R_s$"][:, 1], np.abs(r_s) ** 2, atol=1e-12)
    np.testing.assert_allclose(found["$R_p$"][:, 1], np.abs(r_p) ** 2, atol=1e-12)


def test_brewsters_and_critical_angles_are_marked_where_there_are_any(glass):
    assert marks(1.5) == {"Brewster's angle": pytest.approx(56.3099, abs=1e-4)}
    assert "Brewster's angle 56.31°" in glass
    assert reflected(1.5, np.arctan(1.5)).dolp == pytest.approx(1.0)
    assert marks(1.0 / 1.5) == {
        "Brewster's angle": pytest.approx(33.6901, abs=1e-4),
        "critical angle": pytest.approx(41.8103, abs=1e-4),
    }
    assert "critical angle 41.81°" in curves(reflection(1.0, outside=1.5))
    assert [*marks(1.52 + 1e-8j)] == ["Brewster's angle"]
    assert marks(2j) == {}


@rows("index", [0.608 + 2.12j, 3.882 + 0.019j, 1.5 + 1.0j])
def test_of_metals_the_least_p_and_the_highest_polarisation_are_found(index):
    found = marks(index)
    grid = np.radians(np.linspace(0.0, 90.0, 90_001))
    least = np.degrees(grid[np.argmin(reflected(index, grid).p)])
    most = np.degrees(grid[np.nanargmax(reflected(index, grid).dolp)])
    assert found == {
        "pseudo-Brewster angle": pytest.approx(least, abs=2e-3),
        "highest DoLP": pytest.approx(most, abs=2e-3),
    }


def test_a_material_is_given_by_its_name_or_formula_and_a_wavelength():
    by_name = reflection("gold", wavelength="516 nm")
    at = op.Material.named("gold").at("516 nm").refractive_index
    np.testing.assert_array_equal(curves(by_name)["$R_p$"], curves(reflection(at))["$R_p$"])
    assert "gold at 516 nm" in by_name.get_title()
    # n = 1.5 + 0.004 / 0.5^2, in micrometres.
    ax = reflection(op.Material.cauchy([1.5, 0.004]), wavelength="500 nm")
    assert ax.get_title() == "reflection: n = 1.516 in n = 1"
    with pytest.raises(OptipathError, match="depends on the wavelength; give one"):
        reflection(op.Material.cauchy([1.5, 0.004]))


@rows(
    "given, title",
    [
        ({"index": 1.00001, "outside": 1.00002}, "n = 1.00001 in n = 1.00002"),
        ({"index": "0.2+3.4j", "outside": "1.33"}, "n = 0.2 + 3.4i in n = 1.33"),
    ],
)
def test_the_title_has_numbers_that_differ_and_no_number_for_a_name(given, title):
    assert reflection(**given).get_title() == f"reflection: {title}"


@rows("size", [(6.4, 4.4), (3.2, 2.2)])
@rows(
    "given",
    [
        {"index": 1.00000001, "outside": 1.00000002},
        {"index": "gold", "outside": "water", "wavelength": "516 nm"},
    ],
)
def test_no_text_is_over_another_or_cut_at_either_size(given, size):
    figure = Figure(figsize=size, layout="constrained")
    reflection(ax=figure.add_subplot(), **given)
    assert faults_of(figure) == []


@rows(
    "given, told",
    [
        ({"index": "gold"}, "index 'gold' depends on the wavelength; give one"),
        ({"index": 1.5, "wavelength": "500 nm"}, "no index depends on it; leave it out"),
        ({"index": 1.5, "outside": 1.5}, "are both 1.5, and nothing is reflected"),
        ({"index": 1.5, "outside": 1.0 + 1.0j}, "give the index of a clear medium"),
        ({"index": np.array([1.5, 1.6])}, "a picture is of one index"),
        ({"index": -1.0}, "index"),
        ({"index": None}, "index"),
        ({"index": "gold", "wavelength": 516.0}, "wavelength"),
        ({"index": "gold", "wavelength": ["500 nm", "600 nm"]}, "a picture is of one"),
        ({"index": "gold", "wavelength": [500e-9]}, "a picture is of one"),
        ({"index": 0.0}, "index is 0.0; give .* not both 0"),
        (
            {"index": "gold", "wavelength": "1e-9 m"},
            "'gold' is not known at 1 nm; give a wavelength within 187.9 nm .. 1937 nm$",
        ),
    ],
)
def test_what_is_wrong_is_told(given, told):
    with pytest.raises(OptipathError, match=told):
        reflection(**given)
