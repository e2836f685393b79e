"""Certificates of intensities, and what is tolerated within them."""

import pickle
from typing import ClassVar

import numpy as np
import pytest

import optipath as op
from paths import chain
from random_matrices import bordered, jones, of_jones, unit_vectors
from random_paths import Draw
from tables import rows, slow, slow_except
from wired import wired

ROOT = 1.0 / np.sqrt(3.0)
NO_ROW_TOO_LONG = bordered(np.full((3, 3), ROOT))
REFUSED = r"'e0' is unphysical, having a coherency eigenvalue of -.*Mueller\(matrix\)\.nearest_phys"


class OwnElement(op.Element, kind="test-own-matrix"):
    physical: ClassVar[bool] = False
    share: float = 1.0

    @staticmethod
    def mueller_rows(xp, share):
        inner = [xp.absolute(share) * ROOT] * 3
        return (1.0, 0.0, 0.0, 0.0), *[(0.0, *inner)] * 3


def measured(matrix):
    """An element of any matrix, which bounds must look at themselves."""
    return op.MuellerElement(matrix, physical=False)


def enclosed(found, true):
    """Whether intensities are within their bounds."""
    lower, upper = found.lower * found.scalar, found.upper * found.scalar
    return bool(np.all((lower <= true) & (true <= upper)))


def assert_refused_in_every_way(path, **values):
    """Everything that gives a bound, or rests on one."""
    plan, tolerated = path.compose(), op.Composer(tolerance=0.5).compose(path)
    for asked in (
        lambda: plan.certificate(**values),
        lambda: tolerated.run(**values),
        lambda: list(tolerated.stream(100, **values)),
        lambda: op.polarization(path, **values),
    ):
        with pytest.raises(op.errors.ParameterError, match=REFUSED):
            asked()


def physical(rng, *shape, terms=4):
    """Sums of pure matrices, M00 being 1: on the boundary of what is physical below four."""
    matrix = of_jones(jones(rng, *shape, terms)).sum(axis=-3)
    return matrix / matrix[..., :1, :1]


def unphysical_with_short_rows(rng, count):
    """Matrices no row or column of which is too long, an eigenvalue being negative even so."""
    found = bordered(rng.normal(size=(20 * count, 3, 3)))
    found[:, 0, 1:], found[:, 1:, 0] = rng.normal(size=(2, 20 * count, 3)) * rng.random()
    lengths = [np.linalg.norm(found[:, 1:], axis=-1), np.linalg.norm(found[..., 1:], axis=-2)]
    longest = np.concatenate([*lengths, np.linalg.norm(found[:, :1, 1:], axis=-1)], axis=-1)
    longest = longest.max(axis=-1)
    found[:, 0, 1:] /= longest[:, None]
    found[:, 1:] /= longest[:, None, None]
    values = op.Mueller(found).cloude_eigenvalues
    return found[values[:, 3] < -1e-6][:count]


@rows("element", [measured(NO_ROW_TOO_LONG), OwnElement()])
def test_no_bound_is_given_for_an_unphysical_matrix(element):
    path = chain([element, op.Polarizer(0.3)], [1.0, *[ROOT] * 3], reads="intensity")
    assert_refused_in_every_way(path)


@rows("size", [(), (3,), (2500,)])
@rows("own", [True, False])
def test_one_unphysical_matrix_of_a_batch_is_refused(size, own):
    values, element = (
        {"M": np.broadcast_to(np.eye(4), (*size, 4, 4)).copy()},
        measured(op.Parameter("M")),
    )
    values["M"][-1 if size else ...] = NO_ROW_TOO_LONG
    if own:
        element, values = OwnElement(op.Parameter("s")), {"s": np.full(size, 0.1)}
        values["s"][-1 if size else ...] = 1.0
    path = chain([element, op.Polarizer(0.3)], [1.0, 0.6, 0.0, 0.0], reads="intensity")
    assert_refused_in_every_way(path, **values)


@rows("dtype", ["float64", "float32", "longdouble"])
def test_every_matrix_with_a_negative_eigenvalue_is_refused_however_short_its_rows(dtype):
    plan = op.Composer(dtype=dtype).compose(chain([measured(op.Parameter("M"))]))
    for matrix in unphysical_with_short_rows(np.random.default_rng(1), 100):
        if op.Mueller(matrix).is_physical(1e-4):
            continue
        with pytest.raises(op.errors.ParameterError, match=REFUSED):
            plan.certificate(M=matrix)
        plan.certificate(M=op.Mueller(matrix).nearest_physical().matrix)


