"""Pictures of measured hemispheres: maps, panels of discs, and curves in the plane of incidence."""

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.figure import Figure

import optipath as op
from measured_hemispheres import measured
from optipath.plots import beside_facets, differences, hemisphere, in_plane, mueller_hemisphere
from optipath.surfaces import Sensor, single_scattering
from pictures import faults_of, texts_of
from rough_samples import rough
from tables import rows

QUANTITIES = ["S0", "S1", "S2", "S3", "DoP", "DoLP", "AoP", "difference", "ADM", "MDM"]
SIGNED = "S1", "S2", "S3", "difference"
REFRACTED = np.degrees(np.arcsin(np.sin(np.radians(60.0)) / 1.5))


@pytest.fixture(scope="module")
def glass():
    return measured("glass on glass")


def image_of(ax):
    (image,) = ax.get_images()
    return image


def pixels_of(ax):
    return image_of(ax).get_array()


def words_of(ax):
    return {text.get_text() for text in texts_of(ax.figure)}


def curves_of(ax):
    return [line for line in ax.get_lines() if len(line.get_xdata()) > 2]


def curve_of(ax):
    return curves_of(ax)[0]


@rows("quantity", QUANTITIES)
def test_maps_have_clear_texts_and_colours_that_go_apart_from_zero_where_there_is_a_sign(
    glass, quantity
):
    ax = hemisphere(glass, quantity, source=[1, 0, 0, 0])
    if quantity in {"S0", "S3", "AoP", "ADM"}:
        assert faults_of(ax.figure) == []
        words = {"30°", "60°", "θ = 90°", "φ = 0°", "90°", "180°", "specular direction, 60°"}
        assert words | {f"{quantity}, reflected, incidence 60°"} <= words_of(ax)
    low, high = image_of(ax).get_clim()
    assert high > 0.0
    assert low == {"AoP": -90.0}.get(quantity, -high if quantity in SIGNED else 0.0)
    assert image_of(ax).norm(0.0) == pytest.approx(0.5 if low < 0.0 else 0.0, abs=1e-12)


def test_light_is_per_steradian_as_it_is_seen_from_above_and_blank_beyond_the_horizon(glass):
    image = image_of(hemisphere(glass, "S0"))
    area, drawn = glass.sensor.solid_angle, image.get_array()
    np.testing.assert_array_equal(drawn.mask, area == 0.0)
    shares = glass.dataset.mueller.values[0, :, :, 0, 0, 0]
    np.testing.assert_allclose((drawn * area).sum(), shares.sum(), rtol=1e-12)
    seen = image.get_clip_path().get_fully_transformed_path()
    inside, outside = image.axes.transData.transform([(0.7, 0.7), (0.72, 0.72)])
    assert (seen.contains_point(inside), seen.contains_point(outside)) == (True, False)
    # Light that goes on as it came is on the right, and y upwards.
    assert (image.origin, *image.get_extent()) == ("lower", -1.0, 1.0, -1.0, 1.0)
    drawn = drawn.filled(0.0)
    assert 0.5 < (drawn * glass.sensor.coordinates).sum() / drawn.sum() < 0.9


@rows(
    "name, projection, side, place",
    [
        ("glass on glass", "equidistant", "reflected", 2 / 3),
        ("glass on glass", "equal-area", "reflected", 0.5**0.5),
        ("clear", "equidistant", "transmitted", REFRACTED / 90.0),
    ],
)
def test_the_specular_or_refracted_direction_is_marked_where_it_is(name, projection, side, place):
    ax = hemisphere(measured(name, projection=projection), side=side)
    marks = [line for line in ax.get_lines() if line.get_marker() == "+"]
    assert marks
    for mark in marks:
        np.testing.assert_allclose((*mark.get_xdata(), *mark.get_ydata()), (place, 0.0))
    assert ax.get_title() == f"S0, {side}, incidence 60°"


def test_pixels_are_hatched_where_they_are_masked_or_not_known_well_enough(glass):
    ax = hemisphere(glass, "ADM", mask={"brighter_than": 0.5})
    adm, drawn = glass.adm(brighter_than=0.5), pixels_of(ax)
    np.testing.assert_array_equal(drawn.mask, np.isnan(adm.values))
    np.testing.assert_allclose(drawn.compressed(), 100 * adm.values[adm.notnull()])
    assert any(patch.get_hatch() for patch in ax.patches)
    told = " ".join(ax.get_legend().get_texts()[-1].get_text().split())
    assert told == f"masked; seen are pixels of {adm.attrs['mask']}"
    assert not any(patch.get_hatch() for patch in hemisphere(glass).patches)
    error = glass.dolp().se.values[0, :, :, 0]
    drawn = pixels_of(hemisphere(glass, "DoLP", known_to=0.02))
    np.testing.assert_array_equal(~drawn.mask, error <= 0.02)


