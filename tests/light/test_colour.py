"""Colours against colour-science, published white points and sums; what is out of gamut."""

import json
from pathlib import Path

import numpy as np
import pytest

import optipath as op
from optipath.light.color import DISPLAY_WHITE, FROM_XYZ, adapted, encoded, times
from tables import rows

FIGURES = Path(__file__).parents[1] / "peers" / "figures" / "colour" / "colour_science.json"
COMPUTED = json.loads(FIGURES.read_text("utf-8"))
NM = 1e-9
GRID = np.arange(380.0, 781.0, 5.0)
VISIBLE = GRID * NM
D65, A = op.Spectrum.illuminant("D65"), op.Spectrum.illuminant("A")


def light_of(values, wavelengths=VISIBLE, **given):
    stokes = np.zeros((*np.shape(values), 4))
    stokes[..., 0] = values
    return op.Light(stokes, wavelength=wavelengths, **given)


def smooth(nm):
    return 1.0 + np.sin(nm / 37.0) + 3.0 * np.exp(-(((nm - 560.0) / 40.0) ** 2))


def under(illuminant, reflectance):
    return light_of(illuminant.at(VISIBLE) * reflectance)


def peak(centre, width):
    return np.exp(-(((GRID - centre) / width) ** 2))


@pytest.mark.filterwarnings("ignore::optipath.errors.ColourWarning")
@rows("asked", COMPUTED["xyz"])
def test_tristimulus_values_are_those_of_colour_science(asked):
    grid = np.array(asked["nm"])
    found = light_of(smooth(grid), grid * NM).to_xyz(outside=asked["outside"]) / 683.0
    # Light that ends within the observer's range ends there; a sum counts its last nanometre whole.
    ends_within = grid[0] > 360.0 and asked["outside"] == "dark"
    slack = 2e-5 if ends_within else COMPUTED["precision"]
    np.testing.assert_allclose(found, asked["xyz"], rtol=slack)


@rows(
    "illuminant, white_point, step",
    [
        *[("D65", (0.31272, 0.32903), 5), ("D65", (0.31272, 0.32903), 1)],
        *[("E", (1 / 3, 1 / 3), 5), ("A", (0.44758, 0.40745), 1)],
    ],
)
def test_illuminants_have_their_published_white_points(illuminant, white_point, step):
    path = op.Source(spectrum=op.Spectrum.illuminant(illuminant)) >> op.Detector()
    light = path.trace(wavelength=op.wavelengths("360 nm", "830 nm", step * NM))
    xyz = light.to_xyz()
    np.testing.assert_allclose(xyz[:2] / xyz.sum(), white_point, rtol=0, atol=5e-5)


def test_y_is_that_of_white_and_of_lumens():
    path = op.Source(0.5, spectrum=D65) >> op.Detector()
    light = path.trace(wavelength=VISIBLE)
    assert light.to_xyz(white=D65)[1] == 0.5
    assert (light * 2.0).to_xyz(white=light)[1] == 2.0
    path = op.Source(3.0, spectrum=op.Spectrum.line("555 nm")) >> op.Detector()
    light = path.trace(wavelength=np.arange(400.0, 800.5, 0.5)[::-1] * NM)
    with pytest.warns(op.errors.ColourWarning, match="from 400 nm to 800 nm"):
        found = light.to_xyz()
    np.testing.assert_allclose(found[1], 3.0 * 683.0, rtol=1e-4)
    rising = light_of(smooth(GRID))
    np.testing.assert_allclose(rising[::-1].to_xyz(), rising.to_xyz(), rtol=1e-14)


@rows("step", [0.03, 0.5, 1.7, 4.04, 12.3])
def test_a_line_keeps_its_power_however_the_grid_lies(step):
    grid = np.arange(380.2, 790.0, step)
    place = np.argmin(np.abs(grid - 555.0))
    light = light_of((np.arange(len(grid)) == place) / step, grid * NM)
    xyz = light.to_xyz(outside="nearest") / 683.0
    # V is 0.999 or more where the triangle of the finer ones is, and has that curvature else.
    np.testing.assert_allclose(xyz[1], 1.0, atol=2e-4 + 2e-4 * step**2)


