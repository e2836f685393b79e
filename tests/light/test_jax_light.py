"""Light and Mueller of JAX's arrays: those that are known, and those that JAX traces."""

import numpy as np
import pytest

import optipath as op
from light_figures import FIGURES as LIGHT
from tables import rows

jax = pytest.importorskip("jax")
jnp = jax.numpy

STOKES = np.array([[2.0, 0.6, -0.3, 0.8], [1.0, 1 / 3, 0.2, 0.1]])
MATRIX = np.array(op.Interface(0.6 + 2.1j, 0.8).mueller().matrix)
POLARIZER, TURNED = op.Polarizer(0.3), op.Frame().turned(0.3)
MUELLER = [
    *["diattenuation", "diattenuation_vector", "polarizance", "polarizance_vector", "psi"],
    *["delta", "depolarization_index", "retardance", "coherency", "cloude_eigenvalues"],
]


def doubles(values):
    """Return an array of JAX's in float64, for use where its x64 is off."""
    jax.config.update("jax_enable_x64", val=True)
    try:
        return jax.numpy.array(values, np.float64)
    finally:
        jax.config.update("jax_enable_x64", val=False)


def test_figures_of_what_is_known_and_what_is_done_to_it_keep_its_precision():
    light, metal = op.Light(STOKES), op.Mueller(MATRIX)
    same, same_metal = op.Light(doubles(STOKES)), op.Mueller(doubles(MATRIX))
    for one, other, names in ((light, same, LIGHT), (metal, same_metal, MUELLER)):
        for name in names:
            expected, found = getattr(one, name), getattr(other, name)
            np.testing.assert_array_equal(found, expected, err_msg=name)
            assert found.dtype == expected.dtype, name
    frame = op.Frame().turned(0.3)
    for found, expected in (
        *[(same, light), (same + same, light + light), (same_metal, metal)],
        *[(same_metal @ same, metal @ light), (same_metal @ same_metal, metal @ metal)],
        (same.in_frame(frame), light.in_frame(frame)),
        (same_metal.nearest_physical(), metal.nearest_physical()),
    ):
        assert found == expected
    assert same_metal.is_physical()


@rows(
    "figure",
    [
        *[lambda m: m.coherency, lambda m: m.cloude_eigenvalues, lambda m: m.is_physical()],
        lambda m: m.nearest_physical().matrix,
        *[lambda m: m.lu_chipman().retarder.matrix, lambda m: m.retardance],
    ],
)
def test_what_takes_numbers_says_so_where_jax_traces(figure):
    with pytest.raises(op.errors.ParameterError, match="numbers, not values that JAX traces"):
        jax.jit(lambda m: figure(op.Mueller(m)))(MATRIX)


def test_light_that_jax_traces_is_no_array_and_tolerances_are_known():
    with pytest.raises(op.errors.ParameterError, match="tolerance"):
        jax.jit(lambda t: op.Mueller(np.eye(4)).is_physical(t))(1e-9)
    with pytest.raises(op.errors.ParameterError, match=r"take light\.stokes"):
        jax.jit(lambda s: jnp.asarray(op.Light(s)))(STOKES)


DONE = [
    *[lambda light, _: light.log10_intensity, lambda light, _: sum(light).stokes],
    *[lambda light, _: (2 * light).stokes, lambda light, _: (light / 3).stokes],
    *[lambda light, _: light[0].stokes, lambda light, _: light[..., 1].stokes],
    *[
        lambda light, _: light.reshape(1, 2).stokes,
        lambda light, _: light.in_frame(TURNED).stokes,
    ],
    lambda light, _: (light + op.Light([1.0, 0, 0, 0], TURNED)).stokes,
    lambda light, _: (op.Light([1.0, 0, 0, 0], TURNED) + light).stokes,
    *[lambda light, metal: (metal @ light).stokes, lambda light, _: (POLARIZER @ light).stokes],
    lambda light, metal: (POLARIZER.mueller() @ metal @ light).stokes,
    lambda light, _: (POLARIZER.mueller() @ light).dop,
]


def test_what_is_done_to_light_that_jax_traces_is_what_numpy_does(jacobian):
    def traced(stokes, metal):
        return [done(op.Light(stokes), op.Mueller(metal)) for done in DONE]

    expected, found = traced(STOKES, MATRIX), jax.jit(traced)(STOKES, MATRIX)
    slopes = jacobian(traced)(jnp.array(STOKES), jnp.array(MATRIX))
    for number, wanted in enumerate(expected):
        told = f"number {number} of what is done"
        np.testing.assert_allclose(found[number], wanted, rtol=1e-6, atol=1e-6, err_msg=told)
        assert np.isfinite(slopes[number]).all(), told


def test_the_degree_of_polarisation_has_a_slope_at_unpolarised_light():
    slope = jax.grad(lambda s: op.Light(s).dop)
    np.testing.assert_allclose(slope(jax.numpy.array([1.0, 0.0, 0.0, 0.0])), 0.0)
    found = slope(jax.numpy.array([1.0, 0.6, 0.0, 0.8]))
    np.testing.assert_allclose(found, [-1.0, 0.6, 0.0, 0.8], rtol=1e-5, atol=1e-7)


