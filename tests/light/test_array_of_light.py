"""Light and Mueller matrices as arrays: shapes, parts, numpy and JAX."""

import pickle

import numpy as np
import pytest

import optipath as op
from tables import rows

THREE = [[1.0, 0.0, 0.0, 0.0], [2.0, 1.0, 0.0, -1.0], [4.0, 0.0, 3.0, 0.0]]
FAINT = op.Light([1.0, 0.6, 0.0, 0.8], exponent=-5000)


def test_components_have_their_names_and_those_that_are_not_read_are_nan():
    light = op.Light(THREE)
    for place, component in enumerate([light.S0, light.S1, light.S2, light.S3]):
        np.testing.assert_array_equal(component, np.array(THREE)[:, place])
    assert op.load_preset("malus").trace(angle=0.0).S1 == 0.5
    light = op.load_preset("malus").reading("intensity").trace()
    assert pytest.approx(0.375) == light.S0
    assert np.isnan([light.S1, light.S2, light.S3]).all()


def test_a_batch_has_a_shape_and_is_gone_through_light_by_light():
    light = op.Light(np.ones((2, 3, 4)) * [1, 0, 0, 0])
    assert (light.shape, light.ndim, light.size, len(light)) == ((2, 3), 2, 6, 2)
    one = op.Light(THREE[0])
    assert (one.shape, one.ndim, one.size) == ((), 0, 1)
    assert light.reshape(3, 2).shape == light.reshape((3, -1)).shape == (3, 2)
    with pytest.raises(op.ShapeError, match=r"6 lights of shape \(2, 3\)"):
        light.reshape(4)
    assert list(op.Light(THREE)) == [op.Light(stokes) for stokes in THREE]
    assert [float(light.S0) for light in op.Light(THREE)] == [1.0, 2.0, 4.0]


@rows(
    "key",
    [1, -1, slice(1, None), [2, 0], (..., 0), (None, 1), np.array([True, False, True]), ..., ()],
)
def test_an_index_is_one_of_the_batch(key):
    light = op.Light(THREE)
    places = np.arange(3)[key]
    np.testing.assert_array_equal(light[key].stokes, np.array(THREE)[places])
    assert light[key].shape == places.shape


def test_frames_and_exponents_are_indexed_along():
    frames = op.Frame().turned([0.0, 0.1, 0.2])
    light = op.Light(THREE, frames, exponent=[0, -3000, 0])
    assert light[2] == op.Light(THREE[2], op.Frame().turned(0.2))
    assert light[1] == op.Light(THREE[1], op.Frame().turned(0.1), exponent=-3000)
    grid = op.Light(np.broadcast_to(THREE, (2, 3, 4)), frames)
    np.testing.assert_array_equal(grid[1, 2].frame.x, op.Frame().turned(0.2).x)
    np.testing.assert_array_equal(grid[:, 1:].frame.x[0], frames.x[1:])
    light = op.Light([1.0, 1.0, 0.0, 0.0], op.Frame().turned([0.0, np.pi / 2]))
    assert light.shape == (2,)
    np.testing.assert_allclose(sum(light).stokes, [2, 0, 0, 0], rtol=0, atol=1e-15)
    chain = op.VerticesByAngles(incidences=(0.3, op.Parameter("delta")), turns=(-0.5,))
    path = op.path_from_vertices(chain, materials=[1.5, 1.5])
    light = path.trace(delta=[0.1, 0.2])
    alone = path.trace(delta=0.2)
    np.testing.assert_allclose(light[1].stokes, alone.stokes, rtol=1e-14)
    np.testing.assert_allclose(light[1].frame.x, alone.frame.x, rtol=1e-14)


@rows("call", [len, iter, list, bool])
def test_a_single_light_is_no_batch_and_says_so(call):
    with pytest.raises(op.LightError, match="light"):
        call(op.Light(THREE[0]))
    assert issubclass(op.LightError, TypeError)


@rows(
    "key",
    [
        *[0, (..., 0), "S0", 1.5, [True, False]],
        *[slice("a", "b"), slice(0, 2, 0), [[0, 1], [2]]],
    ],
)
def test_an_index_that_does_not_fit_names_the_components(key):
    for light in (op.Light(THREE[0]), op.Light(THREE)[:, None]):
        if light.ndim and key in (0, (..., 0)):
            continue
        with pytest.raises(op.IndexFault, match=r"does not fit, .* light\.stokes\[\.\.\., 0\]"):
            light[key]


