"""Limits of values in each precision, indices of 0, and numbers of two boundaries that must fit."""

import re
from itertools import product
from types import SimpleNamespace

import numpy as np
import pytest

import optipath as op
from optipath.materials import index_domains as indices
from optipath.materials import quantities
from optipath.materials.quantities import INCIDENCE
from optipath.values import domains as states
from optipath.values.domains import Domain
from optipath.values.precision import precision, precision_name
from optipath.values.units import UNITS, format_quantity, parse_quantity
from tables import rows
from wired import wired

PRECISIONS = [np.float32, np.float64]
RIGHT = np.pi / 2.0
N, K, P = op.Parameter("n"), op.Parameter("k"), op.Parameter


def forms(value, kind):
    """The same number as a scalar, in arrays, and in lists."""
    a = np.full(3, value).astype(kind)
    return [a[0], a[:1].reshape(()), a, a.reshape(3, 1), list(a)]


def path(theta=None, index=1.5, **options):
    theta = op.Parameter("theta", **options) if theta is None else theta
    return op.Source() >> op.Interface(index, theta) >> op.Detector()


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


@rows("way, kind", [*product(WAYS, PRECISIONS), ("trace", np.longdouble)])
def test_a_right_angle_of_any_precision_is_grazing_incidence_and_more_is_refused(way, kind):
    use, grazing = WAYS[way], WAYS[way](RIGHT).stokes
    assert grazing[0] <= 1.0
    for theta in forms(RIGHT, kind):
        np.testing.assert_array_equal(use(theta).stokes.reshape(-1, 4)[-1], grazing)
    next_one = np.float32 if kind is np.float32 else np.float64
    beyond = np.nextafter(next_one(RIGHT), next_one(2.0)).astype(kind)
    for given in (beyond, np.array([0.5, beyond], kind)):
        with pytest.raises(op.OptipathError):
            use(given)


@pytest.mark.parametrize("engine", ["numpy", "numba", "jax"])
def test_every_engine_takes_a_right_angle_of_single_precision(engine):
    pytest.importorskip(engine)
    plan = op.Composer(engine=engine).compose(path())
    theta = np.linspace(0.0, RIGHT, 3000).astype(np.float32)
    doubles = theta.astype(np.float64)
    doubles[-1] = RIGHT
    np.testing.assert_array_equal(plan.run(theta=theta).stokes, plan.run(theta=doubles).stokes)
    with pytest.raises(op.errors.ParameterError, match="90"):
        plan.run(theta=np.nextafter(theta, np.float32(2.0)))


LIMITED = {
    name: found
    for module in (indices, quantities, states)
    for name, found in vars(module).items()
    if isinstance(found, Domain) and np.isfinite([found.minimum, found.maximum]).any()
}
LIMITED["a tenth"] = Domain("number", minimum=-0.1, maximum=0.1)
LIMITED["a third"] = Domain("number", minimum=1.0 / 3.0, maximum=0.7)
LIMITED["a large one"] = Domain("number", minimum=-1e5, maximum=1e5)


@rows("name, kind", [*product(LIMITED, PRECISIONS), ("a third", np.longdouble)])
def test_every_domain_takes_its_limits_in_every_precision(name, kind):
    domain = LIMITED[name]
    for limit in (domain.minimum, domain.maximum):
        with np.errstate(over="ignore", under="ignore"):
            given = np.array(limit).astype(kind)
        if np.isfinite(given) and (given != 0.0 or not limit):
            for value in forms(given, kind):
                found = np.asarray(domain.check("it", value))
                assert found.dtype.itemsize >= 8
                assert np.all((domain.minimum <= found) & (found <= domain.maximum))


