import numpy as np
import pytest

import optipath as op
from measured_hemispheres import measured
from pictures import faults_of, texts_of
from tables import rows

figures = pytest.importorskip("matplotlib.figure")
colours = pytest.importorskip("matplotlib")

QUANTITIES = ["S0", "S1", "S2", "S3", "DoP", "DoLP", "AoP", "difference", "ADM", "MDM"]
SIGNED = "S1", "S2", "S3", "difference"


@pytest.fixture(scope="module")
def glass():
    return measured("glass on glass")


def image_of(ax):
    (image,) = ax.get_images()
    return image


@rows("quantity", ["S0", "S3", "AoP", "ADM"])
def test_maps_are_drawn_without_texts_over_one_another_or_cut(glass, quantity):
    ax = op.plots.hemisphere(glass, quantity, source=[1, 0, 0, 0])
    assert faults_of(ax.figure) == []
    words = {text.get_text() for text in texts_of(ax.figure)}
    assert {"30°", "60°", "θ = 90°", "φ = 0°", "90°", "180°", "specular direction, 60°"} <= words
    assert f"{quantity}, reflected, incidence 60°" in words


@rows("quantity", QUANTITIES)
def test_colours_of_what_has_a_sign_go_apart_from_zero(glass, quantity):
    image = image_of(op.plots.hemisphere(glass, quantity))
    low, high = image.get_clim()
    assert high > 0.0
    assert low == {"AoP": -90.0}.get(quantity, -high if quantity in SIGNED else 0.0)
    assert image.norm(0.0) == pytest.approx(0.5 if low < 0.0 else 0.0, abs=1e-12)


def test_light_is_per_steradian_and_blank_beyond_the_horizon(glass):
    image = image_of(op.plots.hemisphere(glass, "S0"))
    shares = glass.dataset.mueller.values[0, :, :, 0, 0, 0]
    area = glass.sensor.solid_angle
    drawn = image.get_array()
    np.testing.assert_array_equal(drawn.mask, area == 0.0)
    np.testing.assert_allclose((drawn * area).sum(), shares.sum(), rtol=1e-12)
    seen = image.get_clip_path().get_fully_transformed_path()
    inside, outside = image.axes.transData.transform([(0.7, 0.7), (0.72, 0.72)])
    assert seen.contains_point(inside)
    assert not seen.contains_point(outside)


def test_the_picture_is_as_it_is_seen_from_above(glass):
    """Light that goes on as it came is on the right, and y upwards."""
    image = image_of(op.plots.hemisphere(glass, "S0"))
    assert image.origin == "lower"
    assert tuple(image.get_extent()) == (-1.0, 1.0, -1.0, 1.0)
    drawn = image.get_array().filled(0.0)
    x = (drawn * glass.sensor.coordinates).sum() / drawn.sum()
    assert 0.5 < x < 0.9


@rows("projection, place", [("equidistant", 2 / 3), ("equal-area", 0.5**0.5)])
def test_the_specular_direction_is_marked_where_the_projection_has_it(projection, place):
    ax = op.plots.hemisphere(measured("glass on glass", projection=projection))
    marks = [line for line in ax.get_lines() if line.get_marker() == "+"]
    assert marks
    for mark in marks:
        np.testing.assert_allclose((*mark.get_xdata(), *mark.get_ydata()), (place, 0.0))


def test_light_that_goes_through_is_marked_where_it_is_refracted():
    ax = op.plots.hemisphere(measured("clear"), side="transmitted")
    refracted = np.degrees(np.arcsin(np.sin(np.radians(60.0)) / 1.5))
    (mark, *_) = (line for line in ax.get_lines() if line.get_marker() == "+")
    assert mark.get_xdata()[0] == pytest.approx(refracted / 90.0)
    assert ax.get_title() == "S0, transmitted, incidence 60°"


def test_pixels_are_hatched_where_they_are_masked_or_not_known_well_enough(glass):
    ax = op.plots.hemisphere(glass, "ADM", mask={"brighter_than": 0.5})
    adm = glass.adm(brighter_than=0.5)
    image = image_of(ax)
    np.testing.assert_array_equal(image.get_array().mask, np.isnan(adm.values))
    np.testing.assert_allclose(image.get_array().compressed(), 100 * adm.values[adm.notnull()])
    assert any(patch.get_hatch() for patch in ax.patches)
    told = " ".join(ax.get_legend().get_texts()[-1].get_text().split())
    assert told == f"masked; seen are pixels of {adm.attrs['mask']}"
    assert not any(patch.get_hatch() for patch in op.plots.hemisphere(glass).patches)
    error = glass.dolp().se.values[0, :, :, 0]
    image = image_of(op.plots.hemisphere(glass, "DoLP", known_to=0.02))
    np.testing.assert_array_equal(~image.get_array().mask, error <= 0.02)