@rows("factor", [2, 2.0, np.float64(2), np.float32(2), np.array(2), True + True])
def test_light_times_a_number_is_light(factor):
    light = op.Light(THREE, op.Frame().turned(0.3))
    doubled = op.Light(2 * np.array(THREE), op.Frame().turned(0.3))
    assert factor * light == light * factor == doubled
    assert doubled / factor == light


def test_factors_broadcast_over_the_batch_and_lose_no_precision():
    light = np.array([1.0, 2.0]) * op.Light(THREE[1])
    assert light == op.Light([THREE[1], [4.0, 2.0, 0.0, -2.0]])
    assert (np.ones((2, 1)) * op.Light(THREE)).shape == (2, 3)
    with pytest.raises(op.ShapeError, match=r"light \(3,\), factor \(2,\)"):
        op.Light(THREE) * [1.0, 2.0]
    assert (1e-200 * op.Light([1e-200, 0, 0, 0])).log10_intensity == pytest.approx(-400)
    assert op.Light([1.0, 0.6, 0.0, 0.8], exponent=-4999) == 2 * FAINT
    assert (2 * FAINT).dop == pytest.approx(1.0)
    single = op.Light(np.array([1.0, 0.5, 0.0, 0.0], np.float32))
    assert (0.1 * single).stokes.dtype == np.float32
    jax = pytest.importorskip("jax")
    slope = jax.grad(lambda factor: (factor * op.Light(THREE[1])).S0)(3.0)
    assert slope == 2.0


@rows(
    "wrong, sentence",
    [
        (lambda light: -1 * light, "no -1-fold"),
        (lambda light: np.array([1.0, -0.5]) * light, "no -0.5-fold"),
        (lambda light: light * np.nan, "no nan-fold"),
        (lambda light: light * np.inf, "no inf-fold"),
        (lambda light: 1j * light, "1j is no real number"),
        (lambda light: light * "twice", "'twice' is no real number"),
        (lambda light: light * light, "light times light"),
        (lambda light: light / 0, "0 divides none"),
        (lambda light: 2 / light, "no light"),
        (lambda light: light - light, "no light"),
        (lambda light: -light, "no light"),
        (lambda light: light**2, "no light"),
        (lambda light: light + 1.0, "1.0 is no light"),
        (lambda light: 1.0 + light, "1.0 is no light"),
        (lambda light: light @ np.eye(4), "element @ light"),
        (lambda light: op.Polarizer(0) * light, "write element @ light"),
        (lambda light: light * op.Mueller(np.eye(4)), "matrix @ light"),
        (lambda light: np.eye(4) @ light, r"Mueller\(matrix\) @ light"),
        (np.sin, "numpy.sin takes numbers"),
        (np.sum, "numpy.sum takes numbers"),
        (np.max, "numpy.max takes numbers"),
        (np.mean, r"numpy.mean takes numbers.* the mean of lights is sum\(lights\) / len"),
        (np.std, "numpy.std takes numbers"),
        (np.median, "numpy.median takes numbers"),
        (np.sort, "numpy.sort takes numbers"),
        (np.cumsum, "numpy.cumsum takes numbers"),
        (np.round, "numpy.round takes numbers"),
        (np.average, "numpy.average takes numbers"),
        (lambda light: np.percentile(light, 50), "numpy.percentile takes numbers"),
        (lambda light: np.dot(np.eye(4), light), "numpy.dot takes numbers"),
        (lambda light: np.add(light, light, out=np.ones(4)), "numpy.add takes numbers"),
    ],
)
def test_what_light_cannot_do_is_refused_in_words(wrong, sentence):
    with pytest.raises(op.LightError, match=sentence):
        wrong(op.Light(THREE[0]))


def test_lights_are_summed_up_in_the_frame_of_the_first():
    one, other = op.Light(THREE[1]), op.Light(THREE[2], op.Frame().turned(np.pi / 4))
    total = sum([one, other])
    assert total.frame == one.frame
    np.testing.assert_allclose(total.stokes, [6.0, -2.0, 0.0, -1.0], atol=1e-15)
    assert sum(op.Light(THREE)) == op.Light([7.0, 1.0, 3.0, -1.0])
    light = op.Light(THREE)
    assert np.shape(light) == (3,)
    np.testing.assert_array_equal(np.concatenate([light, light]), [*THREE, *THREE])
    assert np.allclose(light, THREE)
    assert np.array_equal(light, light)
    assert sum(light) / len(light) == op.Light(np.mean(THREE, axis=0))