def test_ranges_of_a_parameter_are_met_in_less_precision_and_in_any_unit():
    generator = np.random.default_rng(3)
    for low, high in np.sort(generator.uniform(-10.0, 10.0, (200, 2))):
        parameter = op.Parameter("a", minimum=low, maximum=high)
        for limit in (low, high):
            way = -np.inf if limit == low else np.inf
            assert low <= parameter.resolve(np.float32(limit)).value <= high
            beyond = np.nextafter(np.float32(limit), np.float32(way))
            if low <= float(beyond) <= high:
                beyond = np.nextafter(beyond, np.float32(way))
            with pytest.raises(op.errors.ParameterError, match="range"):
                parameter.resolve(beyond)
    for value in (float(np.float32(RIGHT)), np.nextafter(RIGHT, 2.0), np.nextafter(0.0, -1.0)):
        with pytest.raises(op.OptipathError, match="theta"):
            path().trace(theta=value)
    for unit in [unit for unit, of in UNITS.items() if of.dimension == "angle"]:
        text = format_quantity(RIGHT, unit)
        assert INCIDENCE.check("it", parse_quantity(text, "angle")) == RIGHT
        assert path().trace(theta=text) == path().trace(theta=RIGHT)


def test_fully_polarised_states_of_less_precision_are_taken_and_more_is_refused():
    generator = np.random.default_rng(4)
    directions = generator.normal(size=(500, 3))
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    intensity = generator.uniform(0.5, 50.0, (500, 1))
    states = np.concatenate([intensity, intensity * directions], axis=-1).astype(np.float32)
    expected = states.astype(np.float64)

    def lamp(stokes):
        return op.Source(1.0, stokes) >> op.Detector()

    opened = lamp(op.Parameter("state"))
    for light, stokes in (
        *((lamp(states).trace(), expected), (lamp(states[0]).trace(), expected[0])),
        *((opened.trace(state=states), expected), (opened.bind(state=states).trace(), expected)),
        (lamp(op.Parameter("s", states)).trace(), expected),
    ):
        np.testing.assert_array_equal(light.stokes, stokes)
    too_much = np.float32([1.0, 1.0 + 20.0 * 2.0**-23, 0.0, 0.0])
    for use in (lambda s: lamp(s).trace(), lambda s: opened.trace(state=s)):
        for state in (too_much, np.array([1.0, 1.0 + 1e-9, 0.0, 0.0])):
            with pytest.raises(op.OptipathError, match="more than 100 %"):
                use(state)


def test_cosines_and_sines_of_less_precision_belong_to_angles():
    angles = np.linspace(0.0, RIGHT, 301, dtype=np.float32)
    cos, sin = np.cos(angles), np.sin(angles)
    found = path().trace(theta=op.CosSin(cos, sin)).intensity
    assert np.all(found <= 1.0)
    assert np.all(op.fresnel_reflection(1.5, cos, sin)[0] <= 1.0)
    for some in (0, 150, 299, 300):
        light = path().trace(theta=op.CosSin(cos[some], sin[some]))
        np.testing.assert_allclose(light.intensity, found[some], rtol=1e-12)
    for pair in np.float32([[-0.01, 1.0], [0.7, 0.8]]):
        with pytest.raises(op.OptipathError):
            path().trace(theta=op.CosSin(*pair))


def test_axes_of_less_precision_make_a_frame():
    turned, _ = np.linalg.qr(np.random.default_rng(5).normal(size=(200, 3, 3)))
    turned *= np.linalg.det(turned)[:, np.newaxis, np.newaxis]
    axes, eps = turned.astype(np.float32), 2.0**-23
    frames = op.Frame(axes[:, 0], axes[:, 1], axes[:, 2])
    whole = np.stack([frames.x, frames.y, frames.z], axis=-2)
    product_with_itself = whole @ np.swapaxes(whole, -1, -2)
    np.testing.assert_allclose(product_with_itself, [np.eye(3)] * 200, rtol=0, atol=1e-15)
    np.testing.assert_allclose(whole, turned, rtol=0, atol=4 * eps)
    assert op.Frame().rotated(axes).z.shape == (200, 3)
    long_z = (axes[:, 0], axes[:, 1], np.float32(1.1) * axes[:, 2])
    for wrong in (long_z, [turned[:, i] * (1.0 + 1e-6) for i in range(3)]):
        with pytest.raises(op.errors.FrameError, match="orthogonal unit vectors"):
            op.Frame(*wrong)


