"""What may be given to JAX: refused where its numbers are known, and NaN where it traces them."""

import warnings

import numpy as np
import pytest

import optipath as op
from paths import chain
from tables import rows, slow, slow_except

jax = pytest.importorskip("jax")
jnp = jax.numpy


# Angles of any size are meant in radians.
pytestmark = [
    pytest.mark.filterwarnings("ignore::optipath.errors.AngleWarning"),
    pytest.mark.usefixtures("jax"),
]
V = op.Parameter("v")
STATE = (1.0, 0.5, 0.3, 0.4)
POINTS = np.array([[0.0, 0, 2], [0, 0, 0], [0, 2, 0]])
FIELDS = {
    "intensity": (op.Source, [0.5], [-0.1, np.inf]),
    "stokes": (
        lambda v: op.Source(2.0, v),
        [np.array([1.0, 0.6, 0.0, 0.8]), np.zeros(4)],
        [np.array([1.0, 0.8, 0.0, 0.8]), np.array([-1.0, 0, 0, 0]), np.array([0.0, 1, 0, 0])],
    ),
    "angle": (op.Polarizer, [-9.0, 1e4], [np.inf, np.nan]),
    "transmittance": (lambda v: op.Polarizer(0.3, 0.1, v), [0.0, 0.5, 1.0], [-0.1, 1.1]),
    "leakage": (lambda v: op.Polarizer(0.3, leakage=v), [0.0, 1.0], [-1e-9, 2.0]),
    "attenuation": (op.Attenuator, [0.3, 1.0], [-0.1, 1.5]),
    "depolarization": (op.Depolarizer, [0.3, 1.0], [-0.1, 1.5]),
    "maximum": (lambda v: op.Diattenuator(v, 0.2), [0.7], [-0.1, 1.5]),
    "minimum": (lambda v: op.Diattenuator(0.9, v), [0.7], [-0.1, 1.5]),
    "retardance": (op.Retarder, [0.7], [np.inf]),
    "rotation": (op.Rotator, [0.7], [-np.inf]),
    "amplitude": (op.Mirror, [-1.0, 0.6], [-1.1, 2.0]),
    "complex amplitude": (lambda v: op.Mirror(0.9, v), [0.6 + 0.8j], [0.8 + 0.8j]),
    "matrix": (op.MuellerElement, [np.diag([1, 0.5, 0.2, 0.1])], [np.eye(4) * np.nan]),
    "reflectance": (op.BeamSplitter, [0.0, 0.3], [-0.1, 1.1]),
    "extinction": (op.PolarizingBeamSplitter, [1.000001, 30.0, 1e30], [1.0, -2.0, np.nan]),
    "leakage of circular light": (lambda v: op.CircularPolarizer("left", 1.0, v), [0.3], [1.1]),
    "Faraday's angle": (op.FaradayRotator, [0.7], [np.inf]),
    "field": (lambda v: op.FaradayRotator(verdet=-9.0, field=v, length=0.1), [-2.0], [np.nan, 1e9]),
    "thickness": (lambda v: op.Waveplate(v, 0.01, 5e-7), [0.0, 0.01], [-1e-3, 1e9]),
    "wavelength": (lambda v: op.Waveplate(1e-3, 0.01, v), [5e-7], [0.0, 1.0]),
    "length": (lambda v: op.Medium(v, 2.0), [0.0, 0.5], [-0.1]),
    "absorption": (lambda v: op.Medium(0.5, v), [0.0, 2.0], [-0.1]),
    "dichroism": (lambda v: op.Medium(0.5, 2.0, dichroism=v), [-2.0, 0.0, 2.0], [2.1, -3.0]),
    "depolarisation": (lambda v: op.Medium(0.5, depolarization=v), [0.0, 2.0], [-0.1]),
    "elliptical retardance": (lambda v: op.EllipticalRetarder(0.3, v), [0.0, 2.0], [np.inf]),
    "right-handed": (lambda v: op.CircularDiattenuator(v, 0.2), [0.1, 0.7], [-0.1, 1.5]),
    "incidence": (lambda v: op.Interface(1.5, v), [0.0, 0.7, np.pi / 2], [-0.1, 1.6, 2.0]),
    "index": (lambda v: op.Interface(v, 0.7), [1e-9, 1.5], [-0.5, 0.0, np.inf]),
    "complex index": (lambda v: op.Interface(v, 0.7), [0.2 + 3j], [0.2 - 3j, -0.2 + 3j]),
    "n": (lambda v: op.Interface(op.Material(v, 2.0), 0.7), [0.5], [-0.5]),
    "k": (lambda v: op.Interface(op.Material(1.5, v), 0.7), [0.0, 2.0], [-1e-3]),
    "outside": (lambda v: op.Interface(1.5, 0.7, v), [1.2], [0.0, -1.0]),
    "k outside": (lambda v: op.Interface(1.5, 0.7, op.Material(1.2, v)), [0.0, 0.1], [-0.1, 2.0]),
    "incidence in": (lambda v: op.Interface(1.5, 0.5, incidence_in=v), [1.2], [0.0]),
    "layer": (lambda v: op.LayerStack([1.0, v, 1.5], 0.7), [1.3], [0.0, -1.3]),
    "front": (lambda v: op.LayerStack([v, 1.4, 1.5], 0.7), [1.3], [-1.3]),
    "substrate": (lambda v: op.LayerStack([1.0, 1.3, v], 0.7), [1.3 + 2j], [1.3 - 2j]),
    "incidence of a stack": (lambda v: op.LayerStack([1.0, 1.3, 1.5], v), [0.3], [2.0]),
    "vertices": (lambda v: op.SpecularVertex(1.5, v, 1, reflections=1), [POINTS], [POINTS * 0.0]),
}


