"""A path that depends on the wavelength comes to the same bits alone and in any batch."""

import numpy as np
import pytest

import optipath as op
from chains import COMPILED
from optipath.values.curves.curve_value import curve_values
from spectral_paths import Ramps, SpectralDraw, run_by_run, wavelengths
from tables import rows, slow

FLOATS = np.linspace(0.0, np.pi / 2, 4)
WAVELENGTH = op.Wavelength()

# Absorbing layers are thin here, so that light comes through.
pytestmark = pytest.mark.filterwarnings("ignore::optipath.errors.CoherenceWarning")


def ramp(low, high, period=1.1e-7):
    return curve_values(Ramps(low, high, period), WAVELENGTH)[0]


def metal(theta):
    """Its absorption is exactly 0 at a third of all wavelengths."""
    return op.Interface(op.Material(ramp(0.3, 2.5), ramp(0.0, 3.0, 1.7e-7)), theta)


def wave_plate():
    return op.Waveplate(1e-3, ramp(-0.01, 0.02), WAVELENGTH, angle=0.4)


def absorbing_stack(theta):
    indices = [1.0, op.Material(ramp(1.4, 1.7), ramp(0.0, 1e-2)), 1.5, 1.0]
    return op.LayerStack(indices, theta, lengths=[1e-6, 1e-3], wavelength=WAVELENGTH)


def medium():
    return op.Medium(
        0.1,
        ramp(20.0, 30.0),
        dichroism=ramp(-10.0, 10.0),
        rotation=ramp(-5.0, 5.0),
        retardance=30.0,
    )


def combined(theta):
    """Everything in which elementary functions are taken of what follows from the wavelength."""
    graph = op.PathGraph()
    lamp = graph.add("lamp", op.Source(2.0, [1.0, 0.5, 0.2, 0.1]))
    after = lamp >> metal(theta) >> wave_plate() >> op.Rotator(ramp(-3.0, 3.0, 9e-8))
    after = after >> medium() >> op.Polarizer(theta) >> absorbing_stack(theta)
    after >> op.Detector()
    return graph


def compared(path, *, engine="auto", dtype="float64", runs=1, axis="theta", values=FLOATS):
    """The light of a grid, and the light of each of its paths by a run of its own."""
    shape = 5, len(values)
    given = {"wavelength": wavelengths(5)[:, None], axis: values}
    alone = run_by_run(op.Composer(dtype=dtype).compose(path), given, shape)
    plan = op.Composer(engine=engine, dtype=dtype).compose(path)
    for _ in range(runs):
        lights = plan.run_all(**given)
    assert alone.keys() == lights.keys()
    return [(alone[name], light.stokes) for name, light in lights.items()]


@pytest.mark.parametrize("dtype", ["float64", slow("float32")])
@rows("engine", COMPILED)
def test_a_grid_is_its_runs_one_by_one_by_every_engine(engine, dtype):
    short = op.Source() >> metal(op.Parameter("theta")) >> op.Medium(0.1, ramp(0.0, 9.0))
    path = short >> op.Rotator(ramp(-3.0, 3.0)) >> op.Polarizer(0.3) >> op.Detector()
    ((alone, together),) = compared(path, engine=engine, dtype=dtype)
    assert np.array_equal(alone, together)


@rows("dtype", ["float64", "float32"])
@rows("runs", [1, 5])
def test_a_grid_is_its_runs_step_by_step_and_by_a_formula(runs, dtype):
    for alone, together in compared(combined(op.Parameter("theta")), runs=runs, dtype=dtype):
        assert np.array_equal(alone, together)


