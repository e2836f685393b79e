import numpy as np
import pytest

import optipath as op
from measured_hemispheres import measured
from optipath.surfaces import Sensor, single_scattering
from pictures import faults_of, texts_of
from rough_samples import rough
from tables import rows

pytest.importorskip("matplotlib")
QUANTITIES = ["S0", "S1", "S2", "S3", "DoP", "DoLP", "AoP", "difference"]


def curve_of(ax):
    return next(line for line in ax.get_lines() if len(line.get_xdata()) > 2)


@rows("quantity", QUANTITIES)
def test_every_quantity_has_a_curve_with_names_and_units(quantity):
    ax = op.plots.in_plane(measured("glass on glass"), quantity)
    assert ax.get_title() == f"{quantity}, reflected, incidence 60°"
    assert ax.get_xlabel() == "exit angle to the normal (°)"
    assert ax.get_ylabel()
    assert len(curve_of(ax).get_xdata()) == 16


def test_several_curves_look_otherwise_and_have_their_names():
    several = {"glass": measured("glass on glass"), "silver": measured("silver")}
    ax = op.plots.in_plane(several, "DoLP")
    assert faults_of(ax.figure) == []
    assert {"glass", "silver"} <= {text.get_text() for text in texts_of(ax.figure)}
    lines = [line for line in ax.get_lines() if len(line.get_xdata()) > 2]
    assert len({line.get_color() for line in lines}) == 2
    assert len({line.get_linestyle() for line in lines}) == 2  # In print, too.
    ax = op.plots.in_plane(measured("silver"), "S0")
    op.plots.in_plane({"glass": measured("glass on glass")}, "S0", ax)
    first, second = (line for line in ax.get_lines() if len(line.get_xdata()) > 2)
    assert first.get_color() != second.get_color()
    several = {name: measured(name) for name in ("silver", "mirror")}
    ax = op.plots.in_plane(several, "S3", source=[1, 0, 1, 0])
    assert ax.get_title() == "S3, reflected, in the plane of incidence\nsource (1, 0, 1, 0)"
    assert faults_of(ax.figure) == []


def test_bands_reach_two_standard_errors_up_and_down():
    silver = measured("silver")
    ax = op.plots.in_plane(silver, "S0")
    middle, area = slice(7, 9), silver.sensor.solid_angle[7:9].sum(axis=0)
    mean, error = silver.own.estimate(
        lambda n: silver.matrices(n)[0, middle, :, 0, 0, 0].sum(axis=0) / area
    )
    np.testing.assert_allclose(curve_of(ax).get_ydata(), mean)
    (band,) = (each.get_paths()[0].vertices for each in ax.collections)
    np.testing.assert_allclose(band[:, 1].max(), (mean + 2.0 * error).max())


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
    angles = np.radians(curve_of(op.plots.in_plane(modelled)).get_xdata())
    up = np.stack([np.sin(angles), 0.0 * angles, np.cos(angles)], axis=-1)
    brdf = single_scattering(0.5 + 2.1j, 0.5, (np.sin(0.7), 0.0, -np.cos(0.7)), up).matrix
    # In frames along (0, 0, 1) x direction; a turn by 180 deg changes no Stokes vector.
    expected = (brdf @ source) * np.cos(angles)[:, np.newaxis]
    # Photons next to the normal have frames that differ within a pixel.
    compared = (np.abs(angles) < 1.2) & (np.abs(angles) > 3.5 * np.pi / pixels)
    for component in range(4):
        curve = curve_of(op.plots.in_plane(modelled, f"S{component}", source=source))
        np.testing.assert_allclose(
            curve.get_ydata()[compared],
            expected[compared, component],
            rtol=0,
            atol=0.01 * expected.max(),
        )


def test_an_angle_that_goes_on_from_the_other_end_is_no_line_across():
    ax = op.plots.in_plane(measured("silver"), "AoP", source=(1.0, -0.9, 0.1, 0.0), known_to=90.0)
    angles = curve_of(ax).get_ydata()
    steps = np.abs(np.diff(angles))
    assert not np.any(steps[~np.isnan(steps)] > 90.0)


def test_a_smooth_sample_has_its_line():
    ax = op.plots.in_plane(measured("clear"), side="transmitted")
    lines = [line for line in ax.get_lines() if len(line.get_xdata()) == 2]
    refracted = np.degrees(np.arcsin(np.sin(np.radians(60.0)) / 1.5))
    np.testing.assert_allclose(lines[0].get_xdata(), refracted)


def test_what_is_no_curve_is_refused():
    with pytest.raises(op.SurfaceError, match="give one Hemisphere at least"):
        op.plots.in_plane({})
    with pytest.raises(op.SurfaceError, match="of unpolarised light; leave source out"):
        op.plots.in_plane(measured("silver"), "difference", source=(1, 1, 0, 0))
    with pytest.raises(op.SurfaceError, match=r"^b: 3 is no Hemisphere"):
        op.plots.in_plane({"a": measured("silver"), "b": 3})


def names_of(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def test_wavelengths_that_differ_are_told_and_the_only_one_may_be_left_out():
    gold, silver = measured("gold"), measured("silver")
    ax = op.plots.in_plane({"silver": silver, "gold": gold}, wavelength="600 nm")
    assert ax.get_title() == "S0, reflected, in the plane of incidence, 600 nm"
    assert names_of(ax) == ["silver", "gold"]
    curves = [line.get_ydata() for line in ax.get_lines() if len(line.get_xdata()) > 2]
    alone = op.plots.in_plane(silver), op.plots.in_plane(gold, wavelength="600 nm")
    np.testing.assert_array_equal(curves, [curve_of(each).get_ydata() for each in alone])
    several = {"a": one_of_gold("450 nm"), "b": measured("gold"), "c": measured("silver")}
    ax = op.plots.in_plane(several, wavelength="600 nm", source=[1, 0, 1, 0])
    assert ax.get_title() == "S0, reflected, in the plane of incidence\nsource (1, 0, 1, 0)"
    assert names_of(ax) == ["a, 450 nm", "b, 600 nm", "c"]
    found = one_of_gold("450 nm")
    with pytest.raises(op.SurfaceError, match="give a wavelength of 450 nm, or leave it out"):
        op.plots.in_plane(found, wavelength="600 nm")
    assert op.plots.in_plane(found).get_title() == "S0, reflected, incidence 60°, 450 nm"


def one_of_gold(wavelength):
    gold = op.Material.tabulated(["400 nm", "700 nm"], [1.5, 0.2], [1.9, 4.1])
    return op.measure(op.Sample([(gold, rough(0.3))]), "60 deg", 1000, wavelength, sensor=8)


@rows(
    "names, given, sentence",
    [
        (["silver", "gold"], {}, r"^gold: wavelength is missing; give one of 500 nm and 600 nm$"),
        (["silver", "gold"], {"wavelength": 5.5e-7}, "^gold: 550 nm has not been measured"),
        (["silver", "mirror"], {"wavelength": 5e-7}, "^silver and mirror: .* leave it out$"),
        (["silver", "mirror"], {"source": [0, 0, 0, 0]}, "^silver and mirror: .* no intensity"),
        (["silver", "clear"], {"side": "transmitted"}, "^silver: no side"),
        (
            ["silver", "gold"],
            {"known_to": 0, "wavelength": 1},
            "^2 faults:\n- known_to.*\n- gold: ",
        ),
    ],
)
def test_faults_name_their_curves(names, given, sentence):
    with pytest.raises(op.SurfaceError, match=sentence):
        op.plots.in_plane({name: measured(name) for name in names}, **given)