@rows(
    "ask",
    [
        lambda a: op.Interface(a + 3.4j, 1.1).mueller().delta,
        lambda a: (op.Polarizer(a) @ op.Light([1.0, 0.0, 0.0, 0.0])).S0,
        lambda a: op.refraction_angle(1.5, a),
        lambda a: op.Frame().turned(a).x[0],
        lambda a: op.Light(jnp.ones(4) * a) == op.Light(jnp.ones(4) * a),
        lambda a: op.Mueller(jnp.eye(4) * a) == op.Mueller(jnp.eye(4) * a),
    ],
)
def test_what_takes_numbers_alone_says_so_of_what_jax_traces(ask):
    def traced(number):
        return 1.0 * ask(number)

    with pytest.raises(op.OptipathError, match=r"JAX traces; do it outside of jit and grad"):
        jax.jit(traced)(0.2)


@pytest.mark.usefixtures("jax")
def test_a_default_that_jax_traces_has_a_slope(jacobian):
    def intensity(angle):
        first = op.Polarizer(op.Parameter("angle", default=angle))
        return (op.Source() >> first >> op.Polarizer(0.0) >> op.Detector()).trace().S0

    # Half of cos^2 has the slope -sin cos.
    slope = jacobian(intensity)(0.3)
    np.testing.assert_allclose(slope, -np.sin(0.3) * np.cos(0.3), rtol=1e-12)


def test_an_index_may_be_traced_and_takes_one_of_several_frames_at_which_nobody_looks():
    lights, matrices = op.Light(STOKES), op.Retarder([0.1, 0.2]).mueller()
    np.testing.assert_allclose(jax.jit(lambda i: lights[i].S0)(1), 1.0)
    np.testing.assert_allclose(jax.jit(lambda i: lights[None][0, i].S1)(0), 0.6, rtol=1e-6)
    turned = op.Polarizer(0.0, azimuth=[0.0, 0.5, 1.0]).mueller()
    for several, place in ((matrices, 1), (turned, 2)):
        found = jax.jit(lambda i, several=several: several[i].matrix)(place)
        np.testing.assert_allclose(found, several.matrix[place], rtol=1e-6)
    lights, world = turned @ op.Light(STOKES[0]), op.Frame()
    found = jax.jit(lambda i: (2 * lights[i]).stokes)(2)
    np.testing.assert_allclose(found, 2 * lights.stokes[2], rtol=1e-6)
    with pytest.raises(op.errors.FrameError, match=r"light\.in_frame\(frame\)\[i\]"):
        jax.jit(lambda i: lights[i].in_frame(world).stokes)(2)
    cured = jax.jit(lambda i: lights.in_frame(world)[i].stokes)(2)
    np.testing.assert_allclose(cured, lights[2].in_frame(world).stokes, rtol=1e-6)


@rows("done", [lambda light, x: light * x, lambda light, x: light / x])
def test_a_factor_that_light_does_not_have_makes_it_nan_with_its_slopes(done):
    light = op.Light(STOKES[1])
    for made in (lambda x: done(light, x).S0, lambda x: done(op.Light(abs(x) * STOKES[1]), x).S0):
        found = jax.jit(jax.vmap(jax.value_and_grad(made)))(jnp.array([-1.0, jnp.inf, jnp.nan]))
        assert np.isnan(found).all()
    times = jax.jit(jax.vmap(jax.value_and_grad(lambda x: (light * x).S0)))
    found = times(jnp.array([0.0, 2.0]))
    np.testing.assert_array_equal(found, [[0.0, 2.0], [1.0, 1.0]])
    assert np.isnan(jax.jit(lambda x: (light / x).S0)(0.0))


def test_a_traced_matrix_that_makes_no_light_of_light_gives_nan_with_its_slopes():
    def made(x, light):
        return (
            op.Mueller(jnp.diag(jnp.array([3.0, 0.0, 0.0, 1.0]) * x ** jnp.arange(4))) @ light
        ).S3

    light = op.Light([1.0, 0.0, 0.0, 1.0])
    both = jax.jit(jax.vmap(jax.value_and_grad(lambda x: made(x, light))))
    value, slope = both(jnp.array([1.0, 2.0]))
    # x^3 is no more than 3.
    np.testing.assert_allclose(value, [1.0, np.nan])
    np.testing.assert_allclose(slope, [3.0, np.nan])
    free = op.Light([1.0, 0.0, 0.0, 1.0], physical=False)
    np.testing.assert_allclose(jax.jit(lambda x: made(x, free))(2.0), 8.0)


@pytest.mark.usefixtures("jax")
def test_frames_of_traced_vertices_are_made_where_somebody_asks_alone():
    plan = op.path_from_vertices(op.Parameter("points"), materials=[1.3 + 3.4j]).compose()
    points = np.array([[0, 0, 2], [0, 0, 0], [1, 2, 1.0]])
    both = np.stack([points, points * [1, 2, 1]])

    def found(points):
        light, matrix = plan.run(points=points), plan.mueller(points=points)
        return [
            *[(2 * light).stokes, (light / 3 + 2 * light).stokes, light[0].stokes],
            *[jnp.stack([one.stokes for one in light]), light.reshape(2, 1)[:, 0].stokes],
            *[matrix.matrix, matrix[0].matrix],
        ]

    for traced, known in zip(jax.jit(found)(both), found(both), strict=True):
        np.testing.assert_allclose(traced, known, rtol=1e-12, atol=1e-14)