def test_the_source_the_wavelength_and_axes_that_are_given_are_drawn_and_settings_stay(glass):
    ax = hemisphere(glass, "S3", source=[1, 0, 0, -1])
    assert ax.get_title() == "S3, reflected, incidence 60°\nsource (1, 0, 0, -1)"
    stokes, area = glass.stokes([1, 0, 0, -1]).values[0, :, :, 0, 3], glass.sensor.solid_angle
    there = area > 0.0
    np.testing.assert_allclose(pixels_of(ax).compressed(), stokes[there] / area[there])
    gold = measured("gold")
    ax = hemisphere(gold, "S0", wavelength="600 nm")
    assert ax.get_title() == "S0, reflected, incidence 60°, 600 nm"
    drawn = (pixels_of(ax) * gold.sensor.solid_angle).sum()
    np.testing.assert_allclose(
        drawn, gold.dataset.mueller.values[0, :, :, 1, 0, 0].sum(), rtol=1e-12
    )
    title = hemisphere(gold, "ADM", mask={"noise": None}).get_title()
    assert title == "ADM, reflected, incidence 60°, 2 wavelengths"
    ax, before = Figure().add_subplot(), dict(mpl.rcParams)
    assert hemisphere(glass, "S0", ax) is ax
    assert dict(mpl.rcParams) == before
    axes = Figure().subplots(1, 3)
    assert [*differences(measured("silver"), axes)] == [*axes]
    assert axes[0].figure.get_suptitle() == ""


# Panels of discs.


def test_every_element_of_a_mueller_matrix_has_its_map():
    silver = measured("silver")
    panel = mueller_hemisphere(silver, known_to=0.05)
    assert panel.shape == (4, 4)
    over = silver.own.estimate(lambda n: silver.matrices(n) / silver.matrices(n)[..., :1, :1])
    value, error = (each[0, :, :, 0] for each in over)
    for place in [(0, 1), (1, 0), (2, 3), (3, 3)]:
        ax, drawn = panel[place], pixels_of(panel[place])
        assert ax.get_title() == "M{}{} / M00".format(*place)
        assert image_of(ax).get_clim() == (-1.0, 1.0)
        known = error[:, :, *place] <= 0.05
        np.testing.assert_array_equal(~drawn.mask, known)
        np.testing.assert_array_equal(drawn.compressed(), value[:, :, *place][known])
    told = "hatched: no light, or not known to 0.05"
    assert any(told in text for text in words_of(panel[0, 0]))


@pytest.mark.slow
def test_elements_of_a_mueller_matrix_are_drawn_where_they_are_known_to_a_tenth():
    silver = measured("silver")
    usual, given = (mueller_hemisphere(silver, known_to=each)[1, 0] for each in (None, 0.1))
    np.testing.assert_array_equal(pixels_of(usual).mask, pixels_of(given).mask)


def test_light_with_and_without_polarisation_has_one_scale_and_the_model_is_beside_photons(glass):
    panel = differences(glass)
    assert faults_of(panel[0].figure) == []
    limits = [image_of(ax).get_clim() for ax in panel]
    assert limits[0] == limits[1]
    assert limits[2][0] == -limits[2][1]
    polarised, scalar, apart = map(pixels_of, panel)
    np.testing.assert_allclose(polarised - scalar, apart, rtol=0, atol=1e-12)
    total = (scalar * glass.sensor.solid_angle).sum()
    np.testing.assert_allclose(total, glass.scalar[0][0].sum(), rtol=1e-12)
    # The model stands beside photons that are scattered once.
    panel = beside_facets(measured("silver", events=1))
    assert [ax.get_title() for ax in panel[:, 3]] == ["S3, photons", "S3, model", "S3, difference"]
    # Of an unpolarised source nothing that is reflected once is circular (M. Wang et al. 2017).
    assert np.abs(pixels_of(panel[1, 3])).max() < 1e-12
    photons, model, apart = map(pixels_of, panel[:, 0])
    np.testing.assert_allclose(apart, 100.0 * (photons - model) / model.max(), atol=1e-9)
    assert np.abs(apart).mean() < 3.0


# Curves in the plane of incidence.


@rows("quantity", QUANTITIES[:8])
def test_every_quantity_has_a_curve_with_names_and_units(glass, quantity):
    ax = in_plane(glass, quantity)
    assert ax.get_title() == f"{quantity}, reflected, incidence 60°"
    assert ax.get_xlabel() == "exit angle to the normal (°)"
    assert ax.get_ylabel()
    assert len(curve_of(ax).get_xdata()) == 16