@pytest.mark.parametrize("seed", range(24))
def test_random_paths_are_the_same_alone_and_among_others(seed):
    draw = SpectralDraw(seed)
    path, given = draw.spectral_path()
    plan, shape = path.compose(), (7,)
    try:
        alone = run_by_run(plan, {**given, "wavelength": wavelengths(7)}, shape)
    except op.ParameterError:
        pytest.skip("no light can be where it has been drawn")
    for count in (1, 300):
        lights = plan.run_all(**given, wavelength=np.tile(wavelengths(7), count))
        for name, light in lights.items():
            assert np.array_equal(alone[name], light.stokes[:7], equal_nan=True)


def test_the_first_run_is_the_tenth_and_parts_of_a_stream_are_the_batch():
    plan = combined(op.Parameter("theta")).compose()
    lights = [plan.run(wavelength=5.1e-7, theta=0.7).stokes for _ in range(10)]
    assert all(np.array_equal(lights[0], light) for light in lights)
    plan = combined(op.Parameter("theta")).compose()
    given = {"wavelength": wavelengths(50)[:, None], "theta": FLOATS}
    whole = plan.run(**given).stokes
    for part in plan.stream(7, **given):
        assert np.array_equal(whole[part.where], part.light.stokes)


def test_no_absorption_and_faint_light_leave_their_neighbours_as_they_are():
    path = op.Source() >> metal(op.Parameter("theta")) >> op.Detector()
    k = np.array([ramp(0.0, 3.0, 1.7e-7).curve.evaluated(w)[0] for w in wavelengths(5)])
    assert np.any(k == 0.0)
    assert np.any(k > 0.0)
    ((alone, together),) = compared(path)
    assert np.array_equal(alone, together)
    black = op.Medium(1.0, ramp(0.0, 1900.0))
    path = op.Source() >> black >> metal(op.Parameter("theta")) >> op.Detector()
    ((alone, together),) = compared(path)
    assert np.any(together[..., 0] < 1e-290)
    assert np.array_equal(alone, together)


@pytest.mark.filterwarnings("ignore::optipath.AngleWarning")
def test_huge_angles_beside_others_leave_those_as_they_are():
    path = op.Source(1.0, [1, 1, 0, 0]) >> op.Rotator(op.Parameter("turn")) >> wave_plate()
    path = path >> op.Polarizer(0.2) >> op.Detector()
    turns = np.array([0.3, 3e5, -2.0, 1e12])
    ((alone, together),) = compared(path, axis="turn", values=turns)
    assert np.array_equal(alone, together)


def test_a_loop_is_the_same_alone_and_among_others():
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source())
    path.add("splitter", op.BeamSplitter(ramp(0.0005, 0.9)))
    path.add("mirror", metal(op.Parameter("theta")))
    path.add("eye", op.Detector())
    path.connect("lamp.out", "splitter.in")
    path.connect("splitter.transmitted", "eye.in")
    path.connect("splitter.reflected", "mirror.in")
    path.connect("mirror.reflected", "splitter.back")
    for alone, together in compared(path):
        assert np.array_equal(alone, together)


def test_matrices_are_the_same_alone_and_among_others():
    path, w = combined(op.Parameter("theta")), wavelengths(400)
    plan, single = path.compose(), path.compose()
    found = plan.mueller(wavelength=w[:, None], theta=FLOATS[1:]).matrix
    alone = [
        [single.mueller(wavelength=a, theta=float(t)).matrix for t in FLOATS[1:]] for a in w[:5]
    ]
    assert np.array_equal(found[:5], alone)


def test_a_cosine_and_a_sine_in_place_of_an_angle_are_the_same_alone_and_among_others():
    path = op.Source() >> op.Rotator(op.Parameter("turn")) >> wave_plate() >> op.Polarizer(0.1)
    plan = (path >> op.Detector()).compose()
    pair = op.CosSin(np.cos(0.7), np.sin(0.7))
    alone = [plan.run(wavelength=float(w), turn=pair).stokes for w in wavelengths(7)]
    for count in (1, 300):
        together = plan.run(wavelength=np.tile(wavelengths(7), count), turn=pair).stokes
        assert np.array_equal(alone, together[:7])