@pytest.mark.parametrize("terms", slow_except([1, 4], [1, 2, 3, 4]))
def test_no_physical_matrix_is_refused_whatever_engine_bounds_it(terms):
    rng = np.random.default_rng(terms)
    scale = rng.choice([1e-150, 1e-3, 1.0], (20_000, 1, 1))
    matrices = scale * physical(rng, 20_000, terms=terms)
    path = chain([measured(op.Parameter("M"))], [1.0, 0.8, 0.0, 0.6], reads="intensity")
    compiled, fallback = (
        op.Composer(engine=engine).compose(path).certificate(M=part)
        for engine, part in (("numba", matrices), ("numpy", matrices[:500]))
    )
    np.testing.assert_allclose(compiled.upper[:500], fallback.upper, rtol=1e-11)
    np.testing.assert_allclose(compiled.lower[:500], fallback.lower, rtol=0.0, atol=1e-11)


def behind(state, matrices):
    for matrix in matrices:
        state = (matrix @ state[..., np.newaxis])[..., 0]
    return state[..., 0]


def drawn(rng, count, length, terms):
    """Sources of any degree of polarisation, and Jones matrices of what they meet."""
    dop = rng.choice([0.0, 1.0, 0.9], (count, 1)) * rng.random((count, 1)) ** 0.1
    state = np.concatenate([np.ones((count, 1)), dop * unit_vectors(rng, count)], axis=-1)
    return state, jones(rng, length, count, terms)


@pytest.mark.parametrize("terms", slow_except([1, 4], [1, 2, 3, 4]))
@rows("length", [2, 3])
@rows("end", ["lower", "upper"])
def test_no_physical_matrices_found_by_climbing_violate_a_bound(terms, length, end):
    rng, count = np.random.default_rng([terms, length]), 500
    names = [f"M{i}" for i in range(length)]
    elements = [measured(op.Parameter(name)) for name in names]
    path = chain(elements, op.Parameter("state"), reads="intensity")
    plan = op.Composer(engine="numpy").compose(path)

    def nearness(state, T):
        """How near the bound the intensity comes: at most 1."""
        matrices = of_jones(T).sum(axis=-3)
        matrices /= matrices[..., :1, :1]
        found = plan.certificate(state=state, **dict(zip(names, matrices, strict=True)))
        true = behind(state, matrices)
        assert enclosed(found, true)
        if end == "upper":
            return true / (found.upper * found.scalar)
        return (1e-3 + found.lower) / (1e-3 + true / found.scalar)

    state, T = drawn(rng, count, length, terms)
    best = nearness(state, T)
    for step in np.geomspace(1.0, 1e-3, 8):
        tried = T + step * jones(rng, length, count, terms)
        found = nearness(state, tried)
        better = found > best
        best[better], T[:, better] = found[better], tried[:, better]
    assert best.max() > 0.3


@rows("share", [1e-12, 1e-10, 0.9e-9])
def test_what_a_rounded_matrix_lacks_is_given_away_and_no_more(share):
    rng = np.random.default_rng(5)
    for _ in range(30):
        first, second = physical(rng, 2, terms=1)
        # An eigenvalue as negative as is taken for a rounding.
        spoilt = first - share * physical(rng, terms=1)
        spoilt /= spoilt[0, 0]
        state = np.concatenate([np.ones((200, 1)), unit_vectors(rng, 200)], axis=-1)
        found, exact = (
            chain(list(map(measured, pair)), state).compose().certificate()
            for pair in ([spoilt, second], [first, second])
        )
        assert enclosed(found, behind(state, [spoilt, second]))
        np.testing.assert_allclose(found.upper, exact.upper, rtol=50.0 * share)


@rows("engine", ["numpy", "numba"])
def test_light_polarised_by_a_rounding_too_much_stays_within_its_bounds(engine):
    rng = np.random.default_rng(8)
    axes = unit_vectors(rng, 20_000) * [1.0, 1.0, 1e-7]
    axes /= np.linalg.norm(axes, axis=-1, keepdims=True)
    state = np.concatenate([np.ones((20_000, 1)), (1.0 + 9e-13) * axes], axis=-1)
    angle = 0.5 * np.arctan2(axes[:, 1], axes[:, 0])
    path = chain([op.Polarizer(op.Parameter("a"))], op.Parameter("state"), reads="intensity")
    plan = op.Composer(engine=engine).compose(path)
    along = np.linalg.norm(state[:, 1:3], axis=-1)
    for turned, true in ((angle, 0.5 * (1.0 + along)), (angle + np.pi / 2, 0.5 * (1.0 - along))):
        assert enclosed(plan.certificate(a=turned, state=state), np.maximum(true, 0.0))