SINGLE = ["float32", "f4", "f", "single", np.float32, np.dtype("f4")]
DOUBLE = [float, "float", "f8", "double", "d", np.float64, np.dtype(float)]
ODD = [int, "f2", np.float16, complex, "c8", "i4", bool, str, None, "", "f4,f4", "f4,{", "x", 4]
ODD += [[], np.floating, np.dtype("f8").newbyteorder(), np.ones(3), SimpleNamespace(dtype=3)]


@rows("given, name", [*product(SINGLE, ["float32"]), *product(DOUBLE, ["float64"])])
def test_precisions_go_by_every_name_that_numpy_and_python_have_for_them(given, name):
    assert op.Composer(dtype=given) == op.Composer(dtype=name)
    plan = op.Composer(dtype=given).compose(op.load_preset("malus"))
    assert (plan.dtype, plan.run().stokes.dtype) == (name, name)
    for coefficients in (op.fresnel_reflection, op.fresnel_transmission):
        assert coefficients(1.5, 1.0, 0.0, dtype=given)[0].dtype == name
    assert precision(SimpleNamespace(dtype=np.dtype(given))) == name
    if np.finfo("g").eps < np.finfo("d").eps:  # Otherwise longdouble is float64.
        for long in (np.longdouble, "g", "longdouble", np.dtype(np.longdouble)):
            assert precision_name(long) == "longdouble"
            with pytest.raises(op.errors.ComposerError, match="jax' has no longdouble"):
                op.Composer(dtype=long, engine="jax")


@rows("given", ODD)
def test_any_other_dtype_is_refused_and_the_three_are_named(given):
    named = r"is unknown; give 'float64', 'float32' or 'longdouble'"
    with pytest.raises(op.errors.ComposerError, match=named):
        op.Composer(dtype=given)
    with pytest.raises(op.errors.ComposerError, match="dtype"):
        op.fresnel_reflection(1.5, 1.0, 0.0, dtype=given)


TWO = ["400 nm", "500 nm"]
OF_TABLE = op.tabulated(TWO, [1.5, 0.0])
CORNER = [[0, 0, 0], [0, 0, 1], [0, 1, 1]]


@rows(
    "make, told",
    [
        (lambda: op.Interface(np.diag([1.5, 1.5, 1.6]), 0.3), r"index is 0.0 at \(0, 1\)"),
        (lambda: op.Interface(0, 0.3), "Interface index is 0"),
        (lambda: op.Interface(0j, 0.3), "Interface index is 0j"),
        (lambda: op.Interface(1.5, 0.3, outside=0.0), "Interface outside is 0"),
        (lambda: op.LayerStack([1, 0, 1.5], 0.3), r"indices\[1\] is 0"),
        (lambda: op.LayerStack([1, 1.2, 0], 0.3), r"indices\[2\] is 0"),
        (lambda: op.path_from_vertices(CORNER, materials=[0]), "index"),
        (lambda: op.fresnel_reflection(0.0, 1.0, 0.0), "index is 0"),
        (lambda: op.Material(0), "Material n is 0"),
        (lambda: op.Material([1.5, 0.0], [0.0, 0.0]), r"Material n is 0(\.0)? at 1"),
        (lambda: op.Material.tabulated(TWO, [1.5, 0.0]), "n of .* at 500 nm"),
        (lambda: op.Material.tabulated(["1 um", "2 um"], [0.0, 1.0], [0.0, 1.0]), "at 1000 nm"),
        (lambda: path(0.3, N).trace(n=np.array([1.5, 0.0])), "'n' .* is 0"),
        (lambda: path(0.3, op.Material(N)).trace(n=0), "'n' .* is 0"),
        (lambda: path(0.3, op.Material(N, K)).bind(n=0, k=0), "'n' .* is 0"),
        (lambda: path(0.3, OF_TABLE).trace(wavelength="500 nm"), "the table at 500 nm is 0"),
    ],
)
def test_an_index_of_0_is_refused_with_its_place_and_one_with_absorption_is_taken(make, told):
    with pytest.raises(op.OptipathError, match=told):
        make()
    for index in (1j, op.Material(0.0, 1.0), op.Material([1.5, 0.0], [0.0, 1.0])):
        assert np.all(path(0.3, index).trace().intensity <= 1.0)
    assert path(0.3, op.Material(N, K)).trace(n=0.0, k=1.0).intensity == pytest.approx(1.0)


