"""A measured sample is an element of any path, whichever way one looks at it."""

import math

import numpy as np
import pytest

import optipath as op
from tables import rows

pytest.importorskip("xarray")

GOLD = 0.14 + 3.7j
SILICON = {"n": 3.882, "k": 0.019}


def measured(incidence="45 deg", photons=100_000, alpha=0.25, **given):
    pytest.importorskip("numba")
    return op.measure(op.Sample([(GOLD, alpha)], cells=200), incidence, photons, **given)


@pytest.fixture(scope="module")
def rough():
    return measured(sensor=31)


def ellipsometer(element):
    path = op.load_preset("ellipsometer-rough")
    path.replace("S", element)
    return path.compose()


@rows("incidence", [0.0, 0.3, math.pi / 4, 1.2, 1.5])
@rows("options", [{"sensor": 32}, {"sensor": 33}, {"photons": 4096, "most_events": 999}])
def test_with_a_flat_sample_it_is_the_ellipsometer_of_smooth_ones(rng, incidence, options):
    pytest.importorskip("numba")
    sample = op.Sample([(complex(*SILICON.values()), 0.0)])
    # Photons, where they are walked, go into two columns at a border, by their rounding.
    hemisphere = op.measure(sample, incidence, **{"sensor": 32} | options)
    names = "polarizer", "compensator", "retardance", "analyzer"
    values = dict(zip(names, rng.uniform(-3.0, 3.0, (4, 50)), strict=True))
    found = ellipsometer(hemisphere.toward(incidence)).run_all(**values)
    smooth = op.load_preset("ellipsometer-pcsa").compose()
    expected = smooth.run_all(theta=incidence, **SILICON, **values)
    for end, read in (("state", "stokes"), ("photometer", "intensity")):
        apart = getattr(found[end], read) - getattr(expected[end], read)
        assert np.abs(apart).max() < (1e-13 if "photons" in options else 1e-14)


def test_a_slightly_rough_sample_is_near_a_smooth_one():
    alpha = 0.05
    hemisphere = measured("60 deg", alpha=alpha, sensor=45)

    def seen(matrix):
        light = ellipsometer(op.MuellerElement(matrix, straight=False)).run().stokes
        psi_delta = op.Light(light, physical=False)
        return np.array([psi_delta.psi, psi_delta.delta, psi_delta.dolp])

    found, error = hemisphere.estimate_toward(seen, "60 deg")
    smooth = op.load_preset("ellipsometer-pcsa").trace(n=GOLD.real, k=GOLD.imag, theta="60 deg")
    expected = np.array([smooth.psi, smooth.delta, smooth.dolp])
    assert np.all(np.abs(found - expected) < 5.0 * error + 2.0 * alpha**2)


# The azimuths of the polarizer and of the compensator; and the state: along p, along s, and
# halfway, in frames with x = s, and y away from p.
SIX_STATES = {
    "linear-0": (0.0, 0.0, (-1, 0, 0)),
    "linear-45": (45.0, 45.0, (0, 1, 0)),
    "linear-90": (90.0, 90.0, (1, 0, 0)),
    "linear-135": (135.0, 135.0, (0, -1, 0)),
    "circular-right": (0.0, 45.0, (0, 0, 1)),
    "circular-left": (0.0, -45.0, (0, 0, -1)),
}


def test_the_states_of_the_cases_are_those_of_polariser_and_compensator(rough):
    element = rough.toward("45 deg")
    path = op.load_preset("ellipsometer-rough")
    assert list(path.cases) == list(SIX_STATES)
    path.replace("S", element)
    for name, (polarizer, compensator, state) in SIX_STATES.items():
        case = op.load_preset("ellipsometer-rough", case=name)
        case.replace("S", element)
        told = {"polarizer": np.radians(polarizer), "compensator": np.radians(compensator)}
        np.testing.assert_array_equal(case.trace().stokes, path.trace(**told).stokes)
        expected = element.matrix @ [0.5, *(0.5 * np.array(state))]
        np.testing.assert_allclose(case.trace().stokes, expected, rtol=0, atol=1e-15)