def test_matrices_are_bounded_in_single_precision_and_refused_if_unphysical():
    rng = np.random.default_rng(6)
    matrices = physical(rng, 200, terms=1).astype(np.float32)
    state = np.concatenate([np.ones((200, 1)), 0.999 * unit_vectors(rng, 200)], axis=-1)
    for matrix, values in ((matrices, {}), (op.Parameter("M"), {"M": matrices})):
        path = chain([measured(matrix)] * 2, state, reads="intensity")
        found = path.compose().certificate(**values)
        assert enclosed(found, behind(state, [matrices.astype(np.float64)] * 2))
        assert np.all(found.upper < 4.0)
    matrices = np.broadcast_to(np.eye(4), (20_000, 4, 4)).copy()
    matrices[12_345] = NO_ROW_TOO_LONG
    plan = op.Composer(engine="numba").compose(chain([measured(op.Parameter("M"))]))
    with pytest.raises(op.errors.ParameterError, match=REFUSED):
        plan.certificate(M=matrices)


def test_deep_extinction_and_pure_matrices_stay_within_their_certificates():
    crossed = chain([op.Polarizer(0.0, leakage=1e-12)], [1.0, -1.0, 0.0, 0.0], reads="intensity")
    assert enclosed(crossed.compose().certificate(), crossed.trace().intensity)
    turned = op.Retarder(0.4, 0.3).mueller().matrix
    assert chain([op.MuellerElement(turned)]).compose().certificate().error < 1e-12


def test_certificates_of_traced_values_are_refused_in_words():
    jax = pytest.importorskip("jax")
    path = chain([op.Interface(1.5, op.Parameter("a")), op.Polarizer(0.3)], reads="intensity")
    plan = path.compose()
    for what in (lambda a: plan.certificate(a=a).error, lambda a: plan.evaluations(a=a)):
        with pytest.raises(op.errors.ParameterError, match="not of values that JAX traces"):
            jax.jit(what)(0.3)


def two_panes(n=1.5, k=0.0, reads="intensity"):
    """Unpolarised light on two interfaces, the second turned."""
    first = op.Interface(op.Material(n, k), op.Parameter("a"))
    second = op.Interface(op.Material(n, k), op.Parameter("b"), azimuth=op.Parameter("turn"))
    return chain([first, second], reads=reads)


@rows("seed", range(50))
@pytest.mark.parametrize("more", [0, slow(50), slow(100)])
def test_no_certificate_is_violated_by_any_path(seed, more):
    draw = Draw(seed + more)
    path = draw.path()
    plan = op.Composer(model="full").compose(path)
    for name, light in plan.run_all(**draw.values).items():
        found = plan.certificate(name, **draw.values)
        lit = found.scalar > 0.0
        ratio = light.intensity[lit] / found.scalar[lit]
        assert np.all(found.lower[lit] <= ratio + 1e-13)
        assert np.all(ratio <= found.upper[lit] + 1e-13)
        assert np.all(light.intensity[~lit] == 0.0)


@rows("size", [(), (5,), (3000,), (70_000,), (40, 1, 50)])
@rows("tolerance", [1e-4, 0.01, 0.3])
def test_a_tolerated_intensity_is_as_near_as_it_may_be(size, tolerance):
    draw = np.random.default_rng(3).uniform
    values = {name: draw(0.0, 1.4, size) for name in ("a", "b", "turn")}
    path = two_panes()
    plan = op.Composer(tolerance=tolerance).compose(path)
    exact = path.trace(**values).intensity
    found = plan.run(**values)
    assert found.stokes.shape == (*size, 4)
    assert np.isnan(found.stokes[..., 1:]).all()
    assert np.all(np.abs(found.intensity - exact) <= tolerance * exact)
    certificate = plan.certificate(**values)
    beyond = certificate.error > tolerance
    np.testing.assert_allclose(found.intensity[beyond], exact[beyond], rtol=1e-14)
    np.testing.assert_array_equal(found.intensity[~beyond], certificate.scalar[~beyond])