def two_faces(front, back):
    faces = {"lamp": op.Source(), "front": front, "back": back, "eye": op.Detector()}
    return wired(faces, "lamp -> front, front.transmitted -> back, back.transmitted -> eye")


def fault_of(path, **given):
    with pytest.raises(op.OptipathError) as error:
        path.trace(**given)
    (fault,) = error.value.faults
    return fault


def test_one_bad_path_of_many_is_told_with_its_place_and_no_number_of_one_is_offered_to_many():
    path = two_faces(op.Interface(N, 0.3), op.Interface(1.0, 0.1, outside=P("o"), parallel=False))
    n = np.linspace(1.4, 1.8, 100_000)
    o = n.copy()
    o[[4711, 9999]] = 1.2
    assert "(at 4711, of 100000 paths); give op.FOLLOWS" in fault_of(path, n=n, o=o)
    grid = np.broadcast_to(n[:100, None], (100, 300)).copy()
    grid[7, 30] = 1.2
    assert "(at (7, 30), of 30000 paths);" in fault_of(path, n=n[:100, None], o=grid)
    assert "(at 4711, of 100000 paths);" in fault_of(path.bind(n=n, o=o))
    assert " paths)" not in fault_of(path, n=1.5, o=1.2)
    path = two_faces(op.Interface(N, 0.3), op.Interface(1.0, P("t"), outside=P("o")))
    given = {"n": 1.5, "o": 1.5, "t": np.arcsin(np.sin(0.3) / 1.5)}
    n = np.array([1.5, 1.6])
    for changed, cure in (
        ({"o": n}, "give op.FOLLOWS for outside"),
        (
            {"n": n - 0.1, "o": np.array([1.5, 1.5])},
            "(at 0, of 2 paths); give op.FOLLOWS for outside",
        ),
        ({"t": [0.1, 0.2]}, "give 'back' an incidence of op.FOLLOWS ("),
        ({"n": n, "o": n}, "give 'back' an incidence of op.FOLLOWS ("),
    ):
        assert cure in fault_of(path, **given | changed)


@rows(
    "parameter, given, words",
    [
        (P("x", minimum=0.1), [0.5, 0.05], "is 0.05 at 1, outside its range; give 0.1 or more"),
        (P("x"), [[0.5], [2.0]], r"is 2 at \(1, 0\); give a real fraction"),
        (P("x"), [0.5, np.nan], "is nan at 1; give a finite"),
        (P("x"), 2.0, "is 2; give a real fraction"),
    ],
)
def test_what_is_not_allowed_is_told_with_its_place(parameter, given, words):
    path = op.Source() >> op.Attenuator(parameter) >> op.Detector()
    with pytest.raises(op.OptipathError, match=words):
        path.trace(x=np.array(given))
    with pytest.raises(op.errors.ValueFault, match=r"index is \(1.5-1j\) at 1; give"):
        op.Interface(np.array([1.5, 1.5 - 1j]), 0.3)


@rows("angle", [89.97722848292891, 89.9999999, 40.0, 1e-9])
@rows("n, outside", [(1.561013496050288, 1.290977624), (1.4, 1.4 + 1e-13)])
def test_the_cure_of_an_angle_passes_as_it_is_written(angle, n, outside):
    front = op.Interface(n, f"{angle} deg", outside=outside)

    def back(incidence):
        return two_faces(front, op.Interface(1.0, incidence, outside=n))

    assert "give 'back' an incidence of op.FOLLOWS" in fault_of(back(0.3))
    back(op.FOLLOWS).check()
    if (angle, n) == (89.97722848292891, 1.561013496050288):
        # Figures that differ differ as they are printed.
        here, there = re.findall(r"([0-9.]+) at '", fault_of(back("55.79305157 deg")))
        assert here != there