def test_numpy_reads_the_numbers_of_light_and_of_matrices():
    light = op.Light(THREE)
    assert np.asarray(light, dtype=np.float32).dtype == np.float32
    np.testing.assert_array_equal(np.array(light), THREE)
    np.testing.assert_allclose(light, THREE)
    assert np.isfinite(light).all()
    np.testing.assert_array_equal(np.array(THREE) == light, np.ones((3, 4), bool))
    copy = np.array(light, copy=True)
    copy[...] = 0.0
    assert light.S0[0] == 1.0
    for make in (op.Light, lambda light: op.load_preset("malus").trace(angle=light)):
        with pytest.raises(op.OptipathError, match=r"as in op\.Source\(stokes=light\.stokes\)"):
            make(op.Light(THREE[0]))
    np.testing.assert_array_equal(np.asarray(op.Mueller(np.eye(4))), np.eye(4))
    assert np.asarray(RETARDERS, dtype=np.float32).shape == (2, 3, 4, 4)
    assert (RETARDERS.shape, RETARDERS.ndim, RETARDERS.size, len(RETARDERS)) == ((2, 3), 2, 6, 2)
    assert [row.shape for row in RETARDERS] == [(3,), (3,)]
    assert RETARDERS.reshape(-1).shape == (6,)
    assert op.Mueller(np.eye(4)).shape == ()


def test_light_is_shown_in_a_line_or_a_few():
    assert repr(op.Light([1, 0.5, 0, 0])) == "Light([1. , 0.5, 0. , 0. ])"
    assert "frame=Frame(x=(0.9" in repr(op.Light([1, 0, 0, 0], op.Frame().turned(0.3)))
    many = repr(op.Light(np.ones((1000, 4)) * [1, 0, 0, 0]))
    assert many.count("\n") < 6
    assert many.endswith("shape=(1000,))")
    path = op.load_preset("npgr026", case=8)
    light = op.Composer(composing="jones").compose(path).run()
    assert str(light) == str(path.trace()) == repr(light)


def test_parts_of_light_are_kept_copied_and_compared_by_value():
    part = op.Light(THREE, op.Frame().turned([0.0, 0.1, 0.2]))[1:]
    assert pickle.loads(pickle.dumps(part)) == part
    assert op.Light([0.5, 0.25, 0.0, 0.0], exponent=1) == op.Light([1.0, 0.5, 0.0, 0.0])
    assert op.Light([0.5, 0.25, 0.0, 0.0], exponent=2) != op.Light([1.0, 0.5, 0.0, 0.0])


def test_an_element_acts_on_light_and_on_matrices_as_its_matrix_does():
    frame = op.Frame().turned(0.3)
    behind = op.Polarizer(0.2) @ op.Light([2.0, 0.0, 0.0, 0.0], frame)
    assert behind.frame == frame
    np.testing.assert_allclose(behind, [1.0, np.cos(0.4), np.sin(0.4), 0.0], atol=1e-15)
    # An azimuth turns the element, and the frame behind it with it.
    turned = op.Polarizer(azimuth=0.2) @ op.Light([2.0, 0.0, 0.0, 0.0], frame)
    np.testing.assert_allclose(turned.in_frame(frame), behind, atol=1e-15)
    elements = [
        op.Polarizer(0.2, azimuth=0.3),
        op.Interface(1.5 + 0.2j, incidence=[0.4, 1.2], azimuth=0.7),
        op.Retarder(1.0, 0.3),
        op.Diattenuator(0.9, 0.2, angle=0.1),
    ]
    path = op.PathGraph()
    last = path.add("lamp", op.Source(stokes=[1.0, 0.5, 0.3, 0.1]))
    light = op.Light([1.0, 0.5, 0.3, 0.1])
    for number, element in enumerate(elements):
        last = last >> path.add(f"e{number}", element)
        light = element @ light
    last >> path.add("eye", op.Detector())
    np.testing.assert_allclose(light, path.trace(), rtol=0, atol=1e-15)
    light = op.Light([1.0, 0.2, 0.3, 0.4])
    both = op.Retarder(1.0, 0.3) @ op.Polarizer(0.2).mueller()
    np.testing.assert_allclose(both @ light, op.Retarder(1.0, 0.3) @ (op.Polarizer(0.2) @ light))


