"""Diattenuators, circular polarisers, depolarisers, and elements by their matrix."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from chains import ENGINES
from paths import chain
from tables import rows, slow
from wired import read_back

STATE = [1.0, 0.5, 0.6, 0.4]
T, L = op.Parameter("t"), op.Parameter("l")


def chipman(q, r, angle):
    """Chipman, Lam & Young (2018), eq. 6.54: a diattenuator of transmittances q and r."""
    c, s, cross = np.cos(2 * angle), np.sin(2 * angle), 2 * np.sqrt(q * r)
    return 0.5 * np.array(
        [
            [q + r, (q - r) * c, (q - r) * s, 0],
            [(q - r) * c, (q + r) * c**2 + cross * s**2, (q + r - cross) * c * s, 0],
            [(q - r) * s, (q + r - cross) * c * s, cross * c**2 + (q + r) * s**2, 0],
            [0, 0, 0, cross],
        ]
    )


@rows("named", [op.Diattenuator, lambda q, r, a, z: op.Polarizer(a, z, q, r)])
def test_a_diattenuator_and_a_polariser_that_leaks_are_chipmans(named):
    matrix = named(0.9, 0.05, 0.3, 0.0).mueller().matrix
    np.testing.assert_allclose(matrix, chipman(0.9, 0.05, 0.3), rtol=0, atol=2e-16)
    # Light seen in a frame turned by the azimuth.
    c, s = np.cos(0.4), np.sin(0.4)
    seen = [1.0, 0.5 * c + 0.6 * s, 0.6 * c - 0.5 * s, 0.4]
    found = chain([named(0.9, 0.05, 0.3, 0.2)], STATE).trace().stokes
    np.testing.assert_allclose(found, chipman(0.9, 0.05, 0.3) @ seen, rtol=0, atol=4e-16)


def test_a_diattenuator_passes_light_by_its_principal_transmittances_along_the_axis_of_the_first():
    path = chain([op.Diattenuator(0.8, 0.3, angle=0.4)], op.Parameter("state"))
    along, across = ([1.0, s * np.cos(0.8), s * np.sin(0.8), 0.0] for s in (1, -1))
    found = path.trace(state=[along, across]).intensity
    np.testing.assert_allclose(found, [0.8, 0.3], rtol=1e-15, atol=1e-16)
    light = chain([op.Diattenuator(0.8, 0.2)]).trace()
    np.testing.assert_allclose(light.stokes, [0.5, 0.3, 0.0, 0.0], rtol=1e-15, atol=1e-16)
    assert light.dop == pytest.approx(0.6, abs=1e-15)
    # By default it is an ideal polarizer along x.
    np.testing.assert_array_equal(op.Diattenuator().mueller().matrix, chipman(1.0, 0.0, 0.0))
    swapped = op.Diattenuator(0.2, 0.7).mueller().matrix
    turned = op.Diattenuator(0.7, 0.2, angle=np.pi / 2).mueller().matrix
    np.testing.assert_allclose(swapped, turned, rtol=1e-15, atol=1e-16)
    assert swapped[0, 1] < -0.2


MATRIX = 0.5 * np.diag([1.0, 0.9, -0.8, -0.8])


@rows(
    "make, sentence",
    [
        (lambda: op.Diattenuator(1.2), r"^Diattenuator maximum is 1\.2"),
        (
            lambda: op.CircularDiattenuator(1.5, -0.1),
            r"Diattenuator right is .*\n.* left is -0.1",
        ),
        (lambda: op.CircularPolarizer("rigth"), "handedness is 'rigth'; did you mean 'right'"),
        (lambda: op.CircularPolarizer(op.Parameter("h")), "handedness cannot be a parameter"),
        (lambda: op.Depolarizer(-0.1), "^Depolarizer depolarization is"),
        (lambda: op.Depolarizer(1.1), "^Depolarizer depolarization is"),
        (lambda: op.MuellerElement(MATRIX, straight="no"), "straight"),
    ],
)
def test_values_that_no_such_element_has_are_refused(make, sentence):
    with pytest.raises(op.errors.ValueFault, match=sentence):
        make()


def circular(right, left):
    """The matrix in the books: Chipman, Lam & Young (2018), ch. 6, for S3 > 0 right."""
    a, b, c = (right + left) / 2, (right - left) / 2, np.sqrt(right * left)
    return np.array([[a, 0, 0, b], [0, c, 0, 0], [0, 0, c, 0], [b, 0, 0, a]])


@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_a_circular_diattenuator_is_that_of_the_books(right, left):
    found = op.CircularDiattenuator(right, left).mueller().matrix
    np.testing.assert_allclose(found, circular(right, left), rtol=0, atol=3e-16)
    leak = np.array([1e-3, 1e-12, 1e-300])
    light = chain([op.CircularDiattenuator(1.0, leak)], [1.0, 0.0, 0.0, -1.0]).trace()
    np.testing.assert_allclose(light.S0, leak, rtol=1e-15)


PAIRS = {
    "diattenuator": (op.CircularDiattenuator(T, L), circular),
    "right": (op.CircularPolarizer("right", T, L), circular),
    "left": (op.CircularPolarizer("left", T, L), lambda t, leakage: circular(leakage, t)),
}


@pytest.mark.parametrize(
    ("engine", "composing"),
    [*(("numpy", way) for way in ("stokes", "jones")), *(slow((e, "stokes")) for e in ENGINES[1:])],
)
@rows("name", PAIRS)
def test_every_engine_gives_circular_light_its_two_transmittances(engine, composing, name):
    element, matrix = PAIRS[name]
    t, leakage = np.random.default_rng(2).uniform(0, 1, (2, 400))
    plan = op.Composer(engine=engine, composing=composing).compose(chain([element], STATE))
    found = plan.run(t=t, l=leakage).stokes
    expected = [matrix(a, b) @ STATE for a, b in zip(t, leakage, strict=True)]
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-15)


@rows("word, sign", [("right", 1), ("left", -1)])
def test_an_ideal_circular_polariser_is_exact_and_of_the_handedness_that_light_says(word, sign):
    ideal = op.CircularPolarizer(word)
    expected = circular(*(1.0, 0.0)[::sign])
    np.testing.assert_array_equal(ideal.mueller().matrix, expected)
    light = chain([ideal]).trace()
    assert (light.handedness, light.intensity) == (sign, 0.5)
    assert chain([ideal], light.normalized).trace().intensity == 1.0
    other = op.CircularPolarizer("left" if word == "right" else "right")
    assert chain([ideal, other], STATE).trace().intensity == 0.0
    right, left = (op.Light([1.0, 0.0, 0.0, s3]) for s3 in (1.0, -1.0))
    np.testing.assert_array_equal((op.CircularDiattenuator() @ right).stokes, right.stokes)
    np.testing.assert_array_equal((op.CircularDiattenuator() @ left).stokes, 0.0)


def test_circular_light_does_not_know_a_turn_but_a_laminated_sheet_does():
    pair = [op.Rotator(0.4), op.CircularPolarizer("left", 0.9, 0.2)]
    before, behind = (chain(two, STATE).trace().stokes for two in (pair, pair[::-1]))
    np.testing.assert_allclose(before, behind, rtol=0, atol=3e-16)
    sheet = [op.Polarizer(0.0), op.Retarder(np.pi / 2, np.pi / 4)]
    light = chain(sheet, (1.0, 0.0, 0.0, -1.0)).trace()
    np.testing.assert_allclose(light.stokes, [0.5, 0.0, 0.0, -0.5], rtol=0, atol=1e-16)


def test_a_depolarizer_leaves_what_it_does_not_take_and_no_more_is_carried():
    path, taken = chain([op.Depolarizer(op.Parameter("d"))], STATE), np.linspace(0.0, 1.0, 50)
    light = path.trace(d=taken)
    np.testing.assert_array_equal(light.intensity, 1.0)
    left = np.linalg.norm(STATE[1:]) * (1.0 - taken)
    np.testing.assert_allclose(light.dop, left, rtol=0, atol=1e-15)
    with pytest.raises(op.errors.ComposerError, match=r"'e0\.out' has a Mueller matrix"):
        op.Composer(composing="jones").compose(path)
    plan = chain([op.Depolarizer(), op.Rotator(op.Parameter("a"))], STATE).compose()
    assert plan.program.counts[-1] == 1
    assert "left out, since it changes nothing alive: turn back at 'e1.out'" in plan.explain()
    path = chain([op.Depolarizer(op.Parameter("d"))], [1.0, 0.5, 0.0, 0.0])
    assert path.compose().model == "sp"
    assert len(chain([op.Depolarizer(0.0)], STATE).compose().program.steps) == 1


MEETS = op.plane_of_incidence(direction=(1.0, 0.0, -1.0), normal=(0.0, 0.0, 1.0))


def test_what_scatters_has_a_frame_for_each_way_and_what_light_goes_straight_through_has_one(
    tmp_path,
):
    scatters, passes = (op.MuellerElement(MATRIX, straight=straight) for straight in (False, True))
    paths = []
    for element in (scatters, passes):
        path = op.PathGraph()
        lamp = path.add("lamp", op.Source(stokes=[1, 0, 1, 0]), {"out": MEETS.arriving})
        frames = {"in": MEETS.arriving, "out": MEETS.reflected}
        lamp >> path.add("sample", element, frames=frames) >> path.add("eye", op.Detector())
        paths.append(path)
    light = paths[0].trace()
    np.testing.assert_array_equal(light.stokes, MATRIX @ [1, 0, 1, 0])
    np.testing.assert_array_equal(light.frame.z, MEETS.reflected.z)
    with pytest.raises(
        op.errors.PathError, match="lets light go straight through; give its ports one"
    ):
        paths[1].trace()
    # Alone, light leaves in a frame of its own.
    arriving = op.Light([1, 0, 1, 0], MEETS.arriving)
    assert not np.allclose((scatters @ arriving).frame.z, MEETS.arriving.z)
    np.testing.assert_array_equal((passes @ arriving).frame.z, MEETS.arriving.z)
    assert "straight = false" in paths[0].to_toml()
    assert read_back(paths[0], tmp_path) == paths[0]
    assert scatters.reversed().straight is False

    class Scatterer(op.Element):
        straight: op.fields.YesOrNo = True

    assert Scatterer(straight=False).straight is False