def test_it_is_the_share_of_the_light_that_falls_on_the_pixel(rough):
    row, column = 15, rough.sensor.around(rough.frames_toward("30 deg")["out"].z)[1][0]
    expected = rough.mueller[0][0, row, column, 0]
    element = rough.toward("30 deg")
    np.testing.assert_allclose(element.matrix, expected, rtol=1e-14, atol=0)
    value, error = rough.estimate_toward(lambda matrix: matrix, "30 deg")
    np.testing.assert_array_equal(value, element.matrix)
    np.testing.assert_allclose(error, rough.mueller[1][0, row, column, 0], rtol=1e-9, atol=1e-18)
    # On the border of pixels it is all of them together: 45 deg is between two columns of 32, and
    # the plane of incidence between two rows.
    even = measured(sensor=32)
    matrix = even.toward("45 deg").matrix
    four = even.mueller[0][0, 15:17, 23:25, 0].sum(axis=(0, 1))
    np.testing.assert_allclose(matrix, four, rtol=1e-14, atol=1e-18)
    # They are mirror images: nothing is left that a mirror would turn over.
    assert np.abs([matrix[:2, 2:], matrix[2:, :2]]).max() < 1e-17


@pytest.mark.filterwarnings("ignore:direction:optipath.errors.PhotonWarning")
def test_an_angle_is_a_direction_in_the_plane_of_incidence(rough):
    z = [math.sin(math.radians(-20.0)), 0.0, math.cos(math.radians(-20.0))]
    by_vector = rough.toward(z).matrix
    for angle in ("-20 deg", math.radians(-20.0)):
        np.testing.assert_array_equal(rough.toward(angle).matrix, by_vector)
    # Several directions are several matrices.
    angles = [f"{angle} deg" for angle in range(30, 61, 3)]
    both = rough.toward(angles)
    np.testing.assert_array_equal(both.matrix, [rough.toward(angle).matrix for angle in angles])
    found = ellipsometer(both).run_all(analyzer=np.radians([[0.0], [45.0], [90.0], [135.0]]))
    assert found["photometer"].intensity.shape == (4, 11)


@pytest.mark.filterwarnings("ignore:direction:optipath.errors.PhotonWarning")
def test_in_world_frames_light_leaves_toward_the_direction(rough):
    direction = np.array([0.6, 0.28, math.sqrt(1.0 - 0.36 - 0.0784)])
    frames = rough.frames_toward(direction)
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(stokes=[1, 1, 0, 0]), frames={"out": frames["in"]})
    lamp >> path.add("S", rough.toward(direction), frames=frames) >> path.add("eye", op.Detector())
    light = path.trace()
    np.testing.assert_allclose(light.frame.z, direction, atol=1e-15)
    # Perpendicular to its meridional plane.
    np.testing.assert_allclose(light.frame.x @ [0.0, 0.0, 1.0], 0.0, atol=1e-15)
    np.testing.assert_array_equal(light.stokes, rough.toward(direction).matrix @ [1, 1, 0, 0])
    np.testing.assert_allclose(frames["in"].z, [math.sqrt(0.5), 0.0, -math.sqrt(0.5)], atol=1e-15)
    # The plane of incidence turns with the light.
    turned = measured(photons=20_000, alpha=(0.2, 0.1), sensor=15, azimuth="90 deg")
    frames = turned.frames_toward("45 deg")
    np.testing.assert_allclose(frames["out"].z, [0, math.sqrt(0.5), math.sqrt(0.5)], atol=1e-15)
    np.testing.assert_allclose(frames["in"].x, [-1, 0, 0], atol=1e-15)
    assert turned.toward("45 deg").matrix[0, 0] > 0.01


def test_what_is_let_through_is_seen_from_below():
    flat = op.measure(op.Sample([(1.5, 0.0)]), "50 deg", sensor=33)
    below = math.asin(math.sin(math.radians(50.0)) / 1.5)
    expected = op.Interface(1.5, "50 deg").mueller("in", "transmitted").matrix
    for direction in (below, [math.sin(below), 0.0, -math.cos(below)]):
        found = flat.toward(direction, "transmitted").matrix
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-15)


@rows(
    "direction, message",
    [
        *(
            (each, r"deg\) from the normal; .* such as '45 deg'")
            for each in ("90 deg", "300 deg", 45)
        ),
        ([0.6, 0.0, -0.8], r"has z = -0.8; .* give a z above 0"),
        ([0.1, 0.2], r"must have shape \(..., 3\), not \(2,\)"),
        (op.Parameter("a"), "parameter 'a'"),
        ("-88 deg", r"no light has fallen on the pixel of direction \('-88 deg'\); .* photons"),
        (["30 deg", "-88 deg"], r"of direction at 1 "),
    ],
)
def test_directions_that_are_none_are_refused(rough, direction, message):
    with pytest.raises(op.errors.SurfaceError, match=message):
        rough.toward(direction)