def test_several_curves_look_otherwise_and_have_their_names(glass):
    ax = in_plane({"glass": glass, "silver": measured("silver")}, "DoLP")
    assert faults_of(ax.figure) == []
    assert {"glass", "silver"} <= words_of(ax)
    assert len({line.get_color() for line in curves_of(ax)}) == 2
    assert len({line.get_linestyle() for line in curves_of(ax)}) == 2  # In print, too.
    ax = in_plane(measured("silver"), "S0")
    in_plane({"glass": glass}, "S0", ax)
    first, second = (line.get_color() for line in curves_of(ax))
    assert first != second
    several = {name: measured(name) for name in ("silver", "mirror")}
    ax = in_plane(several, "S3", source=[1, 0, 1, 0])
    assert ax.get_title() == "S3, reflected, in the plane of incidence\nsource (1, 0, 1, 0)"
    assert faults_of(ax.figure) == []


def test_bands_reach_two_errors_up_and_down_angles_go_round_and_a_smooth_sample_has_its_line():
    silver = measured("silver")
    ax = in_plane(silver, "S0")
    middle, area = slice(7, 9), silver.sensor.solid_angle[7:9].sum(axis=0)
    mean, error = silver.own.estimate(
        lambda n: silver.matrices(n)[0, middle, :, 0, 0, 0].sum(axis=0) / area
    )
    np.testing.assert_allclose(curve_of(ax).get_ydata(), mean)
    (band,) = (each.get_paths()[0].vertices for each in ax.collections)
    np.testing.assert_allclose(band[:, 1].max(), (mean + 2.0 * error).max())
    # An angle that comes round is no line across, and a smooth sample has its line.
    ax = in_plane(measured("silver"), "AoP", source=(1.0, -0.9, 0.1, 0.0), known_to=90.0)
    steps = np.abs(np.diff(curve_of(ax).get_ydata()))
    assert not np.any(steps[~np.isnan(steps)] > 90.0)
    ax = in_plane(measured("clear"), side="transmitted")
    (line, *_) = (line for line in ax.get_lines() if len(line.get_xdata()) == 2)
    np.testing.assert_allclose(line.get_xdata(), REFRACTED)


@rows("pixels", [32, 33])
def test_curves_are_in_frames_of_the_plane_of_incidence(pixels):
    """The model's light along directions in the plane, beside pixels that hold the model's."""
    found = op.measure(op.Sample([(0.5 + 2.1j, 0.5)]), 0.7, 600, sensor=Sensor(pixels), events=1)
    model = found.single_scattering(points=4).values
    parts = np.broadcast_to(model.reshape(*model.shape[:-2], 16), (16, *model.shape[:-2], 16))
    number = found.parts.sums.shape[-1] - 16
    sums = np.concatenate([parts, np.zeros((*parts.shape[:-1], number))], axis=-1)
    sums = sums * found.parts.photons[:, None, None, None, None, None]
    modelled = type(found)(
        found.seen, found.parts._replace(sums=sums), found.wavelengths, found.symmetric
    )
    source = (1.0, 0.3, 0.5, 0.4)
    angles = np.radians(curve_of(in_plane(modelled)).get_xdata())
    up = np.stack([np.sin(angles), 0.0 * angles, np.cos(angles)], axis=-1)
    brdf = single_scattering(0.5 + 2.1j, 0.5, (np.sin(0.7), 0.0, -np.cos(0.7)), up).matrix
    # In frames along (0, 0, 1) x direction; a turn by 180 deg changes no Stokes vector.
    expected = (brdf @ source) * np.cos(angles)[:, np.newaxis]
    # Photons next to the normal have frames that differ within a pixel.
    there = (np.abs(angles) < 1.2) & (np.abs(angles) > 3.5 * np.pi / pixels)
    drawn = [curve_of(in_plane(modelled, f"S{each}", source=source)) for each in range(4)]
    drawn = np.stack([line.get_ydata() for line in drawn], axis=-1)
    atol = 0.01 * expected.max()
    np.testing.assert_allclose(drawn[there], expected[there], rtol=0, atol=atol)


