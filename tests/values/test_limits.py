"""Limits of values, in each precision."""

from itertools import product

import numpy as np
import pytest

import optipath as op
from optipath.paths.presets.loader import preset_names
from optipath.values.domains import indices, quantities, states
from optipath.values.domains.domain import Domain
from optipath.values.domains.quantities import INCIDENCE
from optipath.values.precision import precision, precision_name
from optipath.values.units import UNITS, format_quantity, parse_quantity
from tables import rows

NARROW = [np.float16, np.float32]
PRECISIONS = [np.float32, np.float64]
OTHERS = [np.float16, np.longdouble, ">f2", ">f4", ">f8"]
RIGHT = np.pi / 2.0


def forms(value, kind):
    """The same number as a scalar, in arrays, and in lists."""
    a = np.full(3, value).astype(kind)
    return [a[0], a[:1].reshape(()), a, a.reshape(3, 1), list(a), [0.5, a[0]]]


def path(theta=None, **options):
    theta = op.Parameter("theta", **options) if theta is None else theta
    return op.Source() >> op.Interface(1.5, theta) >> op.Detector()


WAYS = {
    "a field": lambda v: path(v).trace(),
    "trace": lambda v: path().trace(theta=v),
    "a default": lambda v: path(default=v).trace(),
    "bind": lambda v: path().bind(theta=v).trace(),
    "every link": lambda v: path().trace(keep="all", theta=v)["interface.reflected -> detector.in"],
    "a stream": lambda v: [part.light for part in path().compose().stream(2, theta=v)][-1],
    "a range": lambda v: path(maximum=RIGHT).trace(theta=v),
    "a matrix": lambda v: path().mueller(theta=v) @ op.Light([1.0, 0.0, 0.0, 0.0]),
    "in float32": lambda v: op.Composer(dtype="float32").compose(path()).run(theta=v),
}
EVERY_WAY = [*product(WAYS, PRECISIONS), *(("trace", kind) for kind in OTHERS)]


@rows("way, kind", EVERY_WAY)
def test_a_right_angle_of_any_precision_is_grazing_incidence(way, kind):
    grazing = WAYS[way](RIGHT).stokes
    for theta in forms(RIGHT, kind):
        found = WAYS[way](theta).stokes.reshape(-1, 4)[-1]
        if np.dtype(kind).itemsize > 2:  # That of float16 is half a mrad less.
            np.testing.assert_array_equal(found, grazing)
        assert found[0] <= 1.0


@rows("way, kind", EVERY_WAY)
def test_what_is_beyond_the_rounding_of_a_limit_is_refused(way, kind):
    native = np.dtype(kind).newbyteorder("=")
    beyond = np.nextafter(np.array(RIGHT).astype(native), native.type(2.0))
    if native == np.longdouble:
        beyond = np.longdouble(np.nextafter(RIGHT, 2.0))
    if float(beyond) <= RIGHT:  # The next number of float16 is still inside.
        beyond = np.nextafter(beyond, native.type(2.0))
    for given in (beyond, np.array([0.5, beyond])):
        with pytest.raises(op.OptipathError):
            WAYS[way](given.astype(kind))


@pytest.mark.parametrize("engine", ["numpy", "numba", "jax"])
def test_every_engine_takes_a_right_angle_of_single_precision(engine):
    pytest.importorskip(engine)
    plan = op.Composer(engine=engine).compose(path())
    theta = np.linspace(0.0, RIGHT, 3000).astype(np.float32)
    doubles = theta.astype(np.float64)
    doubles[-1] = RIGHT
    np.testing.assert_array_equal(plan.run(theta=theta).stokes, plan.run(theta=doubles).stokes)
    with pytest.raises(op.ParameterError, match="90"):
        plan.run(theta=np.nextafter(theta, np.float32(2.0)))


def test_a_number_next_to_a_limit_is_refused():
    for value in (float(np.float32(RIGHT)), np.nextafter(RIGHT, 2.0), np.nextafter(0.0, -1.0)):
        with pytest.raises(op.OptipathError, match="theta"):
            path().trace(theta=value)
    with pytest.raises(op.OptipathError, match="give the optimiser bounds="):
        op.load_preset("pile-of-plates").trace(theta=0.1, n=np.float16(-1.5))