def test_an_element_that_does_not_act_on_light_says_why():
    light = op.Light([1.0, 0.0, 0.0, 0.0])
    with pytest.raises(op.PathError, match="parameter 'a' of polarizer has no value yet"):
        op.Polarizer(op.Parameter("a")) @ light
    with pytest.raises(op.PathError, match="in -> reflected"):
        op.BeamSplitter() @ light
    with pytest.raises(op.LightError, match="element @ light"):
        op.Polarizer(0.1) @ [1.0, 0.0, 0.0, 0.0]


@rows(
    "done",
    [
        lambda light: 2 * light,
        lambda light: light / 3,
        lambda light: light[0],
        lambda light: light[..., 1],
        sum,
        lambda light: op.Polarizer(0.3) @ light,
        lambda light: light.reshape(1, 3),
    ],
)
def test_jax_does_what_numpy_does(done):
    jax = pytest.importorskip("jax")
    expected = done(op.Light(THREE)).stokes

    def traced(stokes):
        return done(op.Light(stokes)).stokes

    np.testing.assert_allclose(jax.jit(traced)(np.array(THREE)), expected, rtol=1e-6, atol=1e-6)
    assert np.isfinite(jax.jacobian(traced)(jax.numpy.array(THREE))).all()


@rows("shape", [-1, (12,), (4, 3), (2, -1, 2)])
@rows("order", ["C", "F"])
def test_numpy_gives_light_another_shape(shape, order):
    places = np.arange(12.0).reshape(3, 4)
    light = op.Light(np.stack([places, places, 0 * places, 0 * places], axis=-1))
    found = np.reshape(light, shape, order=order)
    assert isinstance(found, op.Light)
    np.testing.assert_array_equal(found.S1, np.reshape(places, shape, order=order))


SINGLE = op.Light(np.array([[1.0, 0.6, 0.0, 0.8]] * 2, np.float32))


@rows(
    "made",
    [
        SINGLE + SINGLE,
        SINGLE + op.Light([1.0, 0.0, 0.0, 0.0]),
        op.Light([1.0, 0.0, 0.0, 0.0]) + SINGLE,
        SINGLE * np.float64(0.3),
        SINGLE / [0.3, 0.7],
        SINGLE.in_frame(op.Frame().turned(0.3)),
        op.Retarder(0.3, 0.2) @ SINGLE,
        op.Mueller(op.Retarder(0.3).mueller().matrix.astype("f4")) @ op.Light([1.0, 0, 0, 1.0]),
    ],
)
def test_light_keeps_the_coarser_precision_and_is_light(made):
    assert made.mantissa.dtype == made.stokes.dtype == np.float32
    assert op.Light.from_("mitsuba", made.to("mitsuba")).dop.max() <= 1 + 2.0**-22


HALF = np.array([[1.0, 0.25, 0.125, 0.5], [60000.0, 0.0, 0.0, 0.0]], np.float16)


@rows(
    "made, factor",
    [
        (lambda light: light + light, 2.0),
        (lambda light: sum([light, light, light]), 3.0),
        (lambda light: 3 * light, 3.0),
        (lambda light: light / 0.25, 4.0),
        (lambda light: op.Attenuator(0.5) @ light, 0.5),
        (lambda light: op.Mueller(4 * np.eye(4, dtype=np.float16)) @ light, 4.0),
        (lambda light: light.in_frame(op.Frame().turned(np.pi)), 1.0),
    ],
)
def test_light_of_half_precision_is_computed_in_single_precision(made, factor):
    found = made(op.Light(HALF))
    np.testing.assert_allclose(found.stokes, factor * HALF.astype(float), rtol=1e-6, atol=1e-6)
    assert found.stokes.dtype == np.float32
    assert not found.exponent.any()
    assert np.all(found.noise >= 0.99 * 2.0**-10 * found.S0)