def path_of(field, value):
    element = FIELDS[field][0](value)
    if isinstance(element, op.Source):
        return element >> op.Detector()
    if not isinstance(element, (op.BeamSplitter, op.PolarizingBeamSplitter)):
        return chain([element], STATE)
    path = op.PathGraph()
    path.add("lamp", op.Source(1.0, STATE)) >> path.add("splitter", element)
    path["splitter.reflected"] >> op.Detector()
    return path


@pytest.mark.parametrize("first", [0, *map(slow, range(1, 9))])
def test_inside_a_domain_jax_gives_what_numpy_gives_and_outside_nan(first):
    for field in [*FIELDS][first::9]:
        _, inside, outside = FIELDS[field]
        path = path_of(field, V)
        traced = jax.jit(lambda v, path=path: path.trace(v=v).stokes)
        for value in inside:
            expected = op.Composer(engine="numpy").compose(path).run(v=value).stokes
            found = traced(value)
            np.testing.assert_allclose(found, expected, rtol=0, atol=1e-14, err_msg=field)
        for value in outside:
            with pytest.raises(op.OptipathError):
                op.Composer(engine="jax").compose(path).run(v=value)
            assert np.isnan(traced(value)).all(), (field, value)


@pytest.mark.parametrize(
    "field",
    slow_except(
        ["incidence", "stokes"], ["incidence", "k", "transmittance", "stokes", "layer", "outside"]
    ),
)
def test_a_path_that_is_built_of_traced_values_is_nan_outside_their_domains(field):
    _, (inside, *_), (outside, *_) = FIELDS[field]
    built = jax.jit(lambda v: path_of(field, v).trace().stokes)
    bound = jax.jit(lambda v: path_of(field, V).bind(v=v).trace().stokes)
    for traced in (built, bound):
        assert np.isfinite(traced(inside)).all()
        assert np.isnan(traced(outside)).all()


@pytest.mark.parametrize(
    "field", ["k", "transmittance", *map(slow, ["incidence", "index", "attenuation"])]
)
def test_slopes_are_nan_outside_a_domain_and_finite_inside_and_at_its_ends(field):
    _, inside, outside = FIELDS[field]
    slope = jax.jacobian(lambda v: path_of(field, V).trace(v=v).stokes)
    for value in outside:
        assert np.isnan(slope(value)).all(), value
    for value in inside[1:]:
        assert np.isfinite(slope(value)).all(), value


@pytest.mark.parametrize("transform", [jax.jit, slow(jax.vmap)])
def test_of_a_batch_only_what_is_outside_a_domain_or_range_is_nan(transform):
    path = path_of("incidence", V)
    given = jnp.array([0.3, 2.0, 0.7, -1.0])
    run = transform(lambda v: path.trace(v=v).stokes)
    assert np.isnan(run(given)).all(axis=-1).tolist() == [False, True, False, True]
    matrix = jax.jit(lambda v: path.mueller(v=v).matrix)(given)
    assert np.isnan(matrix).all(axis=(-2, -1)).tolist() == [False, True, False, True]
    narrow = op.Parameter("v", minimum=-0.5, maximum=0.2)
    path = chain([op.Interface(1.5, -narrow)])
    light = jax.vmap(lambda v: path.trace(v=v).stokes[0])(jnp.array([-0.6, -0.5, 0.0, 0.1, 0.3]))
    assert np.isnan(light).tolist() == [True, False, False, True, True]
    path = path_of("incidence", V)
    traced = jax.jit(lambda c: path.trace(v=op.CosSin(c, 0.6)).stokes)
    np.testing.assert_allclose(traced(0.8), path.trace(v=op.CosSin(0.8, 0.6)).stokes, rtol=1e-12)
    assert np.isnan(traced(0.7)).all()