LIMITED = {
    name: found
    for module in (indices, quantities, states)
    for name, found in vars(module).items()
    if isinstance(found, Domain) and np.isfinite([found.minimum, found.maximum]).any()
}
LIMITED["a tenth"] = Domain("number", minimum=-0.1, maximum=0.1)
LIMITED["a third"] = Domain("number", minimum=1.0 / 3.0, maximum=0.7)
LIMITED["a large one"] = Domain("number", minimum=-1e5, maximum=1e5)


@rows("name, kind", [*product(LIMITED, PRECISIONS), *(("a third", kind) for kind in OTHERS)])
def test_every_domain_takes_its_limits_in_every_precision(name, kind):
    domain = LIMITED[name]
    for limit in (domain.minimum, domain.maximum):
        with np.errstate(over="ignore", under="ignore"):
            given = np.array(limit).astype(kind)
        if np.isfinite(given) and (given != 0.0 or not limit):
            for value in forms(given, kind)[:-1]:
                found = np.asarray(domain.check("it", value))
                assert found.dtype.itemsize >= 8
                assert np.all((domain.minimum <= found) & (found <= domain.maximum))


@rows("preset", preset_names())
def test_every_preset_takes_the_ranges_of_its_parameters_in_less_precision(preset):
    kind = np.float32
    graph = op.load_preset(preset)
    for name, parameter in graph.parameters.items():
        for limit in (parameter.minimum, parameter.maximum):
            if abs(limit) <= float(np.finfo(kind).max):
                for value in (kind(limit), np.full(2, limit, kind)):
                    found = parameter.resolve(value).value
                    with np.errstate(over="ignore"):  # The other limit may be beyond.
                        inside = (found >= parameter.minimum) & (found <= parameter.maximum)
                    assert np.all(inside), name
                assert op.load_preset(preset, **{name: kind(limit)}).parameters[name].bound


def test_ranges_of_a_parameter_are_met_in_less_precision():
    generator = np.random.default_rng(3)
    for low, high in np.sort(generator.uniform(-10.0, 10.0, (200, 2))):
        parameter = op.Parameter("a", minimum=low, maximum=high)
        for kind, (limit, way) in product(NARROW, ((low, -np.inf), (high, np.inf))):
            assert low <= parameter.resolve(kind(limit)).value <= high
            beyond = np.nextafter(kind(limit), kind(way))
            if low <= float(beyond) <= high:
                beyond = np.nextafter(beyond, kind(way))
            with pytest.raises(op.ParameterError, match="range"):
                parameter.resolve(beyond)


@rows("unit", [unit for unit, of in UNITS.items() if of.dimension == "angle"])
def test_a_right_angle_written_in_any_unit_is_one(unit):
    text = format_quantity(RIGHT, unit)
    assert INCIDENCE.check("it", parse_quantity(text, "angle")) == RIGHT
    assert path().trace(theta=text) == path().trace(theta=RIGHT)


@rows("kind", NARROW)
def test_fully_polarised_states_of_less_precision_are_taken(kind):
    generator = np.random.default_rng(4)
    directions = generator.normal(size=(500, 3))
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    intensity = generator.uniform(0.5, 50.0, (500, 1))
    states = np.concatenate([intensity, intensity * directions], axis=-1).astype(kind)
    expected = states.astype(np.float64)

    def lamp(stokes):
        return op.Source(1.0, stokes) >> op.Detector()

    opened = lamp(op.Parameter("state"))
    for light, stokes in (
        (lamp(states).trace(), expected),
        (lamp(states[0]).trace(), expected[0]),
        (opened.trace(state=states), expected),
        (opened.bind(state=states).trace(), expected),
        (lamp(op.Parameter("s", states)).trace(), expected),
    ):
        np.testing.assert_array_equal(light.stokes, stokes)
    too_much = np.array([1.0, 1.0 + 20.0 * np.finfo(kind).eps, 0.0, 0.0], kind)
    for use in (lambda s: lamp(s).trace(), lambda s: opened.trace(state=s)):
        for state in (too_much, np.array([1.0, 1.0 + 1e-9, 0.0, 0.0])):
            with pytest.raises(op.OptipathError, match="more than 100 %"):
                use(state)