def flat(*direction, **options):
    return op.measure(op.Sample([(1j, 0.0)]), "45 deg", sensor=9, **options).toward(*direction)


def by_chance():
    # All of 3 photons are reflected, each with 1 / p of what is reflected of s: more than 1.
    few = op.measure(op.Sample([(1.5, 0.0)]), "89 deg", 3, sensor=9, most_events=999)
    few.toward("89 deg")


@rows(
    "ask, message",
    [
        (lambda it: it.toward("45 deg", "transmitted"), "nothing goes through an opaque sample"),
        (lambda it: it.frames_toward("45 deg", "below"), "give reflected"),
        (
            lambda it: it.toward("45 deg", wavelength="550 nm"),
            "since nothing of the sample depends on",
        ),
        (lambda _: by_chance(), r"by chance, 3 photons bring .* with more photons"),
        (lambda _: flat("10 deg"), "of a flat sample give the direction into which all light"),
        (lambda _: flat("45 deg", polarized="scalar"), "with polarized='both' or 'polarized'"),
    ],
)
def test_what_there_is_not_is_refused(rough, ask, message):
    with pytest.raises(op.errors.SurfaceError, match=message):
        ask(rough)
    with pytest.warns(op.errors.PhotonWarning, match="more and smaller pixels"):
        rough.toward("2 deg")
    rough.toward("30 deg")


def test_each_wavelength_has_its_own_light_and_one_of_several_is_asked_for():
    sample = op.Sample([(op.load_sample("gold-rough").layers[0].index, 0.0)])
    lengths = ["450 nm", "550 nm"]
    several = op.measure(sample, "60 deg", wavelengths=lengths, sensor=15)
    for options, sentence in (
        ({}, "wavelength is None, and measured is 450 nm or 550 nm; give that"),
        ({"wavelength": "600 nm"}, "'600 nm', and measured is 450 nm or 550 nm"),
        ({"wavelength": lengths}, "and measured is 450 nm or 550 nm; give that"),
    ):
        with pytest.raises(op.errors.SurfaceError, match=sentence):
            several.toward("60 deg", **options)
    for given in ("450 nm", 5.5e-7):
        index = complex(sample.indices(given).base)
        expected = op.Interface(index, "60 deg").mueller("in", "reflected").matrix
        found = several.toward("60 deg", wavelength=given).matrix
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-15)


def test_four_intensities_tell_the_linear_polarisation(rough):
    plan = ellipsometer(rough.toward("45 deg"))
    told = {"polarizer": "0 deg", "compensator": "45 deg"}
    turns = ["0 deg", "45 deg", "90 deg", "135 deg"]
    i0, i45, i90, i135 = plan.run_all(analyzer=turns, **told)["photometer"].intensity
    # From p towards s: S1 and S2 have the other sign in the frame with x along s.
    s0, s1, s2, _ = plan.run(**told).stokes
    assert [i0 + i90, i90 - i0, i45 - i135] == pytest.approx([s0, s1, s2], abs=1e-16)


def test_light_scattered_once_in_the_plane_is_that_of_facets():
    pytest.importorskip("numba")
    sample = op.Sample([(GOLD, 0.25)], cells=200)
    once = op.measure(sample, "60 deg", 200_000, sensor=91, events=1)
    for angle in once.sensor.theta[45, [65, 73, 81]]:
        theta = 0.5 * (np.radians(60.0) + angle)
        facet = op.Interface(GOLD, theta).mueller("in", "reflected").matrix
        found, error = once.estimate_toward(lambda matrix: matrix / matrix[0, 0], angle)
        # Pixels are 2 deg wide, over which light and matrix are not the same.
        assert np.all(np.abs(found - facet / facet[0, 0]) < 5.0 * error + 1.5e-3)


@pytest.mark.filterwarnings("ignore:direction:optipath.errors.PhotonWarning")
@rows("alpha", [0.02, 0.3])
@rows("layers", [[GOLD], [1.5], [1.5, 2.4], [1.5, GOLD], [1j]])
def test_every_pixel_is_an_element_that_can_be(alpha, layers):
    pytest.importorskip("numba")
    sample = op.Sample([(index, alpha) for index in layers], cells=200, surfaces=1)
    found = op.measure(sample, "60 deg", 3000, sensor=8)
    for place, side in enumerate(found.seen.sides):
        lit = (found.mueller[0][place, :, :, 0, 0, 0] > 0.0) & ~np.isnan(found.sensor.theta)
        directions = found.sensor.directions[lit] * (1, 1, 1 - 2 * place)
        assert len(directions)
        assert found.toward(directions, side).physical is True
