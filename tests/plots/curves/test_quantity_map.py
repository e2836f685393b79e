"""Maps of the light of a path over two of its parameters."""

import numpy as np
import pytest
from matplotlib.figure import Figure

import optipath as op
from optipath.errors import OptipathError
from optipath.plots import quantity_map
from optipath.plots.curves.drawn_quantity import drawn_quantity
from pictures import faults_of
from tables import rows

FEW = {"x_values": "0 deg:180 deg:19", "y_values": "0.5, 1, 2"}


def image(ax):
    (mesh,) = ax.collections
    return mesh


@pytest.fixture(scope="module")
def malus():
    return quantity_map(op.load_preset("malus"), "angle", "intensity", **FEW)


def test_a_map_has_its_values_in_order_with_the_colours_of_its_quantity(malus):
    law = 0.5 * np.cos(np.radians(np.linspace(0, 180, 19))) ** 2
    expected = np.outer([0.5, 1.0, 2.0], law)
    np.testing.assert_allclose(image(malus).get_array(), expected, atol=1e-12)
    limits = *malus.get_xlim(), *malus.get_ylim()
    assert limits == pytest.approx((0.0, 180.0, 0.5, 2.0))
    given = FEW | {"y_values": "2, 0.5, 1"}
    other = quantity_map(op.load_preset("malus"), "angle", "intensity", **given)
    np.testing.assert_array_equal(image(malus).get_array(), image(other).get_array())
    mesh = image(malus)
    assert (mesh.cmap.name, mesh.norm.vmin, mesh.norm.vmax) == ("viridis", 0.0, 1.0)
    assert malus.get_lines()[-1].get_xydata().tolist() == [pytest.approx([30.0, 1.0])]
    assert malus.get_title() == "+ by default: angle 30°, intensity 1"


@rows(
    "quantity, colours, low, high",
    [
        ("S0", "viridis", 0.0, 1.0),
        ("dolp", "viridis", 0.0, 1.0),
        ("S1", "RdBu_r", -1.0, 1.0),
        ("ellipticity", "RdBu_r", -1.0, 1.0),
        ("AoP", "twilight", -90.0, 90.0),
        ("delta", "twilight", -180.0, 180.0),
    ],
)
def test_colours_are_in_order_apart_from_zero_or_round(quantity, colours, low, high):
    scale = drawn_quantity(quantity).colours(np.array([[0.0, 0.2], [0.5, 1.0]]))
    assert scale.colours == colours
    assert (scale.norm.vmin, scale.norm.vmax) == (low, high)


def test_places_without_the_quantity_are_grey_and_the_bar_says_so():
    path = op.load_preset("senarmont")
    ax = quantity_map(
        path, "analyzer", "retardance", "aop", x_values="0 deg, 90 deg", y_values="0 deg, 180 deg"
    )
    assert image(ax).get_array().mask.any()
    (bar,) = [side for side in ax.figure.axes if side is not ax]
    assert bar.get_ylabel().endswith("(grey: none)")


def test_what_the_path_refuses_is_grey_where_nobody_gave_it(monkeypatch):
    monkeypatch.setattr("optipath.plots.curves.quantity_map._COUNT", 13)
    # No dye is stronger than the mean absorption.
    path = op.load_preset("dichroic-sheet")
    numbers = image(quantity_map(path, "absorption", "dichroism")).get_array()
    assert numbers.mask.any()
    assert not numbers.mask.all()
    with pytest.raises(OptipathError, match="dichroism"):
        quantity_map(path, "absorption", "dichroism", y_values="-2 1/um:2 1/um:5")


@rows("size", [(6.4, 4.8), (3.2, 2.4)])
def test_no_text_is_over_another_or_cut_at_either_size(size):
    figure = Figure(figsize=size, layout="constrained")
    path = op.load_preset("copper-gold-spectrum")
    given = {"x_values": "400 nm:700 nm:9", "y_values": "0 deg:90 deg:9"}
    quantity_map(path, "wavelength", "delta", "AoP", figure.add_subplot(), **given)
    assert faults_of(figure) == []


def test_one_parameter_twice_and_several_quantities_are_told():
    path = op.load_preset("malus")
    with pytest.raises(OptipathError, match="both axes are 'angle'; give two parameters"):
        quantity_map(path, "angle", "angle")
    with pytest.raises(OptipathError, match="give one name, such as 'S0'"):
        quantity_map(path, "angle", "intensity", ("S0", "S1"))
