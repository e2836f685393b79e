"""The wavelengths that light is of, and what of them light keeps that is made of it."""

import pickle

import numpy as np
import pytest

import optipath as op
from dispersive import GRID, line
from tables import rows

WAVELENGTHS = np.array([4e-7, 5e-7, 6e-7])
LIGHT = op.Light([[1.0, 0.2, 0, 0], [2.0, 0, 0.5, 0], [3.0, 0, 0, 1]], wavelength=WAVELENGTHS)
DIMMED = op.Source(line(0.2, 0.9)) >> op.Polarizer(op.Parameter("a", 0.0)) >> op.Detector()


def test_light_of_every_run_end_way_and_part_has_its_wavelengths():
    plan = DIMMED.compose()
    (way,) = plan.paths(wavelength=GRID)
    for light in (
        *[DIMMED.trace(wavelength=GRID), DIMMED.bind(wavelength=GRID).trace(), way.light],
        DIMMED.trace_all(wavelength=GRID)["detector"],
    ):
        assert np.array_equal(light.wavelength, GRID)
    assert DIMMED.trace(wavelength=5e-7).wavelength == 5e-7
    assert DIMMED.trace(wavelength="2.4 eV").wavelength == pytest.approx(516.601e-9, rel=1e-6)
    light = DIMMED.trace(wavelength=GRID[:, None], a=np.zeros(7))
    assert light.wavelength.shape == (4, 1)
    assert np.array_equal(light[2, 3].wavelength, GRID[2])
    given = {"wavelength": GRID[:, None], "a": np.linspace(0.0, 1.0, 3)}
    whole = plan.run(**given)
    for part in plan.stream(4, **given):
        expected = np.broadcast_to(whole.wavelength, whole.shape)[part.where]
        assert np.array_equal(np.broadcast_to(part.light.wavelength, part.light.shape), expected)


def test_a_wavelength_may_have_another_name_and_light_of_none_or_two_has_none():
    source, pumped = op.Source(), op.Source(line(0.2, 0.9, op.Wavelength("pump")))
    assert (pumped >> op.Detector()).trace(pump=5e-7).wavelength == 5e-7
    plate = op.Waveplate("1 mm", 0.009, op.Parameter("wavelength"))
    path = op.Source(stokes=[1, 0, 1, 0]) >> plate >> op.Detector()
    assert np.array_equal(path.trace(wavelength=WAVELENGTHS).wavelength, WAVELENGTHS)
    path = pumped >> op.Attenuator(line(0.2, 0.9, op.Wavelength("probe"))) >> op.Detector()
    assert path.trace(pump=5e-7, probe=6e-7).wavelength is None
    assert (source >> op.Detector()).trace().wavelength is None
    path = source >> op.Polarizer(op.Parameter("wavelength")) >> op.Detector()
    assert path.trace(wavelength=0.3).wavelength is None
    assert LIGHT.integrate().wavelength is None


@rows(
    "made",
    [
        *[2.0 * LIGHT, LIGHT / 3.0, LIGHT + LIGHT, sum([LIGHT, LIGHT]), LIGHT.nearest_physical()],
        *[LIGHT.in_frame(op.Frame().turned(0.3)), op.Polarizer(0.3) @ LIGHT],
        *[op.Polarizer(0.3).mueller() @ LIGHT, LIGHT[:], LIGHT.reshape(3, 1)[:, 0]],
        pickle.loads(pickle.dumps(LIGHT)),
        pickle.loads(pickle.dumps(DIMMED.trace(wavelength=WAVELENGTHS))),
    ],
)
def test_light_that_is_made_of_light_has_its_wavelengths(made):
    assert np.array_equal(made.wavelength, WAVELENGTHS)


def test_an_index_takes_its_wavelengths_and_they_do_not_change():
    assert LIGHT[1].wavelength == 5e-7
    assert np.array_equal(LIGHT[::-1].wavelength, WAVELENGTHS[::-1])
    assert np.array_equal(LIGHT[LIGHT.S1 == 0].wavelength, WAVELENGTHS[1:])
    assert [float(each.wavelength) for each in LIGHT] == [4e-7, 5e-7, 6e-7]
    given = GRID.copy()
    light = DIMMED.trace(wavelength=given)
    given[:] = 5e-7
    assert np.array_equal(light.wavelength, GRID)
    with pytest.raises(ValueError, match="read-only"):
        LIGHT.wavelength[0] = 1.0