def test_a_colour_is_the_same_alone_and_in_a_batch_to_the_last_bit():
    values = smooth(GRID)[:, None, None] * np.linspace(0.1, 3.0, 35).reshape(5, 7)
    lights = light_of(values, VISIBLE[:, None, None])
    assert lights.to_xyz(white=D65).shape == (5, 7, 3)
    for place in [(0, 0), (3, 4), (4, 6)]:
        alone = light_of(values[:, *place])
        assert np.array_equal(alone.to_xyz(white=D65), lights.to_xyz(white=D65)[place])


def test_white_may_be_faint_or_light_of_the_path_without_the_sample():
    light, faint = light_of(smooth(GRID)), light_of(1e-250 * smooth(GRID))
    np.testing.assert_allclose(faint.to_xyz(white=faint), light.to_xyz(white=light), rtol=1e-14)
    filtered = op.Source(spectrum=D65) >> op.Attenuator(0.3) >> op.Detector()
    lamp = op.Source(spectrum=D65) >> op.Detector()
    light, white = (path.trace(wavelength=VISIBLE) for path in (filtered, lamp))
    expected = 0.3 * white.to_xyz(white=D65)
    np.testing.assert_allclose(light.to_xyz(white=white), expected, rtol=1e-14)


def test_wavelengths_that_leave_out_what_is_seen_are_told_at_the_line_that_asks():
    light = light_of(np.ones(61), np.linspace(400.0, 700.0, 61) * NM)
    with pytest.warns(
        op.errors.ColourWarning, match="known from 400 nm to 700 nm, and taken for dark"
    ):
        light.to_xyz()
    light.to_xyz(outside="nearest")
    light = light_of(np.ones(11), np.linspace(380.0, 780.0, 11) * NM)
    with pytest.warns(op.errors.ColourWarning, match="wavelengths are 40 nm apart"):
        light.to_xyz()
    for asked in (light.to_xyz, lambda: light.to_srgb(D65, out_of_gamut="keep")):
        with pytest.warns(op.errors.ColourWarning) as caught:
            asked()
        assert {warning.filename for warning in caught} == {__file__}


@rows(
    "given, sentence",
    [
        ({"observer": "CIE 1931"}, "observer 'CIE 1931' is unknown; did you mean 'CIE 1931 2 deg'"),
        ({"outside": "bright"}, "outside 'bright' is unknown; there are: dark, nearest"),
        ({"white": 1.0}, "white is 1.0, which has no spectrum; give white=, the light without"),
        ({"white": light_of(np.zeros(81))}, r"white is dark \(Y = 0\)"),
    ],
)
def test_what_is_no_white_or_observer_is_refused(given, sentence):
    with pytest.raises(op.errors.ValueFault, match=sentence):
        light_of(np.ones(81)).to_xyz(**given)


def test_light_that_has_no_colour_is_refused():
    lights, whites = (light_of(np.ones((81, n)), VISIBLE[:, None]) for n in (3, 2))
    with pytest.raises(op.errors.ShapeError, match=r"light \(3,\), white \(2,\)"):
        lights.to_xyz(white=whites)
    with pytest.raises(op.errors.LightError, match="wavelengths vary along no axis"):
        light_of(1.0, 5e-7).to_xyz()
    light = light_of(np.ones(3), np.array([900.0, 910.0, 920.0]) * NM)
    with pytest.raises(op.errors.LightError, match=r"light of 900 nm \.\. 920 nm is not seen"):
        light.to_xyz()


def test_a_slope_by_jax_is_the_sum_of_slopes(jax, jacobian):
    values = smooth(GRID)

    def luminance(share):
        stokes = jax.numpy.zeros((81, 4)).at[:, 0].set(share * values)
        return op.Light(stokes, wavelength=VISIBLE).to_xyz(white=D65)[1]

    slope = jacobian(luminance)(0.7)
    np.testing.assert_allclose(slope, light_of(values).to_xyz(white=D65)[1], rtol=1e-12)


@rows("asked", COMPUTED["displayed"])
def test_components_and_bradford_adaptation_are_those_of_colour_science(asked):
    found = encoded(times(FROM_XYZ, np.array(asked["xyz"])))
    np.testing.assert_allclose(found, asked["srgb"], atol=1e-12)
    found = adapted(np.array(asked["xyz"]), np.array(asked["white"]))
    np.testing.assert_allclose(found, asked["adapted"], rtol=1e-6)