def test_the_source_is_told_and_seen(glass):
    ax = op.plots.hemisphere(glass, "S3", source=[1, 0, 0, -1])
    assert ax.get_title() == "S3, reflected, incidence 60°\nsource (1, 0, 0, -1)"
    stokes = glass.stokes([1, 0, 0, -1]).values[0, :, :, 0, 3]
    there = glass.sensor.solid_angle > 0.0
    expected = stokes[there] / glass.sensor.solid_angle[there]
    np.testing.assert_allclose(image_of(ax).get_array().compressed(), expected)


def test_one_of_several_wavelengths_is_drawn():
    gold = measured("gold")
    ax = op.plots.hemisphere(gold, "S0", wavelength="600 nm")
    assert ax.get_title() == "S0, reflected, incidence 60°, 600 nm"
    shares = gold.dataset.mueller.values[0, :, :, 1, 0, 0]
    drawn = image_of(ax).get_array() * gold.sensor.solid_angle
    np.testing.assert_allclose(drawn.sum(), shares.sum(), rtol=1e-12)
    title = op.plots.hemisphere(gold, "ADM", mask={"noise": None}).get_title()
    assert title == "ADM, reflected, incidence 60°, 2 wavelengths"


def test_axes_that_are_given_are_drawn_into_and_settings_stay(glass):
    ax = figures.Figure().add_subplot()
    assert op.plots.hemisphere(glass, "S0", ax) is ax
    before = dict(colours.rcParams)
    op.plots.hemisphere(glass, "S0")
    assert dict(colours.rcParams) == before


@rows(
    "quantity, given, sentence",
    [
        ("DoL", {}, "quantity 'DoL' is unknown; did you mean 'DoLP'"),
        ("S0", {"side": "transmitted"}, "no side is called 'transmitted'"),
        ("S0", {"mask": {"noise": 1}}, "mask is given, but S0 has none; leave it out"),
        ("ADM", {"mask": {"brigter_than": 1}}, "unknown; did you mean 'brighter_than'"),
        ("difference", {"mask": {"noise": 1}}, "mask 'noise' is unknown"),
        ("DoLP", {"largest": 0.5}, "largest is given, but colours of DoLP end at their own"),
        ("S0", {"largest": 0.0}, "largest is 0.0; give a number above 0"),
        ("S0", {"known_to": "much"}, "known_to is 'much'; give a number above 0"),
        ("S0", {"source": [1, 2, 0, 0]}, "polarised by more than 100 %"),
        ("S0", {"wavelength": 5e-7}, "nothing depends on it; leave it out"),
        ("ADM", {"wavelength": 5e-7}, "ADM is of all wavelengths together"),
        ("difference", {"source": [1, 1, 0, 0]}, "of unpolarised light; leave source out"),
    ],
)
def test_what_does_not_go_together_is_refused(quantity, given, sentence):
    with pytest.raises(op.SurfaceError, match=sentence):
        op.plots.hemisphere(measured("mirror"), quantity, **given)


@rows(
    "wavelength, sentence",
    [
        (None, "wavelength is missing; give one of 500 nm and 600 nm"),
        ("550 nm", "550 nm has not been measured; give a wavelength of 500 nm and 600 nm"),
    ],
)
def test_a_wavelength_that_was_not_measured_is_refused(wavelength, sentence):
    with pytest.raises(op.SurfaceError, match=sentence):
        op.plots.hemisphere(measured("gold"), wavelength=wavelength)


def test_all_faults_are_told_at_once(glass):
    with pytest.raises(op.SurfaceError) as told:
        op.plots.hemisphere(glass, "ADM", side="above", wavelength=5e-7, source=[0, 0, 0, 0])
    assert len(told.value.faults) == 3
    with pytest.raises(op.OptipathError, match="give Axes of Matplotlib, or leave it out"):
        op.plots.hemisphere(glass, "S0", 3)


@rows("wrong", [None, 3, "sample"])
def test_what_is_no_hemisphere_is_refused(wrong):
    with pytest.raises(op.SurfaceError, match="is no Hemisphere; give what op"):
        op.plots.hemisphere(wrong)


@rows("mask", [0.5, 0.0, "noise", np.ones(2)])
def test_a_mask_that_is_no_mapping_is_refused(glass, mask):
    with pytest.raises(op.SurfaceError, match=r"give a mapping, such as {'brighter_than': 0\.5}"):
        op.plots.hemisphere(glass, "ADM", mask=mask)
    with pytest.raises(op.SurfaceError, match="S0 has none; leave it out"):
        op.plots.hemisphere(glass, mask=mask)