@rows("size", [(), (5,), (3000,)])
def test_each_of_several_tolerated_intensities_is_as_near_as_it_may_be(rng, size):
    nodes = {"lamp": op.Source(), "first": op.Interface(1.5, op.Parameter("a"))}
    links = "lamp -> first"
    for way, medium, turn in (("reflected", 1.0, 0.3), ("transmitted", 1.5, op.Parameter("turn"))):
        nodes[f"pane {way}"] = op.Interface(2.0, op.Parameter("b"), outside=medium, azimuth=turn)
        nodes[f"eye {way}"] = op.Detector("intensity")
        links += f", first.{way} -> pane {way}, pane {way}.reflected -> eye {way}"
    path = wired(nodes, links)
    plan = op.Composer(tolerance=0.1).compose(path)
    for most in (0.3, 1.4):
        values = {name: rng.uniform(0.1, most, size) for name in ("a", "b", "turn")}
        exact, found = path.trace_all(**values), plan.run_all(**values)
        bounds = {name: plan.certificate(name, **values) for name in found}
        near = np.max([each.error for each in bounds.values()], axis=0) <= 0.1
        for name, light in found.items():
            wanted = exact[name].intensity
            assert np.all(np.abs(light.intensity - wanted) <= 0.1 * wanted)
            expected = np.where(near, bounds[name].scalar, wanted)
            np.testing.assert_allclose(light.intensity, expected, rtol=1e-13)


def test_the_certificate_of_two_interfaces_is_reached():
    path, values = two_panes(), {"a": 0.7, "b": 0.7}
    aligned, crossed = (path.trace(turn=turn, **values).intensity for turn in (0.0, np.pi / 2))
    found = path.compose().certificate(turn=0.3, **values)
    assert aligned == pytest.approx(found.upper * found.scalar, rel=1e-12)
    assert crossed == pytest.approx(found.lower * found.scalar, rel=1e-12)


@rows("model", ["sp", "linear"])
def test_a_model_by_name_may_be_tolerated_too(model):
    metal = op.Interface(op.Material(0.2, 3.0), op.Parameter("a"), azimuth=0.4)
    path = chain([metal] * 4, reads="intensity")
    assert path.compose().model == "full"
    values = {"a": np.linspace(0.0, 1.5, 400)}
    exact = path.trace(**values).intensity
    plan = op.Composer(model=model, tolerance=0.05).compose(path)
    assert plan.model == model
    found = plan.run(**values).intensity
    assert np.all(np.abs(found - exact) <= 0.05 * exact)
    assert np.any(found != exact)


def test_where_more_is_read_than_the_intensity_the_plan_stays_exact():
    path = two_panes(k=2.0, reads="stokes")
    plan = op.Composer(tolerance=0.5).compose(path)
    assert plan.model == "full"
    with pytest.raises(op.errors.ComposerError, match=r"not exact .* let all read 'intensity'"):
        op.Composer(model="scalar", tolerance=0.5).compose(path)


def test_tolerated_plans_stream_and_can_be_pickled():
    plan = op.Composer(tolerance=0.02).compose(two_panes())
    plan = pickle.loads(pickle.dumps(plan))
    axes = {"a": np.linspace(0, 1.4, 40)[:, np.newaxis], "b": np.linspace(0, 1.4, 50), "turn": 0.2}
    whole = plan.run(**axes).intensity
    parts = np.full(whole.shape, np.nan)
    for part in plan.stream(300, **axes):
        parts[part.where] = part.light.intensity
    np.testing.assert_allclose(parts, whole, rtol=1e-14)


def test_faint_light_and_values_out_of_range_are_left_to_the_exact_model():
    elements = [op.Attenuator(1e-200), op.Attenuator(op.Parameter("t")), op.Interface(1.5, 0.7)]
    path = chain([*elements, op.Interface(1.5, 0.7)], reads="intensity")
    plan = op.Composer(tolerance=0.5).compose(path)
    light, exact = plan.run(t=[1e-200, 0.5]), path.trace(t=[1e-200, 0.5])
    np.testing.assert_allclose(light.log10_intensity, exact.log10_intensity, rtol=0, atol=0.3)
    plan = op.Composer(tolerance=0.1, dtype="float32").compose(two_panes())
    with pytest.raises(op.errors.ParameterError, match="'a'"):
        plan.run(a=3.0, b=0.1, turn=0.0)
    for a in (0.2, np.linspace(0.0, 1.2, 3000)):
        assert plan.run(a=a, b=0.3, turn=0.3).stokes.dtype == np.float32