def test_white_of_d65_of_lamps_and_of_displays_is_white():
    assert under(D65, 1.0).to_srgb(white=D65).hex == "#ffffff"
    paper = under(A, 0.5)
    assert paper.to_srgb(white=A, adapt=True).hex == "#bcbcbc"
    red, green, blue = paper.to_srgb(white=A).values
    assert red > green > blue
    np.testing.assert_allclose(adapted(DISPLAY_WHITE, DISPLAY_WHITE), DISPLAY_WHITE, rtol=1e-15)


def test_all_that_is_wrong_with_a_colour_is_told_at_once():
    lights = light_of([0.2 * np.ones(81), 40.0 * peak(520.0, 5.0)]).reshape(2, 81)
    with pytest.raises(
        op.errors.ValueFault, match=r"1 of 2 colours are out .*, by up to \d\.\d+ of its"
    ):
        lights.to_srgb(white=light_of(np.ones(81)))
    with pytest.raises(op.errors.ValueFault, match="relative to what is white; give white="):
        light_of(np.ones(81)).to_srgb()
    with pytest.raises(op.errors.ValueFault) as caught:
        light_of(np.ones(81)).to_srgb(adapt="yes", out_of_gamut="clipped")
    assert len(caught.value.faults) == 3
    colour = under(D65, 0.5).to_srgb(white=D65)
    with pytest.raises(AttributeError, match="cannot change"):
        colour.values = 0.0
    with pytest.raises(ValueError, match="read-only"):
        colour.values[0] = 0.0


@rows("way", ["clip", "scale"])
def test_colours_are_brought_into_the_gamut_where_that_is_asked_for(way):
    lights = light_of([peak(centre, 10.0) for centre in (400, 450, 520, 580, 640)])
    colours = lights.to_srgb(white=D65 / 100.0, out_of_gamut=way)
    assert colours.outside.any()
    assert np.all((colours.values >= 0.0) & (colours.values <= 1.0))
    assert np.array_equal(colours.outside, colours.beyond > 0.5 / 255)


def test_what_is_done_with_colours_out_of_gamut_leaves_those_within():
    light = 0.05 * under(D65, peak(500.0, 20.0))
    colour = light.to_srgb(white=D65, out_of_gamut="scale")
    v = colour.values
    within = np.where(v > 0.04045, ((v + 0.055) / 1.055) ** 2.4, v / 12.92)
    weights = [0.2126, 0.7152, 0.0722]
    assert colour.outside
    np.testing.assert_allclose(within @ weights, colour.linear @ weights, rtol=1e-12)
    light = under(D65, peak(500.0, 20.0))
    colour = light.to_srgb(white=D65, out_of_gamut="keep")
    assert colour.values.min() < 0.0
    np.testing.assert_array_equal(colour.linear, times(FROM_XYZ, light.to_xyz(white=D65)))
    light = under(D65, 0.3 + 0.1 * peak(600.0, 80.0))
    first = light.to_srgb(white=D65, out_of_gamut="refuse").values
    for way in ("clip", "scale", "keep"):
        found = light.to_srgb(white=D65, out_of_gamut=way).values
        np.testing.assert_allclose(found, first, rtol=1e-14)


@pytest.mark.slow
def test_slopes_of_colours_are_finite_where_they_are_dark_or_out_of_gamut(jax, jacobian):
    def red(share, way):
        stokes = jax.numpy.zeros((81, 4)).at[:, 0].set(share * peak(500.0, 20.0))
        return op.Light(stokes, wavelength=VISIBLE).to_srgb(D65, out_of_gamut=way).values.sum()

    for way in ("clip", "scale", "keep"):
        slopes = jax.vmap(jacobian(lambda share, way=way: red(share, way)))
        assert np.isfinite(slopes(np.array([0.0, 50.0]))).all()
    with pytest.raises(op.errors.ValueFault, match="JAX traces are in gamut is not known"):
        jax.grad(lambda share: red(share, "refuse"))(0.5)