def test_lights_of_different_wavelengths_are_not_added():
    further = op.Light(LIGHT.stokes, wavelength=WAVELENGTHS + 1e-8)
    both = [
        *[lambda: LIGHT + further, lambda: LIGHT + LIGHT[::-1], lambda: LIGHT + LIGHT[0]],
        *[lambda: sum(LIGHT), lambda: np.add(LIGHT, further)],
        lambda: DIMMED.trace(wavelength="500 nm") + DIMMED.trace(wavelength="501 nm"),
        lambda: DIMMED.trace(wavelength="2 eV") + DIMMED.bind(wavelength="2.1 eV").trace(),
    ]
    for add in both:
        with pytest.raises(op.errors.LightError, match=r"different wavelengths, .* nm and .* nm"):
            add()


def test_lights_of_one_wavelength_or_none_have_it_together():
    plain = op.Light([1.0, 0, 0, 0])
    for light in (LIGHT + plain, plain + LIGHT, sum([LIGHT, plain]), LIGHT + LIGHT.integrate()):
        assert light.wavelength is None
    assert np.array_equal((plain + LIGHT).S0, LIGHT.S0 + 1.0)
    runs = [DIMMED.trace(wavelength=GRID, a=a) for a in (0.1, 0.2)]
    assert np.array_equal((runs[0] + runs[1]).wavelength, GRID)
    light = op.Light([1.0, 0, 0, 0], wavelength=830 * 1e-9)
    assert 830 * 1e-9 != 830e-9
    assert (light + light.at_wavelengths(830e-9)).wavelength == pytest.approx(830e-9)
    single = LIGHT.at_wavelengths(WAVELENGTHS.astype(np.float32))
    assert np.array_equal((LIGHT + single).wavelength, WAVELENGTHS)
    light = op.Light([[1.0, 0, 0, 0]] * 2)
    said = light.at_wavelengths(["400 nm", "500 nm"])
    assert np.array_equal(said.wavelength, [4e-7, 5e-7])
    assert light.wavelength is None
    assert said == light


@rows(
    "wavelengths, sentence",
    [
        ([4e-7, 5e-7, 6e-7], r"shape \(3,\) do not fit light of shape \(2,\)"),
        ([[4e-7], [5e-7]], r"shape \(2, 1\) do not fit light of shape \(2,\)"),
        (516.0, "for nanometres write '516 nm'"),
        (-1.0, "wavelength"),
        ("blue", "blue"),
    ],
)
def test_what_is_no_wavelength_of_light_is_refused(wavelengths, sentence):
    light = op.Light([[1.0, 0, 0, 0]] * 2)
    with pytest.raises(op.OptipathError, match=sentence):
        light.at_wavelengths(wavelengths)


def test_wavelengths_that_jax_traces_are_those_of_the_run(jax):
    found = jax.jit(lambda w: DIMMED.trace(wavelength=w).wavelength * 2.0)(5e-7)
    np.testing.assert_allclose(found, 1e-6)


def probed_gold(**of_source):
    gold = op.Material(line(0.2, 0.9), 0.0)
    return op.Source(**of_source) >> op.Interface(gold, "40 deg") >> op.Detector()


def test_light_is_by_the_wavelength_that_its_spectrum_follows_from():
    lamp = op.Spectrum.black_body(3000.0).at(op.Wavelength("probe"))
    path = probed_gold(spectrum=lamp)
    assert np.array_equal(path.trace(wavelength=GRID, probe="516 nm").wavelength, 516e-9)
    assert np.array_equal(path.trace(wavelength="516 nm", probe=GRID).wavelength, GRID)
    assert path.bind(probe="516 nm").trace(wavelength=GRID).wavelength == 516e-9
    dye = op.Material.cauchy([op.Parameter("a"), 0.004], wavelength=5e-7).n
    light = probed_gold(spectrum=dye).trace(wavelength=GRID, a=1.5)
    assert np.array_equal(light.wavelength, GRID)


def test_light_is_by_no_wavelength_where_several_are_in_doubt():
    path = probed_gold(intensity=line(0.2, 0.9, op.Wavelength("probe")))
    light = path.trace(wavelength=GRID, probe="516 nm")
    assert light.wavelength is None
    for each in (light, light[:2], 2.0 * light):
        with pytest.raises(
            op.errors.LightError, match=r"s, probe and wavelength; .*at_wavelengths"
        ):
            each.integrate()
    known = light.at_wavelengths(GRID).integrate().intensity
    between = (light.intensity[1:] + light.intensity[:-1]) / 2.0
    assert known == pytest.approx(np.sum(between * np.diff(1e9 * GRID)))
