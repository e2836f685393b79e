"""Light and Mueller matrices as arrays: shapes, parts, numpy and JAX."""

import pickle

import numpy as np
import pytest

import optipath as op
from tables import rows

THREE = [[1.0, 0.0, 0.0, 0.0], [2.0, 1.0, 0.0, -1.0], [4.0, 0.0, 3.0, 0.0]]
ONE, SEVERAL, STATE = op.Light(THREE[0]), op.Light(THREE), op.Light([1.0, 0.5, 0.0, 0.2])
TURNED = op.Frame().turned(0.3)
ANGLES = np.array([[0.0, 0.1, 0.2], [0.3, 0.4, 0.5]])
SHEETS = op.Interface(1.5, 0.8, azimuth=ANGLES).mueller()
RETARDERS = op.Retarder(ANGLES).mueller()


def test_components_have_their_names_and_those_that_are_not_read_are_nan():
    components = [SEVERAL.S0, SEVERAL.S1, SEVERAL.S2, SEVERAL.S3]
    np.testing.assert_array_equal(components, np.transpose(THREE))
    assert op.load_preset("malus").trace(angle=0.0).S1 == 0.5
    light = op.load_preset("malus").reading("intensity").trace()
    assert pytest.approx(0.375) == light.S0
    assert np.isnan([light.S1, light.S2, light.S3]).all()


def test_a_batch_has_a_shape_and_is_gone_through_one_by_one():
    light = op.Light(np.ones((2, 3, 4)) * [1, 0, 0, 0])
    for batch in (light, RETARDERS):
        assert (batch.shape, batch.ndim, batch.size, len(batch)) == ((2, 3), 2, 6, 2)
        assert batch.reshape(3, 2).shape == batch.reshape((3, -1)).shape == (3, 2)
        assert [row.shape for row in batch] == [(3,), (3,)]
    assert (ONE.shape, ONE.ndim, ONE.size, op.Mueller(np.eye(4)).shape) == ((), 0, 1, ())
    with pytest.raises(op.errors.ShapeError, match=r"6 lights of shape \(2, 3\)"):
        light.reshape(4)
    assert list(SEVERAL) == [op.Light(stokes) for stokes in THREE]


@rows(
    "key",
    [1, -1, slice(1, None), [2, 0], (..., 0), (None, 1), np.array([True, False, True]), ..., ()],
)
def test_an_index_is_one_of_the_batch(key):
    places = np.arange(3)[key]
    np.testing.assert_array_equal(SEVERAL[key].stokes, np.array(THREE)[places])
    assert SEVERAL[key].shape == places.shape


@rows("key", [0, (1, 2), (..., 1), slice(1), ANGLES > 0.2, (None, 0)])
def test_a_part_of_a_batch_of_matrices_is_that_of_its_values(key):
    expected, found = op.Interface(1.5, 0.8, azimuth=ANGLES[key]).mueller(), SHEETS[key]
    np.testing.assert_allclose(found.matrix, expected.matrix * np.ones_like(found.matrix))
    np.testing.assert_allclose(found.frame_in.x, expected.frame_in.x, rtol=1e-15)
    expected = op.Retarder(ANGLES[key]).mueller().matrix
    np.testing.assert_allclose(RETARDERS[key].matrix, expected, rtol=1e-15, atol=1e-16)


def test_frames_are_indexed_along():
    frames = op.Frame().turned([0.0, 0.1, 0.2])
    light = op.Light(THREE, frames)
    assert light[2] == op.Light(THREE[2], op.Frame().turned(0.2))
    assert light[1] == op.Light(THREE[1], op.Frame().turned(0.1))
    assert pickle.loads(pickle.dumps(light[1:])) == light[1:]
    grid = op.Light(np.broadcast_to(THREE, (2, 3, 4)), frames)
    np.testing.assert_array_equal(grid[1, 2].frame.x, op.Frame().turned(0.2).x)
    np.testing.assert_array_equal(grid[:, 1:].frame.x[0], frames.x[1:])
    light = op.Light([1.0, 1.0, 0.0, 0.0], op.Frame().turned([0.0, np.pi / 2]))
    assert light.shape == (2,)
    np.testing.assert_allclose(sum(light).stokes, [2, 0, 0, 0], rtol=0, atol=1e-15)
    chain = op.VerticesByAngles(incidences=(0.3, op.Parameter("delta")), turns=(-0.5,))
    path = op.path_from_vertices(chain, materials=[1.5, 1.5])
    light, alone = path.trace(delta=[0.1, 0.2]), path.trace(delta=0.2)
    np.testing.assert_allclose(light[1].stokes, alone.stokes, rtol=1e-14)
    np.testing.assert_allclose(light[1].frame.x, alone.frame.x, rtol=1e-14)