def names_of(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def test_wavelengths_that_differ_are_told_and_what_is_no_hemisphere_or_not_measured_is_refused():
    gold, silver = measured("gold"), measured("silver")
    ax = in_plane({"silver": silver, "gold": gold}, wavelength="600 nm")
    assert ax.get_title() == "S0, reflected, in the plane of incidence, 600 nm"
    assert names_of(ax) == ["silver", "gold"]
    alone = in_plane(silver), in_plane(gold, wavelength="600 nm")
    np.testing.assert_array_equal(
        [line.get_ydata() for line in curves_of(ax)], [curve_of(each).get_ydata() for each in alone]
    )
    tabulated = op.Material.tabulated(["400 nm", "700 nm"], [1.5, 0.2], [1.9, 4.1])
    sample = op.Sample([(tabulated, rough(0.3))])
    blue = op.measure(sample, "60 deg", 1000, "450 nm", sensor=8)
    several = {"a": blue, "b": gold, "c": silver}
    ax = in_plane(several, wavelength="600 nm", source=[1, 0, 1, 0])
    assert ax.get_title() == "S0, reflected, in the plane of incidence\nsource (1, 0, 1, 0)"
    assert names_of(ax) == ["a, 450 nm", "b, 600 nm", "c"]
    with pytest.raises(
        op.errors.SurfaceError, match="give a wavelength of 450 nm, or leave it out"
    ):
        in_plane(blue, wavelength="600 nm")
    assert in_plane(blue).get_title() == "S0, reflected, incidence 60°, 450 nm"
    for wrong in (None, "sample"):
        with pytest.raises(op.errors.SurfaceError, match="is no Hemisphere; give what op"):
            hemisphere(wrong)
    with pytest.raises(
        op.errors.SurfaceError, match="550 nm has not been measured; give a wavelength"
    ):
        hemisphere(measured("gold"), wavelength="550 nm")
    with pytest.raises(op.errors.SurfaceError, match="give one Hemisphere at least"):
        in_plane({})
    with pytest.raises(op.errors.SurfaceError, match=r"^b: 3 is no Hemisphere"):
        in_plane({"a": measured("silver"), "b": 3})
    with pytest.raises(op.errors.SurfaceError, match="measure with events=1"):
        beside_facets(measured("silver"))
    sample, options = op.load_sample("perfect-reflector-rough"), {"sensor": 16, "photons": 600}
    found = op.measure(sample, "60 deg", polarized="polarized", **options)
    with pytest.raises(
        op.errors.SurfaceError, match="has not been measured; measure with polarized"
    ):
        differences(found)


@rows(
    "quantity, given, sentence",
    [
        ("DoL", {}, "quantity 'DoL' is unknown; did you mean 'DoLP'"),
        ("S0", {"side": "transmitted"}, "no side is called 'transmitted'"),
        ("S0", {"mask": {"noise": 1}}, "mask is given, but S0 has none; leave it out"),
        ("S0", {"mask": np.ones(2)}, "mask is given, but S0 has none; leave it out"),
        ("ADM", {"mask": 0.0}, r"give a mapping, such as {'brighter_than': 0\.5}"),
        ("ADM", {"mask": {"brigter_than": 1}}, "unknown; did you mean 'brighter_than'"),
        ("difference", {"mask": {"noise": 1}}, "mask 'noise' is unknown"),
        ("DoLP", {"largest": 0.5}, "largest is given, but colours of DoLP end at their own"),
        ("S0", {"largest": 0.0}, "largest is 0.0; give a number above 0"),
        ("S0", {"known_to": "much"}, "known_to is 'much'; give a number above 0"),
        ("S0", {"source": [1, 2, 0, 0]}, r"give S0 > 0 and S1\^2"),
        ("S0", {"wavelength": 5e-7}, "nothing depends on it; leave it out"),
        ("ADM", {"wavelength": 5e-7}, "ADM is of all wavelengths together"),
        ("ADM", {"side": "above"}, "no side is called 'above'"),
        ("difference", {"source": [1, 1, 0, 0]}, "of unpolarised light; leave source out"),
    ],
)
def test_what_does_not_go_together_is_refused(quantity, given, sentence):
    with pytest.raises(op.errors.SurfaceError, match=sentence):
        hemisphere(measured("mirror"), quantity, **given)


OTHER = "550 nm has not been measured; give a wavelength of 500 nm and 600 nm"


@rows(
    "names, given, sentence",
    [
        ("gold", {}, "^wavelength is missing; give one of 500 nm and 600 nm$"),
        ("gold", {"wavelength": "550 nm"}, f"^{OTHER}"),
        ("silver", {"quantity": "difference", "source": (1, 1, 0, 0)}, "unpolarised light; leave"),
        ("silver, gold", {}, "^gold: wavelength is missing; give one of 500 nm and 600 nm$"),
        ("silver, gold", {"wavelength": 5.5e-7}, f"^gold: {OTHER}"),
        ("silver, mirror", {"wavelength": 5e-7}, "^silver: .* leave it out$"),
        ("silver, mirror", {"source": [0, 0, 0, 0]}, "^silver: .* give S0 > 0"),
        ("silver, clear", {"side": "transmitted"}, "^silver: no side"),
        ("silver, gold", {"known_to": 0}, "^known_to is 0; give a number above 0"),
    ],
)
def test_faults_name_their_curves(names, given, sentence):
    several = {name: measured(name) for name in names.split(", ")}
    with pytest.raises(op.errors.SurfaceError, match=sentence):
        in_plane(several if len(several) > 1 else several[names], **given)
