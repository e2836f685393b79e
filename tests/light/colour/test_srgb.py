"""Colours of a display against colour-science, and what becomes of those out of gamut."""

import json
from pathlib import Path

import numpy as np
import pytest

import optipath as op
from optipath.light.colour.adaptation import DISPLAY_WHITE, adapted
from optipath.light.colour.srgb import FROM_XYZ, encoded
from optipath.light.colour.triples import times
from tables import rows

FIGURES = Path(__file__).parents[2] / "peers" / "figures" / "colour" / "colour_science.json"
COMPUTED = json.loads(FIGURES.read_text("utf-8"))["displayed"]
GRID = np.arange(380.0, 781.0, 5.0)
D65, A = op.Spectrum.illuminant("D65"), op.Spectrum.illuminant("A")
figures = pytest.mark.parametrize("asked", COMPUTED, ids=lambda a: a["name"])


def light_of(values):
    stokes = np.zeros((*np.shape(values), 4))
    stokes[..., 0] = values
    return op.Light(stokes, wavelength=GRID * 1e-9)


def under(illuminant, reflectance):
    return light_of(illuminant.at(GRID * 1e-9) * reflectance)


def peak(centre, width):
    return np.exp(-(((GRID - centre) / width) ** 2))


@figures
def test_components_are_those_of_colour_science(asked):
    found = encoded(times(FROM_XYZ, np.array(asked["xyz"])))
    np.testing.assert_allclose(found, asked["srgb"], atol=1e-12)


@figures
def test_bradford_adaptation_is_that_of_colour_science(asked):
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
        op.ValueFault, match=r"1 of 2 colours are out of the gamut of sRGB, by up to \d\.\d+ of its"
    ):
        lights.to_srgb(white=light_of(np.ones(81)))
    with pytest.raises(op.ValueFault, match="relative to what is white; write white="):
        light_of(np.ones(81)).to_srgb()
    with pytest.raises(op.ValueFault) as caught:
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
    within = np.where(
        colour.values > 0.04045, ((colour.values + 0.055) / 1.055) ** 2.4, colour.values / 12.92
    )
    weights = [0.2126, 0.7152, 0.0722]
    assert colour.outside
    np.testing.assert_allclose(within @ weights, colour.linear @ weights, rtol=1e-12)
    light = under(D65, peak(500.0, 20.0))
    colour = light.to_srgb(white=D65, out_of_gamut="keep")
    assert colour.values.min() < 0.0
    expected = times(FROM_XYZ, light.to_xyz(white=D65))
    np.testing.assert_array_equal(colour.linear, expected)
    light = under(D65, 0.3 + 0.1 * peak(600.0, 80.0))
    ways = [
        light.to_srgb(white=D65, out_of_gamut=way).values
        for way in ("refuse", "clip", "scale", "keep")
    ]
    for found in ways[1:]:
        np.testing.assert_allclose(found, ways[0], rtol=1e-14)


def test_slopes_of_colours_are_finite_where_they_are_dark_or_out_of_gamut(jax):
    for way in ("clip", "scale", "keep"):

        def red(share, way=way):
            stokes = jax.numpy.zeros((81, 4)).at[:, 0].set(share * peak(500.0, 20.0))
            light = op.Light(stokes, wavelength=GRID * 1e-9)
            return light.to_srgb(white=D65, out_of_gamut=way).values.sum()

        slopes = jax.jit(jax.vmap(jax.grad(red)))(np.array([0.0, 50.0]))
        assert np.isfinite(slopes).all()


def test_whether_traced_colours_are_in_gamut_is_not_known(jax):
    def red(share):
        stokes = jax.numpy.zeros((81, 4)).at[:, 0].set(share)
        return op.Light(stokes, wavelength=GRID * 1e-9).to_srgb(white=D65).values[0]

    with pytest.raises(op.ValueFault, match="JAX traces are in gamut is not known"):
        jax.grad(red)(0.5)