def test_a_single_light_or_matrix_is_no_batch_and_an_index_that_does_not_fit_is_told():
    assert issubclass(op.errors.LightError, TypeError)
    matrix = op.Mueller(np.eye(4))
    for call in (len, iter, list, bool):
        with pytest.raises(op.errors.LightError, match=r"light\.stokes"):
            call(ONE)
        with pytest.raises(op.errors.LightError, match=r"mueller\.matrix"):
            call(matrix)
    with pytest.raises(op.OptipathError, match=r"Mueller matrix.*mueller\.matrix"):
        matrix[0, 1]
    with pytest.raises(op.OptipathError, match=r"Mueller matrices.*shape 2"):
        matrix.reshape(2)
    batch = SEVERAL[:, None]
    wrong = ["S0", slice("a", "b"), slice(0, 2, 0), [[0, 1], [2]]]
    for light, keys in ((ONE, [0, (..., 0), *wrong]), (batch, [(0, 0, 0), *wrong])):
        for key in keys:
            with pytest.raises(
                op.errors.IndexFault, match=r"not fit, .* light\.stokes\[\.\.\., 0\]"
            ):
                light[key]


@rows("factor", [2, 2.0, np.float64(2), np.float32(2), np.array(2), True + True])
def test_light_times_a_number_is_light(factor):
    light, doubled = op.Light(THREE, TURNED), op.Light(2 * np.array(THREE), TURNED)
    assert factor * light == light * factor == doubled
    assert doubled / factor == light


def test_factors_broadcast_over_the_batch_and_lose_no_precision():
    light = np.array([1.0, 2.0]) * op.Light(THREE[1])
    assert light == op.Light([THREE[1], [4.0, 2.0, 0.0, -2.0]])
    assert (np.ones((2, 1)) * SEVERAL).shape == (2, 3)
    with pytest.raises(op.errors.ShapeError, match=r"light \(3,\), factor \(2,\)"):
        SEVERAL * [1.0, 2.0]
    single = op.Light(np.array([1.0, 0.5, 0.0, 0.0], np.float32))
    assert (0.1 * single).stokes.dtype == np.float32
    for factor in (1e-130, 1e-30):
        for dimmed in (STATE * factor, STATE * factor * factor, STATE * factor / 3.0):
            np.testing.assert_allclose(dimmed.dop, np.sqrt(0.29), rtol=1e-15)
            np.testing.assert_allclose(dimmed.normalized, STATE.stokes, rtol=1e-15)


REFUSED = {
    "no -1-fold": [lambda light: -1 * light],
    "no -0.5-fold": [lambda light: np.array([1.0, -0.5]) * light],
    "no nan-fold": [lambda light: light * np.nan],
    "no inf-fold": [lambda light: light * np.inf],
    "1j is no real number": [lambda light: 1j * light],
    "'twice' is no real number": [lambda light: light * "twice"],
    "light times light": [lambda light: light * light],
    "0 divides none": [lambda light: light / 0],
    "differences, powers and divisors": [
        *[lambda light: 2 / light, lambda light: light - light],
        *[lambda light: -light, lambda light: light**2],
    ],
    "1.0 is no light": [lambda light: light + 1.0, lambda light: 1.0 + light],
    "write element @ light": [
        *[lambda light: light @ np.eye(4), lambda light: op.Polarizer(0) * light],
        lambda _: op.Polarizer(0.1) @ [1.0, 0.0, 0.0, 0.0],
    ],
    "matrix @ light": [lambda light: light * op.Mueller(np.eye(4))],
    r"Mueller\(matrix\) @ light": [lambda light: np.eye(4) @ light],
    r"numpy.mean takes numbers.* the mean of lights is sum\(lights\) / len": [np.mean],
    **{f"numpy.{f.__name__} takes numbers": [f] for f in (np.sin, np.sum, np.max, np.sort)},
    "numpy.percentile takes": [lambda light: np.percentile(light, 50)],
    "numpy.dot takes numbers": [lambda light: np.dot(np.eye(4), light)],
    "numpy.add takes numbers": [lambda light: np.add(light, light, out=np.ones(4))],
    "numpy.add.reduce takes": [np.add.reduce],
}


@rows("sentence, wrong", [(words, each) for words, several in REFUSED.items() for each in several])
def test_what_light_cannot_do_is_refused_in_words(wrong, sentence):
    with pytest.raises(op.errors.LightError, match=sentence):
        wrong(ONE)


def test_lights_are_summed_up_in_the_frame_of_the_first():
    one, other = op.Light(THREE[1]), op.Light(THREE[2], op.Frame().turned(np.pi / 4))
    total = sum([one, other])
    assert total.frame == one.frame
    np.testing.assert_allclose(total.stokes, [6.0, -2.0, 0.0, -1.0], atol=1e-15)
    assert sum(SEVERAL) == op.Light([7.0, 1.0, 3.0, -1.0])
    assert sum(SEVERAL) / len(SEVERAL) == op.Light(np.mean(THREE, axis=0))