@rows("kind", NARROW)
def test_cosines_and_sines_of_less_precision_belong_to_angles(kind):
    angles = np.linspace(0.0, RIGHT, 301).astype(kind)
    cos, sin = np.cos(angles), np.sin(angles)
    found = path().trace(theta=op.CosSin(cos, sin))
    assert np.all(found.intensity <= 1.0)
    assert np.all(op.fresnel_reflection(1.5, cos, sin)[0] <= 1.0)
    for some in (0, 150, 299, 300):
        light = path().trace(theta=op.CosSin(cos[some], sin[some]))
        np.testing.assert_allclose(light.intensity, found.intensity[some], rtol=1e-12)
    for pair in ((kind(-0.01), kind(1.0)), (kind(0.7), kind(0.8))):
        with pytest.raises(op.OptipathError):
            path().trace(theta=op.CosSin(*pair))


@rows("kind", NARROW)
def test_axes_of_less_precision_make_a_frame(kind):
    generator = np.random.default_rng(5)
    turned, _ = np.linalg.qr(generator.normal(size=(200, 3, 3)))
    turned *= np.linalg.det(turned)[:, np.newaxis, np.newaxis]
    axes = turned.astype(kind)
    frames = op.Frame(axes[:, 0], axes[:, 1], axes[:, 2])
    whole = np.stack([frames.x, frames.y, frames.z], axis=-2)
    np.testing.assert_allclose(
        whole @ np.swapaxes(whole, -1, -2), np.tile(np.eye(3), (200, 1, 1)), rtol=0, atol=1e-15
    )
    np.testing.assert_allclose(whole, turned, rtol=0, atol=4 * np.finfo(kind).eps)
    assert op.Frame().rotated(axes).z.shape == (200, 3)
    with pytest.raises(op.FrameError, match="orthogonal unit vectors"):
        op.Frame(axes[:, 0], axes[:, 1], kind(1.1) * axes[:, 2])
    with pytest.raises(op.FrameError, match="orthogonal unit vectors"):
        op.Frame(*(turned[:, i] * (1.0 + 1e-6) for i in range(3)))


LONG = np.finfo(np.longdouble).eps < np.finfo(np.float64).eps


class WithDtype:
    """What NumPy asks for a dtype, as scalar types of other libraries are."""

    def __init__(self, dtype):
        self.dtype = dtype


SINGLE = ["float32", "f4", "f", "single", np.float32, np.dtype("f4")]
DOUBLE = [float, "float", "f8", "double", "d", np.float64, np.dtype(float)]


@rows("given, name", [*product(SINGLE, ["float32"]), *product(DOUBLE, ["float64"])])
def test_precisions_go_by_every_name_that_numpy_and_python_have_for_them(given, name):
    assert op.Composer(dtype=given) == op.Composer(dtype=name)
    plan = op.Composer(dtype=given).compose(op.load_preset("malus"))
    assert (plan.dtype, plan.run().stokes.dtype) == (name, name)
    assert op.fresnel_reflection(1.5, 1.0, 0.0, dtype=given)[0].dtype == name
    assert op.fresnel_transmission(1.5, 1.0, 0.0, dtype=given)[0].dtype == name
    assert precision(WithDtype(np.dtype(given))) == name


@pytest.mark.skipif(not LONG, reason="longdouble is float64 here")
def test_longdouble_goes_by_every_name_that_numpy_has_for_it():
    for given in (np.longdouble, "g", "longdouble", np.dtype(np.longdouble)):
        assert precision_name(given) == "longdouble"
        with pytest.raises(op.ComposerError, match="jax' has no longdouble"):
            op.Composer(dtype=given, engine="jax")


ODD = [int, "f2", np.float16, complex, "c8", "i4", bool, str, None, "", "f4,f4", "f4,{", "x", 4]
ODD += [[], np.floating, np.dtype("f8").newbyteorder(), np.ones(3), WithDtype(3)]


@rows("given", ODD)
def test_any_other_dtype_is_refused_and_the_three_are_named(given):
    named = r"is unknown; give 'float64', 'float32' or 'longdouble'"
    with pytest.raises(op.ComposerError, match=named):
        op.Composer(dtype=given)
    with pytest.raises(op.ComposerError, match="dtype"):
        op.fresnel_reflection(1.5, 1.0, 0.0, dtype=given)
