import numpy as np
import pytest

import optipath as op
from chains import by_engine
from paths import chain
from tables import rows, slow
from wired import read

STATE = [1.0, 0.5, 0.6, 0.4]


def test_intensity_decays_by_beer_and_lambert():
    lengths = np.linspace(0.0, 0.5, 20)
    light = chain([op.Medium(lengths, absorption=13.8)], STATE).trace()
    np.testing.assert_allclose(light.intensity, np.exp(-13.8 * lengths), rtol=4e-15)
    np.testing.assert_allclose(light.dop, np.linalg.norm(STATE[1:]), rtol=1e-15)
    both = [op.Medium(0.2, 3.0, rotation=2.0), op.Medium(0.3, 3.0, rotation=2.0)]
    whole = [op.Medium(0.5, 3.0, rotation=2.0)]
    found, wanted = (chain(elements, STATE).trace().stokes for elements in (both, whole))
    np.testing.assert_allclose(found, wanted, rtol=1e-15, atol=2e-16)


SUCROSE = 66.5
"""The specific rotation at 589 nm and 20 deg C, +66.5 deg ml / (g dm): dextrorotatory."""


def clockwise(light, frame):
    """By how many degrees light is turned from x of a frame, as who looks at the source sees it."""
    facing, up = -frame.z, frame.x
    right = np.cross(facing, up)
    # The axis of what came out polarised along x, from its components in that frame.
    axis = np.cos(light.aop) * light.frame.x + np.sin(light.aop) * light.frame.y
    return np.degrees(np.arctan2(axis @ right, axis @ up))


@rows("z", [(0, 0, 1), (0, 0, -1), (0.6, 0.0, 0.8)])
def test_a_sugar_solution_turns_light_clockwise_to_who_looks_at_the_source(z):
    # A tube of 2 dm with 0.1 g/ml.
    solution = op.Medium(0.2, dextrorotation=np.radians(SUCROSE * 0.1) / 0.1)
    frame = op.Frame.from_direction(z, (1, 2, 0))
    light = solution.mueller(frame_in=frame) @ op.Light([1.0, 1.0, 0.0, 0.0], frame)
    assert clockwise(light, frame) == pytest.approx(13.3, abs=1e-12)


@by_engine
def test_a_dextrorotation_is_a_rotation_of_the_other_sign(engine):
    turns = np.linspace(-40.0, 40.0, 3000)
    medium = op.Medium(0.1, 2.0, dextrorotation=op.Parameter("d"))
    path = chain([medium], STATE)
    assert path.parameters["d"].unit == "deg/dm"
    plan = op.Composer(engine=engine).compose(path)
    wanted = chain([op.Medium(0.1, 2.0, rotation=-turns)], STATE).trace().stokes
    np.testing.assert_allclose(np.asarray(plan.run(d=turns).stokes), wanted, rtol=0, atol=2e-7)
    known = chain([op.Medium(0.1, 2.0, dextrorotation=turns)], STATE).trace().stokes
    np.testing.assert_allclose(known, wanted, rtol=0, atol=1e-15)


SUGAR = """
format = 1
parameters.sugar = { default = "66.5 deg/dm", unit = "deg/dm" }
elements.lamp = { kind = "source", stokes = [1, 1, 0, 0] }
elements.tube = { kind = "medium", length = "2 dm", dextrorotation = "$sugar" }
elements.eye = { kind = "detector" }
links = [{ from = "lamp.out", to = "tube.in" }, { from = "tube.out", to = "eye.in" }]
"""


def test_presets_take_the_chemists_sign_in_the_chemists_unit(tmp_path):
    path = read(SUGAR, tmp_path)
    # 133 degrees clockwise are 47 counter-clockwise.
    assert np.degrees(path.trace().aop) == pytest.approx(47.0, abs=1e-12)
    assert np.degrees(path.trace(sugar=np.radians(6.65) / 0.1).aop) == pytest.approx(-13.3)
    assert "dextrorotation" in path.to_toml()