def test_numpy_reads_the_numbers_of_light_and_of_matrices():
    assert np.asarray(SEVERAL, dtype=np.float32).dtype == np.float32
    assert np.asarray(RETARDERS, dtype=np.float32).shape == (2, 3, 4, 4)
    assert np.shape(SEVERAL) == (3,)
    np.testing.assert_array_equal(np.array(SEVERAL), THREE)
    np.testing.assert_array_equal(np.concatenate([SEVERAL, SEVERAL]), [*THREE, *THREE])
    np.testing.assert_array_equal(np.array(THREE) == SEVERAL, np.ones((3, 4), bool))
    np.testing.assert_array_equal(np.asarray(op.Mueller(np.eye(4))), np.eye(4))
    assert np.allclose(SEVERAL, THREE)
    assert np.array_equal(SEVERAL, SEVERAL)
    assert np.isfinite(SEVERAL).all()
    copy = np.array(SEVERAL, copy=True)
    copy[...] = 0.0
    assert SEVERAL.S0[0] == 1.0
    for make in (op.Light, lambda light: op.load_preset("malus").trace(angle=light)):
        with pytest.raises(op.OptipathError, match=r"as in op\.Source\(stokes=light\.stokes\)"):
            make(ONE)
    a, b = op.Light(THREE[0]), op.Light(THREE[1])
    with pytest.raises(op.errors.ShapeError, match=r"give light\.stokes"):
        op.Light([a, b])
    assert op.Light([a.stokes, b.stokes], a.frame)[1] == b


def test_an_element_acts_on_light_and_on_matrices_as_its_matrix_does():
    behind = op.Polarizer(0.2) @ op.Light([2.0, 0.0, 0.0, 0.0], TURNED)
    assert behind.frame == TURNED
    np.testing.assert_allclose(behind, [1.0, np.cos(0.4), np.sin(0.4), 0.0], atol=1e-15)
    # An azimuth turns the element, and the frame behind it with it.
    turned = op.Polarizer(azimuth=0.2) @ op.Light([2.0, 0.0, 0.0, 0.0], TURNED)
    np.testing.assert_allclose(turned.in_frame(TURNED), behind, atol=1e-15)
    path, light = op.Source(stokes=[1.0, 0.5, 0.3, 0.1]), op.Light([1.0, 0.5, 0.3, 0.1])
    for element in (
        op.Polarizer(0.2, azimuth=0.3),
        op.Interface(1.5 + 0.2j, incidence=[0.4, 1.2], azimuth=0.7),
        op.Retarder(1.0, 0.3),
        op.Diattenuator(0.9, 0.2, angle=0.1),
    ):
        path, light = path >> element, element @ light
    np.testing.assert_allclose(light, (path >> op.Detector()).trace(), rtol=0, atol=1e-15)
    light = op.Light([1.0, 0.2, 0.3, 0.4])
    both = op.Retarder(1.0, 0.3) @ op.Polarizer(0.2).mueller()
    np.testing.assert_allclose(both @ light, op.Retarder(1.0, 0.3) @ (op.Polarizer(0.2) @ light))
    with pytest.raises(op.errors.PathError, match="parameter 'a' of polarizer has no value yet"):
        op.Polarizer(op.Parameter("a")) @ light
    with pytest.raises(op.errors.PathError, match="in -> reflected"):
        op.BeamSplitter() @ light


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
        *[SINGLE + SINGLE, SINGLE + ONE, ONE + SINGLE, SINGLE * np.float64(0.3)],
        *[SINGLE / [0.3, 0.7], SINGLE.in_frame(TURNED), op.Retarder(0.3, 0.2) @ SINGLE],
        op.Mueller(op.Retarder(0.3).mueller().matrix.astype("f4")) @ op.Light([1.0, 0, 0, 1.0]),
    ],
)
def test_light_keeps_the_coarser_precision_and_is_light(made):
    assert made.stokes.dtype == np.float32
    assert op.Light.from_("mitsuba", made.to("mitsuba")).dop.max() <= 1 + 2.0**-22


def test_light_in_any_precision_stays_light():
    rng = np.random.default_rng(3)
    states = rng.normal(size=(2000, 3))
    states /= np.linalg.norm(states, axis=-1, keepdims=True)
    light = op.Light(np.concatenate([np.ones((2000, 1)), states], axis=-1).astype(np.float32))
    for turn in rng.uniform(0.1, 3.0, 30):
        light = 0.9 * (op.Retarder(turn, 2.0 * turn) @ light)
        assert op.Light(light.stokes) == light
        assert op.Source(stokes=light.stokes).stokes.dtype == np.float32