def test_light_in_any_precision_stays_light():
    rng = np.random.default_rng(3)
    states = rng.normal(size=(2000, 3))
    states /= np.linalg.norm(states, axis=-1, keepdims=True)
    light = op.Light(np.concatenate([np.ones((2000, 1)), states], axis=-1).astype(np.float32))
    for turn in rng.uniform(0.1, 3.0, 30):
        light = 0.9 * (op.Retarder(turn, 2.0 * turn) @ light)
        assert op.Light(light.stokes) == light
        assert op.Source(stokes=light.stokes).stokes.dtype == np.float32
    faint = op.Light([1e-300, 0.0, 0.0, 0.0]) + op.Light(np.zeros(4, np.float32))
    assert faint.log10_intensity == pytest.approx(-300)
    assert (SINGLE[0] * 1e-300).log10_intensity == pytest.approx(-300)


@rows(
    "bright, decimal",
    [
        (op.Light([1.0, 0.5, 0.0, 0.2]) / 1e-310, 310),
        (op.Light([1.0, 0.5, 0.0, 0.2]) * 1e300 * 1e300, 600),
        (op.Light(np.array([1.0, 0.5, 0.0, 0.2], np.float32)) * 1e60, 60),
        (op.Mueller(np.eye(4, dtype="f4")) @ op.Light([1e60, 0.5e60, 0.0, 0.2e60]), 60),
        (op.Light([1e60, 0.5e60, 0.0, 0.2e60]) + op.Light(np.zeros(4, np.float32)), 60),
    ],
)
def test_light_brighter_than_floats_has_an_exponent(bright, decimal):
    np.testing.assert_allclose(bright.log10_intensity, decimal, rtol=1e-7)
    np.testing.assert_allclose(bright.dop, np.sqrt(0.29), rtol=1e-7)
    half_way = 10.0 ** (-decimal / 2)
    back = bright * half_way * half_way
    np.testing.assert_allclose(back.stokes, [1.0, 0.5, 0.0, 0.2], rtol=1e-6)
    assert not back.exponent
    assert eval(repr(bright), {"Light": op.Light}).exponent == bright.exponent  # noqa: S307


@rows("factor", [1e-320, 5e-324, 1e-30])
def test_light_that_is_dimmed_keeps_its_digits(factor):
    light = op.Light([1.0, 0.5, 0.0, 0.2])
    for dimmed in (light * factor, light * factor * factor, light * factor / 3.0):
        np.testing.assert_allclose(dimmed.dop, np.sqrt(0.29), rtol=1e-15)
        np.testing.assert_allclose(dimmed.normalized, light.stokes, rtol=1e-15)


def test_several_lights_are_made_one_batch_as_the_sentence_says():
    a, b = op.Light(THREE[0]), op.Light(THREE[1])
    with pytest.raises(op.ShapeError, match=r"op\.Light\(\[a\.stokes, b\.stokes\], a\.frame\)"):
        op.Light([a, b])
    assert op.Light([a.stokes, b.stokes], a.frame)[1] == b


ANGLES = np.array([[0.0, 0.1, 0.2], [0.3, 0.4, 0.5]])
SHEETS = op.Interface(1.5, 0.8, azimuth=ANGLES).mueller()
RETARDERS = op.Retarder(ANGLES).mueller()


@rows("key", [0, (1, 2), (..., 1), slice(1), ANGLES > 0.2, (None, 0)])
def test_a_part_of_a_batch_of_matrices_is_that_of_its_values(key):
    expected = op.Interface(1.5, 0.8, azimuth=ANGLES[key]).mueller()
    np.testing.assert_allclose(
        SHEETS[key].matrix, expected.matrix * np.ones_like(SHEETS[key].matrix)
    )
    np.testing.assert_allclose(SHEETS[key].frame_in.x, expected.frame_in.x, rtol=1e-15)
    expected = op.Retarder(ANGLES[key]).mueller().matrix
    np.testing.assert_allclose(RETARDERS[key].matrix, expected, rtol=1e-15, atol=1e-16)


@rows("call", [len, iter, list, bool, lambda m: m[0, 1], lambda m: m.reshape(2)])
def test_a_single_matrix_is_no_batch_and_says_so(call):
    with pytest.raises(op.OptipathError, match=r"Mueller matri(x|ces).*(mueller\.matrix|shape 2)"):
        call(op.Mueller(np.eye(4)))