@rows("rotation", [1.0, op.Parameter("a"), np.array([0.0, 1.0]), -0.1])
def test_a_rotation_by_both_signs_is_refused(rotation):
    for other in (1.0, op.Parameter("b"), np.array([1.0, 0.0])):
        with pytest.raises(
            op.errors.ValueFault, match=r"rotation.*the same rotation with the other sign"
        ):
            op.Medium(0.1, rotation=rotation, dextrorotation=other)


def test_a_medium_turns_as_a_rotator_and_retards_as_a_plate():
    medium = op.Medium(0.5, rotation=0.6).mueller().matrix
    np.testing.assert_array_equal(medium, op.Rotator(0.3).mueller().matrix)
    # Quartz, 589 nm: a birefringence of 0.00911 makes a quarter wave in 16.16 um.
    per_metre = 2 * np.pi * 0.00911 / 589e-9
    plate = op.Medium(589e-9 / (4 * 0.00911), retardance=per_metre).mueller()
    light = plate @ op.Light([1.0, 0.0, 1.0, 0.0])
    np.testing.assert_allclose(light.stokes, [1, 0, 0, 1], rtol=0, atol=1e-15)
    medium = chain([op.Medium(0.5, retardance=1.4, angle=0.3, azimuth=0.2)], STATE)
    plate = chain([op.Retarder(0.7, 0.3, azimuth=0.2)], STATE)
    np.testing.assert_array_equal(medium.trace().stokes, plate.trace().stokes)


def test_absorption_comes_from_the_extinction_coefficient():
    # One skin depth of the intensity, wavelength / (4 pi k), leaves 1/e.
    medium = op.Medium.from_extinction(500e-9 / (4 * np.pi * 2.12), k=2.12, wavelength=500e-9)
    assert medium.mueller().matrix[0, 0] == pytest.approx(np.exp(-1), rel=1e-15)
    k, wavelength = np.array([[0.0], [0.1]]), np.array([4e-7, 5e-7, 6e-7])
    assert op.Medium.from_extinction(1e-6, k, wavelength, rotation=0.1).absorption.shape == (2, 3)
    medium = op.Medium.from_extinction(0.1, k=1e-7, wavelength=589e-9, dextrorotation=1.0)
    assert medium == op.Medium(0.1, medium.absorption, dextrorotation=1.0)
    with pytest.raises(op.errors.ValueFault) as error:
        op.Medium.from_extinction(1.0, k=op.Parameter("k"), wavelength=0.0)
    assert [fault.split()[0] for fault in error.value.faults] == ["k", "wavelength"]


@pytest.mark.parametrize(
    ("engine", "dtype"), [("numpy", "float32"), ("numpy", "float64"), slow(("numba", "float64"))]
)
@rows("acts", ["rotation", "retardance"])
def test_all_values_may_be_parameters_which_have_the_usual_units(engine, dtype, acts):
    names = ("length", "absorption", acts, "angle")
    path = chain([op.Medium(**{name: op.Parameter(name) for name in names})], STATE)
    assert [path.parameters[name].unit for name in names] == ["mm", "1/cm", "deg/mm", "deg"]
    values = dict(zip(names, np.random.default_rng(2).uniform(0, 1, (4, 3000)), strict=True))
    found = op.Composer(engine=engine, dtype=dtype).compose(path).run(**values).stokes
    wanted = chain([op.Medium(**values)], STATE).trace().stokes
    np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-6 if dtype == "float32" else 1e-15)


def test_a_medium_that_does_nothing_takes_no_step_and_jones_columns_pass():
    assert len(chain([op.Medium(op.Parameter("l"))]).compose().program.steps) == 1
    path = chain([op.Medium(0.1, 5.0, rotation=2.0), op.Medium(0.1, retardance=3.0)], STATE)
    jones = op.Composer(composing="jones").compose(path).run().stokes
    np.testing.assert_allclose(jones, path.trace().stokes, rtol=0, atol=1e-15)


@rows("zero", [np.zeros(3), op.Parameter("a", 0.0, bound=True)])
def test_one_of_both_may_be_0(zero):
    found = op.Medium(0.5, rotation=zero, retardance=1.0).mueller().matrix
    several = np.zeros((*np.shape(zero), 1, 1))
    np.testing.assert_array_equal(found, op.Retarder(0.5).mueller().matrix + several)
    found = op.Medium(0.5, rotation=1.0, retardance=zero).mueller().matrix
    np.testing.assert_array_equal(found, op.Rotator(0.5).mueller().matrix + several)