@pytest.mark.slow
@pytest.mark.parametrize("name", ["malus", "npgr026", "glass-slab"])
def test_presets_keep_their_ranges_where_jax_traces(name):
    path = op.load_preset(name)
    highest = {n: p.maximum for n, p in path.parameters.items() if 0.0 < p.maximum < np.inf}
    traced = jax.jit(lambda given: path.trace(**given).S0)
    assert np.isfinite(traced(highest))
    for given, most in highest.items():
        assert np.isnan(traced({**highest, given: 1.01 * most})), given


def ring():
    path = op.PathGraph(loops="sum")
    node = path.add("lamp", op.Source()) >> path.add("meet", op.Combiner())
    node >> path.add("gain", op.MuellerElement(op.Parameter("gain"), physical=False))
    path.add("splitter", op.BeamSplitter(0.9))
    path["gain"] >> path["splitter.in"]
    path["splitter.reflected"] >> path["meet"]
    path["splitter.transmitted"] >> op.Detector()
    return path


@rows("gain", [1.0, 1.111, 1.1111, 1.5])
def test_known_loops_are_judged_as_by_numpy(gain):
    found = [judged(engine, gain * np.eye(4)) for engine in ("numpy", "jax")]
    assert found[0][1:] == found[1][1:]
    np.testing.assert_allclose(found[1][0], found[0][0], rtol=1e-12)


def judged(engine, gain):
    """Return the light of a ring and its matrix, what is warned of, and what is refused."""
    plan, numbers, faults = op.Composer(engine=engine).compose(ring()), [], []
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        for run in (lambda: plan.run(gain=gain).stokes, lambda: plan.mueller(gain=gain).matrix):
            try:
                numbers.append(np.ravel(run()))
            except op.OptipathError as fault:
                faults.append(str(fault))
    return np.concatenate([[0.0], *numbers]), [str(w.message) for w in warned], faults


@pytest.mark.parametrize("asked", ["light", slow("matrix")])
def test_of_loops_that_gain_light_and_slopes_are_nan_where_jax_traces(asked):
    path = ring()

    def intensity(gain):
        return path.trace(gain=gain * jnp.eye(4)).intensity

    def found(gain):
        if asked == "matrix":
            return path.mueller(gain=gain * jnp.eye(4)).matrix[0, 0]
        return jnp.stack(jax.value_and_grad(intensity)(gain))

    for gain in (1.112, 1.5):
        assert np.isnan(jax.jit(found)(gain)).all()
    for gain in (0.5, 1.1):
        leaves = 1.0 - 0.9 * gain
        light = 0.1 * gain / leaves
        expected = light if asked == "matrix" else (light, 0.1 / leaves**2)
        np.testing.assert_allclose(jax.jit(found)(gain), expected, rtol=1e-12)


def test_random_rings_are_nan_exactly_where_they_are_refused():
    rng = np.random.default_rng(5)
    path, plan = ring(), op.Composer(engine="numpy").compose(ring())
    traced = jax.jit(lambda gain: path.trace(gain=gain).stokes)
    for _ in range(40):
        filters = [op.Diattenuator(*rng.uniform(0, 1, 2), rng.uniform(0, 3)) for _ in range(2)]
        gain = filters[0].mueller().matrix @ op.Retarder(*rng.uniform(0, 3, 2)).mueller().matrix
        gain = rng.uniform(0.5, 4.0) * gain @ filters[1].mueller().matrix
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", op.errors.LoopWarning)
            try:
                expected = plan.run(gain=gain).stokes
            except op.errors.ParameterError:
                assert np.isnan(traced(gain)).all()
                continue
        np.testing.assert_allclose(traced(gain), expected, rtol=1e-9, atol=1e-9 * expected[0])


@pytest.mark.usefixtures("jax_once")
@pytest.mark.parametrize("method", ["stable", slow("amplitude")])
def test_a_traced_right_angle_of_single_precision_is_grazing_incidence(method):
    path = op.PathGraph()
    path.add("lamp", op.Source()) >> path.add("glass", op.Interface(1.5, op.Parameter("a")))
    path["glass.reflected"] >> path.add("back", op.Detector())
    path["glass.transmitted"] >> path.add("on", op.Detector())
    plan = op.Composer(method=method, engine="jax").compose(path)

    def lights(angle):
        return {name: light.stokes for name, light in plan.run_all(a=angle).items()}

    right = jnp.float32(np.pi / 2.0)
    found, slope = jax.jvp(lights, (right,), (jnp.ones_like(right),))
    exact, (_, wide) = lights(np.pi / 2.0), jax.jvp(lights, (np.pi / 2.0,), (1.0,))
    for name, stokes in exact.items():
        np.testing.assert_array_equal(found[name], stokes)
        np.testing.assert_allclose(slope[name], wide[name], rtol=1e-6)