def test_all_faults_are_told_at_once():
    with pytest.raises(op.errors.ValueFault) as error:
        op.Medium(-0.1, -2.0, rotation="x", retardance=op.Parameter("r", unit="deg"))
    found = "\n".join(error.value.faults)
    for part in (
        "Medium length is -100 mm; give a real length of 0 mm or more",
        "Medium absorption is -0.02 1/cm",
        "Medium rotation: 'x' is not a quantity; write a number such as '30 deg/mm'",
        "parameter 'r' is in deg, but Medium retardance takes a real angle per length",
    ):
        assert part in found


@rows("engine", ["numpy", "numba"])
@rows("size", [3, 3000])
def test_light_behind_a_dense_medium_is_right_however_faint(engine, size):
    absorption = np.linspace(600.0, 700.0, size)
    names = op.Parameter("l"), op.Parameter("a")
    found = op.Composer(engine=engine).compose(chain([op.Medium(*names)], STATE))
    known = chain([op.Medium(1.0, absorption)], STATE).trace()
    for light in (found.run(l=1.0, a=absorption), known):
        np.testing.assert_allclose(light.log10_intensity, -absorption / np.log(10), rtol=1e-14)
        np.testing.assert_allclose(light.dop, np.linalg.norm(STATE[1:]), rtol=1e-14)


@rows("dtype", ["float32", "float64"])
@rows("composing", ["stokes", "jones"])
def test_light_too_faint_for_a_medium_is_dark_and_never_polarised_by_more_than_all(
    dtype, composing
):
    absorption = np.linspace(0.0, 2500.0, 3000)
    composer = op.Composer(dtype=dtype, composing=composing)
    path = chain([op.Medium(1.0, op.Parameter("a"))], [1.0, 0.6, 0.0, 0.8])
    light = composer.compose(path).run(a=absorption)
    right = absorption <= (80.0 if dtype == "float32" else 700.0)
    rounding = 1e-6 if dtype == "float32" else 1e-14
    np.testing.assert_allclose(light.dop[right], 1.0, rtol=rounding)
    lit = np.isfinite(light.log10_intensity)
    assert np.all(light.dop[lit] <= 1.0 + rounding)
    wanted = -absorption[lit] / np.log(10)
    np.testing.assert_allclose(light.log10_intensity[lit], wanted, rtol=rounding, atol=1e-6)
    matrix = op.Medium(1.0, np.array([720.0, 740.0, 744.0, 2000.0])).mueller()
    for dark in (light[~lit], matrix @ op.Light([1.0, 0.6, 0.0, 0.8])):
        np.testing.assert_array_equal(dark.stokes, 0.0)
        np.testing.assert_array_equal(dark.dop, np.nan)
        np.testing.assert_array_equal(dark.log10_intensity, -np.inf)


@rows(
    "length, absorption, steps",
    [
        (0.1, 100.0, 1),
        (0.1, 1e4, 3),
        (0.1, op.Parameter("a", maximum=400.0), 1),
        (0.1, op.Parameter("a"), 3),
        (op.Parameter("l", 1.0, bound=True), np.array([1.0, 2.0]), 1),
    ],
)
def test_a_medium_that_is_never_dense_takes_one_step(length, absorption, steps):
    (coupling,) = op.Medium(length, absorption).couplings()
    assert len(coupling.operations) == steps


@pytest.mark.filterwarnings("error")
@rows(
    "options, message",
    [
        ({"k": 1e300, "wavelength": 1e-12}, "absorption is inf"),
        ({"wavelength": 500}, "wavelength is 500 m; give a real wavelength in metres within 1e-12"),
    ],
)
def test_what_gives_no_absorption_is_refused(options, message):
    with pytest.raises(op.errors.ValueFault, match=message):
        op.Medium.from_extinction(1e-6, **({"k": 0.1, "wavelength": 5e-7} | options))
